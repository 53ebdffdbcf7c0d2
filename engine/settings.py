"""Settings: every number that steers a classification, and the profiles that bundle them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields, replace
from typing import Any

from symboslam.errors import InputError, UnknownNameError


@dataclass(frozen=True)
class Settings:
    """How evidence is weighed and how the map is cut.

    Attributes:
        profile: name of the profile these settings started from.
        evidence: ``pairs``, the paper's C and P inside a segment, or ``field``, a density of
            evidence that knows no borders (docs/evidence.md).
        measure: semantic proximity: ``path``, ``wu_palmer``, ``lin``; or ``direct``, the paper's 1.
        importance: ``entropy`` weighs a feature by how few environments it points to; ``none``.
        a: weight of C against the share of inferences (``pairs``), 0 < a < 1.
        bandwidth: standard deviation of the kernel in metres (``field``); None takes the
            ontology's, else a third of the smallest cell's side.
        dissimilarity: how much of its evidence a landmark loses when all its close neighbours
            point elsewhere, in [0, 1] (``field``).
        absence: evidence of unmarked ground per hectare (``field``); None estimates it from how
            crowded the map is where it says anything.
        cells: finest cells along each side of the map.
        threshold: a cell is split while its largest P is below this.
        min_landmarks: a cell with fewer landmarks is not split (``pairs``).
        empty: what a cell without evidence gets: ``inherit`` its parent's, or ``unknown``.
        seed_position: where the first fragment begins, in the input's coordinates (``branch``);
            None takes the densest spot.
        momentum: landmarks that are passed over between fragments (``branch``).
        reach: how far in metres a landmark stands for the ground around it, and how far apart
            neighbours may stand (``branch``); None takes what the map's density suggests.
        relevance: what a landmark says for an environment counts if it is at least this share of
            what it says for its strongest one (``branch``), in [0, 1].
    """

    profile: str = "default"
    evidence: str = "field"
    measure: str = "path"
    importance: str = "entropy"
    a: float = 0.5
    bandwidth: float | None = None
    dissimilarity: float = 0.3
    absence: float | None = None
    cells: int = 24
    threshold: float = 0.95
    min_landmarks: int = 3
    empty: str = "inherit"
    seed_position: tuple[float, float] | None = None
    momentum: int = 0
    reach: float | None = None
    relevance: float = 0.5

    def __post_init__(self) -> None:
        self._one_of("evidence", "field", "pairs")
        self._one_of("measure", "path", "wu_palmer", "lin", "direct")
        self._one_of("importance", "entropy", "none")
        self._one_of("empty", "inherit", "unknown")
        self._between("a", 0, 1, open_ends=True)
        self._between("dissimilarity", 0, 1)
        self._between("threshold", 0, 1)
        self._between("cells", 1, 4_096)
        self._between("min_landmarks", 0, 10**9)
        self._between("relevance", 0, 1)
        self._between("momentum", 0, 10**9)
        if not isinstance(self.momentum, int):
            raise InputError(f"momentum is {self.momentum}; it must be a whole number")
        if self.seed_position is not None:
            self._position("seed_position")
        if self.reach is not None:
            self._between("reach", 0, 1e9, open_ends=True)
        if self.bandwidth is not None:
            self._between("bandwidth", 0, 1e9, open_ends=True)
        if self.absence is not None:
            self._between("absence", 0, 1e9)

    def _one_of(self, name: str, *allowed: str) -> None:
        if getattr(self, name) not in allowed:
            raise InputError(f"{name} is {getattr(self, name)!r}; it can be {', '.join(allowed)}")

    def _position(self, name: str) -> None:
        value = getattr(self, name)
        good = (
            isinstance(value, tuple | list)
            and len(value) == 2
            and all(isinstance(v, int | float) and not isinstance(v, bool) for v in value)
            and all(map(math.isfinite, value))
        )
        if not good:
            raise InputError(f"{name} is {value!r}; it must be two finite numbers, x and y")

    def _between(self, name: str, low: float, high: float, open_ends: bool = False) -> None:
        value = getattr(self, name)
        if isinstance(value, bool) or not isinstance(value, int | float):
            raise InputError(f"{name} is {value!r}; it must be a number")
        inside = low < value < high if open_ends else low <= value <= high
        inside = inside and math.isfinite(value)
        if not inside:
            edges = "between" if open_ends else "from"
            joint = "and" if open_ends else "to"
            raise InputError(f"{name} is {value}; it must lie {edges} {low} {joint} {high}")

    def as_dict(self) -> dict[str, Any]:
        """All settings as plain values, for the record beside a result."""
        return asdict(self)


PROFILES: Mapping[str, Settings] = {
    "default": Settings(),
    "paper": Settings(
        profile="paper",
        evidence="pairs",
        measure="direct",
        importance="none",
        threshold=0.55,
    ),
}


def settings_of(profile: str = "default", **changes: Any) -> Settings:
    """The settings of a profile with some changed; a change that is None leaves the profile's.

    Raises:
        UnknownNameError: no such profile or setting.
        InputError: a value out of its range.
    """
    if profile not in PROFILES:
        raise UnknownNameError(f"no profile {profile!r}; there are {', '.join(PROFILES)}")
    known = {f.name for f in fields(Settings)} - {"profile"}
    for name in changes:
        if name not in known:
            raise UnknownNameError(f"no setting {name!r}; there are {', '.join(sorted(known))}")
    return replace(PROFILES[profile], **{k: v for k, v in changes.items() if v is not None})
