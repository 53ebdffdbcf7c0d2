"""What a page about an environment type shows: its features by weight, and what sets it apart."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass
from functools import cached_property

from rdflib import Graph

from symboslam.reasoning.knowledge import Environment, Feature, Indication, Knowledge
from symboslam.reasoning.statements import Stated, Statements

TELLING = 0.8
"""A feature tells a type from the others if at least this share of its proximity goes to it."""

_MOST_TELLING, _MOST_AGAINST = 12, 5


@dataclass(frozen=True)
class Row:
    """How a feature indicates an environment.

    Attributes:
        feature: the class of landmarks.
        way: the strongest way from it to the environment.
        weight: SP(e, f) times importance I(f).
        share: SP(e, f) over the sum of SP(., f) of all types in the scheme; 1 = only this type.
        also: further indications of the feature that lead to the environment.
    """

    feature: Feature
    way: Indication
    weight: float
    share: float
    also: tuple[Stated, ...] = ()


@dataclass(frozen=True)
class Rival:
    """Another environment type, and how features tell the two apart.

    Attributes:
        environment: the other type.
        shared: how many features indicate both.
        telling: the features whose weight is most above that for the other type.
    """

    environment: Environment
    shared: int
    telling: tuple[Row, ...]


class Evidence:
    """The indications of an ontology, by environment type and by feature.

    Args:
        knowledge: what reasoning left.
        graph: what the ontology states.
    """

    def __init__(self, knowledge: Knowledge, graph: Graph) -> None:
        self.knowledge, self.stated = knowledge, Statements(graph)

    @property
    def environments(self) -> tuple[Environment, ...]:
        """All environment types."""
        return self.knowledge.environments

    def scheme_of(self, environment: str) -> str:
        """The scheme that weights are given for: the default one, or else one with the type."""
        schemes = self.knowledge.schemes
        return next((n for n, members in schemes.items() if environment in members), "")

    @cached_property
    def rows(self) -> dict[str, tuple[Row, ...]]:
        """Name of an environment type -> its features, the weightiest first."""
        found: dict[str, list[Row]] = {e.name: [] for e in self.environments}
        columns = {e.name: self._column(e.name) for e in self.environments}
        for i, feature in enumerate(self.knowledge.features):
            for way in self.knowledge.indications_of(feature.name):
                weight, share = columns[way.environment][i]
                also = self._also(feature, way)
                found[way.environment].append(Row(feature, way, weight, share, also))
        return {
            name: tuple(sorted(rows, key=lambda r: (-r.weight, r.feature.label, r.feature.iri)))
            for name, rows in found.items()
        }

    def _column(self, environment: str) -> list[tuple[float, float]]:
        """Weight and share of each feature for a type."""
        scheme = self.scheme_of(environment) or None
        names = [e.name for e in self.knowledge.scheme(scheme)]
        if environment not in names:
            return [(0.0, 0.0)] * len(self.knowledge.features)
        k = names.index(environment)
        proximity = self.knowledge.proximity(scheme=scheme)
        weights = self.knowledge.weights(scheme=scheme)[:, k]
        totals = proximity.sum(axis=1)
        return [
            (float(w), float(p / total) if total else 0.0)
            for w, p, total in zip(weights, proximity[:, k], totals, strict=True)
        ]

    @cached_property
    def of_feature(self) -> dict[str, tuple[tuple[Environment, Row], ...]]:
        """IRI of a feature -> the types that it indicates, the weightiest first."""
        found: dict[str, list[tuple[Environment, Row]]] = defaultdict(list)
        for environment in self.environments:
            for row in self.rows[environment.name]:
                found[row.feature.iri].append((environment, row))
        return {
            iri: tuple(sorted(pairs, key=lambda p: (-p[1].weight, p[0].label)))
            for iri, pairs in found.items()
        }

    def telling(self, environment: str) -> tuple[Row, ...]:
        """The weightiest features that indicate a type and hardly any other."""
        rows = [row for row in self.rows[environment] if row.share >= TELLING]
        return tuple(rows[:_MOST_TELLING])

    def rivals(self, environment: str) -> tuple[Rival, ...]:
        """The other types, those that share most features first."""
        mine = {row.feature.iri: row for row in self.rows[environment]}
        found = []
        for other in self.environments:
            if other.name == environment:
                continue
            theirs = {row.feature.iri: row.weight for row in self.rows[other.name]}

            def lead(row: Row, theirs: dict[str, float] = theirs) -> float:
                return row.weight - theirs.get(row.feature.iri, 0.0)

            shared = [row for iri, row in mine.items() if iri in theirs]
            best = sorted(shared, key=lambda r: (-lead(r), r.feature.label))
            telling = tuple(row for row in best[:_MOST_AGAINST] if lead(row) > 0)
            found.append(Rival(other, len(shared), telling))
        return tuple(sorted(found, key=lambda r: (-r.shared, r.environment.label)))

    @cached_property
    def by_class(self) -> dict[str, tuple[Stated, ...]]:
        """IRI of a class -> the indications stated for it, the strongest first."""
        found: dict[str, list[Stated]] = defaultdict(list)
        for stated in self.stated.indications:
            found[stated.feature].append(stated)
        return {iri: tuple(sorted(s, key=_strongest)) for iri, s in found.items()}

    @cached_property
    def by_place(self) -> dict[str, tuple[Stated, ...]]:
        """IRI of a place -> the indications that name it, the strongest first."""
        found: dict[str, list[Stated]] = defaultdict(list)
        for stated in self.stated.indications:
            found[stated.place].append(stated)
        return {iri: tuple(sorted(s, key=_strongest)) for iri, s in found.items()}

    def _also(self, feature: Feature, way: Indication) -> tuple[Stated, ...]:
        """What is stated for a feature and leads to the environment, but is not the best way."""
        target = next(e.iri for e in self.environments if e.name == way.environment)
        return tuple(
            stated
            for iri in (feature.iri, *feature.aliases)
            for stated in self.by_class.get(iri, ())
            if stated.reason != way.reason and target in self._reached(stated.place)
        )

    def _reached(self, place: str) -> set[str]:
        """A place and what it is a kind or a part of, at any distance."""
        seen: set[str] = set()
        waiting = [place]
        while waiting:
            name = waiting.pop()
            if name not in seen:
                seen.add(name)
                waiting.extend(self.stated.kinds(name) | self.stated.wholes(name))
        return seen


def _strongest(stated: Stated) -> tuple[float, str, str]:
    strength = stated.strength if stated.is_valid else 0.0
    return -strength, stated.feature, stated.place
