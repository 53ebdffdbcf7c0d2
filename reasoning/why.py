"""Why something follows from an ontology: its minimal sets of axioms, and where they stand."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from symboslam.errors import InconsistentOntologyError, InputError, ReasonerError
from symboslam.reasoning import sources
from symboslam.reasoning import vocabulary as v
from symboslam.reasoning.matching import unknown_name

if TYPE_CHECKING:
    from rdflib import Graph

    from symboslam.reasoning._base import Reasoner
    from symboslam.reasoning.axioms import Axiom
    from symboslam.reasoning.sources import Place, Sources

_PROBE = "urn:symboslam:why"
_SUBCLASS = re.compile(
    r"(.+?)\s+(?:rdfs:)?subClassOf:?\s+(.+)|(.+?)\s+is\s+an?\s+(.+)", re.IGNORECASE
)
_INDICATES = re.compile(r"(.+?)\s+(?:sl:)?indicates\s+(.+)", re.IGNORECASE)
_UNSATISFIABLE = re.compile(
    r"(.+?)\s+(?:is\s+unsatisfiable|subClassOf:?\s+owl:Nothing|can\s+have\s+no\s+members)",
    re.IGNORECASE,
)
_INCONSISTENT = re.compile(r"(?:(?:the\s+)?ontology\s+is\s+)?inconsistent", re.IGNORECASE)
_HOW_TO_ASK = (
    "ask 'House indicates Residential', 'House SubClassOf Building', 'House is unsatisfiable' or "
    "'inconsistent'"
)


@dataclass(frozen=True)
class Entailment:
    """A statement that may follow from an ontology.

    Attributes:
        kind: ``indicates``, ``subclass``, ``unsatisfiable`` or ``inconsistent``.
        subject: IRI of the class that it is about; None for an inconsistent ontology.
        object: IRI of the environment, place or superclass.
    """

    kind: str
    subject: str | None = None
    object: str | None = None

    @property
    def text(self) -> str:
        """The statement in words."""
        if self.subject is None:
            return "the ontology is inconsistent"
        name = v.local_name(self.subject)
        if self.object is None:
            return f"{name} is unsatisfiable"
        other = v.local_name(self.object)
        return f"{name} {'indicates' if self.kind == 'indicates' else 'is'} {self._named(other)}"

    def _named(self, other: str) -> str:
        from symboslam.reasoning.axioms import article

        return other if self.kind == "indicates" else article(other)


@dataclass(frozen=True)
class StatedAxiom:
    """An axiom of a justification and what the ontology says about it.

    Attributes:
        axiom: its triples.
        place: file and line; None if it was not read from a file.
        strength: ``sl:strength`` of an indication, or None.
        reason: its sentence (``rdfs:comment``), or empty.
        source: where it comes from, in words or as IRI, or empty.
    """

    axiom: Axiom
    place: Place | None
    strength: float | None = None
    reason: str = ""
    source: str = ""

    @property
    def text(self) -> str:
        """The axiom in words."""
        return self.axiom.text


@dataclass(frozen=True)
class Justifications:
    """The answer to a why.

    Attributes:
        entailment: what was asked.
        sets: minimal sets of axioms from which it follows, smallest first; none if it does not.
        complete: whether there is no further set.
    """

    entailment: Entailment
    sets: tuple[tuple[StatedAxiom, ...], ...]
    complete: bool

    @property
    def entailed(self) -> bool:
        """Whether it follows at all."""
        return bool(self.sets)

    def __str__(self) -> str:
        from symboslam.reasoning.why_formats import as_text

        return as_text(self)


def why(
    question: str,
    ontology: Sequence[str | Path] | str | Path | None = None,
    *,
    limit: int = 3,
    seconds: float = 60.0,
    strict: bool = True,
    reasoner: Reasoner | None = None,
) -> Justifications:
    """The minimal sets of axioms from which a statement follows.

    A set is minimal: without any one of its axioms the statement does not follow from the rest.

    Args:
        question: ``House indicates Residential``, ``House SubClassOf Building``, ``House is
            unsatisfiable`` or ``inconsistent``. Classes by local name, prefix:name, <IRI> or label.
        ontology: its files, or bundled documents by IRI; None for the whole bundled ontology.
        limit: how many sets to look for.
        seconds: time limit of the search.
        strict: refuse missing and cyclic imports (see :func:`sources.read_closure`).
        reasoner: HermiT by default.

    Raises:
        InputError: the question is not one of these, or a file cannot be read.
        UnknownNameError: the ontology has no such class.
        OntologyError: it does not parse, or is outside OWL 2 DL.
        InconsistentOntologyError: everything follows, for the ontology contradicts itself.
        ReasonerError: the reasoner could not be run, or took longer than ``seconds``.
    """
    if limit < 1:
        raise InputError(f"{limit} justifications? Ask for at least 1")
    if ontology is None:
        ontology = [sources.CLOSURE]
    targets = [ontology] if isinstance(ontology, str | Path) else list(ontology)
    read = sources.read_closure(targets, strict)
    return justify(_understand(question, read.graph), read, limit, seconds, reasoner)


def justify(
    entailment: Entailment,
    read: Sources,
    limit: int = 3,
    seconds: float = 60.0,
    reasoner: Reasoner | None = None,
) -> Justifications:
    """The minimal sets of axioms of an ontology that was read before; see :func:`why`."""
    from symboslam.reasoning.axioms import split
    from symboslam.reasoning.hermit import Hermit
    from symboslam.reasoning.hitting_set import minimal_sets
    from symboslam.reasoning.locality import module

    reasoner = reasoner or Hermit(timeout=seconds)
    declared, axioms = split(read.graph)
    probe_declared, probe = split(_probe(entailment))
    subject = _PROBE if probe else entailment.subject
    found, complete = minimal_sets(
        reasoner, [*declared, *probe_declared], axioms, subject, limit, seconds, probe
    )
    if (
        probe
        and found
        and True
        in reasoner.clashes([[*declared, *(t for a in module(axioms, []) for t in a.triples)]])
    ):
        raise InconsistentOntologyError(
            "the ontology is inconsistent, so that everything follows from it; "
            "why that is, says: symboslam why inconsistent"
        )
    if not found and not complete:
        raise ReasonerError(
            f"no minimal set of axioms was found within {seconds:g} s; --seconds allows more"
        )
    described = [
        tuple(_described(axiom, read) for axiom in sorted(one, key=_reading_order)) for one in found
    ]
    return Justifications(entailment, tuple(sorted(described, key=len)), complete)


def _probe(entailment: Entailment) -> Graph:
    """Axioms of a class that can have no members exactly if the subsumption holds."""
    from rdflib import OWL, RDF, RDFS, BNode, Graph, URIRef

    graph = Graph()
    if entailment.subject is None or entailment.object is None:
        return graph
    probe, negation, wanted = URIRef(_PROBE), BNode(), URIRef(entailment.object)
    graph.add((probe, RDF.type, OWL.Class))
    graph.add((probe, RDFS.subClassOf, URIRef(entailment.subject)))
    graph.add((probe, RDFS.subClassOf, negation))
    graph.add((negation, RDF.type, OWL.Class))
    if entailment.kind == "subclass":
        graph.add((negation, OWL.complementOf, wanted))
        return graph
    restriction, indicates = BNode(), URIRef(v.INDICATES)
    graph.add((negation, OWL.complementOf, restriction))
    graph.add((indicates, RDF.type, OWL.ObjectProperty))
    graph.add((restriction, RDF.type, OWL.Restriction))
    graph.add((restriction, OWL.onProperty, indicates))
    graph.add((restriction, OWL.someValuesFrom, wanted))
    return graph


def _described(axiom: Axiom, read: Sources) -> StatedAxiom:
    from rdflib import OWL, RDFS, URIRef

    head = (axiom.subject, axiom.predicate, axiom.object)
    place = read.places.get(head)
    graph = read.graph
    for note in graph.subjects(OWL.annotatedSource, axiom.subject):
        if graph.value(note, OWL.annotatedTarget) != axiom.object:
            continue
        if graph.value(note, OWL.annotatedProperty) != axiom.predicate:
            continue
        strength = graph.value(note, URIRef(v.STRENGTH))
        source = graph.value(note, URIRef(v.DERIVED_FROM))
        label = None if source is None else graph.value(source, RDFS.label)
        return StatedAxiom(
            axiom,
            place,
            None if strength is None else float(str(strength)),
            str(graph.value(note, RDFS.comment) or ""),
            str(label or source or ""),
        )
    return StatedAxiom(axiom, place)


def _reading_order(axiom: Axiom) -> tuple[str, ...]:
    return (str(axiom.subject), str(axiom.predicate), axiom.text)


def _understand(question: str, graph: Graph) -> Entailment:
    asked = " ".join(question.split()).rstrip(".?!")
    if _INCONSISTENT.fullmatch(asked):
        return Entailment("inconsistent")
    if found := _UNSATISFIABLE.fullmatch(asked):
        return Entailment("unsatisfiable", _class_named(found[1], graph))
    for kind, form in (("indicates", _INDICATES), ("subclass", _SUBCLASS)):
        if found := form.fullmatch(asked):
            one, other = (name for name in found.groups() if name)
            return Entailment(kind, _class_named(one, graph), _class_named(other, graph))
    raise InputError(f"{question!r} is not understood; {_HOW_TO_ASK}")


def _class_named(name: str, graph: Graph) -> str:
    """IRI of the class that is called so."""
    from rdflib import RDFS, URIRef

    from symboslam.reasoning.statements import Statements

    name = name.strip().strip("'\"")
    classes = Statements(graph).classes
    if name.startswith("<") and name.endswith(">") and name[1:-1] in classes:
        return name[1:-1]
    prefixes = dict(graph.namespaces())
    prefix, colon, local = name.partition(":")
    if colon and prefix in prefixes and f"{prefixes[prefix]}{local}" in classes:
        return f"{prefixes[prefix]}{local}"
    labels = {
        iri: {str(label).casefold() for label in graph.objects(URIRef(iri), RDFS.label)}
        for iri in classes
    }
    folded = name.casefold()
    ranks = (
        [iri for iri in classes if v.local_name(iri) == name],
        [iri for iri in classes if v.local_name(iri).casefold() == folded],
        [iri for iri in classes if folded in labels[iri]],
    )
    for found in filter(None, ranks):
        ours = [iri for iri in found if iri.startswith(v.SL)]
        if len(found) == 1 or len(ours) == 1:
            return (ours or found)[0]
        listed = ", ".join(f"<{iri}>" for iri in found)
        raise InputError(f"{name!r} may mean {listed}; give the IRI in angle brackets")
    raise unknown_name("class", name, sorted({v.local_name(iri) for iri in classes}))
