"""estimate: a whole mission at once, the logs of all its robots."""

from __future__ import annotations

from symboslam.engine.slam.control import CollectiveMap
from symboslam.engine.slam.joining import Progress, silent
from symboslam.engine.slam.log import Mission
from symboslam.engine.slam.settings import SlamSettings
from symboslam.engine.slam.slam_map import SlamMap


def estimate(
    mission: Mission, settings: SlamSettings | None = None, progress: Progress | None = None
) -> SlamMap:
    """Where robots went and what they saw, without an oracle.

    Args:
        mission: logs; its truth and identities are not looked at.
        settings: of map building.
        progress: is told what is done, and which share of it.
    """
    told = progress or silent
    collective = CollectiveMap(mission.classes, mission.dynamic, mission.similarity, settings)
    for log in mission.robots:
        collective.add_log(log, told)
    return collective.solve(told)
