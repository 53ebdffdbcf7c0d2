"""Accept headers against what we write, by hand."""

import pytest

from symboslam.service.sparql.negotiation import choose, parse_accept, takes_gzip, with_charset
from symboslam.service.vocabulary import SOLUTIONS, TRIPLES

OFFERS = ("a/x", "a/y", "b/z")


@pytest.mark.parametrize(
    ("header", "expected"),
    [
        (None, "a/x"),
        ("", "a/x"),
        ("*/*", "a/x"),
        ("b/*", "b/z"),
        ("a/y", "a/y"),
        ("A/Y", "a/y"),
        ("a/y;q=0.5, b/z;q=0.6", "b/z"),
        ("a/y, b/z", "a/y"),
        ("b/z, a/y", "b/z"),
        ("b/z, */*", "b/z"),
        ("*/*, a/x;q=0", "a/y"),
        ("a/*;q=0.9, a/x;q=0.1, b/z;q=0.5", "a/y"),
        ("a/y; charset=utf-8 ;q=0.2, a/x;q=0.1", "a/y"),
        ("a/x;q=0", None),
        ("c/d", None),
        ("nonsense, b/z", "b/z"),
        ("nonsense", None),
        ("a/x;q=nonsense", "a/x"),
    ],
)
def test_choice(header: str | None, expected: str | None) -> None:
    assert choose(header, OFFERS) == expected


def test_what_a_browser_sends() -> None:
    browser = "text/html,application/xhtml+xml,application/xml;q=0.9,*/*;q=0.8"
    assert choose(browser, SOLUTIONS) == "application/xml"
    assert choose("text/html, */*;q=0.1", TRIPLES) == "text/turtle"


def test_quality_is_at_most_one() -> None:
    assert [r.quality for r in parse_accept("a/x;q=1.5, a/y;q=0.25, a/*")] == [1.0, 0.25, 1.0]


@pytest.mark.parametrize(
    ("header", "takes"),
    [
        (None, False), ("", False), ("gzip", True), ("br, gzip;q=0.5", True), ("gzip;q=0", False),
        ("gzip; q=0.0", False), ("identity", False), ("*", True), ("GZIP", True),
    ],
)  # fmt: skip
def test_gzip(header: str | None, takes: bool) -> None:
    assert takes_gzip(header) is takes


def test_charset() -> None:
    assert with_charset("text/csv") == "text/csv; charset=utf-8"
    assert with_charset("application/ld+json") == "application/ld+json"
