"""Findings that an ontology accepts itself, with a reason.

``sl:acceptedPitfall "P11: any thing may have a name"`` on a term accepts the pitfall wherever the
term has a part in it; on an axiom (``owl:Axiom``) where that axiom is at fault; on an ontology in
the whole file that declares it. Without a reason it has no effect.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, replace

from rdflib import OWL, RDF, URIRef
from rdflib.term import Node

from symboslam.reasoning.axioms import Triple
from symboslam.reasoning.pitfalls.model import Occurrence, Result, Status
from symboslam.reasoning.pitfalls.ontology import Ontology
from symboslam.reasoning.sources import Place
from symboslam.reasoning.vocabulary import ACCEPTED_PITFALL

_VALUE = re.compile(r"\s*(P\d\d)(-\w)?\s*:?\s*(.*)", re.DOTALL)


@dataclass(frozen=True)
class _Acceptance:
    subject: Node
    code: str
    variant: str
    reason: str
    axiom: Triple | None
    where: Place


class Acceptances:
    """All that an ontology accepts."""

    def __init__(self, ontology: Ontology) -> None:
        self._ontology = ontology
        self._all: list[_Acceptance] = []
        self._used: set[_Acceptance] = set()
        self._notes: list[tuple[Place, str]] = []
        for subject, values in ontology.statements(URIRef(ACCEPTED_PITFALL)).items():
            for value in values:
                place = ontology.place((subject, URIRef(ACCEPTED_PITFALL), value))
                self._read(subject, str(value), place or Place("", None))

    def _read(self, subject: Node, value: str, where: Place) -> None:
        found = _VALUE.fullmatch(value)
        if not found or not found[3].strip():
            shown = " ".join(value.split())
            what = f'"{shown}" accepts nothing: write the code and the reason, "P11: ..."'
            self._notes.append((where, what))
            return
        code, variant = found[1], found[1] + found[2] if found[2] else ""
        reason = " ".join(found[3].split())
        self._all.append(_Acceptance(subject, code, variant, reason, self._axiom(subject), where))

    def _axiom(self, subject: Node) -> Triple | None:
        if OWL.Axiom not in self._ontology.objects(subject, RDF.type):
            return None
        parts = [
            next(iter(self._ontology.objects(subject, predicate)), None)
            for predicate in (OWL.annotatedSource, OWL.annotatedProperty, OWL.annotatedTarget)
        ]
        s, p, o = parts
        return (s, p, o) if s is not None and p is not None and o is not None else None

    def apply(self, result: Result) -> Result:
        """A result whose accepted occurrences carry the reason."""
        code = result.pitfall.code
        occurrences = tuple(self._one(code, occurrence) for occurrence in result.occurrences)
        return replace(result, occurrences=occurrences)

    def _one(self, code: str, occurrence: Occurrence) -> Occurrence:
        fitting = [a for a in self._all if a.code == code and self._covers(a, occurrence)]
        self._used.update(fitting)
        return replace(occurrence, accepted=fitting[0].reason) if fitting else occurrence

    def _covers(self, acceptance: _Acceptance, occurrence: Occurrence) -> bool:
        finding = occurrence.finding
        if acceptance.variant and acceptance.variant != finding.variant:
            return False
        if acceptance.axiom:
            return acceptance.axiom in finding.axioms
        ontology = (acceptance.subject, RDF.type, OWL.Ontology)
        if ontology in self._ontology.graph:
            files = {d.name for d in self._ontology.documents if ontology in d.graph}
            return occurrence.place.file in files
        return str(acceptance.subject) in finding.elements

    def notes(self, results: Iterable[Result]) -> list[str]:
        """Acceptances in given files without a reason, and such as accept what is not there."""
        checked = {r.pitfall.code for r in results if r.status is Status.CHECKED}
        stale = [
            (acceptance.where, f"accepts {acceptance.code}, which is not found there")
            for acceptance in self._all
            if acceptance not in self._used and acceptance.code in checked
        ]
        told = sorted([*self._notes, *stale], key=lambda n: (n[0].file, n[0].line or 0, n[1]))
        return [f"{place}: {what}" for place, what in told if place.file in self._ontology.given]
