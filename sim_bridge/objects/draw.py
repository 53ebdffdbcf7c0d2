"""The draw of a variant: what differs between two objects of one class."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from typing import TypeVar

import numpy as np

from symboslam.sim_bridge.objects.parts import Colour

T = TypeVar("T")


class Draw:
    """Random choices that are the same for a name in every process.

    Args:
        name: what is drawn, such as ``House``.
        index: the number of the variant; styles go round with it, so that all occur.
    """

    def __init__(self, name: str, index: int) -> None:
        seed = hashlib.sha256(f"{name}/{index}".encode()).digest()
        self.rng = np.random.default_rng(int.from_bytes(seed[:8], "big"))
        self.index = index

    def between(self, low: float, high: float) -> float:
        """A number between two others."""
        return float(self.rng.uniform(low, high))

    def whole(self, low: int, high: int) -> int:
        """A whole number, both ends included."""
        return int(self.rng.integers(low, high + 1))

    def pick(self, options: Sequence[T]) -> T:
        """One of the options, by chance."""
        return options[int(self.rng.integers(len(options)))]

    def turn(self, options: Sequence[T], every: int = 1) -> T:
        """One of the options, in turn from variant to variant (each ``every`` times)."""
        return options[self.index // every % len(options)]

    def style(self, count: int, every: int = 1) -> int:
        """A style's number, in turn from variant to variant."""
        return self.index // every % count

    def tint(self, colour: Colour, spread: int = 14) -> Colour:
        """The colour, a little lighter or darker and a little off in hue."""
        light = self.rng.integers(-spread, spread + 1)
        red, green, blue = (
            int(np.clip(c + light + self.rng.integers(-spread // 3, spread // 3 + 1), 0, 255))
            for c in colour
        )
        return red, green, blue
