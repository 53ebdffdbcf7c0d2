"""Where terms stand in the statements of the language: as a class, as a property."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Set
from weakref import WeakKeyDictionary

from rdflib import OWL, RDF, BNode, Namespace, URIRef
from rdflib.term import Node

from symboslam.reasoning.axioms import Triple
from symboslam.reasoning.pitfalls.ontology import Ontology, is_builtin

SWRL = Namespace("http://www.w3.org/2003/11/swrl#")
_SWRLB = "http://www.w3.org/2003/11/swrlb#"

_LONGEST_WAY = 20
_WHOLES: WeakKeyDictionary[Ontology, dict[Node, Triple]] = WeakKeyDictionary()

SUBJECT, OBJECT, LIST = 1, 2, 4
"""Positions in a statement, to be added up; ``LIST`` is the items of the list in its object."""


def is_of_rules(term: Node) -> bool:
    """Whether a term is of the language of rules (SWRL), its built-in functions included."""
    return str(term).startswith((str(SWRL), _SWRLB))


def first_uses(
    ontology: Ontology,
    positions: Mapping[URIRef, int],
    block: URIRef | None = None,
    declared: Set[Node] = frozenset(),
) -> dict[URIRef, Triple]:
    """Term -> the first statement that has it in one of the positions; built-in terms left out.

    Args:
        ontology: where to look.
        positions: predicate -> which of its positions count.
        block: a kind of statement about a whole list (``owl:AllDisjointClasses``) that counts too.
        declared: kinds; terms that are declared as one of them are left out.
    """
    done = {term for term, kinds in ontology.kinds.items() if kinds & declared}
    found: dict[URIRef, tuple[tuple[bool, str, int, str], Triple]] = {}
    for term, triple in _uses(ontology, positions, block):
        if isinstance(term, URIRef) and term not in done and not is_builtin(term):
            rank = by_place(ontology, triple)
            if term in found and rank == found[term][0]:
                if _way(ontology, triple) < _way(ontology, found[term][1]):
                    found[term] = (rank, triple)
            elif term not in found or rank < found[term][0]:
                found[term] = (rank, triple)
    return {term: triple for term, (_, triple) in found.items()}


def _uses(
    ontology: Ontology, positions: Mapping[URIRef, int], block: URIRef | None
) -> Iterator[tuple[Node, Triple]]:
    for predicate, which in positions.items():
        for s, objects in ontology.statements(predicate).items():
            for o in objects:
                triple = (s, predicate, o)
                if which & SUBJECT:
                    yield s, triple
                if which & OBJECT:
                    yield o, triple
                if which & LIST:
                    yield from _items(ontology, o, triple)
    if block:
        for s, objects in ontology.statements(OWL.members).items():
            if block in ontology.kinds.get(s, ()):
                for o in objects:
                    yield from _items(ontology, o, (s, RDF.type, block))


def _items(ontology: Ontology, node: Node, triple: Triple) -> Iterable[tuple[Node, Triple]]:
    return ((item, triple) for item in ontology.members(node))


def by_place(ontology: Ontology, triple: Triple) -> tuple[bool, str, int, str]:
    """Sort key: given files first, then by line; names decide where lines are not known."""
    place = ontology.place(triple)
    names = " ".join(str(term) for term in triple if isinstance(term, URIRef))
    if place is None:
        return True, "", 0, names
    return place.file not in ontology.given, place.file, place.line or 0, names


def _way(ontology: Ontology, triple: Triple) -> list[str]:
    """The predicates that lead to an anonymous subject, the nearest first: its name for sorting."""
    way: list[str] = []
    node: Node | None = triple[0]
    while isinstance(node, BNode) and len(way) < _LONGEST_WAY:
        holders = ontology.graph.subject_predicates(node)
        node, predicate = min(holders, key=lambda pair: str(pair[1]), default=(None, ""))
        way.append(str(predicate))
    return way


def whole(ontology: Ontology, triple: Triple) -> Triple:
    """The axiom that a triple inside of an anonymous expression is part of; else the triple."""
    known = _WHOLES.setdefault(ontology, {})
    path: dict[Node, None] = {}
    top = triple
    while isinstance(top[0], BNode) and top[0] not in path:
        node: Node = top[0]
        path[node] = None
        if node not in known:
            holders = ontology.graph.triples((None, None, node))
            holder = min(holders, key=lambda t: by_place(ontology, t), default=None)
            if holder is None:
                break
            top = holder
        else:
            top = known[node]
            break
    for node in path:
        if node != top[0]:  # so that a long list is climbed once
            known[node] = top
    return top
