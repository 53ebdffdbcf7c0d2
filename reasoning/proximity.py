"""Measures of semantic proximity SP(e, f) between an environment e and a feature f (design 4).

A *way* is a chain ``f is-a* g``, ``g indicates p`` with a strength in (0, 1], and ``p is-a* e``
where part-of counts as is-a. Every measure is ``SP(e, f) = max over ways of strength * factor``
with a factor in [0, 1] that is 1 for a direct link (f = g and p = e); SP is 0 without any way.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from symboslam.reasoning.taxonomy import Taxonomy


@dataclass(frozen=True)
class Way:
    """How a feature leads to an environment.

    Attributes:
        up: f ... g, the shortest is-a way, both ends included.
        on: p ... e, the shortest way by is-a and part-of, both ends included.
        features: the taxonomy of features: is-a below ``sl:Feature``.
        places: the taxonomy of places: is-a and part-of below ``sl:Place``.
    """

    up: tuple[str, ...]
    on: tuple[str, ...]
    features: Taxonomy
    places: Taxonomy

    @property
    def steps(self) -> int:
        """h, the steps beyond the direct link."""
        return len(self.up) + len(self.on) - 2


Measure = Callable[[Way], float]
"""The factor of a way, in [0, 1]."""


def path(way: Way) -> float:
    """Steps: the factor is ``1 / (1 + h)``, h those beyond the direct link (the default)."""
    return 1 / (1 + way.steps)


def wu_palmer(way: Way) -> float:
    """Depth that the classes share.

    The factor is ``wp(f, g) * wp(p, e)`` with ``wp(a, b) = 2 depth(lcs) / (depth(a) + depth(b))``.
    depth(c) is the number of classes on the longest way from the root of c's taxonomy down to c
    (the root's is 1), lcs the deepest class at or above both a and b. With the longest way a class
    is always deeper than what is above it, so wp never exceeds 1 (Z. Wu, M. Palmer: Verb semantics
    and lexical selection, ACL 1994).
    """
    return _wu_palmer(way.features, way.up[0], way.up[-1]) * _wu_palmer(
        way.places, way.on[0], way.on[-1]
    )


def lin(way: Way) -> float:
    """Information that the classes share.

    The factor is ``lin(f, g) * lin(p, e)`` with ``lin(a, b) = 2 IC(lcs) / (IC(a) + IC(b))``.
    IC(c) = -log(share of the classes of c's taxonomy that are at or below c), lcs the class with
    the largest IC at or above both a and b. lin(a, a) = 1, also for a root, whose IC is 0
    (D. Lin: An information-theoretic definition of similarity, ICML 1998). An indication that is
    stated for all features, at the root, says nothing here and yields 0 for the features below.
    """
    return _lin(way.features, way.up[0], way.up[-1]) * _lin(way.places, way.on[0], way.on[-1])


MEASURES: dict[str, Measure] = {"path": path, "wu_palmer": wu_palmer, "lin": lin}
"""Name -> measure; another one is added here and by raising ``store.FORMAT``."""


def _wu_palmer(taxonomy: Taxonomy, a: str, b: str) -> float:
    deepest = max(taxonomy.depth(c) for c in taxonomy.common(a, b))
    return 2 * deepest / (taxonomy.depth(a) + taxonomy.depth(b))


def _lin(taxonomy: Taxonomy, a: str, b: str) -> float:
    if a == b:
        return 1.0
    most = max(taxonomy.information(c) for c in taxonomy.common(a, b))
    total = taxonomy.information(a) + taxonomy.information(b)
    return 2 * most / total if total else 1.0
