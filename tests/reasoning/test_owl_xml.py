"""OWL/XML: each element against the same in functional syntax; IRIs, mistakes, ROBOT's reading."""

from __future__ import annotations

import os
import subprocess
from contextlib import suppress
from pathlib import Path
from time import process_time

import pytest
from rdflib import OWL, RDF, RDFS, Graph, Literal, URIRef
from rdflib.compare import to_isomorphic

from symboslam.errors import OntologySyntaxError
from symboslam.reasoning.parsing import parse

ROOT = Path(__file__).parents[2]
HEAD = (
    '<?xml version="1.0"?>\n<Ontology xmlns="http://www.w3.org/2002/07/owl#"'
    ' xml:base="urn:x" ontologyIRI="urn:x">\n<Prefix name="" IRI="urn:x#"/>'
    '<Prefix name="e" IRI="urn:e#"/>\n'
)
XSD_INT = "http://www.w3.org/2001/XMLSchema#int"
A, B, C = ('<Class IRI="#A"/>', '<Class abbreviatedIRI=":B"/>', '<Class IRI="urn:x#C"/>')
P, Q, R = (f'<ObjectProperty IRI="#{n}"/>' for n in "pqr")
D, E, F = (f'<DataProperty IRI="#{n}"/>' for n in "def")
I1, I2, I3 = (f'<NamedIndividual IRI="#{n}"/>' for n in "ijk")
NOTE = '<AnnotationProperty abbreviatedIRI="rdfs:label"/><Literal>x</Literal>'
INT = '<Datatype abbreviatedIRI="xsd:int"/>'
FIVE = f'<Literal datatypeIRI="{XSD_INT}">5</Literal>'
V = '<Variable IRI="urn:v"/>'


def said(name: str, *parts: str, **attributes: object) -> str:
    """An element."""
    given = "".join(f' {key}="{value}"' for key, value in attributes.items())
    return f"<{name}{given}>{''.join(parts)}</{name}>"


def thing(expression: str) -> str:
    return said("SubClassOf", A, expression)


PAIRS = [
    (said("Declaration", A), "Declaration(Class(:A))"),
    (said("Declaration", '<Datatype IRI="#d"/>'), "Declaration(Datatype(:d))"),
    (said("Declaration", P), "Declaration(ObjectProperty(:p))"),
    (said("Declaration", D), "Declaration(DataProperty(:d))"),
    (said("Declaration", I1), "Declaration(NamedIndividual(:i))"),
    (said("Declaration", '<AnnotationProperty IRI="tag:a,1:n"/>'),
     "Declaration(AnnotationProperty(<tag:a,1:n>))"),
    (said("Annotation", NOTE), 'Annotation(rdfs:label "x")'),
    ("<Import>\n urn:y </Import>", "Import(<urn:y>)"),
    (said("SubClassOf", A, '<Class abbreviatedIRI="owl:Thing"/>'), "SubClassOf(:A owl:Thing)"),
    (said("EquivalentClasses", A, B, C), "EquivalentClasses(:A :B :C)"),
    (said("DisjointClasses", A, B, C), "DisjointClasses(:A :B :C)"),
    (said("DisjointUnion", A, B, C), "DisjointUnion(:A :B :C)"),
    (thing(said("ObjectUnionOf", A, said("ObjectIntersectionOf", B, C))),
     "SubClassOf(:A ObjectUnionOf(:A ObjectIntersectionOf(:B :C)))"),
    (thing(said("ObjectComplementOf", said("ObjectOneOf", I1, I2))),
     "SubClassOf(:A ObjectComplementOf(ObjectOneOf(:i :j)))"),
    (thing(said("ObjectSomeValuesFrom", P, said("ObjectAllValuesFrom", Q, B))),
     "SubClassOf(:A ObjectSomeValuesFrom(:p ObjectAllValuesFrom(:q :B)))"),
    (thing(said("ObjectHasValue", P, I1)), "SubClassOf(:A ObjectHasValue(:p :i))"),
    (thing(said("ObjectHasSelf", P)), "SubClassOf(:A ObjectHasSelf(:p))"),
    (thing(said("ObjectMinCardinality", said("ObjectInverseOf", P), cardinality=2)),
     "SubClassOf(:A ObjectMinCardinality(2 ObjectInverseOf(:p)))"),
    (thing(said("ObjectExactCardinality", P, B, cardinality=2)),
     "SubClassOf(:A ObjectExactCardinality(2 :p :B))"),
    (thing(said("DataMaxCardinality", D, INT, cardinality=2)),
     "SubClassOf(:A DataMaxCardinality(2 :d xsd:int))"),
    (thing(said("DataSomeValuesFrom", D, said("DataComplementOf", INT))),
     "SubClassOf(:A DataSomeValuesFrom(:d DataComplementOf(xsd:int)))"),
    (thing(said("DataAllValuesFrom", D, said(
        "DatatypeRestriction", INT,
        said("FacetRestriction", FIVE, facet=XSD_INT.replace("int", "minInclusive")),
        said("FacetRestriction", FIVE, facet=XSD_INT.replace("int", "maxInclusive"))))),
     'SubClassOf(:A DataAllValuesFrom(:d DatatypeRestriction(xsd:int xsd:minInclusive '
     '"5"^^xsd:int xsd:maxInclusive "5"^^xsd:int)))'),
    (thing(said("DataHasValue", D, '<Literal xml:lang="en-GB"> a &lt;b&gt;\n</Literal>')),
     'SubClassOf(:A DataHasValue(:d " a <b>\n"@en-GB))'),
    (said("DatatypeDefinition", '<Datatype IRI="#t"/>', said("DataUnionOf", INT, said(
        "DataOneOf", FIVE))),
     'DatatypeDefinition(:t DataUnionOf(xsd:int DataOneOf("5"^^xsd:int)))'),
    (said("SubObjectPropertyOf", said("ObjectPropertyChain", P, Q), R),
     "SubObjectPropertyOf(ObjectPropertyChain(:p :q) :r)"),
    (said("SubObjectPropertyOf", said("ObjectPropertyChain", P), R),
     "SubObjectPropertyOf(ObjectPropertyChain(:p) :r)"),
    (said("EquivalentObjectProperties", P, Q, R), "EquivalentObjectProperties(:p :q :r)"),
    (said("InverseObjectProperties", P, Q), "InverseObjectProperties(:p :q)"),
    (said("DisjointDataProperties", D, E, F), "DisjointDataProperties(:d :e :f)"),
    (said("ObjectPropertyDomain", P, A), "ObjectPropertyDomain(:p :A)"),
    (said("DataPropertyRange", D, INT), "DataPropertyRange(:d xsd:int)"),
    (said("TransitiveObjectProperty", P), "TransitiveObjectProperty(:p)"),
    (said("HasKey", A, P, said("ObjectInverseOf", Q), D),
     "HasKey(:A (:p ObjectInverseOf(:q)) (:d))"),
    (said("HasKey", A, D), "HasKey(:A () (:d))"),
    (said("HasKey", said("Annotation", NOTE), A, P),
     'HasKey(Annotation(rdfs:label "x") :A (:p) ())'),
    (said("SameIndividual", I1, I2, I3), "SameIndividual(:i :j :k)"),
    (said("DifferentIndividuals", I1, I2, I3), "DifferentIndividuals(:i :j :k)"),
    (said("ClassAssertion", A, I1), "ClassAssertion(:A :i)"),
    (said("ObjectPropertyAssertion", P, *('<AnonymousIndividual nodeID="a"/>',) * 2),
     "ObjectPropertyAssertion(:p _:a _:a)"),
    (said("ObjectPropertyAssertion", P, '<AnonymousIndividual nodeID="_:a"/>',
          '<AnonymousIndividual nodeID="a"/>'), "ObjectPropertyAssertion(:p _:a _:a)"),
    (said("DataPropertyAssertion", D, I1, FIVE), 'DataPropertyAssertion(:d :i "5"^^xsd:int)'),
    (said("NegativeObjectPropertyAssertion", P, I1, I2),
     "NegativeObjectPropertyAssertion(:p :i :j)"),
    (said("NegativeDataPropertyAssertion", D, I1, FIVE),
     'NegativeDataPropertyAssertion(:d :i "5"^^xsd:int)'),
    (said("SubAnnotationPropertyOf", '<AnnotationProperty IRI="#n"/>',
          '<AnnotationProperty abbreviatedIRI="e:n"/>'), "SubAnnotationPropertyOf(:n <urn:e#n>)"),
    (said("AnnotationPropertyDomain", '<AnnotationProperty IRI="#n"/>', "<IRI>#A</IRI>"),
     "AnnotationPropertyDomain(:n :A)"),
    (said("AnnotationAssertion", '<AnnotationProperty abbreviatedIRI="rdfs:seeAlso"/>',
          "<IRI> #A </IRI>", "<AbbreviatedIRI>e:x</AbbreviatedIRI>"),
     "AnnotationAssertion(rdfs:seeAlso :A <urn:e#x>)"),
    (said("SubClassOf", said("Annotation", said("Annotation", NOTE), NOTE), A, B),
     'SubClassOf(Annotation(Annotation(rdfs:label "x") rdfs:label "x") :A :B)'),
    (said("DLSafeRule", said("Body", said("ClassAtom", A, V), said(
        "BuiltInAtom", V, FIVE, IRI="urn:b")), said("Head", said("ObjectPropertyAtom", P, V, I1))),
     'DLSafeRule(Body(ClassAtom(:A Variable(<urn:v>)) BuiltInAtom(<urn:b> Variable(<urn:v>) '
     '"5"^^xsd:int)) Head(ObjectPropertyAtom(:p Variable(<urn:v>) :i)))'),
    (said("DLSafeRule", "<Body/>", said("Head", said("SameIndividualAtom", I1, V))),
     "DLSafeRule(Body() Head(SameIndividualAtom(:i Variable(<urn:v>))))"),
]  # fmt: skip
KNOWN = sorted({name for _, axiom in PAIRS for name in axiom.split("(")[:1]})


@pytest.mark.parametrize(("xml", "axiom"), PAIRS)
def test_is_what_functional_syntax_says(xml: str, axiom: str) -> None:
    graph = parse("a.owx", f"{HEAD}\n\n{xml}\n</Ontology>".encode())
    text = f"Prefix(:=<urn:x#>)Ontology(<urn:x>\n{axiom})"
    expected = parse("a.ofn", text.encode())
    assert to_isomorphic(graph) == to_isomorphic(expected), graph.serialize()
    assert {line for (_, _, o), line in graph.lines.items() if o != OWL.Ontology} == {6}
    assert len(graph.lines) == len(graph)


def owl_xml(text: str, attributes: str = 'xml:base="http://e.org/a"') -> Graph:
    namespace = 'xmlns="http://www.w3.org/2002/07/owl#"'
    return parse("a.owx", f"<Ontology {namespace} {attributes}>{text}</Ontology>".encode())


def test_names_of_an_ontology() -> None:
    graph = owl_xml("", 'ontologyIRI="urn:x" versionIRI="urn:x/1"')
    assert set(graph) == {
        (URIRef("urn:x"), RDF.type, OWL.Ontology),
        (URIRef("urn:x"), OWL.versionIRI, URIRef("urn:x/1")),
    }
    assert len(owl_xml("")) == 1


@pytest.mark.parametrize(
    ("base", "iri", "full"),
    [
        ("http://e.org/a", "#A", "http://e.org/a#A"),
        ("http://e.org/a#", "#A", "http://e.org/a#A"),
        ("http://e.org/a#", "A", "http://e.org/a#A"),
        ("http://e.org/a/", "A", "http://e.org/a/A"),
        ("http://e.org/a", "/A", "http://e.org/a/A"),
        ("http://e.org/a", "", "http://e.org/a"),
        ("http://e.org/a/b", "../A", "http://e.org/A"),
        ("urn:x", "#A", "urn:x#A"),
        ("urn:x:", "A", "urn:x:A"),  # is absolute, and none of XML's business
        ("http://e.org/a", "urn:x:A", "urn:x:A"),
        ("http://e.org/a", "tag:e.org,2026:A", "tag:e.org,2026:A"),
        ("http://e.org/a", "http://e.org/A/", "http://e.org/A/"),
    ],
)
def test_relative_iris(base: str, iri: str, full: str) -> None:
    """As Protégé and ROBOT write and read them."""
    text = f'<Declaration><Class IRI="{iri}"/></Declaration>'
    for attributes in (f'xml:base="{base}"', f'ontologyIRI="{base}"'):
        assert (URIRef(full), RDF.type, OWL.Class) in owl_xml(text, attributes)


def test_bases_inside_of_bases() -> None:
    graph = owl_xml(
        '<Declaration xml:base="b/"><Class IRI="A"/></Declaration>'
        '<Declaration><Class IRI="#A" xml:base="urn:y"/></Declaration><Import>c.owl</Import>'
    )
    assert set(graph.subjects(RDF.type, OWL.Class)) == {
        URIRef("http://e.org/b/A"), URIRef("urn:y#A")
    }  # fmt: skip
    assert set(graph.objects(None, OWL.imports)) == {URIRef("http://e.org/c.owl")}


def test_without_any_base() -> None:
    graph = owl_xml('<Declaration><Class IRI="#A"/></Declaration>', "")
    assert (URIRef("file:///a.owx#A"), RDF.type, OWL.Class) in graph


def test_plain_literals_of_old_protege() -> None:
    plain = 'datatypeIRI="&rdf;PlainLiteral"'
    text = "".join(
        said("AnnotationAssertion", '<AnnotationProperty abbreviatedIRI="rdfs:label"/>',
             "<IRI>urn:a</IRI>", f"<Literal {tag}>a@b</Literal>")
        for tag in (plain, plain + ' xml:lang="en"')
    )  # fmt: skip
    data = (
        f'<!DOCTYPE Ontology [ <!ENTITY rdf "{RDF}"> ]>\n<Ontology xmlns="{OWL}">{text}</Ontology>'
    )
    labels = set(parse("a.owl", data.encode()).objects(None, RDFS.label))
    assert labels == {Literal("a@b"), Literal("a@b", lang="en")}


def test_annotations_of_the_first_axiom_are_its_own() -> None:
    graph = owl_xml(said("SubClassOf", said("Annotation", NOTE), *(A, C)), 'ontologyIRI="urn:x"')
    (axiom,) = graph.subjects(RDF.type, OWL.Axiom)
    assert set(graph.subject_objects(RDFS.label)) == {(axiom, Literal("x"))}


def test_other_prefixes_encodings_and_foreign_attributes() -> None:
    text = (
        '<?xml version="1.0" encoding="ISO-8859-1"?>'
        '<o:Ontology xmlns:o="http://www.w3.org/2002/07/owl#"'
        ' xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:schemaLocation="a b"><!-- c -->'
        '<o:Declaration><o:Class IRI="urn:é"/></o:Declaration></o:Ontology>'
    )
    assert (URIRef("urn:é"), RDF.type, OWL.Class) in parse("a.owx", text.encode("latin-1"))


def test_long_lines() -> None:
    axiom = said("SubClassOf", A, B) + said("Annotation", NOTE.replace(">x<", f">{'x' * 5000}<"))
    assert len(parse("a.owx", f"{HEAD}{axiom}</Ontology>".encode())) == 3


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("<Foo/>", "line 5: Foo is no kind of axiom"),
        ("<SubClasOf>" + A + B + "</SubClasOf>", "line 5: SubClasOf is no kind of axiom"),
        (thing("<Foo/>"), "line 5: a class is expected in SubClassOf, not Foo(...)"),
        (thing('<x:Foo xmlns:x="urn:x"/>'), "line 5: <Foo> is no element of OWL/XML"),
        ('<Foo xmlns=""/>', "line 5: <Foo> is no element of OWL/XML"),
        (A, "line 5: an axiom is expected, not <Class>"),
        ("<Ontology/>", "line 5: Ontology is no kind of axiom"),
        ("SubClassOf", "line 5: the text 'SubClassOf' has no place in <Ontology>"),
        (said("SubClassOf", A, B, "x"), "line 5: the text 'x' has no place in <SubClassOf>"),
        (said("SubClassOf", A), "line 5: SubClassOf has 1 parts, not 2"),
        (said("Declaration", A, B), "line 5: a declaration is of one of"),
        (said("Declaration", "<Class/>"), "line 5: <Class> has no IRI"),
        (said("Declaration", '<Class iri="#A"/>'), "line 5: <Class> has no attribute iri in OWL"),
        (said("Declaration", '<Class IRI="#A" abbreviatedIRI=":A"/>'), "<Class> has both IRI and"),
        (said("Declaration", '<Class IRI=":A"/>'), "':A' is not an IRI but an abbreviated one"),
        (said("Declaration", '<Class IRI="urn:a b"/>'), "line 5: 'urn:a b' is not an IRI"),
        (said("Declaration", '<Class abbreviatedIRI="y:A"/>'), "the prefix y: is not declared"),
        (said("Declaration", '<Class abbreviatedIRI="A"/>'), "'A' is no name: a prefix is missing"),
        (thing(said("ObjectMinCardinality", P)), "<ObjectMinCardinality> has no cardinality"),
        (thing(said("ObjectMinCardinality", P, cardinality="x")), "is 'x', no number"),
        (thing(f'<Class IRI="#A">{A}</Class>'), "line 5: <Class> has no place in <Class>"),
        (thing('<Prefix name="x" IRI="urn:x"/>'), "<Prefix> has no place in <SubClassOf>"),
        ('<Prefix IRI="urn:x"/>', "<Prefix> has no name"),
        (said("Import", "c.owl"), "line 5: 'c.owl' is not an IRI"),
        ('<Import xml:base="http://[a">b</Import>', "line 5: 'b' is not an IRI"),
        (said("Import"), "line 5: <Import> names no ontology"),
        (said("ClassAssertion", A, "<AnonymousIndividual/>"), "<AnonymousIndividual> has no node"),
        (said("HasKey", A), "a key is stated so"),
        (said("HasKey", A, P, I1.replace("NamedIndividual", "Foo")), "has no attribute IRI"),
        (said("HasKey", A, P, "<Foo/>"), "an object property is expected in HasKey, not Foo"),
        (said("DLSafeRule", said("Body", A), "<Head/>"), "an atom is expected in Body, not urn:"),
        (said("DLSafeRule", said("Body", "<Foo/>"), "<Head/>"), "Foo is no atom of a rule"),
        (thing(said("DataSomeValuesFrom", D, said("DatatypeRestriction", INT, said(
            "FacetRestriction", facet="urn:f")))), "<FacetRestriction> holds one <Literal>"),
        (thing(said("DataSomeValuesFrom", D, said("DatatypeRestriction", INT, said(
            "FacetRestriction", FIVE)))), "<FacetRestriction> has no facet"),
        (said("SubClassOf", said("FacetRestriction", FIVE, facet="urn:f"), A), "FacetRestriction("),
        (said("Annotation", NOTE.replace("Literal>x", 'Literal xml:lang="1">x')),
         "'1' is no language"),
        (said("ObjectComplementOf", "<ObjectComplementOf>" * 2000 + "</ObjectComplementOf>" * 2000),
         "line 5: it is nested too deeply"),
    ],
)  # fmt: skip
def test_mistakes(text: str, message: str) -> None:
    data = f"{HEAD}\n{text}\n</Ontology>".encode()
    with pytest.raises(OntologySyntaxError) as caught:
        parse("a.owx", data)
    assert str(caught.value).startswith("a.owx: line 5: ")
    assert message in str(caught.value)


def test_a_version_needs_a_name() -> None:
    with pytest.raises(OntologySyntaxError, match=r"a\.owx: line 1: an ontology without"):
        owl_xml("", 'versionIRI="urn:x"')


def test_no_part_of_a_file_crashes() -> None:
    """Elements in places that are not theirs: an error or a graph, nothing else."""
    parts = [A, P, D, I1, INT, FIVE, V, NOTE, "<IRI>#A</IRI>", *(xml for xml, _ in PAIRS)]
    outer = [
        "SubClassOf", "Declaration", "HasKey", "Annotation", "Body", "Literal", "Import", "Class",
        "DatatypeRestriction", "FacetRestriction", "DLSafeRule", "Prefix", *KNOWN,
    ]  # fmt: skip
    for name in outer:
        for part in parts:
            with suppress(OntologySyntaxError):
                parse("a.owx", f"{HEAD}{said(name, part, part)}</Ontology>".encode())


@pytest.mark.parametrize("classes", [3_400, pytest.param(17_000, marks=pytest.mark.slow)])
def test_large_file(classes: int) -> None:
    """20,000 triples at once, or 100,000, in a few seconds."""
    axioms = "\n".join(
        f'<Declaration><Class IRI="#C{n}"/></Declaration>\n<SubClassOf><Class IRI="#C{n}"/>'
        f'<ObjectSomeValuesFrom>{P}<Class IRI="#C{n // 2}"/></ObjectSomeValuesFrom></SubClassOf>\n'
        '<AnnotationAssertion><AnnotationProperty abbreviatedIRI="rdfs:label"/>'
        f'<IRI>#C{n}</IRI><Literal xml:lang="en">class {n}</Literal></AnnotationAssertion>'
        for n in range(classes)
    )
    data = f"{HEAD}{axioms}</Ontology>".encode()
    start = process_time()
    graph = parse("a.owx", data)
    assert len(graph) == 6 * classes + 1
    assert process_time() - start < 30 * classes / 17_000


def robot(folder: Path, source: str, target: str) -> None:
    """Convert a file, or skip the test where ROBOT cannot be run."""
    done = subprocess.run(
        [ROOT / "scripts" / "robot", "convert", "--input", source, "--output", target],
        cwd=folder, capture_output=True, text=True, check=False,
    )  # fmt: skip
    if done.returncode == 3:
        (pytest.fail if os.environ.get("CI") else pytest.skip)(done.stderr.strip())
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.robot
@pytest.mark.parametrize("name", ["core.ttl", "map.ttl", "upstream/onto4mat.ttl"])
def test_robot_reads_the_same(tmp_path: Path, name: str) -> None:
    """A module that ROBOT saved as OWL/XML, and that read by ROBOT again."""
    graph = Graph().parse(ROOT / "ontology" / name)
    graph.remove((None, OWL.imports, None))
    graph.serialize(tmp_path / "in.ttl")
    robot(tmp_path, "in.ttl", "a.owx")
    robot(tmp_path, "a.owx", "back.ttl")
    ours = parse("a.owx", (tmp_path / "a.owx").read_bytes())
    assert to_isomorphic(ours) == to_isomorphic(Graph().parse(tmp_path / "back.ttl"))


@pytest.mark.robot
def test_robot_writes_the_same_in_both_syntaxes(tmp_path: Path) -> None:
    """All kinds of axioms; but ROBOT orders the atoms of a rule at random, so no long rules."""
    chosen = [
        axiom for _, axiom in PAIRS if not axiom.startswith("Import") and "BuiltIn" not in axiom
    ]
    chosen.sort(key=lambda axiom: not axiom.startswith("Annotation("))
    head = f"Prefix(:=<urn:x#>)\nPrefix(rdfs:=<{RDFS}>)\n"
    (tmp_path / "in.ofn").write_text(f"{head}Ontology(<urn:x>\n" + "\n".join(chosen) + ")")
    robot(tmp_path, "in.ofn", "a.owx")
    robot(tmp_path, "in.ofn", "b.ofn")
    in_xml = parse("a.owx", (tmp_path / "a.owx").read_bytes())
    functional = parse("b.ofn", (tmp_path / "b.ofn").read_bytes())
    assert len(in_xml) > 100
    assert to_isomorphic(in_xml) == to_isomorphic(functional)
