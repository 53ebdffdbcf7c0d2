"""Content negotiation (RFC 9110, 12.5): what a client accepts against what we can write."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import NamedTuple

from symboslam.service.store._base import Formats
from symboslam.service.vocabulary import SOLUTIONS, TRIPLES

_TOKEN = r"[!#$%&'*+.^_`|~0-9A-Za-z-]+"
_RANGE = re.compile(rf"\s*({_TOKEN})/({_TOKEN})\s*(;.*)?$")
_QUALITY = re.compile(r";\s*q\s*=\s*([01](?:\.\d{0,3})?)\s*(?:;|$)", re.IGNORECASE)


class Range(NamedTuple):
    """One part of an Accept header.

    Attributes:
        type: such as ``text``, or ``*``.
        subtype: such as ``turtle``, or ``*``.
        quality: from 0 (never) to 1.
    """

    type: str
    subtype: str
    quality: float

    def fit(self, media_type: str) -> int:
        """How exactly a media type is meant: 3 by name, 2 by its type, 1 by ``*/*``, 0 not."""
        kind, _, name = media_type.partition("/")
        if (self.type, self.subtype) == (kind, name):
            return 3
        if self.subtype == "*":
            return 2 if self.type == kind else int(self.type == "*")
        return 0


def parse_accept(header: str | None) -> list[Range]:
    """The ranges of an Accept header; what is malformed in it is passed over.

    Parameters other than ``q`` are too: all we write is UTF-8 and has no profiles.

    >>> parse_accept("text/turtle;q=0.5, */*;q=0.1")[0]
    Range(type='text', subtype='turtle', quality=0.5)
    """
    if header is None or not header.strip():
        return [Range("*", "*", 1.0)]
    ranges = []
    for part in header.split(","):
        if found := _RANGE.match(part):
            quality = _QUALITY.search(found[3] or "")
            value = min(float(quality[1]), 1.0) if quality else 1.0
            ranges.append(Range(found[1].lower(), found[2].lower(), value))
    return ranges


def choose(header: str | None, offers: Iterable[str]) -> str | None:
    """The offer that a client likes best; None if it takes none.

    The most exact range decides on an offer's quality. Among equal qualities an offer that is
    named goes before one that is only covered, then the client's order counts, then ours.

    >>> choose("text/csv, */*;q=0.1", ["application/json", "text/csv"])
    'text/csv'
    """
    ranges = parse_accept(header)
    best: tuple[float, int, int] | None = None
    chosen = None
    for offer in offers:
        fits = [(r.fit(offer), -place, r.quality) for place, r in enumerate(ranges)]
        fit, place, quality = max(fits, default=(0, 0, 0.0))
        if fit and quality > 0 and (best is None or (quality, fit, place) > best):
            best, chosen = (quality, fit, place), offer
    return chosen


def formats(header: str | None) -> Formats:
    """What a client takes for each kind of result."""
    solutions = choose(header, SOLUTIONS)
    return Formats(solutions, solutions, choose(header, TRIPLES))


def with_charset(media_type: str) -> str:
    """A media type for the Content-Type header.

    >>> with_charset("text/turtle")
    'text/turtle; charset=utf-8'
    """
    return f"{media_type}; charset=utf-8" if media_type.startswith("text/") else media_type


def takes_gzip(header: str | None) -> bool:
    """Whether an Accept-Encoding header allows gzip."""
    for part in (header or "").split(","):
        name, _, rest = part.strip().partition(";")
        if name.strip().lower() in ("gzip", "x-gzip", "*"):
            return not re.fullmatch(r"\s*q\s*=\s*0(\.0*)?\s*", rest, re.IGNORECASE)
    return False
