"""A mapper and a collective map for tests: quick, plain, and with the interface of the true ones.

Run as a program it is ``symboslam`` with these in the place of `symboslam.engine.slam`'s.
"""

import sys
import types
from collections.abc import Sequence
from typing import Any

import numpy as np

from symboslam.engine.slam.increment import EdgeIncrement
from symboslam.engine.slam.planar import between, compose, place
from symboslam.engine.slam.slam_map import MappedLandmarks, SlamMap


class EdgeMapper:
    """Takes every odometry for a key pose."""

    def __init__(
        self, robot: str, classes: Sequence[str], dynamic: Any, *, run: str | None = None,
        start: Any = None, start_sigma: Any = (0.1, 0.1, 0.1), sigma_range: float = 0.5,
        sigma_bearing: float = 0.02, **_: Any,
    ) -> None:  # fmt: skip
        self.robot, self.classes, self.run = robot, classes, run or "run"
        self.start, self.start_sigma = start, start_sigma
        self.sigmas = sigma_range, sigma_bearing
        self.notes: list[str] = []
        self._poses: list[Any] = []
        self._seen: list[Any] = []
        self._fixes: list[Any] = []
        self._sent = self._told = self._sequence = 0

    def odometry(self, time: float, pose: Any) -> None:
        if self._poses and time <= self._poses[-1][0]:
            self.notes.append(f"odometry at {time:g} s is out of order")
            return
        self._poses.append((time, pose))

    def sighting(
        self, time: float, range: float, bearing: float, feature: int, confidence: float,
        key: str = "", sigma: tuple[float, float] | None = None,
    ) -> None:  # fmt: skip
        name = "" if feature < 0 else self.classes[feature]
        self._seen.append(
            (len(self._poses) - 1, range, bearing, name, confidence, key, *(sigma or self.sigmas))
        )

    def fix(self, time: float, x: float, y: float, sigma: float) -> None:
        self._fixes.append((len(self._poses) - 1, (x, y, sigma)))

    def increment(self, last: bool = False) -> EdgeIncrement | None:
        new, seen = self._poses[self._sent :], self._seen[self._told :]
        if not new and not last:
            return None
        before = [pose for _, pose in self._poses[max(self._sent - 1, 0) : len(self._poses)]]
        if before and self._sent == 0:
            before.insert(0, before[0])
        steps = between(before[:-1], before[1:]) if new else np.zeros((0, 3))

        def objects(values: list[str]) -> Any:
            column = np.empty(len(values), object)
            column[:] = values
            return column

        n = len(seen)
        made = EdgeIncrement(
            self.robot, self.run, self._sequence, self.start, self.start_sigma, self._sent,
            np.array([time for time, _ in new], float), steps, np.full((len(new), 3), 0.1),
            np.arange(self._told, self._told + n), np.zeros(n),
            np.array([s[0] for s in seen], np.int64),
            np.array([s[1] for s in seen], float), np.array([s[2] for s in seen], float),
            np.array([s[6] for s in seen], float), np.array([s[7] for s in seen], float),
            objects([s[3] for s in seen]),
            np.array([s[4] for s in seen], float), objects([s[5] for s in seen]), np.full(n, -1),
            np.array([f[0] for f in self._fixes], np.int64),
            np.array([f[1] for f in self._fixes], float).reshape(-1, 3), last,
        )  # fmt: skip
        self._sent, self._told, self._sequence = (
            len(self._poses),
            len(self._seen),
            made.sequence + 1,
        )
        self._fixes = []
        return made


class CollectiveMap:
    """Believes the odometry, and takes what is of one class on one square metre for one."""

    def __init__(self, classes: Sequence[str], dynamic: Any, similarity: Any) -> None:
        assert similarity.shape == (len(classes), len(classes))
        self.classes = list(classes)
        self.notes: list[str] = []
        self._parts: dict[tuple[str, str], dict[int, EdgeIncrement]] = {}

    def add(self, increment: EdgeIncrement) -> None:
        parts = self._parts.setdefault((increment.robot, increment.run), {})
        parts.setdefault(increment.sequence, increment)

    def solve(self) -> SlamMap:
        found: dict[tuple[str, int, int], list[tuple[float, float, float]]] = {}
        for parts in self._parts.values():
            pose: Any = None
            poses: list[Any] = []
            for sequence in range(len(parts)):
                if sequence not in parts:
                    break
                each = parts[sequence]
                pose = each.start if pose is None else pose
                for step in each.step:
                    pose = compose(pose, step)
                    poses.append(pose)
                for i in range(len(each.row)):
                    if each.feature[i]:
                        r, b = each.range[i], each.bearing[i]
                        x, y = place(poses[each.pose[i]], (r * np.cos(b), r * np.sin(b)))
                        where = str(each.feature[i]), round(float(x)), round(float(y))
                        found.setdefault(where, []).append((x, y, each.confidence[i]))
        n = len(found)
        objects = np.empty(n, object)
        objects[:] = [f"{name}:{x}:{y}" for name, x, y in found]
        xy = np.array([np.mean(s, 0)[:2] for s in found.values()], float).reshape(-1, 2)
        return SlamMap(
            {},
            MappedLandmarks(
                objects, xy, np.full((n, 2, 2), np.nan),
                np.array([self.classes.index(name) for name, _, _ in found], np.int64),
                np.array([max(s[2] for s in seen) for seen in found.values()], float),
                np.array([len(seen) for seen in found.values()], np.int64), np.zeros(n, bool),
                np.full(n, "", object),
            ),
            {},
            doubts=("the test doubts it",),
        )  # fmt: skip


def main() -> None:
    for name, thing in (("edge", EdgeMapper), ("control", CollectiveMap)):
        module = types.ModuleType(f"symboslam.engine.slam.{name}")
        setattr(module, thing.__name__, thing)
        sys.modules[module.__name__] = module
    from symboslam.cli import main as program

    program()


if __name__ == "__main__":
    main()
