"""Along: errors of map building along a mission, and when each landmark was seen first."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from symboslam.engine.slam.identity_error import score_identities
from symboslam.engine.slam.log import Floats, Mission
from symboslam.engine.slam.slam_map import SlamMap
from symboslam.sim_bridge.mission.mission import Tick
from symboslam.sim_bridge.mission.record import Recorder
from symboslam.sim_bridge.mission.team import Team

COLUMNS = ("time", "believed", "map", "landmarks")
STEP = 10.0
"""Seconds between two rows."""


class BeliefRecorder(Recorder):
    """A recorder that also keeps where robots believed to be, each second.

    Attributes:
        beliefs: robot -> rows of time, x and y.
    """

    def begin(self, team: Team) -> None:
        """Begin the record."""
        super().begin(team)
        self._agents = team.agents
        self.beliefs: dict[str, list[tuple[float, float, float]]] = {
            agent.name: [] for agent in team.agents
        }

    def tick(self, tick: Tick) -> None:
        """A row of coverage, and what robots believe."""
        super().tick(tick)
        if abs(tick.time - round(tick.time)) < 1e-9:
            for agent in self._agents:
                x, y, _ = agent.pose
                self.beliefs[agent.name].append((tick.time, x, y))


def errors_along(
    slam_map: SlamMap,
    mission: Mission,
    beliefs: Mapping[str, list[tuple[float, float, float]]],
    step: float = STEP,
) -> Floats:
    """(n, 4) rows of `COLUMNS`: time in seconds, and three errors in metres; NaN for none.

    - ``believed``: between where a robot believed to be at that time, by its own edge map, and
      where it was; mean over the robots.
    - ``map``: between where the map of all robots, made at the end, says that it was at that time
      and where it was; mean over the robots that the map has.
    - ``landmarks``: of the landmarks of the map of all robots that were in view by that time;
      mean. The last row is the landmark error of the whole map.

    Args:
        slam_map: made at the end.
        mission: with truth and identities.
        beliefs: robot -> rows of time, x and y.
        step: seconds between two rows.
    """
    assert mission.truth is not None
    truth = mission.truth.trajectories
    end = max(float(path[-1, 0]) for path in truth.values())
    time = np.unique([*np.arange(0.0, end, step), end])
    believed = [_apart(time, np.array(rows), truth[name]) for name, rows in beliefs.items() if rows]
    mapped = [
        _apart(time, np.column_stack([path.time, path.pose[:, :2]]), truth[name])
        for name, path in slam_map.trajectories.items()
        if len(path.time)
    ]
    return np.column_stack(
        [time, _mean(believed, time), _mean(mapped, time), _landmarks(time, slam_map, mission)]
    )


def first_seen(slam_map: SlamMap, mission: Mission) -> Floats:
    """(L,) seconds when each landmark of a map was first in view; infinite for never."""
    first = np.full(len(slam_map.landmarks), np.inf)
    for robot in mission.robots:
        landmark = np.asarray(slam_map.landmark_of.get(robot.name, ()), int)
        use = np.flatnonzero(landmark >= 0)
        np.minimum.at(first, landmark[use], robot.seen.time[use])
    return first


def _landmarks(time: Floats, slam_map: SlamMap, mission: Mission) -> Floats:
    assert mission.truth is not None
    true = mission.truth.landmarks
    stands = score_identities(slam_map, mission).stands
    pairs = [(at, true[name]) for name, at in stands.items() if name in true]
    if not pairs:
        return np.full(len(time), np.nan)
    at = np.array([p[0] for p in pairs])
    error = np.hypot(*(slam_map.landmarks.xy[at] - np.array([p[1] for p in pairs])).T)
    seen = first_seen(slam_map, mission)[at][None, :] <= time[:, None] + 1e-9
    count = seen.sum(1)
    return np.where(count > 0, (seen @ error) / np.maximum(count, 1), np.nan)


def _apart(time: Floats, path: Floats, true: Floats) -> Floats:
    """Metres between a path and the true one; both (n, 3 or more) with time, x, y."""
    gaps = [
        np.interp(time, path[:, 0], path[:, k]) - np.interp(time, true[:, 0], true[:, k])
        for k in (1, 2)
    ]
    return np.asarray(np.hypot(*gaps))


def _mean(rows: list[Floats], time: Floats) -> Floats:
    return np.mean(rows, axis=0) if rows else np.full(len(time), np.nan)
