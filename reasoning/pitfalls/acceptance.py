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
from symboslam.reasoning.pitfalls.registry import CODES, rule
from symboslam.reasoning.sources import Place
from symboslam.reasoning.vocabulary import ACCEPTED_PITFALL

_VALUE = re.compile(r"\s*(P\d\d(?:-[A-Z])?)\s*:?\s+(.*)", re.DOTALL | re.IGNORECASE)


@dataclass(frozen=True)
class _Acceptance:
    subject: Node
    code: str
    variant: str
    reason: str
    axiom: Triple | None
    where: Place

    @property
    def form(self) -> str:
        """The code, with the form of the pitfall if one is named."""
        return self.variant or self.code


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
        self._all.sort(key=lambda a: (a.where.file, a.where.line or 0, a.code, a.reason))

    def _read(self, subject: Node, value: str, where: Place) -> None:
        found = _VALUE.fullmatch(value)
        if not found or not found[2].strip():
            what = f'"{" ".join(value.split())}" accepts nothing: write the code and the reason'
            self._notes.append((where, f'{what}, "P11: ..."'))
            return
        form, reason = found[1].upper(), " ".join(found[2].split())
        code, dash, _ = form.partition("-")
        if code not in CODES or (dash and form not in rule(code).PITFALL.variants):
            self._notes.append((where, f"accepts {form}, but there is no such pitfall"))
            return
        variant = form if dash else ""
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

    def notes(self, results: Iterable[Result], strict_oops: bool = False) -> list[str]:
        """Acceptances in given files without a reason, and such as accept what is not there.

        OOPS!'s rules name other elements, so that of theirs the latter would not be true.
        """
        checked = {r.pitfall.code for r in results if r.status is Status.CHECKED}
        stale = [
            (acceptance.where, f"accepts {acceptance.form}, which is not found there")
            for acceptance in self._all
            if acceptance not in self._used and acceptance.code in checked and not strict_oops
        ]
        told = sorted([*self._notes, *stale], key=lambda n: (n[0].file, n[0].line or 0, n[1]))
        return [f"{place}: {what}" for place, what in told if place.file in self._ontology.given]
