"""The OpenAPI description is valid and true: schemathesis finds nothing, with and without token."""

import json
import os
import subprocess
import sys
from collections.abc import Iterator
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import pytest

from tests.service.conftest import ADMIN, TOKEN, Service, running

ROOT = Path(__file__).parents[2]
AREA = {"name": "town", "bbox": [149.1, -35.3, 149.2, -35.2]}
LANDMARKS = "\n".join(
    json.dumps({"coordinates": [149.11 + i / 100, -35.29 + i / 100], "class": kind})
    for i, kind in enumerate(["House", "Factory", "BusStop", "Tree"])
)
# Where a schema cannot say all, valid data may be refused: the grammar of SPARQL and of the graph
# formats, columns that are equally long, ids that are there once, the order of a box, names of
# coordinate systems and ontologies, times to come, names that print, features and environments that
# are known, parameters for queries or updates only, media types that agree with a parameter, files
# with nothing in them.
NOT_ALL_SAID = {
    "GET /sparql": "400",
    "POST /sparql": "400",
    "PUT /graphs": "400",
    "POST /graphs": "400, 415",
    "POST /v1/maps": "422",
    "POST /v1/tokens": "422",
    "POST /v1/jobs": "415, 422",
    "POST /v1/maps/{map_id}/observations": "422",
    "POST /v1/maps/{map_id}/increments": "422",
    "PATCH /v1/maps/{map_id}/landmarks": "422",
    "GET /v1/maps/{map_id}/landmarks": "422",
    "GET /v1/maps/{map_id}/segments/{segment}/explanation": "422",
    "PUT /v1/maps/{map_id}/segments/{segment}/override": "422",
}
# What schemathesis takes for wrong, and is not once it is sent: no text at all is an update by
# SPARQL's grammar, and an empty list as the value of `default` is `default=`.
TAKEN_AS_WELL = ("POST /sparql", "GET /graphs", "PUT /graphs", "POST /graphs", "DELETE /graphs")
REFUSED = "200, 201, 204, 400, 401, 403, 404, 405, 406, 409, 415, 422, 429, 5xx"
ACCEPTED = "2xx, 3xx, 401, 403, 404, 409, 429, 5xx"


@pytest.fixture(scope="module")
def described(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Service]:
    with running(
        data=tmp_path_factory.mktemp("described"), admin_token=TOKEN, bundled_ontology=False,
        workers=2, rate="none", query_seconds=5,
    ) as service:  # fmt: skip
        yield service


@pytest.fixture(scope="module")
def document(described: Service) -> Any:
    return described.client.get("/openapi.json").json()


def operations(document: Any) -> list[tuple[str, str, Any]]:
    found = [
        (method, path, operation)
        for path, item in document["paths"].items()
        for method, operation in item.items()
    ]
    assert len(found) > 25
    return found


def test_every_operation_says_what_goes_wrong(document: Any) -> None:
    assert document["openapi"].startswith("3.1.")
    for method, path, operation in operations(document):
        where = f"{method} {path}"
        for status, response in operation["responses"].items():
            assert status != "default", where
            if int(status) >= 400:
                schema = {"$ref": "#/components/schemas/Problem"}
                content = {"application/problem+json": {"schema": schema}}
                assert response["content"] == content, where
            assert "X-Request-ID" in response["headers"], where
        assert {"429", "500", "503"} <= set(operation["responses"]), where
        if operation.get("security"):
            assert {"401", "403"} <= set(operation["responses"]), where
        if "{" in path:
            assert "404" in operation["responses"], where
        if "requestBody" in operation:
            assert operation["requestBody"]["content"], where
            assert {"408", "413", "415"} <= set(operation["responses"]), where
    assert "HTTPValidationError" not in document["components"]["schemas"]


def test_bodies_have_their_media_types(document: Any) -> None:
    def body(method: str, path: str) -> set[str]:
        return set(document["paths"][path][method]["requestBody"]["content"])

    def answer(method: str, path: str) -> set[str]:
        return set(document["paths"][path][method]["responses"]["200"]["content"])

    here = "/v1/maps/{map_id}"
    assert body("post", f"{here}/observations") == {"application/geo+json", "application/x-ndjson"}
    assert "application/sparql-update" in body("post", "/sparql")
    assert "multipart/form-data" in body("post", "/graphs")
    assert answer("get", f"{here}/events") == {"text/event-stream"}
    assert body("post", f"{here}/increments") == {"application/json", "application/x-ndjson"}
    assert answer("get", f"{here}/increments") == {"application/x-ndjson"}
    assert answer("get", f"{here}/landmarks") == {"application/geo+json"}
    assert "text/plain" in answer("get", f"{here}/segments/{{segment}}/explanation")
    assert {"text/csv", "text/turtle"} <= answer("get", "/sparql")
    assert "image/png" in answer("get", f"{here}/export")


def test_the_examples_of_observations_are_taken(described: Service, document: Any) -> None:
    operation = document["paths"]["/v1/maps/{map_id}/observations"]["post"]
    content = operation["requestBody"]["content"]
    made = described.client.post("/v1/maps", json=AREA, headers=ADMIN).json()
    url = f"/v1/maps/{made['id']}/observations"
    example = content["application/geo+json"]["examples"]["house"]["value"]
    response = described.client.post(
        url, json=example, headers={**ADMIN, "Content-Type": "application/geo+json"}
    )
    assert response.json()["new"] == 1
    lines = content["application/x-ndjson"]["schema"]["description"].split("```")[1]
    response = described.client.post(
        url, content=lines, headers={**ADMIN, "Content-Type": "application/x-ndjson"}
    )
    result = response.json()
    assert (result["received"], result["new"], result["merged"]) == (2, 1, 1)


def test_the_example_of_increments_is_taken(described: Service, document: Any) -> None:
    operation = document["paths"]["/v1/maps/{map_id}/increments"]["post"]
    example = operation["requestBody"]["content"]["application/json"]["examples"]["drive"]["value"]
    made = described.client.post("/v1/maps", json=AREA, headers=ADMIN).json()
    url = f"/v1/maps/{made['id']}/increments"
    assert described.client.post(url, json=example, headers=ADMIN).status_code == 201


def config(service: Service, token: bool) -> str:
    """The configuration of schemathesis: a map to ask for, and what `NOT_ALL_SAID` says."""
    made = service.client.post("/v1/maps", json=AREA, headers=ADMIN)
    assert made.status_code == 201, made.text
    identifier = made.json()["id"]
    sent = service.client.post(
        f"/v1/maps/{identifier}/observations", content=LANDMARKS,
        headers={**ADMIN, "Content-Type": "application/x-ndjson"},
    )  # fmt: skip
    assert sent.json()["new"] == 4, sent.text
    segments = service.client.get(f"/v1/maps/{identifier}/segments").json()["features"]
    lines = [
        'hooks = "tests.service.openapi_hooks"',
        "request-timeout = 30",
        "max-stream-events = 1",
        "[parameters]",
        f'"path.map_id" = "{identifier}"',
        f'"path.segment" = "{segments[0]["properties"]["segment_id"]}"',
    ]
    if token:
        lines += ["[headers]", f'Authorization = "Bearer {TOKEN}"']
    for name, statuses in NOT_ALL_SAID.items():
        allowed = json.dumps(f"{ACCEPTED}, {statuses}".split(", "))
        lines += [
            "[[operations]]", f'include-name = "{name}"',
            "[operations.checks.positive_data_acceptance]", f"expected-statuses = {allowed}",
        ]  # fmt: skip
    for name in TAKEN_AS_WELL:
        lines += [
            "[[operations]]", f'include-name = "{name}"',
            "[operations.checks.negative_data_rejection]",
            f"expected-statuses = {json.dumps(REFUSED.split(', '))}",
        ]  # fmt: skip
    # A stream does not end, nobody waits for half a minute, a map would be gone for all.
    lines += [
        "[[operations]]", 'include-name = "GET /v1/maps/{map_id}/events"',
        "request-timeout = 1",
    ]  # fmt: skip
    lines += [
        "[[operations]]", 'include-name = "GET /v1/maps/{map_id}/increments"',
        'parameters = { "query.wait" = 0.1 }',
    ]  # fmt: skip
    lines += [
        "[[operations]]", 'include-name = "DELETE /v1/maps/{map_id}"',
        'parameters = { "path.map_id" = "none-such" }',
    ]  # fmt: skip
    return "\n".join(lines)


def schemathesis(service: Service, folder: Path, examples: int, token: bool) -> None:
    """Run it.

    Raises:
        AssertionError: it found something; says what.
    """
    if find_spec("schemathesis") is None:
        pytest.skip("needs schemathesis, of the dev extra")
    file = folder / "schemathesis.toml"
    file.write_text(config(service, token))
    found = subprocess.run(
        [
            sys.executable, "-m", "schemathesis.cli", "--config-file", str(file), "run",
            f"{service.url}/openapi.json", "--max-examples", str(examples), "--seed", "1",
            "--generation-database", "none",
        ],
        cwd=ROOT, capture_output=True, text=True, env={**os.environ, "NO_COLOR": "1"}, check=False,
    )  # fmt: skip
    assert found.returncode == 0, found.stdout + found.stderr
    assert "Operations:       35 selected" in found.stdout, found.stdout
    assert "FAILURES" not in found.stdout
    assert service.client.get("/readyz").status_code == 200


@pytest.mark.proof
def test_schemathesis_finds_nothing(described: Service, tmp_path: Path) -> None:
    schemathesis(described, tmp_path, 5, True)


@pytest.mark.slow
@pytest.mark.timeout(3600)
@pytest.mark.parametrize("token", [True, False], ids=["token", "anonymous"])
def test_schemathesis_finds_nothing_at_length(
    described: Service, tmp_path: Path, token: bool
) -> None:
    schemathesis(described, tmp_path, 500, token)
