"""EdgeLandmarks: what a robot knows of the landmarks on its own map."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from symboslam.engine.slam.constellation import Things
from symboslam.engine.slam.log import Floats
from symboslam.engine.slam.planar import between
from symboslam.engine.slam.pose_graph import Sighting
from symboslam.engine.slam.scale import together


@dataclass(frozen=True)
class Known:
    """A landmark that others have mapped.

    Attributes:
        xy: (2,) metres.
        covariance: (2, 2) of that.
        evidence: (C,) summed log likelihoods of its class.
        name: what names it beyond doubt; "" for none.
    """

    xy: Floats
    covariance: Floats
    evidence: Floats
    name: str = ""


class EdgeLandmarks:
    """Landmarks by number; numbers of those that were merged into others stay, but are no roots.

    Args:
        classes: how many there are.

    Attributes:
        xy: (n, 2) metres, where they are.
        named: what names a landmark beyond doubt -> its number.
    """

    def __init__(self, classes: int) -> None:
        self.xy = np.zeros((0, 2))
        self.named: dict[str, int] = {}
        self._classes = classes
        self._evidence: list[Floats] = []
        self._moments: dict[int, set[float]] = {}

    def __len__(self) -> int:
        return len(self.xy)

    @property
    def roots(self) -> list[int]:
        """Numbers of those that were not merged into others, in order."""
        return sorted(self._moments)

    def new(self, xy: Floats, evidence: Floats | None = None) -> int:
        """One more, without sightings; its number."""
        number = len(self.xy)
        self.xy = np.vstack([self.xy, xy])
        self._evidence.append(np.zeros(self._classes) if evidence is None else evidence)
        self._moments[number] = set()
        return number

    def see(self, number: int, time: float, evidence: Floats) -> None:
        """Take over a sighting of one."""
        self._evidence[number] = self._evidence[number] + evidence
        self._moments[number].add(time)

    def seen(self, number: int) -> int:
        """Moments at which one was seen."""
        return len(self._moments[number])

    def evidence(self, numbers: list[int]) -> Floats:
        """(k, C) summed log likelihoods of the classes."""
        return np.array([self._evidence[n] for n in numbers])

    def classes(self) -> NDArray[np.int64]:
        """The likeliest class of each root."""
        return np.array([np.argmax(self._evidence[n]) for n in self.roots], np.int64)

    def things(self, numbers: list[int]) -> Things:
        """Landmarks as parts of constellations."""
        return Things(self.xy[numbers], self.evidence(numbers))

    def together(self, one: int, other: int) -> bool:
        """Whether two landmarks were seen beside each other, and so are two."""
        return together(self._moments[one], self._moments[other])

    def merge(self, keep: int, gone: int) -> None:
        """Make two landmarks one."""
        for name, number in self.named.items():
            if number == gone:
                self.named[name] = keep
        self._evidence[keep] = self._evidence[keep] + self._evidence[gone]
        self._moments[keep] |= self._moments.pop(gone)

    def in_view(self, seen: Sighting, pose: Floats, slack: float, reach: float) -> int | None:
        """The only landmark of the class that a range or a bearing alone fits.

        Args:
            seen: what was seen.
            pose: (3,) from where.
            slack: metres by which either may be off beside what the sensor is.
            reach: metres that the sensor reaches.
        """
        roots = [n for n in self.roots if np.argmax(self._evidence[n]) == seen.feature]
        if not roots:
            return None
        away = between(pose, np.column_stack([self.xy[roots], np.zeros(len(roots))]))
        far = np.hypot(away[:, 0], away[:, 1])
        if math.isnan(seen.bearing):
            fits = abs(far - seen.range) < slack + 3 * seen.sigma_range
        else:
            turn = np.arctan2(away[:, 1], away[:, 0]) - seen.bearing
            off = abs((turn + np.pi) % (2 * np.pi) - np.pi)
            near = far < max(reach, slack)
            fits = near & (off < 3 * seen.sigma_bearing + slack / np.maximum(far, slack))
        found = np.flatnonzero(fits)
        return roots[int(found[0])] if len(found) == 1 else None
