"""The library: all modules of an ontology together, and where each of its terms is described."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

from rdflib import OWL, RDF, RDFS, BNode, Graph, URIRef
from rdflib.term import Node

from symboslam.reasoning import vocabulary as v
from symboslam.reasoning.documentation.markup import Markup, external, tag
from symboslam.reasoning.documentation.modules import (
    DEFINITIONS,
    LABELS,
    Module,
    best_text,
    document_index,
)

KINDS: dict[URIRef, str] = {
    OWL.Class: "class",
    RDFS.Class: "class",
    OWL.ObjectProperty: "object property",
    OWL.DatatypeProperty: "datatype property",
    OWL.AnnotationProperty: "annotation property",
    RDFS.Datatype: "datatype",
    OWL.NamedIndividual: "individual",
}
"""What declares a term -> the kind of the term."""

ORDER = tuple(dict.fromkeys(KINDS.values()))
"""The kinds in the order of a page's sections."""

_BUILTIN = (v.OWL_NAMESPACE, v.RDF_NAMESPACE, str(RDFS), "http://www.w3.org/2001/XMLSchema#")
_PREFIXES = {
    v.OWL_NAMESPACE: "owl", v.RDF_NAMESPACE: "rdf", str(RDFS): "rdfs",
    "http://www.w3.org/2001/XMLSchema#": "xsd",
}  # fmt: skip


@dataclass(frozen=True)
class Term:
    """A class, property or individual as one module declares it.

    Attributes:
        iri: its name.
        name: local name.
        kind: one of ``ORDER``.
        label: words for people; the local name if none is stated anywhere.
        definition: one sentence; empty if none is stated anywhere.
        module: the module that declares it.
        anchor: its place on that module's page.
    """

    iri: str
    name: str
    kind: str
    label: str
    definition: str
    module: Module
    anchor: str

    @property
    def href(self) -> str:
        """Where it is described."""
        return f"{self.module.page}.html#{self.anchor}"


class Library:
    """All modules, and questions about terms that more than one of them may answer.

    Args:
        modules: an imported one before those that import it.
    """

    def __init__(self, modules: Iterable[Module]) -> None:
        self.modules = tuple(modules)
        self.documents = document_index(self.modules)

    def reach(self, module: Module) -> set[Module]:
        """A module and all that it imports, directly or not."""
        seen: set[Module] = set()
        waiting = [module]
        while waiting:
            one = waiting.pop()
            if one not in seen:
                seen.add(one)
                waiting.extend(self.documents[i] for i in one.imports if i in self.documents)
        return seen

    @cached_property
    def graph(self) -> Graph:
        """All triples of all modules."""
        merged = Graph()
        for module in self.modules:
            merged += module.graph
        return merged

    @cached_property
    def declared(self) -> dict[Module, tuple[Term, ...]]:
        """Module -> the terms that it declares, by kind and then by label."""
        return {module: self._terms(module) for module in self.modules}

    @cached_property
    def terms(self) -> dict[str, Term]:
        """IRI -> the term where it is declared first, an imported module before its importer."""
        found: dict[str, Term] = {}
        for module in self.modules:
            for term in self.declared[module]:
                found.setdefault(term.iri, term)
        return found

    @cached_property
    def by_name(self) -> dict[str, Term]:
        """Local name -> a term, a class before others and ours before those of others."""
        ranked = sorted(
            self.terms.values(),
            key=lambda t: (ORDER.index(t.kind), not t.iri.startswith(v.SL), t.iri),
        )
        found: dict[str, Term] = {}
        for term in ranked:
            found.setdefault(term.name, term)
        return found

    @cached_property
    def namespaces(self) -> dict[str, str]:
        """Namespace -> prefix, for names of what no module declares."""
        found = dict(_PREFIXES)
        for module in self.modules:
            for prefix, namespace in sorted(module.graph.namespaces()):
                if prefix:
                    found.setdefault(str(namespace), prefix)
        return found

    def label(self, iri: str) -> str:
        """Words for a term, or its prefixed name if no module declares it."""
        if (term := self.terms.get(iri)) is not None:
            return term.label
        if stated := best_text(self.graph, URIRef(iri), LABELS):
            return stated
        return self.short(iri)

    def short(self, iri: str) -> str:
        """An IRI with its namespace as a prefix where one is known."""
        name = v.local_name(iri)
        namespace = iri[: len(iri) - len(name)]
        prefix = self.namespaces.get(namespace)
        return f"{prefix}:{name}" if prefix and name else iri

    def href(self, iri: str, here: Module | None = None) -> str | None:
        """Where a term is described: on the page of ``here`` if that declares it too."""
        term = self.on_page(here).get(iri) if here else None
        term = term or self.terms.get(iri)
        return term.href if term else None

    def link(self, iri: str, here: Module | None = None, words: str = "") -> Markup:
        """A term as a link to where it is described, or to the web if no module declares it."""
        if iri.startswith(_BUILTIN):
            return tag("span", words or self.short(iri), class_="builtin")
        if (href := self.href(iri, here)) is None:
            if (module := self.documents.get(iri)) is not None:
                return tag("a", words or module.title, href=f"{module.page}.html")
            return external(iri, words or self.label(iri))
        term = self.terms[iri]
        return tag("a", words or term.label, href=href, title=term.definition or None)

    def on_page(self, module: Module) -> dict[str, Term]:
        """IRI -> term for what a module declares."""
        return self._pages[module]

    @cached_property
    def _pages(self) -> dict[Module, dict[str, Term]]:
        return {m: {t.iri: t for t in terms} for m, terms in self.declared.items()}

    @cached_property
    def statements(self) -> dict[Node, list[tuple[URIRef, Node, Module]]]:
        """Subject -> what all modules state about it: predicate, object and module."""
        found: dict[Node, list[tuple[URIRef, Node, Module]]] = defaultdict(list)
        for module in self.modules:
            for s, p, o in module.graph:
                if isinstance(s, URIRef):
                    found[s].append((URIRef(str(p)), o, module))
        for stated in found.values():
            stated.sort(key=lambda one: (str(one[0]), self._sort_key(one[1], one[2])))
        return found

    def stated(self, iri: str, predicate: URIRef) -> list[tuple[Node, Module]]:
        """What is stated about a term under a predicate, and by which module."""
        about = self.statements.get(URIRef(iri), [])
        return [(o, module) for p, o, module in about if p == predicate]

    @cached_property
    def kinds_below(self) -> dict[str, list[str]]:
        """IRI of a class or property -> IRIs of those stated to be right below it, by label."""
        found: dict[str, set[str]] = defaultdict(set)
        for subject, stated in self.statements.items():
            for p, o, module in stated:
                if p in (RDFS.subClassOf, RDFS.subPropertyOf):
                    for above in named(module.graph, o):
                        found[above].add(str(subject))
        return {k: sorted(below, key=self._by_label) for k, below in found.items()}

    def kinds_above(self, iri: str) -> list[str]:
        """IRIs of the named classes or properties right above a term."""
        found = {
            above
            for predicate in (RDFS.subClassOf, RDFS.subPropertyOf, OWL.equivalentClass)
            for o, module in self.stated(iri, predicate)
            for above in named(module.graph, o, alone=predicate != OWL.equivalentClass)
        }
        return sorted(found - {iri}, key=self._nearest_first)

    def _nearest_first(self, iri: str) -> tuple[int, str, str]:
        """Our own terms first, then those of modules that import least."""
        place = self._places.get(iri, len(self.modules))
        return (-1 if iri.startswith(v.SL) else place), *self._by_label(iri)

    @cached_property
    def _places(self) -> dict[str, int]:
        order = {module: i for i, module in enumerate(self.modules)}
        return {iri: order[term.module] for iri, term in self.terms.items()}

    def _by_label(self, iri: str) -> tuple[str, str]:
        return self.label(iri).casefold(), iri

    def _sort_key(self, node: Node, module: Module) -> str:
        """Something to sort by that does not depend on the names of blank nodes."""
        if not isinstance(node, BNode):
            return str(node)
        parts = sorted(f"{p} {o}" for p, o in module.graph.predicate_objects(node) if o != node
                       and not isinstance(o, BNode))  # fmt: skip
        deeper = sorted(
            f"{p} {self._sort_key(o, module)}"
            for p, o in module.graph.predicate_objects(node)
            if isinstance(o, BNode) and p not in (OWL.annotatedSource, OWL.annotatedTarget)
        )
        return "~" + "|".join([*parts, *deeper])

    def _terms(self, module: Module) -> tuple[Term, ...]:
        kinds: dict[str, str] = {}
        for declares, kind in KINDS.items():
            for s in module.graph.subjects(RDF.type, declares):
                if isinstance(s, URIRef) and not str(s).startswith(_BUILTIN):
                    kinds.setdefault(str(s), kind)
        own = (v.SL, module.iri) if module.iri else (v.SL,)
        ours = sorted(kinds, key=lambda iri: (not iri.startswith(own), iri))
        places = anchors(ours)
        found = [
            Term(iri, v.local_name(iri), kinds[iri], self._text(module, iri, LABELS)
                 or v.local_name(iri), self._text(module, iri, DEFINITIONS), module, places[iri])
            for iri in ours
        ]  # fmt: skip
        return tuple(sorted(found, key=lambda t: (ORDER.index(t.kind), t.label.casefold(), t.iri)))

    def _text(self, module: Module, iri: str, predicates: tuple[URIRef, ...]) -> str:
        """A text that the module states about a term, or else any module."""
        here = best_text(module.graph, URIRef(iri), predicates)
        return here or best_text(self.graph, URIRef(iri), predicates)


def anchors(iris: Iterable[str], before: str = "") -> dict[str, str]:
    """IRI -> anchor: the local name, with a number after it where two share one.

    >>> anchors(["https://example.org/a#House", "https://example.org/b#House"])
    {'https://example.org/a#House': 'House', 'https://example.org/b#House': 'House-2'}
    """
    taken, found = set(_RESERVED), {}
    for iri in iris:
        name = before + (re.sub(r"[^\w.~-]+", "-", v.local_name(iri)) or "term")
        fresh, number = name, 2
        while fresh in taken:
            fresh, number = f"{name}-{number}", number + 1
        taken.add(fresh)
        found[iri] = fresh
    return found


_RESERVED = ("site-search", "site-results", "section-top", "terms", "terms-count")
"""What pages call their own parts."""


def named(graph: Graph, node: Node, alone: bool = True) -> list[str]:
    """The named classes that a class expression says to be a kind of.

    Args:
        graph: holds the expression.
        node: a class, or an intersection of several.
        alone: whether a class by itself counts, and not only one in an intersection.
    """
    if isinstance(node, URIRef):
        return [str(node)] if alone and not str(node).startswith(v.OWL_NAMESPACE) else []
    from rdflib.collection import Collection

    members = graph.value(node, OWL.intersectionOf)
    if members is None:
        return []
    return [iri for member in Collection(graph, members) for iri in named(graph, member)]
