"""Interleaving: odometry that jumps there and back, as of two drives sorted into one by time.

That is what becomes of a log whose clock was set back while the robot drove on.
"""

from __future__ import annotations

import numpy as np

from symboslam.engine.slam.log import Floats

OFTEN = 10
"""So many jumps there and back are no accident."""
LARGE = 5.0
"""A jump is this many times as long as what the robot drives from row to row."""
LEAST = 0.1
"""Metres; shorter ones are no jumps."""
BACK = 0.5
"""One jump takes another one back if they add up to less than this share of the shorter."""
LAGS = (1, 2, 3, 4)
"""Rows of one drive are so far apart at most."""


def jumps(xy: Floats) -> int:
    """How often (n, 2) places in the order of time jump there and back."""
    if len(xy) <= max(LAGS):
        return 0
    step = np.diff(xy, axis=0)
    length = np.hypot(*step.T)
    rows = len(xy) - max(LAGS)
    usual = np.median(
        np.min([np.hypot(*(xy[lag:] - xy[:-lag]).T)[:rows] / lag for lag in LAGS], axis=0)
    )
    large = step[length > max(LARGE * float(usual), LEAST)]
    one, other = large[:-1], large[1:]
    shorter = np.minimum(np.hypot(*one.T), np.hypot(*other.T))
    return int((np.hypot(*(one + other).T) < BACK * shorter).sum())
