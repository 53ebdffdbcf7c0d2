"""Detections: boxes with classes in a picture, from a detector that is chosen by name."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from symboslam.errors import InputError
from symboslam.sim_bridge.bridge.camera import Picture
from symboslam.sim_bridge.bridge.settings import DetectorSpec

Box = tuple[int, int, int, int]
"""Left, top, right and bottom in points; right and bottom are the first points outside."""


@dataclass(frozen=True)
class Detection:
    """Something that a detector reports.

    Attributes:
        box: where it is in the picture.
        kind: class; one of the 56 labels.
        confidence: in (0, 1].
        body: for measuring alone: number of the body that it is of; None if it is of none, or if
            the detector cannot know.
    """

    box: Box
    kind: str
    confidence: float
    body: int | None = None


class Detector(ABC):
    """Finds objects in pictures."""

    @abstractmethod
    def detect(self, picture: Picture, kinds: Mapping[int, str]) -> list[Detection]:
        """What is in a picture.

        Args:
            picture: it.
            kinds: body -> class of the objects that there are. Only an oracle looks at it.
        """


class SegDetector(Detector):
    """Reads boxes off the segmentation, and errs as it is told.

    Args:
        spec: how it errs.
        classes: what a wrong class is drawn from.
        rng: draws the errors.
    """

    def __init__(
        self, spec: DetectorSpec, classes: tuple[str, ...], rng: np.random.Generator
    ) -> None:
        self._spec, self._classes, self._rng = spec, classes, rng

    def detect(self, picture: Picture, kinds: Mapping[int, str]) -> list[Detection]:
        """The visible objects, in the order of their bodies' numbers, then what is of nothing."""
        spec, rng = self._spec, self._rng
        found = []
        for body, box, points in boxes_of(picture.segmentation, kinds):
            left, top, right, bottom = box
            if bottom - top < spec.least_height or points < spec.least_points:
                continue
            if points < spec.least_share * (right - left) * (bottom - top):
                continue
            missed, confused, sure, other = rng.random(4).tolist()
            if missed < spec.misses:
                continue
            kind = kinds[body]
            if confused < spec.confusion:
                rest = [c for c in self._classes if c != kind]
                found.append(Detection(box, rest[int(other * len(rest))], 0.3 + 0.5 * sure, body))
            else:
                found.append(Detection(box, kind, 0.7 + 0.29 * sure, body))
        for _ in range(int(rng.poisson(spec.false_positives))):
            height, width = picture.segmentation.shape
            w, h = int(rng.integers(8, 60)), int(rng.integers(8, 60))
            x, y = int(rng.integers(0, width - w)), int(rng.integers(0, height - h))
            kind = self._classes[int(rng.integers(len(self._classes)))]
            found.append(Detection((x, y, x + w, y + h), kind, 0.3 + 0.3 * float(rng.random())))
        return found


def boxes_of(
    segmentation: NDArray[np.int32], kinds: Mapping[int, str]
) -> list[tuple[int, Box, int]]:
    """Body, box and number of points of each of these bodies that can be seen, by body."""
    rows, columns = np.nonzero(segmentation > 0)
    body = segmentation[rows, columns]
    if not len(body):
        return []
    order = np.argsort(body, kind="stable")
    body, rows, columns = body[order], rows[order], columns[order]
    first = np.flatnonzero(np.r_[True, body[1:] != body[:-1]])
    counts = np.diff(np.r_[first, len(body)])
    left, right = np.minimum.reduceat(columns, first), np.maximum.reduceat(columns, first)
    top, bottom = np.minimum.reduceat(rows, first), np.maximum.reduceat(rows, first)
    table = np.column_stack([body[first], left, top, right + 1, bottom + 1, counts]).tolist()
    return [(b, (x0, y0, x1, y1), n) for b, x0, y0, x1, y1, n in table if b in kinds]


def _seg(spec: DetectorSpec, classes: tuple[str, ...], rng: np.random.Generator) -> Detector:
    return SegDetector(spec, classes, rng)


def _onnx(spec: DetectorSpec, classes: tuple[str, ...], rng: np.random.Generator) -> Detector:
    raise InputError("--detector onnx: no model is installed yet; use --detector seg")


DETECTORS: Mapping[
    str, Callable[[DetectorSpec, tuple[str, ...], np.random.Generator], Detector]
] = {"seg": _seg, "onnx": _onnx}
"""All detectors by name."""


def get_detector(
    name: str, spec: DetectorSpec, classes: tuple[str, ...], rng: np.random.Generator
) -> Detector:
    """The detector of a name.

    Raises:
        InputError: there is none of that name, or it cannot be used here.
    """
    if name not in DETECTORS:
        raise InputError(f"no detector {name!r}; there are: {', '.join(DETECTORS)}")
    return DETECTORS[name](spec, classes, rng)
