"""SlamSettings: what an estimator of maps may be told; the defaults fit rooms and towns alike."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class SlamSettings:
    """Settings of map building; lengths are shares of the spacing of landmarks.

    Attributes:
        interval: seconds between key poses, at least.
        every: key poses between two updates of an edge agent's map.
        join: a sighting belongs to a landmark seen before as long as odometry since is good to
            this share of the spacing (gating of tracks).
        hold: a landmark is compared with the map as long as odometry since is good to this share
            (delayed data association; it sets the window of a local map).
        base: metres by which two positions of one landmark may differ beside what is modelled,
            as a share of the standard deviation of ranges.
        certainty: log odds by which landmarks have to be the same, to be joined (acceptance
            threshold on the log-odds of a hypothesis).
        rival: log odds by which the best explanation has to be better than the next (margin over
            the second-best hypothesis, as of an ambiguity test).
        kernel: of the Cauchy loss on measurements, in standard deviations.
        floor: metres by which merged landmarks may lie apart beside their covariances, as a share
            of the standard deviation of ranges.
        rounds: of merging, at most.
        confirm: a thing has to be seen so many times to be in the map, if others are seen often
            (track confirmation).
        repairs: so many times a doubted robot is mapped again, at most.
    """

    interval: float = 0.5
    every: int = 10
    join: float = 0.1
    hold: float = 0.14
    base: float = 1.3
    certainty: float = 7.0
    rival: float = 2.3
    kernel: float = 2.0
    floor: float = 0.5
    rounds: int = 15
    confirm: int = 2
    repairs: int = 6
