"""Columns: what every reader hands on, raw, in the coordinates of the input."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, Protocol

import numpy as np
from numpy.typing import NDArray

from symboslam.engine.landmarks import Box
from symboslam.engine.readers.crs import DEGREES

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

    from symboslam.reasoning.knowledge import Feature

Floats = NDArray[np.float64]
Progress = Callable[[str, float], None]
Tags = tuple[tuple[str, str], ...]
Kind = tuple[str, Tags]
"""What one landmark is said to be: a class name (or "") and its tags, sorted by key."""


class FeatureIndex(Protocol):
    """The part of ``Knowledge`` that readers need."""

    @property
    def features(self) -> Sequence[Feature]:
        """All feature classes."""

    @property
    def tag_keys(self) -> frozenset[str]:
        """The OSM keys that occur in the features' tags."""

    def index_of(self, name: str, /) -> int | None:
        """Position of the feature with this name."""

    def match_tags(self, tags: Mapping[str, str], /) -> int | None:
        """Position of the feature that fits these OSM tags best."""


class Codes(dict[Any, int]):
    """Numbers distinct values in the order of their first use: ``codes[value] -> number``."""

    def __missing__(self, value: Hashable) -> int:
        """Number a value that was not seen before."""
        self[value] = number = len(self)
        return number


@dataclass(frozen=True)
class Columns:
    """Landmarks of one file, column by column (n rows), before any check of their values.

    Attributes:
        source: name of the file or stream, for messages.
        x: (n,) first coordinate: longitude, easting or metres.
        y: (n,) second coordinate: latitude, northing or metres.
        kind: (n,) position in ``kinds``.
        kinds: the distinct kinds.
        place: row -> words that name its place in the input, such as ``line 7``.
        crs: coordinate system of the input: ``OGC:CRS84``, ``m`` or a name that PROJ knows.
        crs_from: who says so: nobody (``default``), the ``file``, or the ``format`` by definition.
        confidence: (n,) detection confidence, or None for 1 everywhere.
        id: n identifiers or None each; None if there are none at all.
        time: n times as text or None each; None if there are none at all.
        agent: n names of agents or None each; None if there are none at all.
        bbox: the file's area as it stands in the file, unchecked.
        surveyed: the file's ``surveyed`` member as it stands in the file, unchecked.
        find_surveyed: box in the input's coordinates -> the part of it that was looked at, None for
            all of it; only for formats whose content tells that.
        notes: remarks for the report.
        attribution: the file's licence line, unchecked.
    """

    source: str
    x: Floats
    y: Floats
    kind: NDArray[np.int32]
    kinds: Sequence[Kind]
    place: Callable[[int], str]
    crs: str = DEGREES
    crs_from: Literal["default", "file", "format"] = "default"
    confidence: Floats | None = None
    id: Sequence[str | None] | None = None
    time: Sequence[str | None] | None = None
    agent: Sequence[str | None] | None = None
    bbox: object = None
    surveyed: object = None
    find_surveyed: Callable[[Box], BaseGeometry | None] | None = None
    notes: tuple[str, ...] = ()
    attribution: str = ""

    def __len__(self) -> int:
        """Number of rows."""
        return len(self.x)
