"""Every triple is located on the line that states it."""

from __future__ import annotations

import pytest
from rdflib import OWL, RDF, RDFS, XSD, BNode, Graph, Literal, URIRef
from rdflib.compare import isomorphic

from symboslam.reasoning.parsing import parse

EX = "https://example.org/x#"
TURTLE = """@prefix : <https://example.org/x#> .
@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
# a comment

:House a owl:Class ;   # of a line
    rdfs:label \"\"\"House
of two lines\"\"\" ;

    rdfs:subClassOf :Building ,
        [ a owl:Restriction ;
          owl:onProperty :indicates ;
          owl:someValuesFrom :Residential ] .
:Tower rdfs:subClassOf :Building . :Hut rdfs:subClassOf :Building .
[] a owl:AllDisjointClasses ; owl:members ( :House
    :Tower ) .
"""
XML = """<?xml version="1.0"?>
<rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#"
         xmlns:rdfs="http://www.w3.org/2000/01/rdf-schema#"
         xmlns:owl="http://www.w3.org/2002/07/owl#">
  <owl:Class rdf:about="https://example.org/x#House">
    <rdfs:subClassOf
        rdf:resource="https://example.org/x#Building"/>
    <rdfs:subClassOf>
      <owl:Restriction>
        <owl:onProperty rdf:resource="https://example.org/x#indicates"/>
        <owl:someValuesFrom rdf:resource="https://example.org/x#Residential"/>
      </owl:Restriction>
    </rdfs:subClassOf>
    <rdfs:label>House</rdfs:label>
  </owl:Class>
</rdf:RDF>
"""
OWL_XML = """<?xml version="1.0"?>
<Ontology xmlns="http://www.w3.org/2002/07/owl#"
     xml:base="https://example.org/x"
     ontologyIRI="https://example.org/x">
    <Declaration><Class IRI="#House"/></Declaration>
    <SubClassOf>
        <Class IRI="#House"/>
        <Class IRI="#Building"/>
    </SubClassOf>
    <SubClassOf>
        <Class IRI="#House"/>
        <ObjectSomeValuesFrom>
            <ObjectProperty IRI="#indicates"/>
            <Class IRI="#Residential"/>
        </ObjectSomeValuesFrom>
    </SubClassOf>
</Ontology>
"""


def ex(name: str) -> URIRef:
    return URIRef(EX + name)


def test_turtle() -> None:
    graph = parse("a.ttl", TURTLE.encode())
    lines = graph.lines
    assert lines[ex("House"), RDF.type, OWL.Class] == 6
    assert lines[ex("House"), RDFS.label, Literal("House\nof two lines")] == 7
    assert lines[ex("House"), RDFS.subClassOf, ex("Building")] == 10
    (restriction,) = graph.subjects(OWL.someValuesFrom, ex("Residential"))
    assert lines[ex("House"), RDFS.subClassOf, restriction] == 11
    assert lines[restriction, OWL.onProperty, ex("indicates")] == 12
    assert lines[restriction, OWL.someValuesFrom, ex("Residential")] == 13
    assert lines[ex("Tower"), RDFS.subClassOf, ex("Building")] == 14
    assert lines[ex("Hut"), RDFS.subClassOf, ex("Building")] == 14
    (disjoint,) = graph.subjects(RDF.type, OWL.AllDisjointClasses)
    assert lines[disjoint, RDF.type, OWL.AllDisjointClasses] == 15
    assert set(lines) == set(graph)


def test_line_ends_of_windows_and_a_byte_order_mark() -> None:
    data = b"\xef\xbb\xbf" + TURTLE.replace("\n", "\r\n").encode()
    lines = parse("a.ttl", data).lines
    assert lines[ex("Tower"), RDFS.subClassOf, ex("Building")] == 14


def test_rdf_xml() -> None:
    graph = parse("a.owl", XML.encode())
    lines = graph.lines
    (restriction,) = graph.subjects(OWL.someValuesFrom, ex("Residential"))
    assert lines[ex("House"), RDF.type, OWL.Class] == 5
    assert lines[ex("House"), RDFS.subClassOf, ex("Building")] == 6
    assert lines[ex("House"), RDFS.subClassOf, restriction] == 8
    assert lines[restriction, OWL.onProperty, ex("indicates")] == 10
    assert lines[ex("House"), RDFS.label, Literal("House")] == 14
    assert set(lines) == set(graph)


def test_the_graph_is_what_rdflib_reads() -> None:
    for name, text, form in (("a.ttl", TURTLE, "turtle"), ("a.owl", XML, "xml")):
        assert isomorphic(parse(name, text.encode()), Graph().parse(data=text, format=form))


def test_owl_xml() -> None:
    graph = parse("a.owx", OWL_XML.encode())
    lines = graph.lines
    (restriction,) = graph.subjects(OWL.someValuesFrom, ex("Residential"))
    assert lines[ex("House"), RDF.type, OWL.Class] == 5
    assert lines[ex("House"), RDFS.subClassOf, ex("Building")] == 6
    assert lines[ex("House"), RDFS.subClassOf, restriction] == 10
    assert set(lines) == set(graph)


SHARED_LINES = """<?xml version="1.0"?>
<Ontology xmlns="http://www.w3.org/2002/07/owl#"
     ontologyIRI="https://example.org/x">
<SubClassOf><Class IRI="#A"/>
  <Class IRI="#B"/></SubClassOf><SubClassOf><Class IRI="#B"/>
  <Class IRI="#C"/></SubClassOf><SubClassOf><Class IRI="#C"/><Class IRI="#D"
  /></SubClassOf><SubClassOf
  ><Class IRI="#D"/><Class IRI="#E"/></SubClassOf></Ontology>
"""


def lines_of_subclasses(text: str) -> dict[str, int]:
    lines = parse("a.owx", text.encode()).lines
    return {
        str(s).partition("#")[2]: line for (s, p, _), line in lines.items() if p == RDFS.subClassOf
    }


@pytest.mark.parametrize(
    "long",
    [
        "",
        f"<!-- {'x' * 7772} -->",
        f'<Prefix name="long" IRI="https://example.org/{"x" * 5000}"/>',
        f'<Annotation><AnnotationProperty abbreviatedIRI=":a"/><Literal>{"x" * 3000}</Literal>'
        "</Annotation>",
    ],
    ids=["nothing", "comment", "tag", "literal"],
)
def test_owl_xml_axioms_share_lines(long: str) -> None:
    prefix = '<Prefix name="" IRI="https://example.org/x#"/>'
    text = SHARED_LINES.replace("<SubClassOf>", prefix + long + "<SubClassOf>", 1)
    assert lines_of_subclasses(text) == {"A": 4, "B": 5, "C": 6, "D": 7}


def test_owl_xml_literal_of_many_characters() -> None:
    label = "x y" * 1000
    axiom = f"""    <AnnotationAssertion>
        <AnnotationProperty IRI="http://www.w3.org/2000/01/rdf-schema#label"/>
        <IRI>#House</IRI>
        <Literal>{label}</Literal>
    </AnnotationAssertion>
    <SubClassOf><Class IRI="#Z"/><Class IRI="#House"/></SubClassOf>
"""
    lines = parse("a.owx", OWL_XML.replace("</Ontology>", axiom + "</Ontology>").encode()).lines
    assert lines[ex("House"), RDFS.label, Literal(label)] == 17
    assert lines[ex("Z"), RDFS.subClassOf, ex("House")] == 22


@pytest.mark.parametrize("size", [10_000, 1_000_000])
def test_owl_xml_on_one_line(size: int) -> None:
    axiom = OWL_XML[OWL_XML.index("    <SubClassOf>") : OWL_XML.index("</Ontology>")]
    count = size // len(axiom) + 1
    axioms = "".join(axiom.replace("#House", f"#C{n}") for n in range(count))
    text = OWL_XML.replace("</Ontology>", axioms + "</Ontology>")
    graph = parse("a.owx", text.replace("\n", " ").encode())
    assert len(graph) == 2 + 5 * (count + 1)
    assert set(graph.lines.values()) == {1}
    assert set(graph.lines) == set(graph)


JSON_LD = r"""{
  "@context": {
    "@base": "https://example.org/x", "@vocab": "https://example.org/x#",
    "e": "https://example.org/x#", "owl": "http://www.w3.org/2002/07/owl#",
    "rdfs": "http://www.w3.org/2000/01/rdf-schema#",
    "xsd": "http://www.w3.org/2001/XMLSchema#",
    "a": "@type", "id": "@id", "comment": {"@id": "rdfs:comment", "@container": "@language"},
    "members": {"@id": "owl:members", "@container": "@list"},
    "sub": {"@id": "rdfs:subClassOf", "@type": "@id"},
    "domain": {"@id": "rdfs:domain", "@type": "@vocab"}
  },
  "@graph": [
    {
      "@type": [
        "owl:Class",
        "Kind"
      ],
      "sub": [
        "e:Building",
        "https://example.org/x#Hut",
        "#Tower"
      ],
      "@id": "e:House",
      "rdfs:seeAlso": [
        {"@id": "e:Hut"},
        {
          "id": "#Shed",
          "a": "owl:Class",
          "rdfs:label": "inside",
          "rdfs:seeAlso": {"@id": "e:Far"}
        },
        {"id": "e:Far"}
      ],
      "rdfs:label": [
        "e:Building",
        {"@language": "en",
         "@value": "the \"House\""}
      ],
      "comment": {
        "de": "Haus",
        "en": ["house",
               "home"]
      },
      "height": [
        12,
        2.5,
        true,
        {"@value": "2020-01-01",
         "@type": "xsd:date"}
      ],
      "owl:equivalentClass": [
        {
          "@type": "owl:Restriction",
          "owl:onProperty": {"@id": "e:has"},
          "owl:someValuesFrom":
            {"@id": "e:Missing"}
        },
        {
          "@type": "owl:Restriction",
          "owl:onProperty": {"@id": "e:has"},
          "owl:hasValue": "Missing"
        },
        {
          "owl:unionOf": {"@list": [
            {"@id": "e:Hut"},
            {"@id": "e:Tower"}]}
        }
      ]
    },
    {"@id": "e:has",
     "domain":
       "House",
     "sub": "e:Hut",
     "rdfs:range": "e:Hut",
     "rdfs:seeAlso":
       {"@id": "e:Hut"}
    },
    {"@id": "e:Hut", "@type": "owl:Class"},
    {"@id": "_:all",
     "@type": "owl:AllDisjointClasses",
     "members": [
       {"@id": "e:Hut"},
       {"@id": "e:House"}]}
  ]
}
"""


@pytest.mark.parametrize(
    ("name", "predicate", "value", "line"),
    [
        ("House", RDF.type, OWL.Class, 15),
        ("House", RDF.type, ex("Kind"), 16),
        ("House", RDFS.subClassOf, ex("Building"), 19),
        ("House", RDFS.subClassOf, ex("Hut"), 20),
        ("House", RDFS.subClassOf, ex("Tower"), 21),
        ("House", RDFS.seeAlso, ex("Hut"), 25),
        ("House", RDFS.seeAlso, ex("Shed"), 27),
        ("House", RDFS.seeAlso, ex("Far"), 32),
        ("Shed", RDF.type, OWL.Class, 28),
        ("Shed", RDFS.label, Literal("inside"), 29),
        ("Shed", RDFS.seeAlso, ex("Far"), 30),
        ("House", RDFS.label, Literal("e:Building"), 35),
        ("House", RDFS.label, Literal('the "House"', lang="en"), 37),
        ("House", RDFS.comment, Literal("Haus", lang="de"), 40),
        ("House", RDFS.comment, Literal("house", lang="en"), 41),
        ("House", RDFS.comment, Literal("home", lang="en"), 42),
        ("House", ex("height"), Literal(12), 45),
        ("House", ex("height"), Literal(2.5), 46),
        ("House", ex("height"), Literal(True), 47),
        ("House", ex("height"), Literal("2020-01-01", datatype=XSD.date), 48),
        ("has", RDFS.domain, ex("House"), 72),
        ("has", RDFS.subClassOf, ex("Hut"), 73),
        ("has", RDFS.range, Literal("e:Hut"), 74),
        ("has", RDFS.seeAlso, ex("Hut"), 76),
        ("Hut", RDF.type, OWL.Class, 78),
    ],
)
def test_json_ld(name: str, predicate: URIRef, value: URIRef | Literal, line: int) -> None:
    assert parse("a.jsonld", JSON_LD.encode()).lines[ex(name), predicate, value] == line


def test_json_ld_anonymous_nodes() -> None:
    """What stands on two lines of them, or is itself anonymous, is on the line of the node."""
    graph = parse("a.jsonld", JSON_LD.encode())
    found = {
        (str(p).partition("#")[2], str(o).partition("#")[2] or str(o)): graph.lines[s, p, o]
        for s, p, o in graph
        if isinstance(s, BNode) and not isinstance(o, BNode) and p not in (RDF.first, RDF.rest)
    }
    assert found == {
        ("type", "Restriction"): 23,
        ("onProperty", "has"): 23,
        ("someValuesFrom", "Missing"): 56,
        ("hasValue", "Missing"): 61,
        ("type", "AllDisjointClasses"): 80,
    }
    firsts = sorted(graph.lines[t] for t in graph.triples((None, RDF.first, None)))
    assert firsts == [65, 66, 82, 83]
    (restriction,) = graph.subjects(OWL.someValuesFrom, ex("Missing"))
    assert graph.lines[ex("House"), OWL.equivalentClass, restriction] == 23


def test_json_ld_never_points_outside_the_node() -> None:
    """Here the meaning of a prefix is not known, and the same words stand elsewhere."""
    data = b"""[{"@context": {"p": "https://example.org/x#", "q": "https://example.org/x#"},
      "@id": "https://example.org/x#A",
      "q:is": {"@id": "p:B"}, "q:was":
        {"@id": "https://example.org/x#C", "q:is": {"@id": "https://example.org/x#B"}}},
    {"@context": {"p": "https://example.org/y#"}, "@id": "https://example.org/x#D",
      "https://example.org/x#is": {"@id": "https://example.org/x#B"}, "https://example.org/x#n": [
        1.50, "01", "a\\u0062\\n}"]},
    {"@id": "https://example.org/x#D",
      "https://example.org/x#n": "more"}]"""
    lines = parse("a.jsonld", data).lines
    assert lines[ex("A"), ex("is"), ex("B")] == 2
    assert lines[ex("A"), ex("was"), ex("C")] == 4
    assert lines[ex("C"), ex("is"), ex("B")] == 4
    assert lines[ex("D"), ex("is"), ex("B")] == 6
    assert lines[ex("D"), ex("n"), Literal("1.5", datatype=XSD.double)] == 7
    assert lines[ex("D"), ex("n"), Literal("01")] == 7
    assert lines[ex("D"), ex("n"), Literal("ab\n}")] == 7
    assert lines[ex("D"), ex("n"), Literal("more")] == 9
