"""What the pitfall rules look at: an ontology's terms, and its statements by predicate."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from rdflib import DC, DCTERMS, OWL, RDF, RDFS, SKOS, BNode, Graph, Literal, URIRef
from rdflib.term import Node

from symboslam.reasoning.axioms import Axiom, Triple, Words
from symboslam.reasoning.sources import Place, Sources

BUILTIN = (
    "http://www.w3.org/2002/07/owl#",
    "http://www.w3.org/1999/02/22-rdf-syntax-ns#",
    "http://www.w3.org/2000/01/rdf-schema#",
    "http://www.w3.org/2006/12/owl2-xml#",
    "http://www.w3.org/2001/XMLSchema#",
)
"""Namespaces of the languages themselves, whose terms are nobody's pitfall."""

Statements = Mapping[Node, tuple[Node, ...]]
_LONGEST = 400  # letters of an axiom in words


def is_builtin(term: Node) -> bool:
    """Whether a term is of the languages themselves."""
    return str(term).startswith(BUILTIN)


@dataclass(frozen=True)
class Document:
    """One file.

    Attributes:
        name: as shown to users.
        graph: what it states.
        path: where it is; None for a bundled module.
        given: the user named it, it is no import.
    """

    name: str
    graph: Graph
    path: Path | None
    given: bool


class Ontology:
    """An ontology and its imports as one graph, indexed for the rules.

    Terms are IRIs in the order of their names; objects of a statement come as they are stated.
    Terms of imported files count as terms: whether a finding about them is reported is decided by
    the scan. Terms in ``BUILTIN`` are left out.

    Args:
        sources: the merged files.
        documents: the files one by one.
        unread: IRIs of imports that were not read; what they declare is not known.
    """

    def __init__(
        self, sources: Sources, documents: Iterable[Document], unread: tuple[str, ...] = ()
    ) -> None:
        self.sources, self.graph = sources, sources.graph
        self.documents, self.unread = list(documents), unread
        self.words = Words(self.graph, limit=30)
        self._texts: dict[Triple, str] = {}
        index: dict[Node, dict[Node, list[Node]]] = defaultdict(lambda: defaultdict(list))
        for s, p, o in self.graph:
            index[p][s].append(o)
        self._index: dict[Node, Statements] = {
            p: {s: tuple(objects) for s, objects in by.items()} for p, by in index.items()
        }

    def statements(self, predicate: URIRef) -> Statements:
        """Subject -> objects of all triples with a predicate."""
        return self._index.get(predicate, {})

    def objects(self, subject: Node, predicate: URIRef) -> tuple[Node, ...]:
        """The objects of one subject."""
        return self.statements(predicate).get(subject, ())

    # Terms

    @cached_property
    def kinds(self) -> Mapping[Node, frozenset[Node]]:
        """Term -> the classes of the language that it is declared to be in."""
        return {s: frozenset(kinds) for s, kinds in self.statements(RDF.type).items()}

    def declared(self, *kinds: URIRef) -> list[URIRef]:
        """The IRIs that are declared as one of ``kinds``."""
        return sorted(
            term
            for term, found in self.kinds.items()
            if isinstance(term, URIRef) and not is_builtin(term) and found & {*kinds}
        )

    @cached_property
    def classes(self) -> list[URIRef]:
        """Named classes."""
        return self.declared(OWL.Class, RDFS.Class)

    @cached_property
    def object_properties(self) -> list[URIRef]:
        """Object properties; a characteristic that only they can have declares one."""
        return self.declared(
            OWL.ObjectProperty, OWL.InverseFunctionalProperty, OWL.SymmetricProperty,
            OWL.TransitiveProperty, OWL.AsymmetricProperty, OWL.ReflexiveProperty,
            OWL.IrreflexiveProperty,
        )  # fmt: skip

    @cached_property
    def datatype_properties(self) -> list[URIRef]:
        """Datatype properties."""
        return self.declared(OWL.DatatypeProperty)

    @cached_property
    def annotation_properties(self) -> list[URIRef]:
        """Annotation properties."""
        return self.declared(OWL.AnnotationProperty)

    @cached_property
    def terms(self) -> list[URIRef]:
        """Classes, then object properties, then datatype properties."""
        return [*self.classes, *self.object_properties, *self.datatype_properties]

    def deprecated(self, term: Node) -> bool:
        """Whether a term is marked as no longer to be used."""
        kinds = self.kinds.get(term, frozenset())
        marks = self.objects(term, OWL.deprecated)
        return bool(kinds & {OWL.DeprecatedClass, OWL.DeprecatedProperty}) or any(
            str(mark).lower() in ("true", "1") for mark in marks
        )

    @cached_property
    def iri(self) -> str:
        """The ontology's IRI: that of the first given file that declares one, else its name."""
        for document in self.documents:
            if document.given:
                for subject in sorted(document.graph.subjects(RDF.type, OWL.Ontology), key=str):
                    if isinstance(subject, URIRef):
                        return str(subject)
        return self.documents[0].name

    # Annotations

    def labels(self, term: Node) -> tuple[Node, ...]:
        """Values of rdfs:label."""
        return self.objects(term, RDFS.label)

    def names(self, term: Node) -> tuple[Node, ...]:
        """Values of rdfs:label and skos:prefLabel."""
        return self.objects(term, RDFS.label) + self.objects(term, SKOS.prefLabel)

    def comments(self, term: Node) -> tuple[Node, ...]:
        """Values of rdfs:comment, skos:definition, and description of Dublin Core."""
        found: tuple[Node, ...] = ()
        for predicate in (RDFS.comment, SKOS.definition, DCTERMS.description, DC.description):
            found += self.objects(term, predicate)
        return found

    # Axioms

    @cached_property
    def superclasses(self) -> Mapping[URIRef, tuple[URIRef, ...]]:
        """Named class -> its asserted named superclasses."""
        return self._named(RDFS.subClassOf)

    @cached_property
    def superproperties(self) -> Mapping[URIRef, tuple[URIRef, ...]]:
        """Property -> its asserted super-properties."""
        return self._named(RDFS.subPropertyOf)

    def _named(self, predicate: URIRef) -> dict[URIRef, tuple[URIRef, ...]]:
        return {
            s: tuple(o for o in objects if isinstance(o, URIRef))
            for s, objects in self.statements(predicate).items()
            if isinstance(s, URIRef)
        }

    @cached_property
    def equivalents(self) -> Mapping[Node, tuple[Node, ...]]:
        """Class or property -> what it is stated to be equivalent to, in either direction."""
        return self._both_ways(OWL.equivalentClass, OWL.equivalentProperty)

    @cached_property
    def inverses(self) -> Mapping[Node, tuple[Node, ...]]:
        """Property -> its inverses, stated in either direction."""
        return self._both_ways(OWL.inverseOf)

    def _both_ways(self, *predicates: URIRef) -> dict[Node, tuple[Node, ...]]:
        found: dict[Node, set[Node]] = defaultdict(set)
        for predicate in predicates:
            for s, objects in self.statements(predicate).items():
                for o in objects:
                    found[s].add(o)
                    found[o].add(s)
        return {s: tuple(sorted(others, key=str)) for s, others in found.items()}

    def domains(self, prop: Node) -> tuple[Node, ...]:
        """The asserted domains of a property: IRIs and anonymous expressions."""
        return self.objects(prop, RDFS.domain)

    def ranges(self, prop: Node) -> tuple[Node, ...]:
        """The asserted ranges of a property: IRIs and anonymous expressions."""
        return self.objects(prop, RDFS.range)

    def members(self, node: Node) -> list[Node]:
        """The items of an RDF list; a broken list ends where it breaks."""
        found: list[Node] = []
        seen: set[Node] = set()
        while node != RDF.nil and node not in seen:
            seen.add(node)
            found += self.objects(node, RDF.first)[:1]
            node = next(iter(self.objects(node, RDF.rest)), RDF.nil)
        return found

    def mentioned(self, node: Node) -> Iterator[URIRef]:
        """The IRIs inside an anonymous expression, or the IRI itself; built-in terms left out."""
        waiting, seen = [node], {node}
        while waiting:
            node = waiting.pop()
            if isinstance(node, URIRef):
                if not is_builtin(node):
                    yield node
            elif isinstance(node, BNode):
                for _, _, o in self.graph.triples((node, None, None)):
                    if o not in seen and not isinstance(o, Literal):
                        seen.add(o)
                        waiting.append(o)

    # Places

    def place(self, triple: Triple) -> Place | None:
        """Where a triple is stated."""
        return self.sources.places.get(triple)

    def text(self, triple: Triple) -> str:
        """The axiom that a triple stands for in words, cut if it is very long."""
        if triple not in self._texts:
            text = self.words.axiom(Axiom(*triple, frozenset(), self.graph))
            self._texts[triple] = text if len(text) <= _LONGEST else f"{text[:_LONGEST]} ..."
        return self._texts[triple]

    def is_given(self, triple: Triple) -> bool:
        """Whether a triple is stated in a file that the user gave."""
        place = self.place(triple)
        return place is not None and place.file in self.given

    def declaration(self, term: Node) -> Triple | None:
        """The triple that declares a term: its type, else the first that is said of it."""
        types = [(term, RDF.type, kind) for kind in self.objects(term, RDF.type)]
        said: Iterable[Triple] = types or self.graph.triples((term, None, None))
        placed = [t for t in said if t in self.sources.places]
        return min(placed, key=self._order, default=None)

    def _order(self, triple: Triple) -> tuple[bool, str, int]:
        """Given files come first."""
        place = self.sources.places[triple]
        return place.file not in self.given, place.file, place.line or 0

    @cached_property
    def given(self) -> frozenset[str]:
        """Names of the files that the user gave."""
        return frozenset(d.name for d in self.documents if d.given)
