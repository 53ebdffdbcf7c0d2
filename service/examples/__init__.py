"""Example queries: a file each, with the question in the comment that it begins with."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from importlib.resources import files

from symboslam.errors import UnknownNameError

ORDER = (
    "maps", "what-is-here", "why", "why-not", "second", "uncertain", "unknown", "overridden",
    "override-history", "in-force", "agents", "seen-lately", "near", "for-or-against",
    "landmarks-for", "doubtful-landmarks", "area-shares", "segments-of", "landmarks-of-class",
    "landmark-classes", "distributions", "provenance", "settings", "left-out", "compare",
    "compare-settings", "segment-as-graph", "feature", "environment", "no-indication", "inferred",
    "zones", "osm-tags", "tag", "sources",
)  # fmt: skip
"""Names of the examples, in the order of a menu."""


@dataclass(frozen=True)
class Example:
    """A query with its question.

    Attributes:
        name: of its file.
        title: the question.
        description: what the answer says.
        audience: who asks it: ``operator``, ``analyst``, ``ontology engineer``.
        query: all of the file.
    """

    name: str
    title: str
    description: str
    audience: tuple[str, ...]
    query: str


@cache
def examples() -> tuple[Example, ...]:
    """All examples, in the order of a menu."""
    return tuple(_read(name) for name in ORDER)


def get_example(name: str) -> Example:
    """An example by its name.

    Raises:
        UnknownNameError: there is none of that name.
    """
    for example in examples():
        if example.name == name:
            return example
    raise UnknownNameError(f"there is no example {name!r}; there are {', '.join(ORDER)}")


def _read(name: str) -> Example:
    query = (files(__name__) / f"{name}.rq").read_text("utf-8")
    title, description, audience = (line.removeprefix("# ") for line in query.split("\n")[:3])
    asked_by = tuple(audience.removeprefix("For: ").split(", "))
    return Example(name, title, description, asked_by, query)
