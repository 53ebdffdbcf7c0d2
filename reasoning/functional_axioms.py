"""Axioms as RDF, by the W3C's "OWL 2 Mapping to RDF Graphs"."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from rdflib import OWL, RDF, RDFS, BNode, URIRef
from rdflib.term import Node

from symboslam.reasoning.functional_expressions import SWRL, Expressions, Form

if TYPE_CHECKING:
    from symboslam.reasoning.located import LocatedGraph, Triple

_KINDS = {
    "Class": OWL.Class, "Datatype": RDFS.Datatype, "ObjectProperty": OWL.ObjectProperty,
    "DataProperty": OWL.DatatypeProperty, "AnnotationProperty": OWL.AnnotationProperty,
    "NamedIndividual": OWL.NamedIndividual,
}  # fmt: skip
# The letters, what an argument is, are those of functional_expressions.
_PLAIN = {  # subject and object of one triple
    "SubClassOf": ("CC", RDFS.subClassOf),
    "SubObjectPropertyOf": ("PP", RDFS.subPropertyOf),
    "SubDataPropertyOf": ("RR", RDFS.subPropertyOf),
    "SubAnnotationPropertyOf": ("RR", RDFS.subPropertyOf),
    "InverseObjectProperties": ("PP", OWL.inverseOf),
    "ObjectPropertyDomain": ("PC", RDFS.domain),
    "ObjectPropertyRange": ("PC", RDFS.range),
    "DataPropertyDomain": ("RC", RDFS.domain),
    "DataPropertyRange": ("RD", RDFS.range),
    "AnnotationPropertyDomain": ("RR", RDFS.domain),
    "AnnotationPropertyRange": ("RR", RDFS.range),
    "DatatypeDefinition": ("RD", OWL.equivalentClass),
}
_CHARACTERISTICS = {  # a property and its type
    "FunctionalObjectProperty": ("P", OWL.FunctionalProperty),
    "InverseFunctionalObjectProperty": ("P", OWL.InverseFunctionalProperty),
    "ReflexiveObjectProperty": ("P", OWL.ReflexiveProperty),
    "IrreflexiveObjectProperty": ("P", OWL.IrreflexiveProperty),
    "SymmetricObjectProperty": ("P", OWL.SymmetricProperty),
    "AsymmetricObjectProperty": ("P", OWL.AsymmetricProperty),
    "TransitiveObjectProperty": ("P", OWL.TransitiveProperty),
    "FunctionalDataProperty": ("R", OWL.FunctionalProperty),
}
_ASSERTED = {  # predicate, subject and object
    "ObjectPropertyAssertion": "RII",
    "DataPropertyAssertion": "RIL",
    "AnnotationAssertion": "RSV",
}
_ALIKE = {  # two or more
    "EquivalentClasses": ("C", OWL.equivalentClass),
    "EquivalentObjectProperties": ("P", OWL.equivalentProperty),
    "EquivalentDataProperties": ("R", OWL.equivalentProperty),
    "SameIndividual": ("I", OWL.sameAs),
}
_APART = {  # two, or more as members of a node
    "DisjointClasses": ("C", OWL.disjointWith, OWL.AllDisjointClasses),
    "DisjointObjectProperties": ("P", OWL.propertyDisjointWith, OWL.AllDisjointProperties),
    "DisjointDataProperties": ("R", OWL.propertyDisjointWith, OWL.AllDisjointProperties),
    "DifferentIndividuals": ("I", OWL.differentFrom, OWL.AllDifferent),
}
_NEGATIVE = {
    "NegativeObjectPropertyAssertion": ("PII", OWL.targetIndividual),
    "NegativeDataPropertyAssertion": ("RIL", OWL.targetValue),
}
_REIFIED = (OWL.annotatedSource, OWL.annotatedProperty, OWL.annotatedTarget)


class Axioms:
    """Adds an ontology to a graph, each axiom with its line."""

    def __init__(self, graph: LocatedGraph) -> None:
        self._graph = graph
        self._inside = Expressions(graph)

    def ontology(self, form: Form) -> None:
        """Add all that an ``Ontology(...)`` states (mapping, sections 2.1 to 2.3).

        Raises:
            FormError: a part of it is not OWL.
        """
        names: list[Node] = []
        rest = list(form.arguments)
        while rest and isinstance(rest[0], URIRef) and len(names) < 2:
            names.append(rest[0])
            del rest[0]
        node, *version = names or [BNode()]
        self._graph.line = form.line
        self._graph.add((node, RDF.type, OWL.Ontology))
        for iri in version:
            self._graph.add((node, OWL.versionIRI, iri))
        for part in rest:
            if not isinstance(part, Form):
                raise form.error(f"an axiom is expected, not {part}")
            self._graph.line = part.line
            if part.name == "Import":
                self._graph.add((node, OWL.imports, *self._inside.terms(part, "R")))
            elif part.name == "Annotation":
                self._annotate(node, [part])
            else:
                self._axiom(part)

    def _axiom(self, form: Form) -> None:
        """An axiom with its annotations (mapping, section 2.3)."""
        notes = [a for a in form.arguments if isinstance(a, Form) and a.name == "Annotation"]
        form = form.but(form.arguments[len(notes) :])
        if (node := self._node(form)) is not None:
            self._annotate(node, notes)
            return
        for triple in self._triples(form):
            self._graph.add(triple)
            if notes:
                self._annotate(self._inside.node(OWL.Axiom, _REIFIED, triple), notes)

    def _annotate(self, node: Node, notes: Sequence[Form]) -> None:
        """Annotations, and the annotations of these (mapping, section 2.2)."""
        for note in notes:
            inner = [a for a in note.arguments if isinstance(a, Form)]
            if any(a.name != "Annotation" for a in inner):
                raise note.error("an annotation has a value, no expression")
            predicate, value = self._inside.terms(note.but(note.arguments[len(inner) :]), "RV")
            self._graph.add((node, predicate, value))
            if inner:
                parts = node, predicate, value
                self._annotate(self._inside.node(OWL.Annotation, _REIFIED, parts), inner)

    def _node(self, form: Form) -> Node | None:
        """The node of an axiom that is one (mapping, section 2.3.3); None for other axioms."""
        inside = self._inside
        if form.name == "DLSafeRule":
            match form.arguments:
                case [Form(name="Body") as body, Form(name="Head") as head]:
                    parts = [inside.atoms(body), inside.atoms(head)]
                    return inside.node(SWRL.Imp, (SWRL.body, SWRL.head), parts)
            raise form.error("a rule is stated so: DLSafeRule(Body(...) Head())")
        if form.name in _NEGATIVE:
            letters, target = _NEGATIVE[form.name]
            predicates = OWL.assertionProperty, OWL.sourceIndividual, target
            terms = inside.terms(form, letters)
            return inside.node(OWL.NegativePropertyAssertion, predicates, terms)
        if form.name in _APART and len(form.arguments) != 2:
            letter, _, kind = _APART[form.name]
            members = inside.seq(inside.terms(form, letter, several=2))
            return inside.node(kind, (OWL.members,), [members])
        return None

    def _triples(self, form: Form) -> Iterable[Triple]:
        """The triples of an axiom that is no node of its own (mapping, section 2.1).

        More than two equivalents: all with the first name, where the mapping has the first with the
        second, the second with the third. So a class stands beside each of its definitions.
        """
        name, inside = form.name, self._inside
        match name, form.arguments:
            case "Declaration", _:
                return [self._declared(form)]
            case "HasKey", _:
                return [self._key(form)]
            case "SubObjectPropertyOf", [Form(name="ObjectPropertyChain") as chain, *rest]:
                (whole,) = inside.terms(form.but(rest), "P")
                steps = inside.terms(chain, "P", several=1)  # OWL wants two; pitfall P33
                return [(whole, OWL.propertyChainAxiom, inside.seq(steps))]
            case "ObjectPropertyAssertion", [Form("ObjectInverseOf", _, [named]), source, target]:
                form = form.but([named, target, source])
        if name in _PLAIN:
            letters, predicate = _PLAIN[name]
            s, o = inside.terms(form, letters)
            return [(s, predicate, o)]
        if name in _CHARACTERISTICS:
            letters, kind = _CHARACTERISTICS[name]
            return [(s, RDF.type, kind) for s in inside.terms(form, letters)]
        if name in _ASSERTED:
            p, s, o = inside.terms(form, _ASSERTED[name])
            return [(s, p, o)]
        if name == "ClassAssertion":
            about, individual = inside.terms(form, "CI")
            return [(individual, RDF.type, about)]
        if name in _ALIKE:
            letter, predicate = _ALIKE[name]
            found = inside.terms(form, letter, several=2)
            first = next((t for t in found if isinstance(t, URIRef)), found[0])
            return [(first, predicate, o) for o in found if o is not first]
        if name in _APART:
            letter, predicate, _ = _APART[name]
            s, o = inside.terms(form, letter * 2)
            return [(s, predicate, o)]
        if name == "DisjointUnion":
            union, *parts = inside.terms(form, "C", several=3)
            return [(union, OWL.disjointUnionOf, inside.seq(parts))]
        raise form.error(f"{name or '(...)'} is no kind of axiom")

    def _declared(self, form: Form) -> Triple:
        match form.arguments:
            case [Form(name=kind, arguments=[URIRef() as iri])] if kind in _KINDS:
                return iri, RDF.type, _KINDS[kind]
        names = ", ".join(_KINDS)
        raise form.error(f"a declaration is of one of {names}: Declaration(Class(name))")

    def _key(self, form: Form) -> Triple:
        match form.arguments:
            case [about, Form(name="") as objects, Form(name="") as data]:
                given = [about, *objects.arguments, *data.arguments]
                letters = "C" + "P" * len(objects.arguments) + "R" * len(data.arguments)
                owner, *keys = self._inside.terms(form.but(given), letters)
                if keys:
                    return owner, OWL.hasKey, self._inside.seq(keys)
        raise form.error("a key is stated so: HasKey(class (object properties) (data properties))")
