"""What an ontology states, read from its graph: kinds, parts, indications, labels and tags."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import PurePath
from typing import TYPE_CHECKING

from rdflib import OWL, RDF, RDFS, SKOS, BNode, Graph, Literal, URIRef
from rdflib.collection import Collection
from rdflib.term import Node

from symboslam.errors import OntologyError
from symboslam.reasoning import vocabulary as v

if TYPE_CHECKING:
    from symboslam.reasoning.located import Triple
    from symboslam.reasoning.sources import Place

_NECESSARY = (RDFS.subClassOf, OWL.equivalentClass)


@dataclass(frozen=True)
class Stated:
    """One stated indication: ``feature rdfs:subClassOf [indicates some place]``.

    Attributes:
        feature: IRI of the class g.
        place: IRI of the class p.
        strengths: as stated; NaN where a value is no number; empty if none is given.
        reason: the axiom's sentence; empty if none is given.
        source: IRI or text of where it comes from; empty if none is given.
        stands: name of the file, and line, of the axiom; empty where that is not known.
    """

    feature: str
    place: str
    strengths: tuple[float, ...] = ()
    reason: str = ""
    source: str = ""
    stands: str = ""

    @property
    def strength(self) -> float:
        """The strength in force: 1 if none is stated, the largest if several are."""
        return max(self.strengths, default=1.0)

    @property
    def is_valid(self) -> bool:
        """Whether all stated strengths are in (0, 1]."""
        return all(0 < strength <= 1 for strength in self.strengths)  # False for NaN


@dataclass(frozen=True)
class Scheme:
    """A set of environment types in use: its name, its members' IRIs, whether it is the default.

    ``bandwidth`` is how far in metres a landmark speaks for the ground around it, if stated.
    """

    name: str
    members: frozenset[str]
    is_default: bool
    bandwidth: float | None = None


class Statements:
    """Answers from a graph, always in the same order, so that results repeat exactly.

    Args:
        graph: what is stated.
        places: triple -> the file and line on which it stands, where that is known.
    """

    def __init__(self, graph: Graph, places: Mapping[Triple, Place] | None = None) -> None:
        self.graph, self._places = graph, places or {}

    @cached_property
    def classes(self) -> tuple[str, ...]:
        """Named classes: declared ones, and those that a class axiom uses."""
        found = set(self.graph.subjects(RDF.type, OWL.Class))
        for predicate in _NECESSARY:
            for s, o in self.graph.subject_objects(predicate):
                found.update((s, o))
        names = (str(c) for c in found if isinstance(c, URIRef))
        return tuple(sorted(name for name in names if not name.startswith(v.OWL_NAMESPACE)))

    def kinds(self, name: str) -> frozenset[str]:
        """The named classes that a class is stated to be a kind of."""
        parts = (part for node in self._necessary(name) for part in self._conjuncts(node))
        return frozenset(str(part) for part in parts if isinstance(part, URIRef)) - {name}

    def wholes(self, name: str) -> frozenset[str]:
        """The classes of places that each place of a class is stated to be a part of."""
        return frozenset(
            whole
            for node in self._necessary(name)
            for whole in self._fillers(node, self._part_properties)
        )

    @cached_property
    def indications(self) -> tuple[Stated, ...]:
        """All indications, stated as ``rdfs:subClassOf``.

        One inside an ``owl:equivalentClass`` is none: it says which features belong to the class,
        as in ``ResidentialFeature``, and not what an own feature points to.
        """
        found = []
        for name in self.classes:
            for node in self.graph.objects(URIRef(name), RDFS.subClassOf):
                for place in self._fillers(node, self._indicating_properties):
                    found.append(self._stated(name, place, node))
        return tuple(sorted(set(found), key=lambda s: (s.feature, s.place, repr(s))))

    def defined_by_indicating(self, name: str) -> frozenset[str]:
        """The places that members of a class indicate by its definition (owl:equivalentClass)."""
        return frozenset(
            place
            for node in self.graph.objects(URIRef(name), OWL.equivalentClass)
            for place in self._fillers(node, self._indicating_properties)
        )

    def text(self, name: str, *predicates: str | URIRef) -> str:
        """The first text under one of the predicates, English before none before others."""
        for predicate in predicates:
            texts = self.graph.objects(URIRef(name), URIRef(predicate))
            literals = [t for t in texts if isinstance(t, Literal)]
            if literals:
                return _clean(min(literals, key=_english_first))
        return ""

    def label(self, name: str) -> str:
        """A name's label, or else its local name taken apart: ``BusStop`` -> ``Bus stop``."""
        if label := self.given_label(name):
            return label
        local = v.local_name(name)
        words = re.sub(r"(?<=[a-z0-9])(?=[A-Z])|_", " ", local).split()
        return " ".join([words[0], *(w.lower() if w[1:].islower() else w for w in words[1:])])

    def given_label(self, name: str) -> str:
        """A name's label, or nothing."""
        return self.text(name, RDFS.label, SKOS.prefLabel)

    def definition(self, name: str) -> str:
        """A name's definition, or else its comment."""
        return self.text(name, SKOS.definition, RDFS.comment)

    def texts(self, name: str, predicate: str) -> tuple[str, ...]:
        """All texts under a predicate, sorted."""
        found = self.graph.objects(URIRef(name), URIRef(predicate))
        return tuple(sorted({str(text).strip() for text in found}))

    def number(self, name: str, predicate: str) -> float | None:
        """The largest number above 0 under a predicate, in metres; None if there is none.

        Raises:
            OntologyError: something is stated that is no such number.
        """
        numbers = [_number(o) for o in self.graph.objects(URIRef(name), URIRef(predicate))]
        if not all(0 < n < math.inf for n in numbers):
            raise OntologyError(f"{predicate} of {name} must be a number of metres above 0")
        return max(numbers, default=None)

    def is_true(self, name: str, predicate: str) -> bool:
        """Whether ``name predicate true`` is stated."""
        return any(
            isinstance(o, Literal) and o.toPython() is True
            for o in self.graph.objects(URIRef(name), URIRef(predicate))
        )

    def same_names(self, name: str) -> frozenset[str]:
        """IRIs that are stated to mean the same class, in any direction."""
        found: set[Node] = set()
        for predicate in (OWL.equivalentClass, SKOS.exactMatch):
            found.update(self.graph.objects(URIRef(name), predicate))
            found.update(self.graph.subjects(predicate, URIRef(name)))
        return frozenset(str(node) for node in found if isinstance(node, URIRef)) - {name}

    @cached_property
    def schemes(self) -> tuple[Scheme, ...]:
        """The schemes, sorted by name: the notation, or else the local name."""
        found = []
        for node in self.graph.subjects(RDF.type, SKOS.ConceptScheme):
            name = self.text(str(node), SKOS.notation) or v.local_name(str(node))
            members = frozenset(str(s) for s in self.graph.subjects(SKOS.inScheme, node))
            is_default = self.is_true(str(node), v.DEFAULT_SCHEME)
            bandwidth = self.number(str(node), v.BANDWIDTH)
            found.append(Scheme(name, members, is_default, bandwidth))
        return tuple(sorted(found, key=lambda s: s.name))

    def _necessary(self, name: str) -> Iterator[Node]:
        for predicate in _NECESSARY:
            yield from self.graph.objects(URIRef(name), predicate)

    def _conjuncts(self, node: Node) -> Iterator[Node]:
        """The parts of an intersection, or the expression itself."""
        members = self.graph.value(node, OWL.intersectionOf) if isinstance(node, BNode) else None
        if members is None:
            yield node
        else:
            for member in Collection(self.graph, members):
                yield from self._conjuncts(member)

    def _fillers(self, node: Node, properties: frozenset[Node]) -> Iterator[str]:
        """The classes p of each ``property some p`` that an expression demands."""
        for part in self._conjuncts(node):
            prop = self.graph.value(part, OWL.onProperty) if isinstance(part, BNode) else None
            if prop is not None and prop in properties:
                filler = self.graph.value(part, OWL.someValuesFrom)
                if filler is not None:
                    places = self._conjuncts(filler)
                    yield from sorted(str(p) for p in places if isinstance(p, URIRef))

    @cached_property
    def _indicating_properties(self) -> frozenset[Node]:
        return self._at_or_below(URIRef(v.INDICATES))

    @cached_property
    def _part_properties(self) -> frozenset[Node]:
        return self._at_or_below(URIRef(v.PART_OF))

    def _at_or_below(self, prop: Node) -> frozenset[Node]:
        found = self.graph.transitive_subjects(RDFS.subPropertyOf, prop)
        return frozenset(node for node in found if node is not None)

    @cached_property
    def _annotated(self) -> dict[tuple[str, object], list[Node]]:
        """(subject, shape of the object) of a subclass axiom -> its owl:Axiom nodes.

        By shape, not by identity: tools such as Protégé write the object a second time.
        """
        found: dict[tuple[str, object], list[Node]] = {}
        for axiom in self.graph.subjects(OWL.annotatedProperty, RDFS.subClassOf):
            subject = self.graph.value(axiom, OWL.annotatedSource)
            target = self.graph.value(axiom, OWL.annotatedTarget)
            if subject is not None and target is not None:
                found.setdefault((str(subject), self._shape(target)), []).append(axiom)
        return found

    def _shape(self, node: Node) -> object:
        if not isinstance(node, BNode):
            return node
        if (node, RDF.first, None) in self.graph:
            return tuple(self._shape(member) for member in Collection(self.graph, node))
        pairs = self.graph.predicate_objects(node)
        shapes = ((str(p), self._shape(o)) for p, o in pairs if p != RDF.type)
        return tuple(sorted(shapes, key=repr))

    def _stated(self, name: str, place: str, node: Node) -> Stated:
        """An indication with what its axiom's annotations say."""
        strengths: set[float] = set()
        reasons: set[Literal] = set()
        sources: set[str] = set()
        for axiom in self._annotated.get((name, self._shape(node)), []):
            strengths |= {_number(o) for o in self.graph.objects(axiom, URIRef(v.STRENGTH))}
            comments = self.graph.objects(axiom, RDFS.comment)
            reasons |= {o for o in comments if isinstance(o, Literal)}
            sources |= {str(o) for o in self.graph.objects(axiom, URIRef(v.DERIVED_FROM))}
        reason = _clean(min(reasons, key=_english_first)) if reasons else ""
        stands = self._places.get((URIRef(name), RDFS.subClassOf, node))
        return Stated(
            name, place, tuple(sorted(strengths)), reason, min(sources, default=""),
            "" if stands is None else str(stands._replace(file=PurePath(stands.file).name)),
        )  # fmt: skip


def _english_first(text: Literal) -> tuple[int, str]:
    language = (text.language or "").lower()
    return (0 if language.startswith("en") else 1 if not language else 2, str(text))


def _clean(text: str) -> str:
    return " ".join(str(text).split())


def _number(node: Node) -> float:
    """A literal's number; NaN if it is none."""
    value = node.toPython() if isinstance(node, Literal) else None
    if value is None or isinstance(value, bool):
        return math.nan
    try:
        return float(str(value))
    except ValueError:
        return math.nan
