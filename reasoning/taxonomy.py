"""A taxonomy: classes and the steps up from them, as the proximity measures need it."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from math import log


@dataclass(frozen=True)
class Taxonomy:
    """A rooted taxonomy; classes of one cycle count as equally deep.

    Attributes:
        parents: class -> the classes one step up.
        root: the class above all; every class that leads nowhere else is put right under it.
    """

    parents: Mapping[str, frozenset[str]]
    root: str

    @cached_property
    def classes(self) -> frozenset[str]:
        """All classes, the root included."""
        above = (parent for parents in self.parents.values() for parent in parents)
        return frozenset([self.root, *self.parents, *above])

    @cached_property
    def _ways_up(self) -> dict[str, dict[str, tuple[str, ...]]]:
        return {c: self._shortest_ways(c) for c in self.classes}

    def _shortest_ways(self, start: str) -> dict[str, tuple[str, ...]]:
        ways: dict[str, tuple[str, ...]] = {start: (start,)}
        waiting = deque([start])
        while waiting:
            here = waiting.popleft()
            for parent in sorted(self.parents.get(here, ())):
                if parent not in ways:
                    ways[parent] = (*ways[here], parent)
                    waiting.append(parent)
        ways.setdefault(self.root, (*ways[max(ways, key=lambda c: len(ways[c]))], self.root))
        return ways

    def ways_up(self, name: str) -> Mapping[str, tuple[str, ...]]:
        """Each class at or above ``name`` -> a shortest way there, both ends included."""
        return self._ways_up[name]

    @cached_property
    def _depths(self) -> dict[str, int]:
        # Whatever is strictly above a class has fewer classes above it, so this order works.
        depths: dict[str, int] = {}
        for c in sorted(self.classes, key=lambda c: (len(self._ways_up[c]), c)):
            above = [d for d in self._ways_up[c] if c not in self._ways_up[d]]
            depths[c] = 1 + max((depths[d] for d in above), default=0)
        return depths

    def depth(self, name: str) -> int:
        """Classes on the longest way from the root down to ``name``, so the root's depth is 1."""
        return self._depths[name]

    @cached_property
    def _counts(self) -> dict[str, int]:
        counts = dict.fromkeys(self.classes, 0)
        for ways in self._ways_up.values():
            for above in ways:
                counts[above] += 1
        return counts

    def information(self, name: str) -> float:
        """IC = -log(share of the taxonomy's classes that are at or below ``name``)."""
        return log(len(self.classes) / self._counts[name])

    def common(self, first: str, second: str) -> Iterable[str]:
        """The classes at or above both; never empty, as the root is one of them."""
        return sorted(self._ways_up[first].keys() & self._ways_up[second].keys())
