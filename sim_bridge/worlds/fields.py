"""Fields: typed access to the parts of a world file, with errors that name the place."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

from symboslam.errors import WorldError

LIMIT = 1e8
"""Largest coordinate in metres that makes sense on this planet."""


class Part:
    """One JSON object of a file.

    Args:
        value: what stands there.
        source: the file, for messages.
        where: the place in the file, such as ``objects[3]``; empty for the whole.
        known: the members that it may have; others are refused.

    Raises:
        WorldError: it is no object, or has a member that nobody knows.
    """

    def __init__(self, value: object, source: str, where: str, known: tuple[str, ...]) -> None:
        self.source, self.where = source, where
        if not isinstance(value, Mapping):
            raise self.error(f"{_told(value)} is no JSON object", "")
        self.value: Mapping[str, Any] = value
        for name in value:
            if name not in known:
                raise self.error(f"there is no such member; there are: {', '.join(known)}", name)

    def error(self, problem: str, member: str) -> WorldError:
        """The error for a member; an empty one is the part itself."""
        where = ".".join(part for part in (self.where, member) if part)
        return WorldError(problem, source=self.source, where=where)

    def text(self, member: str, default: str | None = None) -> str:
        """A text that must not be empty; without a default it must be there."""
        value = self.value.get(member, default)
        if not isinstance(value, str) or (not value.strip() and default is None):
            raise self.error(f"{_told(value)} is no text", member)
        return value

    def optional_text(self, member: str) -> str | None:
        """A text, or None where it is absent or null."""
        return None if self.value.get(member) is None else self.text(member)

    def number(self, member: str, default: float | None = None, above: float = -LIMIT) -> float:
        """A finite number above a bound; without a default it must be there."""
        value = self.value.get(member, default)
        if not _is_number(value):
            raise self.error(f"{_told(value)} is no finite number", member)
        if not above < value < LIMIT:
            raise self.error(f"{value:g} is not between {above:g} and {LIMIT:g}", member)
        return float(value)

    def numbers(self, member: str, names: str) -> tuple[float, ...]:
        """A list of finite numbers, as many as there are names."""
        value = self.value.get(member)
        right = isinstance(value, list) and len(value) == names.count(",") + 1
        if not isinstance(value, list) or not right or not all(map(_is_number, value)):
            raise self.error(f"{_told(value)}: give finite numbers [{names}]", member)
        if max(map(abs, value)) >= LIMIT:
            raise self.error(f"{_told(value)} is not within {LIMIT:g} m", member)
        return tuple(map(float, value))

    def items(self, member: str) -> Iterator[tuple[str, Any]]:
        """Place and value of each item of a list; none where the member is absent."""
        value = self.value.get(member, [])
        if not isinstance(value, list):
            raise self.error(f"{_told(value)} is no list", member)
        place = ".".join(part for part in (self.where, member) if part)
        return ((f"{place}[{i}]", item) for i, item in enumerate(value))

    def line(self, member: str, least: int = 2) -> tuple[tuple[float, float], ...]:
        """Points ``[x, y]`` in metres, at least so many."""
        return self.line_of(self.value.get(member), member, least)

    def line_of(self, value: object, member: str, least: int) -> tuple[tuple[float, float], ...]:
        """Points of a value that stands at a member."""
        if not isinstance(value, list) or len(value) < least:
            raise self.error(f"give a list of at least {least} points [x, y]", member)
        for i, point in enumerate(value):
            if not (isinstance(point, list) and len(point) == 2 and all(map(_is_number, point))):
                raise self.error(f"{_told(point)} is no point [x, y]", f"{member}[{i}]")
            if max(map(abs, point)) >= LIMIT:
                raise self.error(f"{_told(point)} is not within {LIMIT:g} m", f"{member}[{i}]")
        return tuple((float(x), float(y)) for x, y in value)


def _is_number(value: object) -> bool:
    if isinstance(value, bool) or not isinstance(value, int | float):
        return False
    try:
        return math.isfinite(value)
    except OverflowError:
        return False


def _told(value: object) -> str:
    if value is None:
        return "nothing (it is missing or null)"
    shown = repr(value)
    return shown if len(shown) <= 60 else shown[:57] + "..."
