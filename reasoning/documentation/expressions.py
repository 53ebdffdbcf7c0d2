"""Class expressions and lists of classes in words close to Manchester syntax, names as links."""

from __future__ import annotations

from collections.abc import Callable

from rdflib import OWL, XSD, BNode, Graph, Literal, URIRef
from rdflib.collection import Collection
from rdflib.term import Node

from symboslam.reasoning.documentation.markup import Markup, join, tag, text

_QUANTIFIERS = (
    (OWL.someValuesFrom, "some"),
    (OWL.allValuesFrom, "only"),
    (OWL.hasValue, "value"),
)
_COUNTS = (
    (OWL.minCardinality, "min"), (OWL.minQualifiedCardinality, "min"),
    (OWL.maxCardinality, "max"), (OWL.maxQualifiedCardinality, "max"),
    (OWL.cardinality, "exactly"), (OWL.qualifiedCardinality, "exactly"),
)  # fmt: skip
_FACETS = {
    XSD.minInclusive: "≥", XSD.maxInclusive: "≤", XSD.minExclusive: ">", XSD.maxExclusive: "<",
    XSD.length: "length", XSD.minLength: "length ≥", XSD.maxLength: "length ≤",
    XSD.pattern: "pattern",
}  # fmt: skip
_DEEPEST = 40


class Expressions:
    """Renders the expressions of a graph.

    Args:
        graph: holds them.
        link: how a class, property or individual is shown.
    """

    def __init__(self, graph: Graph, link: Callable[[str], Markup]) -> None:
        self.graph, self.link = graph, link

    def show(self, node: Node, depth: int = 0) -> Markup:
        """An expression, such as ``Feature and (indicates some Residential)``."""
        if isinstance(node, URIRef):
            return self.link(str(node))
        if not isinstance(node, BNode):
            return literal(node)
        if depth > _DEEPEST:
            return text("…")
        value = self.graph.value
        for connective, word in ((OWL.intersectionOf, "and"), (OWL.unionOf, "or")):
            if (listed := value(node, connective)) is not None:
                return join(_word(word), (self._inner(m, depth) for m in self.members(listed)))
        for negation in (OWL.complementOf, OWL.datatypeComplementOf):
            if (negated := value(node, negation)) is not None:
                return text([_word("not", ""), self._inner(negated, depth)])
        if (single := value(node, OWL.oneOf)) is not None:
            shown = join(", ", (self.show(m, depth + 1) for m in self.members(single)))
            return text(["{", shown, "}"])
        if (inverse := value(node, OWL.inverseOf)) is not None:
            return text([_word("inverse", ""), self.show(inverse, depth + 1)])
        if (base := value(node, OWL.onDatatype)) is not None:
            return text([self.show(base, depth + 1), self._facets(node)])
        return self._restriction(node, depth)

    def members(self, listed: Node | None) -> list[Node]:
        """The items of an RDF list; none where the list is broken."""
        try:
            return [] if listed is None else list(Collection(self.graph, listed))
        except ValueError:  # a list that runs in a circle
            return []

    def _inner(self, node: Node, depth: int) -> Markup:
        shown = self.show(node, depth + 1)
        return text(["(", shown, ")"]) if isinstance(node, BNode) else shown

    def _restriction(self, node: Node, depth: int) -> Markup:
        value = self.graph.value
        on = value(node, OWL.onProperty)
        if on is None:
            return text("something")
        where = self.show(on, depth + 1)
        for constraint, word in _QUANTIFIERS:
            if (filler := value(node, constraint)) is not None:
                return text([where, _word(word), self._inner(filler, depth)])
        filler = value(node, OWL.onClass) or value(node, OWL.onDataRange) or OWL.Thing
        for constraint, word in _COUNTS:
            if (number := value(node, constraint)) is not None:
                kind = None if filler == OWL.Thing else [" ", self._inner(filler, depth)]
                return text([where, _word(word), str(number), kind])
        return text([where, _word("Self", "")])

    def _facets(self, node: Node) -> Markup:
        found = []
        for facets in self.members(self.graph.value(node, OWL.withRestrictions)):
            for p, o in sorted(self.graph.predicate_objects(facets)):
                if (word := _FACETS.get(URIRef(str(p)))) is not None:
                    found.append(f"{word} {o}")
        return text(f" [{', '.join(found)}]" if found else "")


def _word(word: str, before: str = " ") -> Markup:
    return text([before, tag("em", word), " "])


def literal(node: Node) -> Markup:
    """A value, with its language where that is not English."""
    language = node.language if isinstance(node, Literal) else None
    shown = tag("span", " ".join(str(node).split()), class_="value")
    if language and not language.lower().startswith("en"):
        return text([shown, tag("small", f" ({language})")])
    return shown


def is_indication(graph: Graph, node: Node, properties: frozenset[str]) -> bool:
    """Whether an expression is a restriction by one of the properties, with ``some``."""
    return (
        isinstance(node, BNode)
        and str(graph.value(node, OWL.onProperty)) in properties
        and (node, OWL.someValuesFrom, None) in graph
    )
