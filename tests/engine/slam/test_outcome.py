"""Outcome: what was seen too seldom, where other things are seen often, is left out and told."""

from dataclasses import replace
from typing import Any

import numpy as np

from symboslam.engine.slam.estimate import estimate
from symboslam.engine.slam.log import Mission
from symboslam.engine.slam.settings import SlamSettings
from symboslam.engine.slam.simulate import World, simulate


def passing(mission: Any, log: Any, often: int) -> Mission:
    """A drive past a house seen again and again, another seen twice, and a dog on two visits."""
    pose = [(float(n), 0, 0) for n in range(130)]
    rows = [(float(n), float(np.hypot(60 - n, 20)), float(np.arctan2(20, 60 - n)), "House", 0.9)
            for n in range(often)]  # fmt: skip
    rows += [(float(n), 15.0, -np.pi / 2, "Cottage", 0.9) for n in (100,)]
    rows += [(float(n), float(np.hypot(30 - n, 9)), float(np.arctan2(9, 30 - n)), "Dog", 0.9)
             for n in (1, 2, 3, 50, 51, 52)]  # fmt: skip
    made: Mission = mission(log("r", pose, sorted(rows)))
    return made


def kept(mission: Mission, confirm: int) -> tuple[dict[str, list[int]], tuple[str, ...]]:
    found = estimate(mission, SlamSettings(confirm=confirm))
    names: dict[str, list[int]] = {}
    for feature, times in zip(found.landmarks.feature, found.landmarks.sightings, strict=True):
        names.setdefault(mission.classes[feature], []).append(int(times))
    return names, found.notes


def test_what_is_seen_too_seldom_is_left_out(mission: Any, log: Any) -> None:
    one = passing(mission, log, 125)
    names, notes = kept(one, 1)
    assert names["Cottage"] == [1]
    assert sum(names["House"]) == 125
    assert not any("fewer than" in note for note in notes)
    names, notes = kept(one, 2)
    assert set(names) == {"House", "Dog"}
    assert "things seen fewer than 2 times, where others are seen often, left out: 1" in notes


def test_where_little_is_seen_all_is_kept(mission: Any, log: Any) -> None:
    names, _ = kept(passing(mission, log, 40), 2)
    assert names["Cottage"] == [1]


def test_a_dog_that_sits_where_it_sat_is_one(mission: Any, log: Any) -> None:
    names, _ = kept(passing(mission, log, 125), 2)
    assert names["Dog"] == [6]


def test_confirmation_leaves_out_nothing_that_is_seen_often() -> None:
    world = World(robots=1, poses=200, side=200.0, landmarks=30, classes=6, known_starts=1)
    mission = simulate(replace(world, misclassified=0.0), 2)
    few, many = (estimate(mission, SlamSettings(confirm=n)) for n in (1, 5))
    often = few.landmarks.sightings >= 5
    assert 0 < often.sum() < len(often) or often.all()
    assert many.landmarks.xy.tolist() == few.landmarks.xy[often].tolist()
