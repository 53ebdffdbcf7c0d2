"""Every triple is located on the line that states it."""

from __future__ import annotations

import pytest
from rdflib import OWL, RDF, RDFS, Graph, Literal, URIRef
from rdflib.compare import isomorphic

from symboslam.errors import OntologySyntaxError
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


@pytest.mark.parametrize("tag", ["HasKey", "SubClasOf", "NegativeObjectPropertyAssertion"])
def test_owl_xml_is_not_read_in_part(tag: str) -> None:
    """owlready2's parser passes over what it does not know."""
    text = OWL_XML.replace("</Ontology>", f'    <{tag}><Class IRI="#House"/></{tag}>\n</Ontology>')
    with pytest.raises(OntologySyntaxError, match=rf"a\.owx: line 17: <{tag}> is not understood"):
        parse("a.owx", text.encode())
