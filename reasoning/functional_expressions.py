"""Expressions of OWL 2 functional syntax as RDF: classes, data ranges and properties.

Tables 1 of the W3C's "OWL 2 Mapping to RDF Graphs" (second edition), section 2.1, as tables here. A
letter in them says what an argument is:

    C class expression, P object property expression, D data range,
    R a name (data or annotation property, datatype, facet), I individual, L literal,
    S subject of an annotation, V value of an annotation, A argument of a rule's atom
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from rdflib import OWL, RDF, RDFS, XSD, BNode, Literal, Namespace, URIRef
from rdflib.term import Node

from symboslam.errors import OntologySyntaxError

if TYPE_CHECKING:
    from symboslam.reasoning.located import LocatedGraph

SWRL = Namespace("http://www.w3.org/2003/11/swrl#")

# Several items, of what sort, as a list.
_LISTS = {
    "ObjectIntersectionOf": ("C", OWL.intersectionOf), "ObjectUnionOf": ("C", OWL.unionOf),
    "ObjectOneOf": ("I", OWL.oneOf), "DataIntersectionOf": ("D", OWL.intersectionOf),
    "DataUnionOf": ("D", OWL.unionOf), "DataOneOf": ("L", OWL.oneOf),
}  # fmt: skip
# One node with so many triples.
_NODES = {
    "ObjectComplementOf": ("C", (OWL.complementOf,)),
    "DataComplementOf": ("D", (OWL.datatypeComplementOf,)),
    "ObjectSomeValuesFrom": ("PC", (OWL.onProperty, OWL.someValuesFrom)),
    "ObjectAllValuesFrom": ("PC", (OWL.onProperty, OWL.allValuesFrom)),
    "ObjectHasValue": ("PI", (OWL.onProperty, OWL.hasValue)),
    "ObjectHasSelf": ("P", (OWL.onProperty,)),
    "DataSomeValuesFrom": ("RD", (OWL.onProperty, OWL.someValuesFrom)),
    "DataAllValuesFrom": ("RD", (OWL.onProperty, OWL.allValuesFrom)),
    "DataHasValue": ("RL", (OWL.onProperty, OWL.hasValue)),
}
_COUNT = re.compile(r"(Object|Data)(Min|Max|Exact)Cardinality")
_COUNTED = {
    "Min": (OWL.minCardinality, OWL.minQualifiedCardinality),
    "Max": (OWL.maxCardinality, OWL.maxQualifiedCardinality),
    "Exact": (OWL.cardinality, OWL.qualifiedCardinality),
}
_TERMS: dict[str, type | tuple[type, ...]] = {
    "R": URIRef, "I": (URIRef, BNode), "L": Literal, "S": (URIRef, BNode), "V": Node,
}  # fmt: skip
_MEANINGS = {
    "C": "a class", "P": "an object property", "D": "a datatype", "R": "a name",
    "I": "an individual", "L": "a literal", "S": "a name", "V": "a name or a literal",
    "A": "a variable, an individual or a literal",
}  # fmt: skip


class FunctionalSyntaxError(OntologySyntaxError):
    """What is wrong in a document.

    Attributes:
        line: where; None for the document as a whole.
        problem: what, in words.
    """

    def __init__(self, line: int | None, problem: str) -> None:
        super().__init__(problem)
        self.line, self.problem = line, problem


@dataclass(slots=True)
class Form:
    """``Name(arguments)``; the words among the arguments are numbers or mistakes."""

    name: str
    line: int
    arguments: list[Form | Node | str] = field(default_factory=list)

    def but(self, *arguments: Argument) -> Form:
        """The same with other arguments."""
        return Form(self.name, self.line, list(arguments))

    def error(self, problem: str) -> FunctionalSyntaxError:
        """An error on the form's line."""
        return FunctionalSyntaxError(self.line, problem)


Argument = Form | Node | str


class Expressions:
    """Adds the triples of expressions to a graph."""

    def __init__(self, graph: LocatedGraph) -> None:
        self._graph = graph
        self._by_letter: dict[str, Callable[[Argument], Node | None]] = {
            "C": self._class, "P": self._property, "D": self._range, "A": self._atom_argument,
        }  # fmt: skip

    def terms(self, form: Form, letters: str, several: int = 0) -> list[Node]:
        """The arguments of a form as nodes of the graph.

        Args:
            form: has the arguments.
            letters: what each of them is.
            several: at least so many arguments are what the one letter says.

        Raises:
            FunctionalSyntaxError: they are others, or more, or fewer.
        """
        given = len(form.arguments)
        if several and given >= several:
            letters *= given
        elif several or given != len(letters):
            what = f"at least {several}" if several else str(len(letters))
            raise form.error(f"{form.name} has {given} parts, not {what}")
        return [self._term(x, a, form) for x, a in zip(letters, form.arguments, strict=True)]

    def _term(self, letter: str, argument: Argument, form: Form) -> Node:
        if letter in self._by_letter:
            term = self._by_letter[letter](argument)
        else:
            term = argument if isinstance(argument, _TERMS[letter]) else None  # type: ignore[assignment]
        if term is None:
            is_form = isinstance(argument, Form)
            said, where = (f"{argument.name}(...)", argument) if is_form else (argument, form)
            raise where.error(f"{_MEANINGS[letter]} is expected in {form.name}, not {said}")
        return term

    def _class(self, argument: Argument) -> Node | None:
        if not isinstance(argument, Form):
            return argument if isinstance(argument, URIRef) else None
        if counted := _COUNT.fullmatch(argument.name):
            return self._counted(argument, counted[1] == "Object", counted[2])
        if argument.name == "DataComplementOf":
            return None
        if argument.name in _NODES:
            return self._restriction(argument)
        return self._joined(argument, OWL.Class, "Object")
