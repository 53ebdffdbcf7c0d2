"""Progressive clustering: fragments grow landmark by landmark while they stay as certain.

The paper's N-nearest-neighbour segmentation (design 6). From a place the three landmarks nearest to
it begin a fragment; then again and again the landmark nearest to the fragment's centre joins, as
long as the winning P does not fall. The next fragment begins at the landmark that is the
``momentum`` + 1-th nearest to that centre, until all landmarks are placed. A landmark costs one
distance to each member of the fragment, never the distances between all of them.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from symboslam.engine.nearest import Nearest

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
FIRST = 3
"""Landmarks that a fragment begins with."""
TOLERANCE = 1e-12
"""A winning P that is lower by at most this has not fallen: that is rounding."""
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
    points, rows = xy.tolist(), weight.tolist()
    while len(left):
        fragment = Fragment(weight, a)
        for first in left.find(*start, FIRST):
            fragment.add(first, points[first], rows[first])
            left.take(first)
        while near := left.find(*fragment.centre):
            if not fragment.grow(near[0], points[near[0]], rows[near[0]]):
                break
            left.take(near[0])
        fragments.append(fragment.landmarks)
        tell(1 - len(left) / len(xy))
        ahead = left.find(*fragment.centre, momentum + 1)
        if ahead:
            start = points[ahead[-1]][0], points[ahead[-1]][1]
    return fragments


class Fragment:
    """A growing fragment and what its evidence is made of (design 5).

    For each environment it keeps the number n of members (landmarks that speak for it), the sum of
    their weights, and the sum over members x of ``w_x`` times the distances to all members; so C
    follows for any diagonal. Distances matter once two environments have pairs: before, the
    winning P is 1, or 0 while none has a pair, whatever they are.

    Args:
        weight: (n, K) weights of all landmarks.
        a: weight of C.

    Attributes:
        landmarks: positions of its landmarks, in the order in which they joined.
        winning: largest P, 0 while there is no pair.
    """

    def __init__(self, weight: Floats, a: float) -> None:
        k = weight.shape[1]
        self._a, self._k = a, k
        self.landmarks: list[int] = []
        self.winning = 0.0
        self._sum = [0.0, 0.0]
        self._box = [np.inf, np.inf, -np.inf, -np.inf]
        self._count, self._weight, self._far = [0] * k, [0.0] * k, np.zeros(k)
        self._x, self._y = np.zeros(16), np.zeros(16)
        self._rows = np.zeros((16, 2 * k))  # members' weights, and 1 where they are above 0
        self._members = 0

    @property
    def centre(self) -> tuple[float, float]:
        """Mean position of the landmarks."""
        z = len(self.landmarks)
        return self._sum[0] / z, self._sum[1] / z

    def add(self, landmark: int, point: list[float], row: list[float]) -> None:
        """Take a landmark in, whatever it does to P."""
        far = self._distances(point, row)
        box, count, total = self._with(point, row)
        self.winning = self._winning(box, count, total, self._far + far)
        self._take(landmark, point, row, box, count, total, far)

    def grow(self, landmark: int, point: list[float], row: list[float]) -> bool:
        """Take a landmark in if the winning P does not fall; whether it did not."""
        box, count, total = self._with(point, row)
        paired = sum(n > 1 for n in count)
        if paired > 1 and self.winning == 1 and sum(n > 1 for n in self._count) == 1:
            return False  # a second environment has a pair now, so P is below 1
        far = self._distances(point, row) if paired > 1 or self._few else np.zeros(self._k)
        winning = self._winning(box, count, total, self._far + far)
        if winning < self.winning - TOLERANCE:
            return False
        self.winning = winning
        self._take(landmark, point, row, box, count, total, far)
        return True

    @property
    def _few(self) -> bool:
        """Whether no environment has a pair, so that distances may matter later and are few."""
        return max(self._count, default=0) < 2

    def _with(
        self, point: list[float], row: list[float]
    ) -> tuple[list[float], list[int], list[float]]:
        """The box, the numbers of members and their weights with one landmark more."""
        x, y = point
        west, south, east, north = self._box
        box = [min(west, x), min(south, y), max(east, x), max(north, y)]
        count = [n + (w > 0) for n, w in zip(self._count, row, strict=True)]
        total = [s + w for s, w in zip(self._weight, row, strict=True)]
        return box, count, total

    def _distances(self, point: list[float], row: list[float]) -> Floats:
        """(K,) what a landmark adds to the sums of weighted distances."""
        m, k = self._members, self._k
        dx, dy = self._x[:m] - point[0], self._y[:m] - point[1]
        sums = np.sqrt(dx * dx + dy * dy) @ self._rows[:m]
        own = np.array(row)
        return np.asarray(own * sums[k:] + (own > 0) * sums[:k])

    def _winning(self, box: list[float], count: list[int], total: list[float], far: Floats) -> float:
        """Largest P of a fragment."""
        z = len(self.landmarks) + 1
        paired = [e for e, n in enumerate(count) if n > 1]
        if len(paired) < 2:
            return float(len(paired))
        diagonal = float(np.hypot(box[2] - box[0], box[3] - box[1]))
        largest = everything = 0.0
        for e, d in zip(paired, far[paired].tolist(), strict=True):
            n = count[e] * (count[e] - 1)
            near = total[e] * (count[e] - 1) - (d / diagonal if diagonal > 0 else 0.0)
            value = self._a * near / n + (1 - self._a) * n / (z * (z - 1))
            largest, everything = max(largest, value), everything + value
        return largest / everything

    def _take(
        self, landmark: int, point: list[float], row: list[float], box: list[float],
        count: list[int], total: list[float], far: Floats,
    ) -> None:  # fmt: skip
        self.landmarks.append(landmark)
        self._sum[0] += point[0]
        self._sum[1] += point[1]
        self._box, self._count, self._weight, self._far = box, count, total, self._far + far
        if not any(row):
            return  # speaks for nothing: a landmark of the fragment, but no member
        m = self._members
        if m == len(self._x):
            self._x, self._y = (np.concatenate([v, np.zeros(m)]) for v in (self._x, self._y))
            self._rows = np.concatenate([self._rows, np.zeros_like(self._rows)])
        self._x[m], self._y[m] = point
        self._rows[m, : self._k], self._rows[m, self._k :] = row, np.array(row) > 0
        self._members = m + 1


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
