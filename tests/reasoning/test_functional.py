"""OWL functional syntax: what axioms become, lines, mistakes, other readers' reading of it."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path
from time import process_time

import pyhornedowl
import pytest
from rdflib import OWL, XSD, Graph, Literal, URIRef
from rdflib.compare import isomorphic, to_isomorphic
from rdflib.term import Node

from symboslam.errors import OntologySyntaxError
from symboslam.reasoning.parsing import parse

ROOT = Path(__file__).parents[2]
HEAD = """Prefix(:=<urn:x#>)
Prefix(rdfs:=<http://www.w3.org/2000/01/rdf-schema#>)
Prefix ( swrl: = <http://www.w3.org/2003/11/swrl#> )
Ontology(<urn:x>
"""
TURTLE = """@prefix : <urn:x#> .
@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rdf: <http://www.w3.org/1999/02/22-rdf-syntax-ns#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
@prefix swrl: <http://www.w3.org/2003/11/swrl#> .
@prefix xsd: <http://www.w3.org/2001/XMLSchema#> .
<urn:x> a owl:Ontology .
"""

AXIOMS = [
    ("Declaration(Class(:A))", ":A a owl:Class ."),
    ("Declaration(Datatype(:d))", ":d a rdfs:Datatype ."),
    ("Declaration(DataProperty(:d))", ":d a owl:DatatypeProperty ."),
    ("Declaration(AnnotationProperty(:d))", ":d a owl:AnnotationProperty ."),
    ("Declaration(NamedIndividual(:a))", ":a a owl:NamedIndividual ."),
    ('Annotation(rdfs:label "x")', '<urn:x> rdfs:label "x" .'),
    ("Import(<urn:y>)", "<urn:x> owl:imports <urn:y> ."),
    ("SubClassOf(:A owl:Thing)", ":A rdfs:subClassOf owl:Thing ."),
    ("EquivalentClasses(:A :B :C)", ":A owl:equivalentClass :B, :C ."),
    (
        "EquivalentClasses(ObjectOneOf(:a _:b) :A)",
        ":A owl:equivalentClass [ a owl:Class ; owl:oneOf (:a []) ] .",
    ),
    ("DisjointClasses(:A :B)", ":A owl:disjointWith :B ."),
    (
        "DisjointClasses(:A ObjectComplementOf(:B) :C)",
        "[] a owl:AllDisjointClasses ; "
        "owl:members (:A [ a owl:Class ; owl:complementOf :B ] :C) .",
    ),
    ("DisjointUnion(:A :B :C)", ":A owl:disjointUnionOf (:B :C) ."),
    (
        "SubClassOf(ObjectUnionOf(:A :B) ObjectIntersectionOf(:C :D))",
        "[ a owl:Class ; owl:unionOf (:A :B) ] rdfs:subClassOf "
        "[ a owl:Class ; owl:intersectionOf (:C :D) ] .",
    ),
    *(
        (
            f"SubClassOf(:A {name}({arguments}))",
            f":A rdfs:subClassOf [ a owl:Restriction ; {said} ] .",
        )
        for name, arguments, said in [
            ("ObjectSomeValuesFrom", ":p :B", "owl:onProperty :p ; owl:someValuesFrom :B"),
            ("ObjectAllValuesFrom", ":p :B", "owl:onProperty :p ; owl:allValuesFrom :B"),
            ("ObjectHasValue", ":p :b", "owl:onProperty :p ; owl:hasValue :b"),
            ("ObjectHasSelf", ":p", "owl:onProperty :p ; owl:hasSelf true"),
            (
                "ObjectMinCardinality",
                "2 ObjectInverseOf(:p)",
                "owl:onProperty [ owl:inverseOf :p ] ; "
                'owl:minCardinality "2"^^xsd:nonNegativeInteger',
            ),
            (
                "ObjectMaxCardinality",
                "2 :p :B",
                "owl:onProperty :p ; owl:onClass :B ; "
                'owl:maxQualifiedCardinality "2"^^xsd:nonNegativeInteger',
            ),
            (
                "DataExactCardinality",
                "2 :p xsd:int",
                "owl:onProperty :p ; owl:onDataRange xsd:int ; "
                'owl:qualifiedCardinality "2"^^xsd:nonNegativeInteger',
            ),
            (
                "DataSomeValuesFrom",
                ':p DatatypeRestriction(xsd:int xsd:minInclusive "5"^^xsd:int)',
                "owl:onProperty :p ; owl:someValuesFrom [ a rdfs:Datatype ; "
                "owl:onDatatype xsd:int ; owl:withRestrictions "
                '([ xsd:minInclusive "5"^^xsd:int ]) ]',
            ),
            (
                "DataAllValuesFrom",
                ":p :q DataComplementOf(xsd:int)",
                "owl:onProperties (:p :q) ; owl:allValuesFrom "
                "[ a rdfs:Datatype ; owl:datatypeComplementOf xsd:int ]",
            ),
            ("DataHasValue", ':p "x"@en-GB', 'owl:onProperty :p ; owl:hasValue "x"@en-GB'),
        ]
    ),
    ("SubObjectPropertyOf(:p ObjectInverseOf(:q))", ":p rdfs:subPropertyOf [ owl:inverseOf :q ] ."),
    (
        "SubObjectPropertyOf(ObjectPropertyChain(:p ObjectInverseOf(:q)) :r)",
        ":r owl:propertyChainAxiom (:p [ owl:inverseOf :q ]) .",
    ),
    ("SubObjectPropertyOf(ObjectPropertyChain(:p) :r)", ":r owl:propertyChainAxiom (:p) ."),
    ("EquivalentObjectProperties(:p :q)", ":p owl:equivalentProperty :q ."),
    ("DisjointObjectProperties(:p :q)", ":p owl:propertyDisjointWith :q ."),
    (
        "DisjointDataProperties(:p :q :r)",
        "[] a owl:AllDisjointProperties ; owl:members (:p :q :r) .",
    ),
    ("InverseObjectProperties(:p :q)", ":p owl:inverseOf :q ."),
    ("ObjectPropertyDomain(:p :A)", ":p rdfs:domain :A ."),
    ("DataPropertyRange(:p DataOneOf(\"a\"))",
     ':p rdfs:range [ a rdfs:Datatype ; owl:oneOf ("a") ] .'),
    ("TransitiveObjectProperty(:p)", ":p a owl:TransitiveProperty ."),
    ("FunctionalDataProperty(:p)", ":p a owl:FunctionalProperty ."),
    ("SubAnnotationPropertyOf(:p :q)", ":p rdfs:subPropertyOf :q ."),
    ("DatatypeDefinition(:d xsd:int)", ":d owl:equivalentClass xsd:int ."),
    ("HasKey(:A (:p) (:q))", ":A owl:hasKey (:p :q) ."),
    ("HasKey(:A ( ) ( :q ))", ":A owl:hasKey (:q) ."),
    ("SameIndividual(:a :b)", ":a owl:sameAs :b ."),
    ("DifferentIndividuals(:a :b)", ":a owl:differentFrom :b ."),
    ("DifferentIndividuals(:a _:b :c)", "[] a owl:AllDifferent ; owl:members (:a [] :c) ."),
    ("ClassAssertion(:A :a)", ":a a :A ."),
    ("ObjectPropertyAssertion(:p :a :b)", ":a :p :b ."),
    ("ObjectPropertyAssertion(ObjectInverseOf(:p) :a :b)", ":b :p :a ."),
    ("ObjectPropertyAssertion(:p _:a _:b)", "_:a :p _:b ."),
    (
        'NegativeObjectPropertyAssertion(Annotation(rdfs:label "x") :p :a :b)',
        "[] a owl:NegativePropertyAssertion ; owl:assertionProperty :p ; owl:sourceIndividual :a ; "
        'owl:targetIndividual :b ; rdfs:label "x" .',
    ),
    (
        "NegativeDataPropertyAssertion(:p :a true)".replace("true", '"true"^^xsd:boolean'),
        "[] a owl:NegativePropertyAssertion ; owl:assertionProperty :p ; owl:sourceIndividual :a ; "
        "owl:targetValue true .",
    ),
    ('DataPropertyAssertion(:p :a "x"^^xsd:string)', ':a :p "x" .'),
    ('DataPropertyAssertion(:p :a "x@en"^^rdf:PlainLiteral)', ':a :p "x"@en .'),
    ('DataPropertyAssertion(:p :a "1"^^<urn:t>)', ':a :p "1"^^<urn:t> .'),
    (
        r'AnnotationAssertion(rdfs:comment :A "a \"b\" \\ (c) # <d>")',
        r':A rdfs:comment "a \"b\" \\ (c) # <d>" .',
    ),
    ("AnnotationAssertion(rdfs:seeAlso :A <urn:y>)", ":A rdfs:seeAlso <urn:y> ."),
    (
        'SubClassOf(Annotation(Annotation(rdfs:comment "y") rdfs:label "x") :A :B)',
        ":A rdfs:subClassOf :B . _:x a owl:Axiom ; owl:annotatedSource :A ; "
        'owl:annotatedProperty rdfs:subClassOf ; owl:annotatedTarget :B ; rdfs:label "x" . '
        "[] a owl:Annotation ; owl:annotatedSource _:x ; owl:annotatedProperty rdfs:label ; "
        'owl:annotatedTarget "x" ; rdfs:comment "y" .',
    ),
    (
        "DLSafeRule(Body(ClassAtom(:A Variable(<urn:v>)) "
        "BuiltInAtom(<urn:b> Variable(<urn:v>))) "
        "Head(ObjectPropertyAtom(:p Variable(<urn:v>) :a)))",
        "<urn:v> a swrl:Variable . [] a swrl:Imp ; swrl:body [ a swrl:AtomList ; rdf:first "
        "[ a swrl:ClassAtom ; swrl:classPredicate :A ; swrl:argument1 <urn:v> ] ; rdf:rest "
        "[ a swrl:AtomList ; rdf:rest () ; rdf:first [ a swrl:BuiltinAtom ; swrl:builtin <urn:b> ; "
        "swrl:arguments (<urn:v>) ] ] ] ; swrl:head [ a swrl:AtomList ; rdf:rest () ; rdf:first "
        "[ a swrl:IndividualPropertyAtom ; swrl:propertyPredicate :p ; swrl:argument1 <urn:v> ; "
        "swrl:argument2 :a ] ] .",
    ),
]  # fmt: skip


@pytest.mark.parametrize(("axiom", "turtle"), AXIOMS)
def test_axioms(axiom: str, turtle: str) -> None:
    graph = parse("a.ofn", f"{HEAD}\n\n{axiom}\n)\n".encode())
    expected = to_isomorphic(Graph().parse(data=TURTLE + turtle))
    assert to_isomorphic(graph) == expected, graph.serialize()
    lines = {line for (_, _, o), line in graph.lines.items() if o != OWL.Ontology}
    assert lines == {7}
    assert len(graph.lines) == len(graph)


def test_names_of_an_ontology() -> None:
    graph = parse("a.ofn", b"Ontology(<urn:x>\n <urn:x/1>\n)")
    assert (URIRef("urn:x"), OWL.versionIRI, URIRef("urn:x/1")) in graph
    assert len(parse("a.ofn", b"Ontology()")) == 1


def test_axiom_over_several_lines() -> None:
    graph = parse(
        "a.ofn", b"Ontology(\r\n# (\r\nSubClassOf\r\n(\r\n<urn:A>\r\n<urn:B>)\r\n)\r\n# the end"
    )
    assert sorted(graph.lines.values()) == [1, 3]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "there is no Ontology(...) in it"),
        ("Prefix(:=<urn:x>)", "there is no Ontology(...) in it"),
        ("Ontology()\nOntology()", "line 2: there is a second Ontology(...) in it"),
        ("Ontology(\nSubClassOf(<urn:a>", "line 2: the file ends in the middle of something"),
        ("Ontology(\n)\n)", "line 3: there is a ) too many"),
        ("Ontology(\n)\nfoo", "line 3: 'foo' has no place here"),
        ("Ontology(\n)\nfoo()", "line 3: Prefix(...) or Ontology(...) is expected, not foo("),
        ("hello <urn:a>", "line 1: Prefix(...) or Ontology(...) is expected, not hello"),
        ("Prefix(x <urn:a>)\nOntology()", "line 1: a prefix is declared so: Prefix(name:=<n"),
        ("Ontology(\nSubClassOf(x:A x:B))", "line 2: the prefix x: is not declared"),
        ("Ontology(\nSubClassOf(A B))", "line 2: a class is expected in SubClassOf, not A"),
        ("Ontology(\nSubClasOf(<urn:A> <urn:B>))", "line 2: SubClasOf is no kind of axiom"),
        ("Ontology(\nSubClassOf(<urn:A>))", "line 2: SubClassOf has 1 parts, not 2"),
        ("Ontology(\n<urn:a> <urn:b> <urn:c>)", "an axiom is expected, not urn:c"),
        ("Ontology(EquivalentClasses(<urn:A>))", "EquivalentClasses has 1 parts, not at least 2"),
        ("Ontology(DisjointClasses(<urn:A>))", "DisjointClasses has 1 parts, not at least 2"),
        ('Ontology(\n\nSubClassOf("A', "line 3: there is a text that does not end"),
        ("Ontology(\nSubClassOf(<urn: A>", "line 2: there is something that is no <IRI>"),
        ("Ontology(Declaration(Thing(<urn:A>)))", "a declaration is of one of Class, Datatype"),
        ("Ontology(HasKey(<urn:A> <urn:p>))", "a key is stated so: HasKey(class (object"),
        ("Ontology(DLSafeRule(<urn:A>))", "a rule is stated so: "),
        (
            "Ontology(\nSubObjectPropertyOf(ObjectPropertyChain() <urn:r>))",
            "line 2: ObjectPropertyChain has 0 parts, not at least 1",
        ),
        (
            "Ontology(DLSafeRule(Body(<urn:A>) Head()))",
            "line 1: an atom is expected in Body, not urn:A",
        ),
        ("Ontology(DLSafeRule(Body(Foo(<urn:A>)) Head()))", "Foo is no atom of a rule"),
        ("Ontology(Annotation(<urn:a> ObjectOneOf(<urn:b>)))", "an annotation has a value"),
        (
            "Ontology(SubClassOf(<urn:A>\nObjectMinCardinality(<urn:p> 1)))",
            "line 2: ObjectMinCardinality begins with a number",
        ),
        (
            "Ontology(SubClassOf(<urn:A>\nDataUnionOf(<urn:p> <urn:q>)))",
            "line 2: a class is expected in SubClassOf, not DataUnionOf(...)",
        ),
        ('Ontology(DataPropertyAssertion(<urn:p> <urn:a> "1"^^int))', "'int' is no name"),
        ('Ontology(\nAnnotation(<urn:p> "x"@en-))', "line 2: 'en-' is no language"),
        (
            "Ontology(AnnotationAssertion(ObjectInverseOf(<urn:p>) <urn:a> <urn:b>))",
            "a name is expected in AnnotationAssertion, not ObjectInverseOf(...)",
        ),
        ("Ontology(SubClassOf(<urn:A> " + "ObjectComplementOf(" * 2000, "is nested too deeply"),
    ],
)  # fmt: skip
def test_mistakes(text: str, message: str) -> None:
    with pytest.raises(OntologySyntaxError) as caught:
        parse("a.ofn", text.encode())
    assert str(caught.value).startswith("a.ofn: ")
    assert message in str(caught.value)


def test_no_part_of_a_file_crashes() -> None:
    whole = HEAD + "\n".join(axiom for axiom, _ in AXIOMS) + "\n)"
    for end in range(0, len(whole) - 1, 7):
        with pytest.raises(OntologySyntaxError):
            parse("a.ofn", whole[:end].encode())


@pytest.mark.parametrize("classes", [3_400, pytest.param(17_000, marks=pytest.mark.slow)])
def test_large_file(classes: int) -> None:
    """20,000 triples at once, or 100,000, in a few seconds."""
    axioms = "\n".join(
        f"Declaration(Class(:C{n}))\nSubClassOf(:C{n} ObjectSomeValuesFrom(:p :C{n // 2}))\n"
        f'AnnotationAssertion(rdfs:label :C{n} "class {n}"@en)'
        for n in range(classes)
    )
    data = f"{HEAD}{axioms})".encode()
    start = process_time()
    graph = parse("a.ofn", data)
    assert len(graph) == 6 * classes + 1
    assert process_time() - start < 20 * classes / 17_000


HORNED = """Prefix(:=<urn:x#>)
Prefix(rdfs:=<http://www.w3.org/2000/01/rdf-schema#>)
Prefix(xsd:=<http://www.w3.org/2001/XMLSchema#>)
Prefix(owl:=<http://www.w3.org/2002/07/owl#>)
Ontology(<urn:x> <urn:x/1>
Import(<urn:y>)
Annotation(Annotation(rdfs:comment "y") rdfs:label "x"@en)
Declaration(Annotation(rdfs:comment "why") Class(:House))
Declaration(ObjectProperty(:has))
Declaration(DataProperty(:storeys))
SubClassOf(Annotation(Annotation(rdfs:comment "y") rdfs:label "x") :House
  ObjectSomeValuesFrom(:has ObjectUnionOf(:Roof ObjectComplementOf(:Wall))))
EquivalentClasses(:House
  ObjectIntersectionOf(:Building ObjectAllValuesFrom(ObjectInverseOf(:in) :Home))
  ObjectMinCardinality(1 :has :Door))
EquivalentClasses(:Kind ObjectOneOf(:big :small))
DisjointClasses(Annotation(rdfs:label "x") :House ObjectHasSelf(:has))
DisjointUnion(:Building :House :Shed :Tower)
SubClassOf(Annotation(rdfs:label "x") Annotation(:note "z") :Shed
  DataMaxCardinality(1 :storeys xsd:int))
SubClassOf(:Shed DataAllValuesFrom(:storeys DatatypeRestriction(xsd:int
  xsd:minInclusive "0"^^xsd:int xsd:maxExclusive "9"^^xsd:int)))
DataPropertyRange(:colour DataUnionOf(DataOneOf("red" "blue"@en) DataComplementOf(xsd:string)))
DatatypeDefinition(:few DataIntersectionOf(xsd:int xsd:nonNegativeInteger))
SubObjectPropertyOf(ObjectPropertyChain(:has ObjectInverseOf(:in) :has) :reaches)
SubObjectPropertyOf(:has :touches)
EquivalentObjectProperties(:has ObjectInverseOf(:of))
InverseObjectProperties(:has :in)
DisjointObjectProperties(:has :lacks :wants)
ObjectPropertyDomain(Annotation(rdfs:label "x") :has :Building)
AsymmetricObjectProperty(:has)
FunctionalDataProperty(:storeys)
SubAnnotationPropertyOf(:note rdfs:comment)
HasKey(:House (:in) (:number))
SameIndividual(:a :b)
DifferentIndividuals(:a :b :c)
ClassAssertion(ObjectHasValue(:has :a) :b)
ObjectPropertyAssertion(ObjectInverseOf(:has) :a _:d)
DataPropertyAssertion(:number _:d "7"^^xsd:int)
NegativeObjectPropertyAssertion(:has :a :b)
NegativeDataPropertyAssertion(:number :a "8"^^xsd:int)
AnnotationAssertion(Annotation(:note <urn:z>) rdfs:seeAlso :House <urn:y>)
)
"""


def test_horned_owl_reads_the_same() -> None:
    """An independent reading, of what horned-owl 2.0 writes by the mapping (decision 9)."""
    written = pyhornedowl.open_ontology_from_string(HORNED, "ofn").save_to_string("rdf")
    theirs = Graph()
    for s, p, o in Graph().parse(data=written, format="xml"):
        theirs.add((s, p, _untyped(o)))
    ours = parse("a.ofn", HORNED.encode())
    assert len(ours) == len(theirs)
    assert isomorphic(ours, theirs)


def _untyped(term: Node) -> Node:
    """``"x"`` for ``"x"^^xsd:string``, which horned-owl writes now so, now so."""
    is_text = isinstance(term, Literal) and term.datatype == XSD.string
    return Literal(str(term)) if is_text else term


@pytest.mark.robot
@pytest.mark.parametrize("name", ["core.ttl", "team.ttl", "map.ttl", "upstream/onto4mat.ttl"])
def test_robot_reads_the_same(tmp_path: Path, name: str) -> None:
    """A module that ROBOT saved as functional syntax, and that read by ROBOT again."""
    graph = Graph().parse(ROOT / "ontology" / name)
    graph.remove((None, OWL.imports, None))
    graph.serialize(tmp_path / "in.ttl")
    for source, target in (("in.ttl", "a.ofn"), ("a.ofn", "back.ttl")):
        done = subprocess.run(
            [ROOT / "scripts" / "robot", "convert", "--input", source, "--output", target],
            cwd=tmp_path, capture_output=True, text=True, check=False,
        )  # fmt: skip
        if done.returncode == 3:
            (pytest.fail if os.environ.get("CI") else pytest.skip)(done.stderr.strip())
        assert done.returncode == 0, done.stdout + done.stderr
    ours = parse("a.ofn", (tmp_path / "a.ofn").read_bytes())
    assert to_isomorphic(ours) == to_isomorphic(Graph().parse(tmp_path / "back.ttl"))
