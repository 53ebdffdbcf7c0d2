"""W3C's tests of the SPARQL 1.1 Protocol and of the Graph Store Protocol, against a real server.

Once with the embedded store, once with Apache Jena Fuseki behind it.
"""

from collections.abc import Iterator

import httpx
import pytest

from tests.service.conftest import ADMIN, TOKEN, Service, running
from tests.service.w3c import Case, cases, replay, require

PROTOCOL = cases("sparql11-protocol", "manifest.ttl")
GRAPH_STORE = cases("graph-store-protocol", "manifest-direct.ttl", "manifest-indirect.ttl")


@pytest.fixture(scope="module")
def with_fuseki(fuseki_url: str, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Service]:
    with running(
        data=tmp_path_factory.mktemp("fuseki"), store=fuseki_url, admin_token=TOKEN,
        bundled_ontology=False,
    ) as service:  # fmt: skip
        yield service


@pytest.fixture(params=["embedded", "Fuseki"])
def client(request: pytest.FixtureRequest) -> Iterator[httpx.Client]:
    """A client with the administrator's token, of a store that is empty."""
    name = "shared_service" if request.param == "embedded" else "with_fuseki"
    service: Service = request.getfixturevalue(name)
    service.update("DROP ALL").raise_for_status()
    with httpx.Client(base_url=service.url, headers=ADMIN) as client:
        yield client


def test_the_tests_are_there() -> None:
    require(PROTOCOL, 34)
    require(GRAPH_STORE, 14)


@pytest.mark.parametrize("case", PROTOCOL, ids=lambda case: case.name)
def test_protocol(case: Case, client: httpx.Client) -> None:
    for graph, file in case.graphs.items():
        kind = {"content-type": "application/n-triples"}
        client.put(
            "/graphs", params={"graph": graph}, content=file.read_bytes(), headers=kind
        ).raise_for_status()
    replay(case, client, "/sparql/", "/sparql/")


@pytest.mark.parametrize("case", PROTOCOL[:1] + PROTOCOL[-1:], ids=lambda case: case.name)
def test_protocol_without_slash(case: Case, client: httpx.Client) -> None:
    replay(case, client, "/sparql/", "/sparql")


@pytest.mark.parametrize("case", GRAPH_STORE, ids=lambda case: case.name)
def test_graph_store_protocol(case: Case, client: httpx.Client) -> None:
    replay(case, client, "/gsp", "/graphs")
