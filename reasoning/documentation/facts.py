"""What is stated about a term, sorted under headings, ready to be shown."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable
from functools import cached_property

from rdflib import OWL, RDF, RDFS, BNode, Literal, URIRef
from rdflib.collection import Collection
from rdflib.term import Node

from symboslam.reasoning import vocabulary as v
from symboslam.reasoning.axioms import SYMMETRIC
from symboslam.reasoning.documentation.expressions import Expressions, is_indication, literal
from symboslam.reasoning.documentation.library import KINDS, Library, Term
from symboslam.reasoning.documentation.markup import Markup, join, safe_colour, tag, text
from symboslam.reasoning.documentation.modules import DEFINITIONS, LABELS, Module

_HEADINGS: dict[URIRef, str] = {
    RDFS.subClassOf: "kind of",
    RDFS.subPropertyOf: "kind of",
    OWL.equivalentClass: "same as",
    OWL.equivalentProperty: "same as",
    OWL.sameAs: "same as",
    OWL.disjointWith: "disjoint with",
    OWL.propertyDisjointWith: "disjoint with",
    OWL.disjointUnionOf: "disjoint union of",
    OWL.differentFrom: "different from",
    RDFS.domain: "from (domain)",
    RDFS.range: "to (range)",
    OWL.inverseOf: "inverse of",
    OWL.propertyChainAxiom: "follows from",
    OWL.hasKey: "key",
    RDFS.comment: "comment",
    RDFS.seeAlso: "see also",
    RDFS.isDefinedBy: "defined by",
}
_CHARACTERISTICS = {
    OWL.FunctionalProperty: "functional: at most one value",
    OWL.InverseFunctionalProperty: "inverse functional: each value belongs to one thing",
    OWL.TransitiveProperty: "transitive",
    OWL.SymmetricProperty: "symmetric",
    OWL.AsymmetricProperty: "asymmetric",
    OWL.ReflexiveProperty: "reflexive",
    OWL.IrreflexiveProperty: "irreflexive",
}
_ORDER = (
    "type", "kind of", "same as", "disjoint union of", "disjoint with", "kinds", "from (domain)",
    "to (range)", "inverse of", "characteristics", "follows from", "key", "has", "value of",
)  # fmt: skip

Add = Callable[[str, Markup, Module], None]


class Facts:
    """Answers for the entries of pages.

    Args:
        library: all modules.
    """

    def __init__(self, library: Library) -> None:
        self.library = library

    def about(self, term: Term) -> list[tuple[str, list[Markup]]]:
        """Headings and what stands under each, for a term on its module's page."""
        found: dict[str, list[Markup]] = defaultdict(list)

        def add(heading: str, shown: Markup, source: Module) -> None:
            if shown and shown not in found[heading]:
                found[heading].append(shown)
                if source != term.module and heading in _ORDER:
                    note = [" (stated in ", tag("a", source.name, href=f"{source.page}.html"), ")"]
                    found[heading][-1] = text([shown, tag("small", note)])

        here = term.module
        for p, o, module in self.library.statements.get(URIRef(term.iri), []):
            if p == RDF.type:
                self._add_type(o, module, here, add)
            elif not self._is_shown_elsewhere(term, p, o, module):
                heading = _HEADINGS.get(p) or self.library.label(str(p))
                add(heading, self.value(p, o, module, here), module)
        for p, s, module in self._reverse.get(term.iri, []):
            add(_HEADINGS[p], self.library.link(s, here), module)
        for others, module in self._disjoint.get(term.iri, []):
            rest = [self.library.link(iri, here) for iri in others if iri != term.iri]
            add("disjoint with", join(", ", rest), module)
        below = [self.library.link(iri, here) for iri in self.library.kinds_below.get(term.iri, [])]
        if below:
            found["kinds"].append(folded(below))
        for heading, iris in (("has", self._has), ("value of", self._value_of)):
            if links := [self.library.link(iri, here) for iri in iris.get(term.iri, [])]:
                found[heading].append(folded(links))
        last = len(_ORDER)
        return sorted(
            ((heading, shown) for heading, shown in found.items() if shown),
            key=lambda pair: (_ORDER.index(pair[0]) if pair[0] in _ORDER else last, pair[0]),
        )

    def value(self, predicate: URIRef, node: Node, module: Module, here: Module) -> Markup:
        """An object of a statement: a link, an expression, a list or a value."""

        def link(iri: str) -> Markup:
            return self.library.link(iri, here)

        expressions = Expressions(module.graph, link)
        if predicate == OWL.propertyChainAxiom:
            return join(" followed by ", map(expressions.show, expressions.members(node)))
        if predicate in (OWL.disjointUnionOf, OWL.hasKey):
            return join(", ", map(expressions.show, expressions.members(node)))
        if isinstance(node, Literal):
            if str(predicate) == v.OSM_TAG:
                return tag("code", str(node))
            if str(predicate) == v.COLOUR:
                dot = tag("i", class_="dot", style=f"background:{safe_colour(str(node))}")
                return text([dot, " ", literal(node)])
        return expressions.show(node)

    @cached_property
    def indicating(self) -> frozenset[str]:
        """The properties that indicate: ``sl:indicates`` and those below it."""
        found, waiting = set[str](), [v.INDICATES]
        while waiting:
            if (iri := waiting.pop()) not in found:
                found.add(iri)
                waiting.extend(self.library.kinds_below.get(iri, []))
        return frozenset(found)

    def _add_type(self, o: Node, module: Module, here: Module, add: Add) -> None:
        if o in _CHARACTERISTICS:
            add("characteristics", text(_CHARACTERISTICS[URIRef(str(o))]), module)
        elif o not in KINDS and o != RDF.Property:
            add("type", self.value(RDF.type, o, module, here), module)

    def _is_shown_elsewhere(self, term: Term, p: URIRef, o: Node, module: Module) -> bool:
        """Whether a statement has its own place: labels, the definition, indications."""
        if p in LABELS or (p in DEFINITIONS and " ".join(str(o).split()) == term.definition):
            return True
        return p == RDFS.subClassOf and is_indication(module.graph, o, self.indicating)

    @cached_property
    def _reverse(self) -> dict[str, list[tuple[URIRef, str, Module]]]:
        """Object -> statements about others that say the same of it."""
        found: dict[str, list[tuple[URIRef, str, Module]]] = defaultdict(list)
        for s, stated in self.library.statements.items():
            for p, o, module in stated:
                if p in SYMMETRIC and isinstance(o, URIRef):
                    found[str(o)].append((p, str(s), module))
        return {o: sorted(stated, key=lambda x: (x[0], x[1])) for o, stated in found.items()}

    @cached_property
    def _disjoint(self) -> dict[str, list[tuple[list[str], Module]]]:
        """Term -> the sets of terms with which it is declared disjoint or different."""
        found: dict[str, list[tuple[list[str], Module]]] = defaultdict(list)
        blocks = (OWL.AllDisjointClasses, OWL.AllDisjointProperties)
        for module in self.library.modules:
            for block in blocks:
                for node in module.graph.subjects(RDF.type, block):
                    listed = module.graph.value(node, OWL.members)
                    if listed is None:
                        continue
                    members = list(Collection(module.graph, listed))
                    iris = [str(m) for m in members if isinstance(m, URIRef)]
                    for iri in iris:
                        found[iri].append((iris, module))
        return {iri: sorted(sets, key=lambda x: x[0]) for iri, sets in found.items()}

    @cached_property
    def _has(self) -> dict[str, list[str]]:
        return self._classes_of(RDFS.domain)

    @cached_property
    def _value_of(self) -> dict[str, list[str]]:
        return self._classes_of(RDFS.range)

    def _classes_of(self, predicate: URIRef) -> dict[str, list[str]]:
        """Class -> properties that name it, alone or in a union, as domain or range."""
        found: dict[str, set[str]] = defaultdict(set)
        for s, stated in self.library.statements.items():
            for p, o, module in stated:
                if p != predicate:
                    continue
                nodes = [o]
                if isinstance(o, BNode) and (listed := module.graph.value(o, OWL.unionOf)):
                    nodes = list(Collection(module.graph, listed))
                for node in nodes:
                    if isinstance(node, URIRef):
                        found[str(node)].add(str(s))
        return {c: sorted(iris, key=self.library.label) for c, iris in found.items()}


def folded(shown: list[Markup], most: int = 16) -> Markup:
    """A list in a line; the rest of a long one behind a click."""
    if len(shown) <= most + 4:
        return join(", ", shown)
    rest = tag("details", tag("summary", f"{len(shown) - most} more"), join(", ", shown[most:]))
    return text([join(", ", shown[:most]), rest])
