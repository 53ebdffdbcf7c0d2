"""Rows with times, put in order: sorted, without repeats, with notes on what was mended."""

from __future__ import annotations

import numpy as np

from symboslam.engine.slam.log import Floats, Ints
from symboslam.engine.slam.readers.text import count
from symboslam.errors import InputError

APART = 0.1
"""Metres; nearer places are one."""
SHARE = 0.1
"""Of all times, at which a robot in two places is no accident."""
TWICE = 10
"""So many times in two places at once are no accident."""


def in_order(time: Floats, name: str, notes: list[str]) -> Ints:
    """(n,) order in which times do not go back; rows of one time stay as they follow each other.

    A robot whose clock was set back is worth more than an error: rows are sorted and that is noted.
    """
    back = np.diff(time) < 0
    if not back.any():
        return np.arange(len(time))
    notes.append(
        f"{name}: time goes back at {count(int(back.sum()), 'row')}, by up to "
        f"{-np.diff(time).min():.3g} s; rows were sorted by time"
    )
    return np.argsort(time, kind="stable")


def without_repeats(rows: Floats, name: str, notes: list[str]) -> Ints:
    """(k,) finite rows but for those that are equal to an earlier one in all columns."""
    _, first = np.unique(rows, axis=0, return_index=True)
    kept = np.sort(first)
    if len(kept) < len(rows):
        notes.append(f"{name}: {count(len(rows) - len(kept), 'repeated row')} left out")
    return np.asarray(kept, np.int64)


def one_a_time(time: Floats, name: str, notes: list[str], xy: Floats | None = None) -> Ints:
    """(k,) of rows in order of time, the last of each time: odometry is in one place at a time.

    Args:
        time: (n,) seconds, in order.
        name: of the file or robot, for messages.
        notes: is told what was left out.
        xy: (n, 2) metres, where the rows say it was.

    Raises:
        InputError: it was in two places at once too often.
    """
    last = np.append(np.diff(time) > 0, True) if len(time) else np.zeros(0, np.bool_)
    if not last.all():
        if xy is not None:
            twice = int((np.hypot(*np.diff(xy, axis=0).T)[~last[:-1]] > APART).sum())
            if twice >= TWICE and twice > SHARE * last.sum():
                raise InputError(
                    f"{name}: in two places at once at {twice} of {last.sum()} times: two robots "
                    "under one name, or a clock that was set back? Name each drive for itself"
                )
        notes.append(
            f"{name}: {count(int((~last).sum()), 'row')} left out that another row of the same "
            "time contradicts; the last one counts"
        )
    return np.flatnonzero(last)
