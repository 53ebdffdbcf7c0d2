"""What stands inside axioms, as RDF: expressions, terms, atoms of rules; names and literals.

Here are the forms that the readers of functional syntax and of OWL/XML make.

The tables are Table 1 of the W3C's "OWL 2 Mapping to RDF Graphs" (section 2.1). A letter in them
says what an argument is:

    C class expression, P object property expression, D data range,
    R a name (of a data or annotation property, a datatype, a facet), I individual, L literal,
    S subject of an annotation, V value of an annotation, A argument of a rule's atom
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from rdflib import OWL, RDF, RDFS, XSD, BNode, Literal, Namespace, URIRef
from rdflib.term import Node

from symboslam.errors import OntologySyntaxError

if TYPE_CHECKING:
    from symboslam.reasoning.located import LocatedGraph

SWRL = Namespace("http://www.w3.org/2003/11/swrl#")
DEEPEST = 100
"""Forms may be so many inside of each other."""

_STANDARD = {"owl": str(OWL), "rdf": str(RDF), "rdfs": str(RDFS), "xsd": str(XSD)}
_LANGUAGE = re.compile("[A-Za-z]+(-[A-Za-z0-9]+)*")

# Type of the node, what the arguments are ("C+": one class or more, as a list), their predicates.
_EXPRESSIONS: dict[str, tuple[URIRef, str, tuple[URIRef, ...]]] = {
    "ObjectIntersectionOf": (OWL.Class, "C+", (OWL.intersectionOf,)),
    "ObjectUnionOf": (OWL.Class, "C+", (OWL.unionOf,)),
    "ObjectOneOf": (OWL.Class, "I+", (OWL.oneOf,)),
    "ObjectComplementOf": (OWL.Class, "C", (OWL.complementOf,)),
    "ObjectSomeValuesFrom": (OWL.Restriction, "PC", (OWL.onProperty, OWL.someValuesFrom)),
    "ObjectAllValuesFrom": (OWL.Restriction, "PC", (OWL.onProperty, OWL.allValuesFrom)),
    "ObjectHasValue": (OWL.Restriction, "PI", (OWL.onProperty, OWL.hasValue)),
    "ObjectHasSelf": (OWL.Restriction, "P", (OWL.onProperty, OWL.hasSelf)),
    "DataSomeValuesFrom": (OWL.Restriction, "RD", (OWL.onProperty, OWL.someValuesFrom)),
    "DataAllValuesFrom": (OWL.Restriction, "RD", (OWL.onProperty, OWL.allValuesFrom)),
    "DataHasValue": (OWL.Restriction, "RL", (OWL.onProperty, OWL.hasValue)),
    "DataIntersectionOf": (RDFS.Datatype, "D+", (OWL.intersectionOf,)),
    "DataUnionOf": (RDFS.Datatype, "D+", (OWL.unionOf,)),
    "DataOneOf": (RDFS.Datatype, "L+", (OWL.oneOf,)),
    "DataComplementOf": (RDFS.Datatype, "D", (OWL.datatypeComplementOf,)),
}
_COUNT = re.compile(r"(Object|Data)(Min|Max|Exact)Cardinality")
_COUNTED = {
    "Min": (OWL.minCardinality, OWL.minQualifiedCardinality),
    "Max": (OWL.maxCardinality, OWL.maxQualifiedCardinality),
    "Exact": (OWL.cardinality, OWL.qualifiedCardinality),
}
_ATOMS: dict[str, tuple[URIRef, str, tuple[URIRef, ...]]] = {
    "ClassAtom": (SWRL.ClassAtom, "CA", (SWRL.classPredicate, SWRL.argument1)),
    "DataRangeAtom": (SWRL.DataRangeAtom, "DA", (SWRL.dataRange, SWRL.argument1)),
    "ObjectPropertyAtom": (
        SWRL.IndividualPropertyAtom, "PAA",
        (SWRL.propertyPredicate, SWRL.argument1, SWRL.argument2),
    ),
    "DataPropertyAtom": (
        SWRL.DatavaluedPropertyAtom, "RAA",
        (SWRL.propertyPredicate, SWRL.argument1, SWRL.argument2),
    ),
    "SameIndividualAtom": (SWRL.SameIndividualAtom, "AA", (SWRL.argument1, SWRL.argument2)),
    "DifferentIndividualsAtom": (
        SWRL.DifferentIndividualsAtom, "AA", (SWRL.argument1, SWRL.argument2),
    ),
}  # fmt: skip
_MEANINGS = {
    "C": "a class", "P": "an object property", "D": "a datatype", "R": "a name",
    "I": "an individual", "L": "a literal", "S": "a name", "V": "a name or a literal",
    "A": "a variable, an individual or a literal",
}  # fmt: skip


class FormError(OntologySyntaxError):
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

    def but(self, arguments: Sequence[Argument]) -> Form:
        """The same with other arguments."""
        return Form(self.name, self.line, list(arguments))

    def error(self, problem: str) -> FormError:
        """The error that this form is."""
        return FormError(self.line, problem)


Argument = Form | Node | str


class Names:
    """What short names, anonymous individuals and literals mean in one document.

    Attributes:
        prefixes: the declared prefixes -> namespace; those of OWL 2 itself need no declaration.
    """

    def __init__(self) -> None:
        self.prefixes: dict[str, str] = {}
        self._anonymous: dict[str, BNode] = {}

    def short(self, word: str, line: int) -> URIRef:
        """The IRI of ``prefix:name``.

        Raises:
            FormError: the word has no prefix, or one that is not declared.
        """
        prefix, colon, rest = word.partition(":")
        namespace = self.prefixes.get(prefix, _STANDARD.get(prefix))
        if not colon:
            raise FormError(line, f"{word!r} is no name: a prefix is missing")
        if namespace is None:
            raise FormError(line, f"the prefix {prefix}: is not declared")
        return URIRef(namespace + rest)

    def anonymous(self, name: str) -> BNode:
        """The one node of that name; another in another document."""
        return self._anonymous.setdefault(name, BNode())

    def tagged(self, text: str, language: str, line: int) -> Literal:
        """A text in a language.

        Raises:
            FormError: that is no language.
        """
        if not _LANGUAGE.fullmatch(language):
            raise FormError(line, f"{language!r} is no language")
        return Literal(text, lang=language)

    def typed(self, text: str, datatype: URIRef) -> Literal:
        """A literal without language; a text in RDF names no type."""
        return Literal(text, datatype=None if datatype == XSD.string else datatype)


class Expressions:
    """Adds what forms mean to a graph, by section 2.1 of the mapping."""

    def __init__(self, graph: LocatedGraph) -> None:
        self.graph = graph

    def terms(self, form: Form, letters: str, several: int = 0) -> list[Node]:
        """The arguments of a form as nodes.

        Args:
            form: has the arguments.
            letters: what each of them is, in the letters of this module.
            several: at least so many arguments are what the one letter says.

        Raises:
            FormError: they are others, or more, or fewer.
        """
        given = len(form.arguments)
        if several and given >= several:
            letters *= given
        elif several or given != len(letters):
            what = f"at least {several}" if several else str(len(letters))
            raise form.error(f"{form.name} has {given} parts, not {what}")
        found = []
        for letter, argument in zip(letters, form.arguments, strict=True):
            term = self._term(letter, argument)
            if term is None:
                at, said = form, str(argument)
                if isinstance(argument, Form):
                    at, said = argument, f"{argument.name}(...)"
                raise at.error(f"{_MEANINGS[letter]} is expected in {form.name}, not {said}")
            found.append(term)
        return found

    def _term(self, letter: str, argument: Argument) -> Node | None:
        """The node of one argument; None where it is not what the letter says."""
        match letter, argument:
            case "C" | "D" | "P" | "R" | "I" | "S" | "V" | "A", URIRef():
                return argument
            case "I" | "S" | "V" | "A", BNode():
                return argument
            case "L" | "V" | "A", Literal():
                return argument
            case "C" | "D", Form():
                return self._expression(letter, argument)
            case "P", Form(name="ObjectInverseOf", arguments=[URIRef() as named]):
                self.graph.add((inverse := BNode(), OWL.inverseOf, named))
                return inverse
            case "A", Form(name="Variable", arguments=[URIRef() as variable]):
                self.graph.add((variable, RDF.type, SWRL.Variable))
                return variable
        return None

    def _expression(self, letter: str, form: Form) -> Node | None:
        """A class expression or data range; None where it is not what the letter says."""
        if letter == "D" and form.name == "DatatypeRestriction":
            return self._faceted(form)
        if letter == "C" and (counted := _COUNT.fullmatch(form.name)):
            return self._counted(form, counted[1] == "Object", *_COUNTED[counted[2]])
        kind, letters, predicates = _EXPRESSIONS.get(form.name, (None, "", ()))
        if kind is None or (kind == RDFS.Datatype) != (letter == "D"):
            return None
        if letters.endswith("+"):
            return self.node(kind, predicates, [self.seq(self.terms(form, letters[0], several=1))])
        if letters == "RD" and len(form.arguments) > 2:
            *several, filler = self.terms(form, "R" * (len(form.arguments) - 1) + "D")
            return self.node(kind, (OWL.onProperties, predicates[1]), [self.seq(several), filler])
        values = self.terms(form, letters)
        if form.name == "ObjectHasSelf":
            values.append(Literal(True))
        return self.node(kind, predicates, values)

    def _counted(self, form: Form, is_object: bool, plain: URIRef, qualified: URIRef) -> Node:
        number, *given = form.arguments or [""]
        if isinstance(number, Form | Node) or not (number.isascii() and number.isdigit()):
            raise form.error(f"{form.name} begins with a number")
        letters = ("PC" if is_object else "RD")[: max(1, len(given))]
        values = self.terms(form.but(given), letters)
        values.insert(1, Literal(number, datatype=XSD.nonNegativeInteger))
        if len(given) < 2:
            return self.node(OWL.Restriction, (OWL.onProperty, plain), values)
        filler = OWL.onClass if is_object else OWL.onDataRange
        return self.node(OWL.Restriction, (OWL.onProperty, qualified, filler), values)

    def _faceted(self, form: Form) -> Node:
        pairs = (len(form.arguments) - 1) // 2
        datatype, *given = self.terms(form, "R" + "RL" * max(1, pairs))
        facets: list[Node] = []
        for facet, value in zip(given[::2], given[1::2], strict=True):
            facets.append(BNode())
            self.graph.add((facets[-1], facet, value))
        predicates = OWL.onDatatype, OWL.withRestrictions
        return self.node(RDFS.Datatype, predicates, [datatype, self.seq(facets)])

    def atoms(self, form: Form) -> Node:
        """The atoms of a rule's body or head, by the RDF syntax of the SWRL submission (2004)."""
        return self.seq([self._atom(form, atom) for atom in form.arguments], SWRL.AtomList)

    def _atom(self, around: Form, form: Argument) -> Node:
        if not isinstance(form, Form):
            raise around.error(f"an atom is expected in {around.name}, not {form}")
        if form.name == "BuiltInAtom":
            builtin, *values = self.terms(form, "R" + "A" * (len(form.arguments) - 1))
            parts = [builtin, self.seq(values)]
            return self.node(SWRL.BuiltinAtom, (SWRL.builtin, SWRL.arguments), parts)
        if form.name not in _ATOMS:
            raise form.error(f"{form.name} is no atom of a rule")
        kind, letters, predicates = _ATOMS[form.name]
        return self.node(kind, predicates, self.terms(form, letters))

    def node(self, kind: URIRef, predicates: Sequence[URIRef], values: Sequence[Node]) -> BNode:
        """A new node of a type, with a value for each predicate."""
        node = BNode()
        self.graph.add((node, RDF.type, kind))
        for predicate, value in zip(predicates, values, strict=True):
            self.graph.add((node, predicate, value))
        return node

    def seq(self, items: Sequence[Node], kind: URIRef | None = None) -> Node:
        """A new list, T(SEQ ...) of the mapping; ``kind`` is the type of its cells."""
        head: Node = RDF.nil
        for item in reversed(items):
            cell = BNode()
            if kind:
                self.graph.add((cell, RDF.type, kind))
            self.graph.add((cell, RDF.first, item))
            self.graph.add((cell, RDF.rest, head))
            head = cell
        return head
