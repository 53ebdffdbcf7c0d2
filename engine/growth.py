"""Progressive clustering: fragments grow landmark by landmark while they stay as certain.

The paper's N-nearest-neighbour segmentation (design 6). From a place the three landmarks nearest to
it begin a fragment; then again and again the landmark nearest to the fragment's centre joins, as
long as the winning P does not fall. The next fragment begins at the landmark that is the
``momentum`` + 1-th nearest to that centre, until all landmarks are placed. A landmark costs one
distance to each member of the fragment, never the distances between all of them.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from symboslam.engine.nearest import Nearest

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
FIRST = 3
"""Landmarks that a fragment begins with."""
TOLERANCE = 1e-12
"""A winning P that is lower by at most this has not fallen: that is rounding."""
FEW = 48
"""Members of a fragment up to which they are gone through one by one."""
Said: TypeAlias = "list[tuple[int, float]]"
"""What a landmark says: environments with weights above 0."""
CROWD = 5
"""How crowded a spot is, the distance to the neighbour of this rank tells."""


def grow(
    xy: Floats,
    weight: Floats,
    a: float,
    start: tuple[float, float],
    momentum: int = 0,
    tell: Callable[[float], None] = lambda share: None,
) -> list[list[int]]:
    """Place all landmarks in fragments.

    Args:
        xy: (n, 2) positions in metres.
        weight: (n, K) SP(e, x) * f_x of each landmark.
        a: weight of C against the share of pairs, 0 < a < 1.
        start: where the first fragment begins, in metres.
        momentum: landmarks that are passed over between one fragment and the next.
        tell: called now and then with the share that is placed.

    Returns:
        The positions of each fragment's landmarks, in the order in which they joined.
    """
    left, fragments = Nearest(xy), []
    points: list[tuple[float, float]] = list(map(tuple, xy.tolist()))
    said = [[(e, w) for e, w in enumerate(row) if w > 0] for row in weight.tolist()]
    while len(left):
        fragment = Fragment(weight.shape[1], a)
        for first in left.find(*start, FIRST):
            fragment.add(first, points[first], said[first])
            left.take(first)
        while near := left.find(*fragment.centre):
            if not fragment.grow(near[0], points[near[0]], said[near[0]]):
                break
            left.take(near[0])
        fragments.append(fragment.landmarks)
        tell(1 - len(left) / len(xy))
        if ahead := left.find(*fragment.centre, momentum + 1):
            start = points[ahead[-1]]
    return fragments


@dataclass(frozen=True)
class Sums:
    """What the evidence of a fragment follows from.

    Attributes:
        z: its landmarks.
        box: (min x, min y, max x, max y) around them.
        members: (K,) landmarks that speak for each environment.
        weight: (K,) sum of what they say.
        far: (K,) sum over members x of ``w_x`` times the distances to all members, in metres; kept
            while it matters.
    """

    z: int
    box: tuple[float, float, float, float]
    members: list[int]
    weight: list[float]
    far: list[float]

    @property
    def paired(self) -> list[int]:
        """The environments with a pair of members."""
        return [e for e, n in enumerate(self.members) if n > 1]


class Fragment:
    """A growing fragment (design 5).

    From the sums that it keeps, C follows for any diagonal. Distances matter once two environments
    have pairs: before, the winning P is 1, or 0 while none has a pair, whatever they are.

    Args:
        environments: K, how many there are.
        a: weight of C.

    Attributes:
        landmarks: positions of its landmarks, in the order in which they joined.
        winning: largest P, 0 while there is no pair.
    """

    def __init__(self, environments: int, a: float) -> None:
        self._a, self._k = a, environments
        self.landmarks: list[int] = []
        self.winning = 0.0
        self._x = self._y = 0.0
        nothing = [0.0] * environments
        box = (math.inf, math.inf, -math.inf, -math.inf)
        self._sums = Sums(0, box, [0] * environments, nothing, nothing)
        self._members = Members(environments)

    @property
    def centre(self) -> tuple[float, float]:
        """Mean position of the landmarks."""
        z = len(self.landmarks)
        return self._x / z, self._y / z

    def add(self, landmark: int, point: tuple[float, float], said: Said) -> None:
        """Take a landmark in, whatever it does to P."""
        sums = self._with(point, said, distances=True)
        self._take(landmark, point, said, sums, self._winning(sums))

    def grow(self, landmark: int, point: tuple[float, float], said: Said) -> bool:
        """Take a landmark in if the winning P does not fall; whether it did not."""
        before = len(self._sums.paired)
        sums = self._with(point, said, distances=False)
        after = len(sums.paired)
        if before == 1 and after > 1:
            return False  # P was 1, and a second environment has a pair now
        if before != 1:
            sums = self._with(point, said, distances=True)
        winning = self._winning(sums)
        if winning < self.winning - TOLERANCE:
            return False
        self._take(landmark, point, said, sums, winning)
        return True

    def _with(self, point: tuple[float, float], said: Said, distances: bool) -> Sums:
        """The sums with one landmark more."""
        (x, y), now = point, self._sums
        west, south, east, north = now.box
        members, weight, far = now.members.copy(), now.weight.copy(), now.far.copy()
        for e, w in said:
            members[e] += 1
            weight[e] += w
        if distances:
            for (e, w), (near, heavy) in zip(said, self._members.far(x, y, said), strict=True):
                far[e] += w * near + heavy
        box = (min(west, x), min(south, y), max(east, x), max(north, y))
        return Sums(now.z + 1, box, members, weight, far)

    def _winning(self, sums: Sums) -> float:
        """Largest P of a fragment."""
        paired = sums.paired
        if len(paired) < 2:
            return float(len(paired))
        diagonal = math.hypot(sums.box[2] - sums.box[0], sums.box[3] - sums.box[1])
        all_pairs = sums.z * (sums.z - 1)
        largest = everything = 0.0
        for e in paired:
            others = sums.members[e] - 1
            n = sums.members[e] * others
            near = sums.weight[e] * others - (sums.far[e] / diagonal if diagonal > 0 else 0.0)
            value = self._a * near / n + (1 - self._a) * n / all_pairs
            largest, everything = max(largest, value), everything + value
        return largest / everything

    def _take(
        self, landmark: int, point: tuple[float, float], said: Said, sums: Sums, winning: float
    ) -> None:
        self.landmarks.append(landmark)
        self._x += point[0]
        self._y += point[1]
        self._sums, self.winning = sums, winning
        if said:  # what speaks for nothing is a landmark of the fragment, but no member
            self._members.add(*point, said)


class Members:
    """The landmarks of a fragment that speak for anything, and how far they are from a place.

    A few are gone through one by one, which is faster than numpy; many are not.

    Args:
        environments: K, how many there are.
    """

    def __init__(self, environments: int) -> None:
        self._k = environments
        self._each: list[tuple[float, float, Said]] = []
        self._xy, self._rows = np.zeros((0, 2)), np.zeros((0, 2 * environments))

    def add(self, x: float, y: float, said: Said) -> None:
        """One more."""
        m = len(self._each)
        self._each.append((x, y, said))
        if m < FEW:
            return
        if m >= len(self._xy):
            grown = np.zeros((2 * m, 2)), np.zeros((2 * m, 2 * self._k))
            for i, each in enumerate(self._each[:m]) if m == FEW else ():
                _put(*grown, i, each)
            if m > FEW:
                grown[0][:m], grown[1][:m] = self._xy[:m], self._rows[:m]
            self._xy, self._rows = grown
        _put(self._xy, self._rows, m, self._each[m])

    def far(self, x: float, y: float, said: Said) -> list[tuple[float, float]]:
        """For each environment of ``said``: distances to its members, plain and times weight."""
        k, m = self._k, len(self._each)
        if m > FEW:
            dx, dy = self._xy[:m, 0] - x, self._xy[:m, 1] - y
            sums = (np.sqrt(dx * dx + dy * dy) @ self._rows[:m]).tolist()
        else:
            sums = [0.0] * (2 * k)
            for other_x, other_y, other_said in self._each:
                distance = math.hypot(other_x - x, other_y - y)
                for e, w in other_said:
                    sums[e] += distance
                    sums[k + e] += distance * w
        return [(sums[e], sums[k + e]) for e, _ in said]


def _put(xy: Floats, rows: Floats, i: int, member: tuple[float, float, Said]) -> None:
    """Write a member into row ``i``: 1 for its environments, and what it says for them."""
    x, y, said = member
    xy[i], k = (x, y), rows.shape[1] // 2
    for e, w in said:
        rows[i, e], rows[i, k + e] = 1.0, w


def densest(xy: Floats) -> tuple[float, float]:
    """The densest spot: the landmark whose fifth neighbour is nearest, ties by position.

    Args:
        xy: (n, 2) positions in metres, at least one.
    """
    x, y = xy[int(crowding(xy).argmin())].tolist()
    return x, y


def crowding(xy: Floats) -> Floats:
    """(n,) distance from each landmark to its fifth neighbour, or to the farthest of fewer."""
    from scipy.spatial import cKDTree

    rank = min(CROWD + 1, len(xy))  # each is its own first neighbour
    return np.asarray(cKDTree(xy).query(xy, [rank])[0][:, 0])
