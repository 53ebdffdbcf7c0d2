"""EdgeIncrement: what is new in a robot's pose graph, as an edge agent sends it to the control agent."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symboslam.engine.slam.log import Floats, Ints, Pose
from symboslam.errors import InputError


@dataclass(frozen=True)
class EdgeIncrement:
    """A piece of one robot's pose graph: key poses that follow each other, and what was seen there.

    Attributes:
        robot: its name.
        run: names one run of one robot; two robots with the same name differ in it.
        sequence: number of the increment in its run, from 0.
        start: where the run began, in the collective frame; None if not known.
        start_sigma: standard deviations of that.
        first: number of the first key pose here.
        time: (k,) seconds.
        step: (k, 3) from the key pose before, in its frame; zeros for the very first.
        sigma: (k, 3) standard deviations of the steps.
        row: (m,) number of each sighting in its run.
        pose: (m,) number of the key pose that it is made from.
        range: (m,) metres; NaN for none.
        bearing: (m,) radians; NaN for none.
        sigma_range: (m,) metres.
        sigma_bearing: (m,) radians.
        feature: (m,) class by name; "" for a robot.
        confidence: (m,) of the class.
        key: (m,) what names it beyond doubt; "" for none.
        track: (m,) sightings that the robot holds for one thing, seen without a break; -1 for none.
        fix_pose: (g,) number of the key pose of each position from outside.
        fix: (g, 3) x, y and standard deviation in metres.
        last: nothing more comes from this run.
    """

    robot: str
    run: str
    sequence: int
    start: Pose | None
    start_sigma: Pose
    first: int
    time: Floats
    step: Floats
    sigma: Floats
    row: Ints
    pose: Ints
    range: Floats
    bearing: Floats
    sigma_range: Floats
    sigma_bearing: Floats
    feature: NDArray[np.object_]
    confidence: Floats
    key: NDArray[np.object_]
    track: Ints
    fix_pose: Ints
    fix: Floats
    last: bool = False

    def to_json(self) -> dict[str, Any]:
        """As JSON values; NaN is written as null."""
        raise NotImplementedError

    @classmethod
    def from_json(cls, value: Mapping[str, Any]) -> EdgeIncrement:
        """Read what `to_json` wrote.

        Raises:
            InputError: not an increment; the message says what is wrong.
        """
        raise InputError("not written yet")
