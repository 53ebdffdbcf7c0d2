"""WriteOptions: what a caller can ask of a writer."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from datetime import datetime

from symboslam.errors import InputError

Progress = Callable[[str, float], None]
REASONS = 8
"""Reasons of a segment unless a number is asked for."""
MANY_SEGMENTS = 20_000
"""Above this many segments reasons are written only if a number is asked for."""


def reasons_wanted(reasons: int | None, segments: int) -> int:
    """How many reasons each of so many segments lists; None leaves it to the size of the map.

    Raises:
        InputError: a number below 0.
    """
    if reasons is None:
        return REASONS if segments <= MANY_SEGMENTS else 0
    if reasons < 0:
        raise InputError(f"reasons is {reasons}; it must be 0 or more")
    return reasons


@dataclass(frozen=True)
class WriteOptions:
    """Settings of a writer; each format uses those that mean something to it.

    Attributes:
        reasons: how many reasons each segment lists, the strongest first; 0 = none.
        progress: called with a stage and the share of it that is done.
        base: RDF: absolute IRI below which the map's own IRIs lie; None derives one from the
            content, so that equal maps get equal IRIs.
        ended: RDF: when the classification ended, with time zone; None leaves it out, so that
            equal maps give equal files.
    """

    reasons: int = 0
    progress: Progress | None = None
    base: str | None = None
    ended: datetime | None = None

    def tell(self, stage: str, share: float) -> None:
        """Report progress, if anybody listens."""
        if self.progress is not None:
            self.progress(stage, share)
