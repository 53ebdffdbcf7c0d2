"""Trouble: notices that a robot has tipped over or is stuck, and frees it or gives it up."""

from __future__ import annotations

import math
from dataclasses import dataclass

STILL = 8.0
"""Seconds within which a robot that wants to drive has to get somewhere."""
SOMEWHERE = 1.0
"""Metres that are somewhere."""
BACK = 1.5
"""Seconds of backing off."""
AROUND = 5.0
"""Seconds of driving past the goal's side after that, each time the other side."""
TRIES = 5
"""Attempts in one place, after which a robot is given up."""
AWAY = 5.0
"""Metres from the first attempt, beyond which attempts are counted anew."""


@dataclass(frozen=True)
class Finding:
    """What is wrong and what is done about it.

    Attributes:
        kind: ``tipped``, ``stuck`` or ``given up``.
        text: a sentence.
    """

    kind: str
    text: str


class Watch:
    """Watches one robot by its odometry and its tilt sensor."""

    def __init__(self) -> None:
        self._since = 0.0
        self._place = (0.0, 0.0)
        self._trouble: tuple[float, float] | None = None
        self.tries = 0
        self.given_up = False

    def check(
        self, time: float, place: tuple[float, float], wants: bool, tipped: bool
    ) -> Finding | None:
        """What is wrong at a time, if anything.

        Args:
            time: seconds.
            place: x and y by odometry, metres.
            wants: whether the robot has somewhere to go.
            tipped: whether it leans too much.
        """
        if self.given_up:
            return None
        if self._trouble is not None and math.dist(place, self._trouble) > AWAY:
            self._trouble, self.tries = None, 0
        if tipped:
            return self._attempt(time, place, "tipped", "tipped over; it is set upright")
        if not wants or math.dist(place, self._place) > SOMEWHERE:
            self._since, self._place = time, place
            return None
        if time - self._since < STILL:
            return None
        return self._attempt(time, place, "stuck", f"stuck for {STILL:g} s; it backs off")

    def _attempt(self, time: float, place: tuple[float, float], kind: str, text: str) -> Finding:
        self._since, self._place = time, place
        self._trouble = self._trouble or place
        self.tries += 1
        if self.tries > TRIES:
            self.given_up = True
            return Finding("given up", f"{kind} {TRIES} times in one place; it is given up")
        return Finding(kind, text)
