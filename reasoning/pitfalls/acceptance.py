"""Findings that an ontology accepts itself, with a reason.

``sl:acceptedPitfall "P11: any thing may have a name"`` on a term accepts the pitfall wherever the
term has a part in it; on an axiom (``owl:Axiom``) where that axiom is at fault; on an ontology in
the whole file that declares it. Without a reason it has no effect.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable, Iterator
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


_Key = tuple[str, str | Triple | Place]
"""Code and what it is accepted for."""


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
        self._all.sort(key=lambda a: (a.where.file, a.where.line or 0, a.form, a.reason))
        self._by: dict[_Key, list[_Acceptance]] = defaultdict(list)
        for acceptance in self._all:
            for scope in self._scopes(acceptance):
                self._by[acceptance.code, scope].append(acceptance)

    def _scopes(self, acceptance: _Acceptance) -> Iterator[str | Triple | Place]:
        """What an acceptance holds for: an axiom, the files of an ontology, or a term."""
        ontology = (acceptance.subject, RDF.type, OWL.Ontology)
        if acceptance.axiom:
            yield acceptance.axiom
        elif ontology in self._ontology.graph:
            for document in self._ontology.documents:
                if ontology in document.graph:
                    yield Place(document.name, None)
        else:
            yield str(acceptance.subject)

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
        finding = occurrence.finding
        keys: list[_Key] = [(code, element) for element in finding.elements]
        keys += [(code, axiom) for axiom in finding.axioms]
        keys.append((code, Place(occurrence.place.file, None)))
        fitting = [
            acceptance
            for key in keys
            for acceptance in self._by.get(key, ())
            if acceptance.variant in ("", finding.variant)
        ]
        self._used.update(fitting)
        return replace(occurrence, accepted=fitting[0].reason) if fitting else occurrence

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
