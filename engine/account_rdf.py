"""Accounts as RDF, in the terms of ``ontology/map.ttl`` and ``ontology/justification.ttl``."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Mapping
from typing import Any
from urllib.parse import quote

from symboslam.engine.account import Account, Change, Taken
from symboslam.engine.account_formats import as_json
from symboslam.engine.landmark_parts import LandmarkPart
from symboslam.engine.wording import text_of
from symboslam.engine.writers.vocabulary import GEO
from symboslam.reasoning.knowledge import Indication
from symboslam.reasoning.vocabulary import DOCUMENTS, SL

EXPLANATIONS = DOCUMENTS + "explanation/"
"""Where explanations lie of segments that have no IRI."""


def as_turtle(
    account: Account,
    iris: Mapping[str, str],
    length: str = "paragraph",
    segment: str | None = None,
) -> str:
    """As Turtle.

    Args:
        account: what to tell.
        iris: name -> IRI of environments, groups, zones and features; ours where one is missing.
        length: of its words.
        segment: IRI of the segment in its map, which the explanation then points to.
    """
    return _Graph(account, iris, length, segment).serialised()


def iri_of(account: Account, length: str = "paragraph", segment: str | None = None) -> str:
    """The IRI of an explanation: below its segment's, and the same if all that it says is."""
    digest = hashlib.sha256(as_json(account, length).encode()).hexdigest()[:16]
    name = quote(account.explanation.segment_id, safe="", errors="replace")
    return f"{segment}/explanation/{digest}" if segment else f"{EXPLANATIONS}{name}/{digest}"


class _Graph:
    """The statements about one account."""

    def __init__(
        self, account: Account, iris: Mapping[str, str], length: str, segment: str | None
    ) -> None:
        from rdflib import Graph, Namespace, URIRef
        from rdflib.namespace import DCTERMS, OWL, PROV

        self.account, self._iris, self._length, self._segment = account, iris, length, segment
        self.sl, self.graph = Namespace(SL), Graph()
        self.node = URIRef(iri_of(account, length, segment))
        spaces = {"sl": SL, "owl": OWL, "dcterms": DCTERMS, "prov": PROV, "geo": GEO}
        for prefix, namespace in spaces.items():
            self.graph.bind(prefix, namespace)

    def serialised(self) -> str:
        """All of it as Turtle."""
        from rdflib import RDF, RDFS, Literal, URIRef
        from rdflib.namespace import DCTERMS

        told, sl, add = self.account.explanation, self.sl, self.graph.add
        add((self.node, RDF.type, sl.SegmentExplanation))
        add((self.node, DCTERMS.identifier, Literal(told.segment_id)))
        add((self.node, RDFS.comment, Literal(text_of(self.account, self._length), lang="en")))
        if self._segment is not None:
            add((self.node, sl.explains, URIRef(self._segment)))
        if told.environment is not None:
            add((self.node, sl.environment, self._iri(told.environment)))
        if self.account.runner_up is not None:
            add((self.node, sl.runnerUp, self._iri(self.account.runner_up)))
        for name, p in told.probabilities.items():
            node = self._part("hasProbability", "EnvironmentProbability")
            add((node, sl.environment, self._iri(name)))
            add((node, sl.probability, self._decimal(p)))
            self._zones(node, name)
        for reason in told.reasons:
            for name, share in reason.contribution.items():
                self._contribution("hasContribution", name, share, reason.count, [reason.feature])
        self._comparison()
        self._landmarks()
        self._pairs()
        self._groups()
        for change in self.account.counterfactuals or ():
            self._change(change)
        for indication in self.account.indications:
            self._justification(indication)
        return self.graph.serialize(format="turtle")

    def _iri(self, name: str) -> Any:
        from rdflib import URIRef

        return URIRef(self._iris.get(name, SL + name))

    def _decimal(self, value: float) -> Any:
        from rdflib import XSD, Literal

        return Literal(f"{value:.12f}", datatype=XSD.decimal)

    def _part(self, link: str, kind: str) -> Any:
        """A new node of a class, linked from the explanation."""
        from rdflib import RDF, BNode

        node = BNode()
        self.graph.add((self.node, self.sl[link], node))
        self.graph.add((node, RDF.type, self.sl[kind]))
        return node

    def _zones(self, node: Any, environment: str) -> None:
        """The zones of an environment, below the node of its probability."""
        from rdflib import RDF, RDFS, BNode, Literal

        chain, sl, add = self.account.explanation.chain, self.sl, self.graph.add
        if chain is None:
            return
        if environment in chain.untold:
            add((node, sl.zonesToldApart, Literal(False)))
        for zone, p in chain.zones.get(environment, {}).items():
            below = BNode()
            add((node, sl.hasZoneProbability, below))
            add((below, RDF.type, sl.ChainedProbability))
            add((below, sl.environment, self._iri(zone)))
            add((below, sl.probability, self._decimal(p)))
            add((self._iri(zone), RDFS.subClassOf, self._iri(environment)))

    def _groups(self) -> None:
        """The probabilities of groups; types that are in none have theirs among the others."""
        told = self.account.explanation
        for name, p in (told.chain.groups if told.chain else {}).items():
            if name not in told.probabilities:
                node = self._part("hasGroupProbability", "ChainedProbability")
                self.graph.add((node, self.sl.environment, self._iri(name)))
                self.graph.add((node, self.sl.probability, self._decimal(p)))

    def _comparison(self) -> None:
        """Why the one environment rather than the other, class by class."""
        from rdflib import RDF, BNode, Literal

        why, other, add, sl = self.account.why, self.account.against, self.graph.add, self.sl
        if why is None or other is None:
            return
        node = self._part("hasComparison", "EnvironmentComparison")
        add((node, sl.environment, self._iri(other.environment)))
        add((node, sl.lead, self._decimal(why.probability - other.probability)))
        for each in self.account.differences:
            below = BNode()
            add((node, sl.hasDifference, below))
            add((below, RDF.type, sl.ShareDifference))
            if each.feature:
                add((below, sl.featureClass, self._iri(each.feature)))
            add((below, sl["count"], Literal(each.count)))
            add((below, sl.winnerShare, self._decimal(each.winner)))
            add((below, sl.otherShare, self._decimal(each.other)))
            add((below, sl.difference, self._decimal(each.difference)))

    def _landmarks(self) -> None:
        """What landmarks add; without an identifier what the others do, and the ground."""
        link, name, parts = "hasLandmarkContribution", self._name, self.account.parts
        for mark in parts.landmarks:
            node = self._contribution(link, name, mark.contribution, 1, [mark.feature], [mark.id])
            self._landmark(node, mark)
        if parts.other_landmarks and parts.other_landmarks.count:
            others = parts.other_landmarks
            self._contribution(link, name, others.contribution, others.count)
        if parts.ground:
            self._contribution(link, name, parts.ground, 0)

    def _landmark(self, node: Any, mark: LandmarkPart) -> None:
        add, sl = self.graph.add, self.sl
        own = sl.countShare if self.account.parts.counted else sl.ownShare
        add((node, own, self._decimal(mark.own)))
        add((node, sl.pairShare, self._decimal(mark.pairs)))
        if mark.without is not None:
            add((node, sl.probabilityWithout, self._decimal(mark.without)))
        self._stands_at(node, mark.position)

    def _pairs(self) -> None:
        """What pairs add; without identifiers what all others do."""
        link, name, parts = "hasPairContribution", self._name, self.account.parts
        for pair in parts.pairs:
            self._contribution(link, name, pair.contribution, 2, [], [pair.first, pair.second])
        if parts.other_pairs and parts.other_landmarks:
            count = len(parts.landmarks) + parts.other_landmarks.count
            self._contribution(link, name, parts.other_pairs, count)

    def _stands_at(self, node: Any, position: tuple[float, float]) -> None:
        """A point in the coordinates of the input."""
        from rdflib import RDF, BNode, Literal, URIRef

        place, (x, y) = BNode(), position
        wkt = f"<{self.account.parts.crs}> POINT ({x:.9f} {y:.9f})"
        self.graph.add((node, self.sl.standsAt, place))
        self.graph.add((place, RDF.type, URIRef(GEO + "Geometry")))
        literal = Literal(wkt, datatype=URIRef(GEO + "wktLiteral"))
        self.graph.add((place, URIRef(GEO + "asWKT"), literal))

    @property
    def _name(self) -> str:
        return self.account.explanation.environment or ""

    def _contribution(
        self,
        link: str,
        environment: str,
        share: float,
        count: int,
        features: Iterable[str] = (),
        landmarks: Iterable[str] = (),
    ) -> Any:
        from rdflib import Literal
        from rdflib.namespace import DCTERMS

        node, add = self._part(link, "Contribution"), self.graph.add
        add((node, self.sl.environment, self._iri(environment)))
        add((node, self.sl.share, self._decimal(share)))
        add((node, self.sl["count"], Literal(count)))
        for feature in filter(None, features):
            add((node, self.sl.featureClass, self._iri(feature)))
        for landmark in landmarks:
            add((node, DCTERMS.identifier, Literal(landmark)))
        return node

    def _change(self, change: Change) -> None:
        from rdflib import Literal

        node, add, sl = self._part("hasCounterfactual", "Counterfactual"), self.graph.add, self.sl
        if change.environment is not None:
            add((node, sl.environment, self._iri(change.environment)))
        add((node, sl.probability, self._decimal(change.probability)))
        add((node, sl.provedMinimal, Literal(change.minimal)))
        add((node, sl.tries, Literal(change.tried)))
        add((node, sl.classifiedAnew, Literal(change.anew)))
        for taken in change.without:
            self._changed(node, sl.removes, taken)
        if change.plus is not None:
            some = self._changed(node, sl.adds, change.plus)
            if change.place is not None:
                self._stands_at(some, change.place)

    def _changed(self, change: Any, link: Any, taken: Taken) -> Any:
        """The landmarks of one class that a change takes away or adds."""
        from rdflib import RDF, BNode, Literal
        from rdflib.namespace import DCTERMS

        some, add, sl = BNode(), self.graph.add, self.sl
        add((change, link, some))
        add((some, RDF.type, sl.ChangedLandmarks))
        add((some, sl.featureClass, self._iri(taken.feature)))
        add((some, sl["count"], Literal(taken.count)))
        for identifier in taken.ids:
            add((some, DCTERMS.identifier, Literal(identifier)))
        return some

    def _justification(self, found: Indication) -> None:
        """Why a class of features indicates an environment: the axiom, and where it stands."""
        from rdflib import OWL, RDF, RDFS, BNode, Literal, URIRef
        from rdflib.namespace import DCTERMS, PROV

        add, sl = self.graph.add, self.sl
        entailment, node, axiom = BNode(), self._part("hasJustification", "Justification"), BNode()
        add((node, sl.justifies, entailment))
        add((entailment, RDF.type, sl.Entailment))
        add((entailment, OWL.annotatedSource, self._iri(found.feature)))
        add((entailment, OWL.annotatedProperty, sl.indicates))
        add((entailment, OWL.annotatedTarget, self._iri(found.environment)))
        add((entailment, RDF.type, sl.Indication))
        add((entailment, sl.environment, self._iri(found.environment)))
        add((entailment, sl.strength, self._decimal(found.strength)))
        add((entailment, sl.steps, Literal(found.steps)))
        add((entailment, sl.way, Literal(" > ".join(found.path))))
        if found.source:
            add((entailment, DCTERMS.source, Literal(found.source, lang="en")))
        if found.source_iri:
            add((entailment, PROV.wasDerivedFrom, URIRef(found.source_iri)))
        add((node, sl.usesAxiom, axiom))
        for text in found.axioms or (f"{found.feature} indicates {found.environment}",):
            add((axiom, RDFS.label, Literal(text, lang="en")))
        add((axiom, sl.strength, self._decimal(found.strength)))
        file, _, line = found.stands.partition(": line ")
        if file:
            add((axiom, DCTERMS.source, Literal(file)))
        if line.isdigit():
            add((axiom, sl.lineNumber, Literal(int(line))))
        if found.reason:
            add((axiom, RDFS.comment, Literal(found.reason, lang="en")))
