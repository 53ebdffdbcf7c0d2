"""Accounts as JSON, after ``account.schema.json``, and as RDF."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict
from importlib.resources import files
from typing import Any

from symboslam.engine.account import Account, Change
from symboslam.engine.wording import text_of
from symboslam.reasoning.knowledge import Indication
from symboslam.reasoning.vocabulary import SL

SCHEMA = "account.schema.json"


def record_of(account: Account, length: str = "paragraph") -> dict[str, Any]:
    """An account as plain values, with its words in the length asked for."""
    told = account.explanation
    record: dict[str, Any] = {
        "segment_id": told.segment_id,
        "environment": told.environment,
        "probabilities": dict(told.probabilities),
        "runner_up": account.runner_up,
        "chain": None
        if told.chain is None
        else {
            "groups": dict(told.chain.groups),
            "zones": {name: dict(zones) for name, zones in told.chain.zones.items()},
            "untold": list(told.chain.untold),
        },
        "reasons": [asdict(reason) for reason in told.reasons],
        "why": account.why and asdict(account.why),
        "against": account.against and asdict(account.against),
        "difference": account.why.probability - account.against.probability
        if account.why and account.against
        else None,
        "differences": [asdict(each) for each in account.differences],
        "landmarks": [asdict(each) for each in account.landmarks],
        "pairs": [asdict(each) for each in account.pairs],
        "counterfactuals": None
        if account.counterfactuals is None
        else [asdict(each) for each in account.counterfactuals],
        "indications": [asdict(each) for each in account.indications],
        "text": text_of(account, length),
    }
    return record


def as_json(account: Account, length: str = "paragraph") -> str:
    """For programs; ``schema`` says what is in it."""
    return json.dumps(record_of(account, length), indent=1, ensure_ascii=False)


def schema() -> dict[str, Any]:
    """The JSON schema of ``as_json``."""
    text = (files("symboslam.engine") / SCHEMA).read_text(encoding="utf-8")
    found: dict[str, Any] = json.loads(text)
    return found


def as_turtle(account: Account, iris: Mapping[str, str], length: str = "paragraph") -> str:
    """As RDF, in the terms of ``ontology/map.ttl`` and ``ontology/justification.ttl``.

    Args:
        account: what to tell.
        iris: name -> IRI of environments, groups, zones and features; ours where one is missing.
        length: of its words.
    """
    return _Graph(account, iris).serialised(length)


class _Graph:
    """The statements about one account."""

    def __init__(self, account: Account, iris: Mapping[str, str]) -> None:
        from rdflib import Graph, Namespace, URIRef
        from rdflib.namespace import DCTERMS, OWL, PROV

        self.account, self._iris = account, iris
        self.sl, self.graph, self.node = Namespace(SL), Graph(), URIRef("#explanation")
        for prefix, namespace in (("sl", SL), ("owl", OWL), ("dcterms", DCTERMS), ("prov", PROV)):
            self.graph.bind(prefix, namespace)

    def serialised(self, length: str) -> str:
        """All of it as Turtle."""
        from rdflib import RDF, RDFS, Literal
        from rdflib.namespace import DCTERMS

        told, sl, add = self.account.explanation, self.sl, self.graph.add
        add((self.node, RDF.type, sl.SegmentExplanation))
        add((self.node, DCTERMS.identifier, Literal(told.segment_id)))
        add((self.node, RDFS.comment, Literal(text_of(self.account, length), lang="en")))
        if told.environment is not None:
            add((self.node, sl.environment, self._iri(told.environment)))
        for name, p in told.probabilities.items():
            node = self._part("hasProbability", "EnvironmentProbability")
            add((node, sl.environment, self._iri(name)))
            add((node, sl.probability, self._decimal(p)))
            self._zones(node, name)
        for reason in told.reasons:
            for name, share in reason.contribution.items():
                self._contribution("hasContribution", name, share, reason.count, [reason.feature])
        for mark in self.account.landmarks:
            parts = "hasLandmarkContribution", told.environment, mark.contribution, 1
            self._contribution(*parts, [mark.feature], [mark.id])
        for pair in self.account.pairs:
            parts = "hasPairContribution", told.environment, pair.contribution, 2
            self._contribution(*parts, [], [pair.first, pair.second])
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

    def _contribution(
        self,
        link: str,
        environment: str | None,
        share: float,
        count: int,
        features: list[str],
        landmarks: list[str] | None = None,
    ) -> None:
        from rdflib import Literal
        from rdflib.namespace import DCTERMS

        node, add = self._part(link, "Contribution"), self.graph.add
        add((node, self.sl.environment, self._iri(environment or "")))
        add((node, self.sl.share, self._decimal(share)))
        add((node, self.sl["count"], Literal(count)))
        for feature in filter(None, features):
            add((node, self.sl.featureClass, self._iri(feature)))
        for landmark in landmarks or []:
            add((node, DCTERMS.identifier, Literal(landmark)))

    def _change(self, change: Change) -> None:
        from rdflib import RDF, BNode, Literal
        from rdflib.namespace import DCTERMS

        node, add, sl = self._part("hasCounterfactual", "Counterfactual"), self.graph.add, self.sl
        if change.environment is not None:
            add((node, sl.environment, self._iri(change.environment)))
        add((node, sl.probability, self._decimal(change.probability)))
        add((node, sl.provedMinimal, Literal(change.minimal)))
        added = [(sl.adds, change.plus)] if change.plus else []
        for link, taken in [*((sl.removes, each) for each in change.without), *added]:
            some = BNode()
            add((node, link, some))
            add((some, RDF.type, sl.ChangedLandmarks))
            add((some, sl.featureClass, self._iri(taken.feature)))
            add((some, sl["count"], Literal(taken.count)))
            for identifier in taken.ids:
                add((some, DCTERMS.identifier, Literal(identifier)))

    def _justification(self, found: Indication) -> None:
        """Why a class of features indicates an environment: the axiom, and where it stands."""
        from rdflib import OWL, RDF, RDFS, BNode, Literal
        from rdflib.namespace import DCTERMS

        add, sl = self.graph.add, self.sl
        entailment, node, axiom = BNode(), self._part("hasJustification", "Justification"), BNode()
        add((node, sl.justifies, entailment))
        add((entailment, RDF.type, sl.Entailment))
        add((entailment, OWL.annotatedSource, self._iri(found.feature)))
        add((entailment, OWL.annotatedProperty, sl.indicates))
        add((entailment, OWL.annotatedTarget, self._iri(found.environment)))
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
