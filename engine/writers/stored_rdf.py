"""Maps read back from Turtle or N-Quads; see ``stored.read_map``."""

from __future__ import annotations

from collections import defaultdict
from pathlib import Path
from typing import TYPE_CHECKING

from symboslam.engine.explanation import Explanation, Reason
from symboslam.engine.writers.rdf_files import read_graph
from symboslam.engine.writers.stored import StoredMap, in_order
from symboslam.engine.writers.vocabulary import DCTERMS, PROV, RDF, RDFS, SKOS, SOSA
from symboslam.errors import InputError
from symboslam.reasoning.knowledge import Environment, Indication
from symboslam.reasoning.vocabulary import SL, local_name

if TYPE_CHECKING:
    from rdflib import Graph
    from rdflib.term import Node


def read_rdf(path: Path) -> StoredMap:
    """Read a map from a Turtle or N-Quads file.

    Raises:
        InputError: it cannot be read, does not parse, or is no environment map.
    """
    graph = read_graph(path)
    try:
        return _Reader(graph, str(path)).stored()
    except ValueError as error:
        raise InputError(f"{path} is no complete environment map: {error}") from error


class _Reader:
    """Looks up what the records of ``rdf_records`` and ``rdf_lineage`` say."""

    def __init__(self, graph: Graph, source: str) -> None:
        self.graph, self.source = graph, source

    def one(self, subject: Node, predicate: str) -> Node | None:
        """The value of a property, or None."""
        from rdflib import URIRef

        return next(self.graph.objects(subject, URIRef(predicate)), None)

    def all(self, subject: Node, predicate: str) -> list[Node]:
        """All values of a property."""
        from rdflib import URIRef

        return list(self.graph.objects(subject, URIRef(predicate)))

    def text(self, subject: Node, predicate: str) -> str:
        """The value of a property as text; empty where there is none."""
        value = self.one(subject, predicate)
        return "" if value is None else str(value)

    def of_type(self, kind: str) -> list[Node]:
        """All subjects of a class."""
        from rdflib import URIRef

        return list(self.graph.subjects(URIRef(RDF + "type"), URIRef(SL + kind)))

    def name(self, term: Node | None) -> str:
        """The name that a class goes by in files."""
        if term is None:
            raise InputError(f"{self.source} is no complete environment map: a class is missing")
        return self.text(term, SKOS + "notation") or local_name(str(term))

    def stored(self) -> StoredMap:
        """The map."""
        from rdflib import URIRef

        if not self.of_type("EnvironmentMap"):
            raise InputError(f"{self.source} holds no sl:EnvironmentMap")
        classified = {}
        for classification in self.of_type("SegmentClassification"):
            classified[self.one(classification, SOSA + "hasFeatureOfInterest")] = classification
        segments = [self.segment(s, classified.get(s)) for s in self.of_type("Segment")]
        below = URIRef(RDFS + "subClassOf")
        mentioned = {self.one(c, SL + "featureClass") for c in self.of_type("Contribution")}
        features = [f for f in mentioned if f is not None]
        return StoredMap(
            source=self.source,
            environments={
                self.name(e): self.environment(e)
                for e in self.graph.subjects(below, URIRef(SL + "Environment"))
            },
            features={self.name(f): self.text(f, RDFS + "label") for f in features},
            indications={
                (i.feature, i.environment): i for f in features for i in self.indications(f)
            },
            segments={segment.segment_id: segment for segment in segments},
        )

    def environment(self, term: Node) -> Environment:
        """An environment type."""
        return Environment(
            iri=str(term),
            name=self.name(term),
            label=self.text(term, RDFS + "label"),
            definition=self.text(term, SKOS + "definition"),
            colour=self.text(term, SL + "colour"),
        )

    def indications(self, feature: Node) -> list[Indication]:
        """What a feature indicates."""
        return [
            Indication(
                feature=self.name(feature),
                environment=self.name(self.one(node, SL + "environment")),
                strength=float(self.text(node, SL + "strength")),
                steps=int(self.text(node, SL + "steps")),
                path=tuple(filter(None, self.text(node, SL + "way").split(" > "))),
                reason=self.text(node, RDFS + "comment"),
                source=self.text(node, DCTERMS + "source"),
                source_iri=self.text(node, PROV + "wasDerivedFrom"),
            )
            for node in self.all(feature, SL + "hasIndication")
        ]

    def segment(self, segment: Node, classification: Node | None) -> Explanation:
        """A segment with its distribution and reasons."""
        environment = self.one(segment, SL + "environment")
        probabilities: dict[str, float] = {}
        reasons: tuple[Reason, ...] = ()
        if classification is not None:
            result = self.one(classification, SOSA + "hasResult")
            given = self.all(result, SL + "hasProbability") if result is not None else []
            probabilities = {
                self.name(self.one(node, SL + "environment")): self.number(node, "probability")
                for node in given
            }
            reasons = self.reasons(classification)
        return in_order(
            Explanation(
                segment_id=self.text(segment, DCTERMS + "identifier"),
                environment=None if environment is None else self.name(environment),
                probabilities=probabilities,
                reasons=reasons,
            )
        )

    def number(self, node: Node, name: str) -> float:
        """The value of a numeric property."""
        return float(self.text(node, SL + name))

    def reasons(self, classification: Node) -> tuple[Reason, ...]:
        """The contributions, put together by feature."""
        shares: dict[Node | None, dict[str, float]] = defaultdict(dict)
        labels: dict[Node | None, tuple[str, str, int]] = {}
        for node in self.all(classification, SL + "hasContribution"):
            feature = self.one(node, SL + "featureClass")
            name = "" if feature is None else self.name(feature)
            label = self.text(node if feature is None else feature, RDFS + "label")
            labels[feature] = (name, label, int(self.text(node, SL + "count")))
            environment = self.name(self.one(node, SL + "environment"))
            shares[feature][environment] = self.number(node, "share")
        return tuple(Reason(*labels[feature], shares[feature]) for feature in shares)
