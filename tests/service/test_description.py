"""The Service Description: W3C's three tests, and that it tells the truth."""

import pytest
from rdflib import RDF, Graph, Namespace, URIRef

from tests.service.conftest import MakeService, Service
from tests.service.test_protocol import problem

SD = Namespace("http://www.w3.org/ns/sparql-service-description#")
FORMATS = Namespace("http://www.w3.org/ns/formats/")


@pytest.mark.parametrize("path", ["/sparql", "/sparql/"])
@pytest.mark.parametrize("accept", ["text/turtle", "application/rdf+xml", "application/n-triples"])
def test_it_is_rdf_with_an_endpoint(service: Service, path: str, accept: str) -> None:
    response = service.client.get(path, headers={"Accept": accept})
    graph = Graph().parse(data=response.text, format=accept)
    (described,) = graph.subjects(RDF.type, SD.Service)
    assert list(graph.objects(described, SD.endpoint)) == [URIRef(f"{service.url}/sparql")]


def test_it_conforms_to_the_schema(with_ontology: Service) -> None:
    graph = Graph().parse(data=with_ontology.client.get("/sparql").text, format="turtle")
    (described,) = graph.subjects(RDF.type, SD.Service)
    (dataset,) = graph.objects(described, SD.defaultDataset)
    assert (dataset, RDF.type, SD.Dataset) in graph
    (default,) = graph.objects(dataset, SD.defaultGraph)
    assert (default, RDF.type, SD.Graph) in graph
    names = {str(graph.value(g, SD.name)) for g in graph.objects(dataset, SD.namedGraph)}
    assert names == {
        "https://w3id.org/symboslam/graph/ontology",
        "https://w3id.org/symboslam/graph/inferences",
    }
    assert set(graph.objects(described, SD.resultFormat)) >= {
        FORMATS.SPARQL_Results_JSON, FORMATS.SPARQL_Results_CSV, FORMATS.Turtle, FORMATS.RDF_XML,
    }  # fmt: skip
    terms = {p for p in graph.predicates() if str(p).startswith(SD)}
    assert terms == {
        SD.endpoint, SD.supportedLanguage, SD.feature, SD.resultFormat, SD.inputFormat,
        SD.defaultDataset, SD.defaultGraph, SD.namedGraph, SD.name,
    }  # fmt: skip


def test_it_says_what_is_switched_on(make_service: MakeService, with_ontology: Service) -> None:
    def said(service: Service) -> tuple[set[object], set[object]]:
        graph = Graph().parse(data=service.client.get("/sparql").text, format="turtle")
        return set(graph.objects(None, SD.supportedLanguage)), set(graph.objects(None, SD.feature))

    languages, features = said(with_ontology)
    assert languages == {SD.SPARQL10Query, SD.SPARQL11Query}
    assert features == {SD.UnionDefaultGraph}
    languages, features = said(make_service(allow_service=True, union_default_graph=False))
    assert SD.SPARQL11Update in languages
    assert features == {SD.BasicFederatedQuery}


def test_negotiation_and_caching(service: Service) -> None:
    problem(service.client.get("/sparql", headers={"Accept": "text/csv"}), 406, "not-acceptable")
    tag = service.client.head("/sparql").headers["etag"]
    assert service.client.get("/sparql", headers={"If-None-Match": tag}).status_code == 304
    service.update("INSERT DATA { GRAPH <urn:new> { <urn:a> <urn:b> 1 } }")
    response = service.client.get("/sparql", headers={"If-None-Match": tag})
    assert "urn:new" in response.text
