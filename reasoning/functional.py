"""Read OWL 2 functional syntax into a graph, by the W3C's mapping to RDF, with lines.

Written here because the readers that there are tell no lines, and horned-owl (2.0) writes RDF that
lacks the lists of annotated axioms, pairs of disjoint classes and anonymous members of "one of".
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING

from rdflib import OWL, RDF, RDFS, XSD, BNode, Literal, Namespace, URIRef
from rdflib.term import Node

from symboslam.errors import OntologySyntaxError

if TYPE_CHECKING:
    from symboslam.reasoning.located import LocatedGraph, Triple

_DEEPEST = 100  # parentheses inside of each other
_STANDARD = {"owl": str(OWL), "rdf": str(RDF), "rdfs": str(RDFS), "xsd": str(XSD)}
_SWRL = Namespace("http://www.w3.org/2003/11/swrl#")

_TOKEN = re.compile(
    r"\s+|\#[^\n]*"
    r'|"(?P<text>(?:[^"\\]|\\.)*)"(?:\^\^(?:<(?P<type>[^<>"\s]*)>|(?P<short>[^\s()<>"\#]+))'
    r"|@(?P<language>[A-Za-z0-9-]+))?"
    r'|<(?P<iri>[^<>"\s{}|\\^`]*)>|(?P<open>\()|(?P<close>\))|(?P<word>[^\s()<>"\#]+)',
    re.DOTALL,
)

_KINDS = {
    "Class": OWL.Class, "Datatype": RDFS.Datatype, "ObjectProperty": OWL.ObjectProperty,
    "DataProperty": OWL.DatatypeProperty, "AnnotationProperty": OWL.AnnotationProperty,
    "NamedIndividual": OWL.NamedIndividual,
}  # fmt: skip
# Axioms that are one triple. Letters, here and below: C class expression, P object property
# expression, D data range, R data property or annotation property, I individual, L literal,
# S subject of an annotation, V value of an annotation.
_PLAIN = {
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
_CHARACTERISTICS = {
    "FunctionalObjectProperty": ("P", OWL.FunctionalProperty),
    "InverseFunctionalObjectProperty": ("P", OWL.InverseFunctionalProperty),
    "ReflexiveObjectProperty": ("P", OWL.ReflexiveProperty),
    "IrreflexiveObjectProperty": ("P", OWL.IrreflexiveProperty),
    "SymmetricObjectProperty": ("P", OWL.SymmetricProperty),
    "AsymmetricObjectProperty": ("P", OWL.AsymmetricProperty),
    "TransitiveObjectProperty": ("P", OWL.TransitiveProperty),
    "FunctionalDataProperty": ("R", OWL.FunctionalProperty),
}
_ALIKE = {
    "EquivalentClasses": ("C", OWL.equivalentClass),
    "EquivalentObjectProperties": ("P", OWL.equivalentProperty),
    "EquivalentDataProperties": ("R", OWL.equivalentProperty),
    "SameIndividual": ("I", OWL.sameAs),
}
_APART = {
    "DisjointClasses": ("C", OWL.disjointWith, OWL.AllDisjointClasses),
    "DisjointObjectProperties": ("P", OWL.propertyDisjointWith, OWL.AllDisjointProperties),
    "DisjointDataProperties": ("R", OWL.propertyDisjointWith, OWL.AllDisjointProperties),
    "DifferentIndividuals": ("I", OWL.differentFrom, OWL.AllDifferent),
}
_NEGATIVE = {
    "NegativeObjectPropertyAssertion": ("PII", OWL.targetIndividual),
    "NegativeDataPropertyAssertion": ("RIL", OWL.targetValue),
}

# Expressions: of several items, of one, and restrictions.
_LISTS = {
    "ObjectIntersectionOf": ("C", OWL.intersectionOf), "ObjectUnionOf": ("C", OWL.unionOf),
    "ObjectOneOf": ("I", OWL.oneOf), "DataIntersectionOf": ("D", OWL.intersectionOf),
    "DataUnionOf": ("D", OWL.unionOf), "DataOneOf": ("L", OWL.oneOf),
}  # fmt: skip
_COMPLEMENTS = {
    "ObjectComplementOf": ("C", OWL.complementOf),
    "DataComplementOf": ("D", OWL.datatypeComplementOf),
}
_FILLED = {
    "ObjectSomeValuesFrom": ("PC", OWL.someValuesFrom),
    "ObjectAllValuesFrom": ("PC", OWL.allValuesFrom),
    "ObjectHasValue": ("PI", OWL.hasValue),
    "DataSomeValuesFrom": ("RD", OWL.someValuesFrom),
    "DataAllValuesFrom": ("RD", OWL.allValuesFrom),
    "DataHasValue": ("RL", OWL.hasValue),
}
_COUNTED = {
    "Min": (OWL.minCardinality, OWL.minQualifiedCardinality),
    "Max": (OWL.maxCardinality, OWL.maxQualifiedCardinality),
    "Exact": (OWL.cardinality, OWL.qualifiedCardinality),
}
_COUNT = re.compile(r"(Object|Data)(Min|Max|Exact)Cardinality")
_ATOMS = {
    "ClassAtom": (_SWRL.ClassAtom, _SWRL.classPredicate, "CA"),
    "DataRangeAtom": (_SWRL.DataRangeAtom, _SWRL.dataRange, "DA"),
    "ObjectPropertyAtom": (_SWRL.IndividualPropertyAtom, _SWRL.propertyPredicate, "PAA"),
    "DataPropertyAtom": (_SWRL.DatavaluedPropertyAtom, _SWRL.propertyPredicate, "RAA"),
    "SameIndividualAtom": (_SWRL.SameIndividualAtom, None, "AA"),
    "DifferentIndividualsAtom": (_SWRL.DifferentIndividualsAtom, None, "AA"),
}
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


class _Form:
    """``Name(arguments)``; the words among the arguments are numbers or mistakes."""

    __slots__ = ("arguments", "line", "name")

    def __init__(self, name: str, line: int) -> None:
        self.name, self.line = name, line
        self.arguments: list[_Form | Node | str] = []


_Argument = _Form | Node | str


def parse_functional(graph: LocatedGraph, data: bytes) -> None:
    """Read functional syntax; the line of a triple is that on which its axiom begins.

    Raises:
        FunctionalSyntaxError: it does not parse.
        UnicodeDecodeError: it is not UTF-8.
    """
    reader = _Reader(data.decode())
    for prefix, namespace in reader.prefixes.items():
        graph.bind(prefix, namespace)
    ontologies = [form for form in reader.forms if form.name == "Ontology"]
    if len(ontologies) != 1:
        line = ontologies[1].line if ontologies else None
        problem = "there is a second Ontology(...)" if ontologies else "there is no Ontology(...)"
        raise FunctionalSyntaxError(line, problem + " in it")
    _Mapping(graph).ontology(ontologies[0])


class _Reader:
    """The forms of a document.

    Attributes:
        forms: the outermost ones.
        prefixes: the declared prefixes -> namespace.
    """

    def __init__(self, text: str) -> None:
        self.forms: list[_Form] = []
        self.prefixes: dict[str, str] = {}
        self._line = 1
        self._anonymous: dict[str, BNode] = {}
        self._open: list[_Form] = []
        self._read(text)

    def _error(self, problem: str) -> FunctionalSyntaxError:
        return FunctionalSyntaxError(self._line, problem)

    def _read(self, text: str) -> None:
        end = counted = 0
        word, word_line = "", 1  # the one before, which the next parenthesis makes a form's name
        for found in _TOKEN.finditer(text):
            if found.start() != end:
                break
            self._line += text.count("\n", counted, end)
            counted, end = end, found.end()
            kind, token = found.lastgroup, found[0]
            if kind is None:
                continue
            if kind == "open":
                if ":" in word:  # HasKey(:A (:p) ())
                    self._add(self._word(word))
                    word = ""
                self._enter(_Form(word, word_line if word else self._line))
                word = ""
                continue
            if word:
                self._add(self._word(word))
                word = ""
            if kind == "close":
                self._leave()
            elif kind == "word":
                word, word_line = token, self._line
            elif kind == "iri":
                self._add(URIRef(found["iri"]))
            else:
                self._add(self._literal(found))
        self._line += text.rstrip().count("\n", counted, max(end, counted))
        if end < len(text):
            what = "a text that does not end" if text[end] == '"' else "something that is no <IRI>"
            raise self._error(f"there is {what}")
        if self._open:
            self._line = text.rstrip().count("\n") + 1
            raise self._error("the file ends in the middle of something: a ) is missing")
        if word:
            raise self._error(f"{word!r} has no place here")

    def _enter(self, form: _Form) -> None:
        if len(self._open) == _DEEPEST:
            raise self._error("it is nested too deeply")
        if not self._open:
            if form.name not in ("Prefix", "Ontology"):
                raise self._error(f"Prefix(...) or Ontology(...) is expected, not {form.name}(")
            self.forms.append(form)
        else:
            self._open[-1].arguments.append(form)
        self._open.append(form)

    def _leave(self) -> None:
        if not self._open:
            raise self._error("there is a ) too many")
        form = self._open.pop()
        if form.name == "Prefix" and not self._open:
            match form.arguments:
                case [str(prefix), URIRef() as namespace] if prefix.rstrip("=").endswith(":"):
                    self.prefixes[prefix.rstrip("=").removesuffix(":")] = str(namespace)
                case [str(prefix), "=", URIRef() as namespace] if prefix.endswith(":"):
                    self.prefixes[prefix.removesuffix(":")] = str(namespace)
                case _:
                    raise self._error("a prefix is declared so: Prefix(name:=<namespace>)")

    def _add(self, item: Node | str) -> None:
        if not self._open:
            raise self._error(f"Prefix(...) or Ontology(...) is expected, not {item}")
        self._open[-1].arguments.append(item)

    def _word(self, word: str) -> Node | str:
        if ":" not in word or (len(self._open) == 1 and self._open[0].name == "Prefix"):
            return word
        if word.startswith("_:"):
            return self._anonymous.setdefault(word, BNode())
        return self._short(word)

    def _short(self, word: str) -> URIRef:
        prefix, colon, rest = word.partition(":")
        namespace = self.prefixes.get(prefix, _STANDARD.get(prefix))
        if not colon:
            raise self._error(f"{word!r} is no name: a prefix is missing")
        if namespace is None:
            raise self._error(f"the prefix {prefix}: is not declared")
        return URIRef(namespace + rest)

    def _literal(self, found: re.Match[str]) -> Literal:
        text = re.sub(r"\\(.)", r"\1", found["text"], flags=re.DOTALL)
        if found["language"]:
            return Literal(text, lang=found["language"])
        datatype = None
        if found["type"] is not None or found["short"]:
            datatype = URIRef(found["type"] or "") if not found["short"] else None
            datatype = datatype or self._short(found["short"])
        if datatype == RDF.PlainLiteral:
            text, _, language = text.rpartition("@")
            return Literal(text, lang=language or None)
        return Literal(text, datatype=None if datatype == XSD.string else datatype)


class _Mapping:
    """Turns forms into triples."""

    def __init__(self, graph: LocatedGraph) -> None:
        self._graph = graph
        self._by_letter: dict[str, Callable[[_Argument], Node | None]] = {
            "C": self._class, "P": self._property, "D": self._range, "A": self._atom_argument,
            "R": lambda a: a if isinstance(a, URIRef) else None,
            "I": lambda a: a if isinstance(a, URIRef | BNode) else None,
            "S": lambda a: a if isinstance(a, URIRef | BNode) else None,
            "L": lambda a: a if isinstance(a, Literal) else None,
            "V": lambda a: a if isinstance(a, Node) else None,
        }  # fmt: skip

    def ontology(self, form: _Form) -> None:
        """All that an ontology states."""
        names: list[Node] = []
        rest = list(form.arguments)
        while rest and isinstance(rest[0], URIRef) and len(names) < 2:
            names.append(rest[0])
            del rest[0]
        node = names[0] if names else BNode()
        self._graph.line = form.line
        self._add(node, RDF.type, OWL.Ontology)
        if len(names) > 1:
            self._add(node, OWL.versionIRI, names[1])
        for part in rest:
            if not isinstance(part, _Form):
                raise FunctionalSyntaxError(form.line, f"an axiom is expected, not {part}")
            self._graph.line = part.line
            if part.name == "Import":
                self._add(node, OWL.imports, *self._terms(part, "R"))
            elif part.name == "Annotation":
                self._annotate(node, [part])
            else:
                self._axiom(part)

    # Axioms

    def _axiom(self, form: _Form) -> None:
        notes = [a for a in form.arguments if isinstance(a, _Form) and a.name == "Annotation"]
        bare = _Form(form.name, form.line)
        bare.arguments = form.arguments[len(notes) :]
        if form.name == "DLSafeRule":
            self._annotate(self._rule(bare), notes)
        elif (negative := _NEGATIVE.get(form.name)) is not None:
            prop, source, target = self._terms(bare, negative[0])
            parts = {OWL.sourceIndividual: source, OWL.assertionProperty: prop, negative[1]: target}
            node = self._node(OWL.NegativePropertyAssertion, parts)
            self._annotate(node, notes)
        elif (apart := _APART.get(form.name)) and len(bare.arguments) != 2:
            members = self._list(self._terms(bare, apart[0], several=2))
            self._annotate(self._node(apart[2], {OWL.members: members}), notes)
        else:
            for triple in self._stated(bare):
                self._add(*triple)
                if notes:
                    parts = dict(zip(_REIFIED, triple, strict=True))
                    self._annotate(self._node(OWL.Axiom, parts), notes)

    def _stated(self, form: _Form) -> Iterable[Triple]:
        """The triples of an axiom that is no node of its own."""
        name = form.name
        if name == "Declaration":
            return [self._declared(form)]
        if name == "SubObjectPropertyOf" and _is_form(form, 0, "ObjectPropertyChain"):
            chain = form.arguments.pop(0)
            assert isinstance(chain, _Form)
            (prop,) = self._terms(form, "P")
            chained = self._list(self._terms(chain, "P", several=2))
            return [(prop, OWL.propertyChainAxiom, chained)]
        if name in _PLAIN:
            letters, predicate = _PLAIN[name]
            s, o = self._terms(form, letters)
            return [(s, predicate, o)]
        if name in _CHARACTERISTICS:
            letters, characteristic = _CHARACTERISTICS[name]
            return [(s, RDF.type, characteristic) for s in self._terms(form, letters)]
        if name in _ALIKE:
            letters, predicate = _ALIKE[name]
            found = self._terms(form, letters, several=2)
            # All with the first name, so that a class stands beside each of its definitions.
            first = next((t for t in found if isinstance(t, URIRef)), found[0])
            return [(first, predicate, o) for o in found if o is not first]
        if name in _APART:
            letter, apart, _ = _APART[name]
            s, o = self._terms(form, letter, several=2)
            return [(s, apart, o)]
        if name == "DisjointUnion":
            whole, *parts = self._terms(form, "C", several=3)
            return [(whole, OWL.disjointUnionOf, self._list(parts))]
        if name == "ClassAssertion":
            kind, individual = self._terms(form, "CI")
            return [(individual, RDF.type, kind)]
        if name in ("DataPropertyAssertion", "AnnotationAssertion", "ObjectPropertyAssertion"):
            return [self._asserted(form)]
        if name == "HasKey":
            return [self._key(form)]
        raise FunctionalSyntaxError(form.line, f"{name or '(...)'} is no kind of axiom")

    def _asserted(self, form: _Form) -> Triple:
        if form.name == "DataPropertyAssertion":
            p, s, o = self._terms(form, "RIL")
        elif form.name == "AnnotationAssertion":
            p, s, o = self._terms(form, "RSV")
        elif _is_form(form, 0, "ObjectInverseOf") and isinstance(form.arguments[0], _Form):
            form.arguments[:1] = form.arguments[0].arguments
            p, o, s = self._terms(form, "RII")
        else:
            p, s, o = self._terms(form, "RII")
        return s, p, o

    def _declared(self, form: _Form) -> Triple:
        match form.arguments:
            case [_Form(name=kind, arguments=[URIRef() as iri])] if kind in _KINDS:
                return iri, RDF.type, _KINDS[kind]
        problem = f"a declaration is of one of {', '.join(_KINDS)}: Declaration(Class(name))"
        raise FunctionalSyntaxError(form.line, problem)

    def _key(self, form: _Form) -> Triple:
        match form.arguments:
            case [about, _Form(name="") as objects, _Form(name="") as data]:
                (owner,) = self._each("C", [about], form)
                keys = [*self._each("P", objects.arguments, form)]
                keys += self._each("R", data.arguments, form)
                if keys:
                    return owner, OWL.hasKey, self._list(keys)
        problem = "a key is stated so: HasKey(class (object properties) (data properties))"
        raise FunctionalSyntaxError(form.line, problem)

    def _annotate(self, node: Node, notes: Sequence[_Form]) -> None:
        for note in notes:
            inner = [a for a in note.arguments if isinstance(a, _Form)]
            if any(a.name != "Annotation" for a in inner):
                raise FunctionalSyntaxError(note.line, "an annotation has a value, no expression")
            bare = _Form(note.name, note.line)
            bare.arguments = note.arguments[len(inner) :]
            predicate, value = self._terms(bare, "RV")
            self._add(node, predicate, value)
            if inner:
                parts = dict(zip(_REIFIED, (node, predicate, value), strict=True))
                self._annotate(self._node(OWL.Annotation, parts), inner)

    # Rules

    def _rule(self, form: _Form) -> Node:
        match form.arguments:
            case [_Form(name="Body") as body, _Form(name="Head") as head]:
                parts = {_SWRL.body: self._atoms(body), _SWRL.head: self._atoms(head)}
                return self._node(_SWRL.Imp, parts)
        raise FunctionalSyntaxError(form.line, "a rule is stated so: DLSafeRule(Body(...) Head())")

    def _atoms(self, form: _Form) -> Node:
        found = [self._rule_atom(a) for a in form.arguments if isinstance(a, _Form)]
        return self._list(found, _SWRL.AtomList)

    def _rule_atom(self, form: _Form) -> Node:
        if form.name == "BuiltInAtom":
            builtin, *values = self._terms(form, "R" + "A" * (len(form.arguments) - 1))
            parts: dict[URIRef, Node] = {_SWRL.builtin: builtin}
            return self._node(_SWRL.BuiltinAtom, {**parts, _SWRL.arguments: self._list(values)})
        if form.name not in _ATOMS:
            raise FunctionalSyntaxError(form.line, f"{form.name} is no atom of a rule")
        kind, predicate, letters = _ATOMS[form.name]
        terms = self._terms(form, letters)
        parts = {predicate: terms.pop(0)} if predicate else {}
        parts |= dict(zip((_SWRL.argument1, _SWRL.argument2), terms, strict=False))
        return self._node(kind, parts)

    def _atom_argument(self, argument: _Argument) -> Node | None:
        match argument:
            case _Form(name="Variable", arguments=[URIRef() as variable]):
                self._add(variable, RDF.type, _SWRL.Variable)
                return variable
            case Node():
                return argument
        return None

    # Expressions

    def _class(self, argument: _Argument) -> Node | None:
        if not isinstance(argument, _Form):
            return argument if isinstance(argument, URIRef) else None
        name, given = argument.name, argument.arguments
        if name in _FILLED:
            letters, predicate = _FILLED[name]
            parts: dict[URIRef, Node] = {}
            if name.startswith("Data") and len(given) > 2:
                *properties, filler = self._terms(argument, "R" * (len(given) - 1) + letters[1])
                parts = {OWL.onProperties: self._list(properties), predicate: filler}
            else:
                on, filler = self._terms(argument, letters)
                parts = {OWL.onProperty: on, predicate: filler}
            return self._node(OWL.Restriction, parts)
        if name == "ObjectHasSelf":
            (on,) = self._terms(argument, "P")
            return self._node(OWL.Restriction, {OWL.onProperty: on, OWL.hasSelf: Literal(True)})
        if counted := _COUNT.fullmatch(name):
            return self._counted(argument, counted[1] == "Object", counted[2])
        return self._joined(argument, OWL.Class, "Object")

    def _counted(self, form: _Form, is_object: bool, bound: str) -> Node:
        number, *given = form.arguments or [""]
        if isinstance(number, _Form | Node) or not (number.isascii() and number.isdigit()):
            raise FunctionalSyntaxError(form.line, f"{form.name} begins with a number")
        rest = _Form(form.name, form.line)
        rest.arguments = given
        letters = ("PC" if is_object else "RD")[: max(1, len(given))]
        on, *filler = self._terms(rest, letters)
        parts = {OWL.onProperty: on}
        parts[_COUNTED[bound][bool(filler)]] = Literal(number, datatype=XSD.nonNegativeInteger)
        if filler:
            parts[OWL.onClass if is_object else OWL.onDataRange] = filler[0]
        return self._node(OWL.Restriction, parts)

    def _range(self, argument: _Argument) -> Node | None:
        if not isinstance(argument, _Form):
            return argument if isinstance(argument, URIRef) else None
        if argument.name != "DatatypeRestriction":
            return self._joined(argument, RDFS.Datatype, "Data")
        pairs = (len(argument.arguments) - 1) // 2
        datatype, *given = self._terms(argument, "R" + "RL" * max(1, pairs))
        facets: list[Node] = []
        for facet, value in zip(given[::2], given[1::2], strict=True):
            facets.append(BNode())
            self._add(facets[-1], facet, value)
        parts = {OWL.onDatatype: datatype, OWL.withRestrictions: self._list(facets)}
        return self._node(RDFS.Datatype, parts)

    def _joined(self, form: _Form, kind: URIRef, start: str) -> Node | None:
        """Intersections, unions, enumerations and complements of classes or of datatypes."""
        if not form.name.startswith(start):
            return None
        if form.name in _LISTS:
            letter, predicate = _LISTS[form.name]
            items = self._list(self._terms(form, letter, several=1))
            return self._node(kind, {predicate: items})
        if form.name in _COMPLEMENTS:
            letter, predicate = _COMPLEMENTS[form.name]
            return self._node(kind, {predicate: self._terms(form, letter)[0]})
        return None

    def _property(self, argument: _Argument) -> Node | None:
        match argument:
            case URIRef():
                return argument
            case _Form(name="ObjectInverseOf", arguments=[URIRef() as named]):
                node = BNode()
                self._add(node, OWL.inverseOf, named)
                return node
        return None

    # Terms and triples

    def _terms(self, form: _Form, letters: str, several: int = 0) -> list[Node]:
        """The arguments as terms.

        Args:
            form: has the arguments.
            letters: what each of them is.
            several: at least so many arguments are what the one letter says.
        """
        count = len(form.arguments)
        if several and count >= several:
            letters *= count
        elif several or count != len(letters):
            what = f"at least {several}" if several else str(len(letters))
            raise FunctionalSyntaxError(form.line, f"{form.name} has {count} parts, not {what}")
        return [self._each(x, [a], form)[0] for x, a in zip(letters, form.arguments, strict=True)]

    def _each(self, letter: str, arguments: Iterable[_Argument], form: _Form) -> list[Node]:
        found = []
        for argument in arguments:
            term = self._by_letter[letter](argument)
            if term is None:
                said = f"{argument.name}(...)" if isinstance(argument, _Form) else str(argument)
                line = argument.line if isinstance(argument, _Form) else form.line
                problem = f"{_MEANINGS[letter]} is expected in {form.name}, not {said}"
                raise FunctionalSyntaxError(line, problem)
            found.append(term)
        return found

    def _node(self, kind: URIRef, parts: dict[URIRef, Node]) -> BNode:
        node = BNode()
        self._add(node, RDF.type, kind)
        for predicate, value in parts.items():
            self._add(node, predicate, value)
        return node

    def _list(self, items: Sequence[Node], kind: URIRef | None = None) -> Node:
        head: Node = RDF.nil
        for item in reversed(items):
            cell = BNode()
            if kind:
                self._add(cell, RDF.type, kind)
            self._add(cell, RDF.first, item)
            self._add(cell, RDF.rest, head)
            head = cell
        return head

    def _add(self, s: Node, p: Node, o: Node) -> None:
        self._graph.add((s, p, o))


_REIFIED = (OWL.annotatedSource, OWL.annotatedProperty, OWL.annotatedTarget)


def _is_form(form: _Form, index: int, name: str) -> bool:
    argument = form.arguments[index] if len(form.arguments) > index else None
    return isinstance(argument, _Form) and argument.name == name
