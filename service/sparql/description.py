"""The SPARQL 1.1 Service Description: what this endpoint can do, as RDF."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fastapi import Request, Response

from symboslam.reasoning.vocabulary import RDF_NAMESPACE
from symboslam.service.problems import Problem
from symboslam.service.requests import address
from symboslam.service.responses import etag, not_modified, respond
from symboslam.service.settings import Settings
from symboslam.service.sparql.negotiation import choose
from symboslam.service.store._base import Answer, Store
from symboslam.service.vocabulary import (
    FORMATS,
    PREFIXES,
    RESULT_FORMATS,
    SD,
    SOLUTIONS,
    TRIPLES,
    UPLOADS,
)

if TYPE_CHECKING:
    from pyoxigraph import Triple

_MOST_GRAPHS = 1000


async def describe(request: Request, settings: Settings, store: Store) -> Response:
    """The description in the format that the client likes best."""
    import pyoxigraph

    media_type = choose(request.headers.get("accept"), TRIPLES)
    if media_type is None:
        detail = f"the service is described as {', '.join(TRIPLES)}"
        raise Problem(406, "not-acceptable", detail)
    endpoint = address(request, settings, "/sparql")
    tag = etag(store.version, media_type, endpoint)
    if same := not_modified(request, tag):
        return same
    body = pyoxigraph.serialize(
        triples(endpoint, settings, await store.graph_names(_MOST_GRAPHS)),
        format=getattr(pyoxigraph.RdfFormat, TRIPLES[media_type]),
        prefixes=PREFIXES,
    )
    assert body is not None
    return respond(request, Answer(media_type, len(body), body), tag)


def triples(endpoint: str, settings: Settings, graphs: list[str]) -> list[Triple]:
    """The description of an endpoint.

    Args:
        endpoint: its address.
        settings: what is switched on.
        graphs: IRIs of its named graphs.
    """
    from pyoxigraph import BlankNode, NamedNode, Triple

    found: list[Triple] = []

    def add(subject: NamedNode | BlankNode, term: str, value: NamedNode | BlankNode) -> None:
        found.append(Triple(subject, NamedNode(SD + term), value))

    def typed(subject: NamedNode | BlankNode, kind: str) -> None:
        found.append(Triple(subject, NamedNode(RDF_NAMESPACE + "type"), NamedNode(SD + kind)))

    service, dataset, default = NamedNode(endpoint), BlankNode(), BlankNode()
    typed(service, "Service")
    add(service, "endpoint", service)
    languages = ["SPARQL10Query", "SPARQL11Query"]
    if settings.admin_token is not None:
        languages.append("SPARQL11Update")
    for language in languages:
        add(service, "supportedLanguage", NamedNode(SD + language))
    features = []
    if settings.union_default_graph:
        features.append("UnionDefaultGraph")
    if settings.allow_service:
        features.append("BasicFederatedQuery")
    if settings.allow_load:
        features.append("DereferencesURIs")
    for feature in features:
        add(service, "feature", NamedNode(SD + feature))
    for name in sorted({*SOLUTIONS.values(), *TRIPLES.values()}):
        add(service, "resultFormat", NamedNode(FORMATS + RESULT_FORMATS[name]))
    for name in sorted(set(UPLOADS.values())):
        add(service, "inputFormat", NamedNode(FORMATS + RESULT_FORMATS[name]))
    add(service, "defaultDataset", dataset)
    typed(dataset, "Dataset")
    add(dataset, "defaultGraph", default)
    typed(default, "Graph")
    for iri in graphs:
        graph = BlankNode()
        add(dataset, "namedGraph", graph)
        typed(graph, "NamedGraph")
        add(graph, "name", NamedNode(iri))
    return found
