"""Bad input: each gets a problem that says what is wrong and where, and leaves no trace."""

import json
from collections.abc import Iterator
from typing import Any

import httpx
import pytest

from tests.service.conftest import ADMIN, TOKEN, Service, running

NDJSON = {"Content-Type": "application/x-ndjson"}
GEOJSON = {"Content-Type": "application/geo+json"}
JSON = {"Content-Type": "application/json"}
TURTLE = {"Content-Type": "text/turtle"}
AREA: dict[str, Any] = {"name": "town", "bbox": [149.1, -35.3, 149.2, -35.2]}
HERE = [149.15, -35.25]
NOT_AN_ONTOLOGY = "<urn:a> <urn:b> <urn:c> ."
SL = "https://w3id.org/symboslam#"
INCONSISTENT = f"""
@prefix sl: <{SL}> . @prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> . @prefix : <urn:x#> .
:Room a owl:Class ; rdfs:subClassOf sl:Environment ; owl:disjointWith :Hall .
:Hall a owl:Class ; rdfs:subClassOf sl:Environment .
:Chair a owl:Class ; rdfs:subClassOf sl:Feature ,
  [ a owl:Restriction ; owl:onProperty sl:indicates ; owl:someValuesFrom :Room ] .
sl:indicates a owl:ObjectProperty .
:thing a :Room , :Hall .
"""


@pytest.fixture(scope="module")
def fed(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Service]:
    with running(
        data=tmp_path_factory.mktemp("bad"), admin_token=TOKEN, bundled_ontology=False,
        workers=2, max_body_bytes=200_000,
    ) as service:  # fmt: skip
        for name, text in (("none", NOT_AN_ONTOLOGY), ("inconsistent", INCONSISTENT)):
            service.client.put(
                "/graphs", params={"graph": f"urn:{name}"}, content=text,
                headers={**ADMIN, **TURTLE},
            ).raise_for_status()  # fmt: skip
        yield service


@pytest.fixture(scope="module")
def town(fed: Service) -> str:
    made = fed.client.post("/v1/maps", json=AREA, headers=ADMIN).json()["id"]
    line = json.dumps({"id": "h", "coordinates": HERE, "class": "House"})
    response = fed.client.post(
        f"/v1/maps/{made}/observations", content=line,
        headers={**ADMIN, **NDJSON, "Idempotency-Key": "first"},
    )  # fmt: skip
    assert response.json()["new"] == 1, response.text
    return str(made)


def state(service: Service) -> dict[str, Any]:
    """All that a request could have changed."""
    everything = "SELECT ?g (COUNT(*) AS ?n) { GRAPH ?g { ?s ?p ?o } } GROUP BY ?g ORDER BY ?g"
    folder = service.app.state.settings.data
    return {
        "maps": service.client.get("/v1/maps").json(),
        "graphs": service.values(everything),
        "version": service.app.state.store.version,
        "tokens": service.client.get("/v1/tokens", headers=ADMIN).json(),
        "files": sorted(map(str, (folder / "ontologies").glob("*"))),
        "uploads": sorted(map(str, (folder / "jobs").glob("*"))),
    }


def refused(response: httpx.Response, *words: str) -> None:
    assert 400 <= response.status_code < 500, (response.status_code, response.text[:500])
    assert response.headers["content-type"] == "application/problem+json", response.text[:200]
    body = response.json()
    assert body["status"] == response.status_code
    assert body["type"].startswith("https://w3id.org/symboslam/problems#")
    for word in words:
        assert word in body["detail"], body["detail"]
    assert "Traceback" not in response.text
    assert len(response.text) < 3000


def line(**members: Any) -> bytes:
    return json.dumps({"coordinates": HERE, "class": "House"} | members).encode()


def feature(**members: Any) -> dict[str, Any]:
    point = {"type": "Point", "coordinates": HERE}
    return {
        "type": "Feature", "geometry": point, "properties": {"class": "House"}, **members,
    }  # fmt: skip


def collection(*features: Any, **members: Any) -> bytes:
    return json.dumps({"type": "FeatureCollection", "features": features, **members}).encode()


def at(*coordinates: Any) -> bytes:
    return collection(feature(geometry={"type": "Point", "coordinates": coordinates}))


GOOD = line()
LINES: dict[str, tuple[bytes, str]] = {
    "truncated": (GOOD + b"\n" + GOOD[:-5], "line 2"),
    "not an object": (GOOD + b"\n[1, 2]", "line 2"),
    "two values in a line": (GOOD + GOOD, "line 1"),
    "NaN": (b'{"coordinates": [NaN, 1], "class": "House"}', "line 1"),
    "Infinity": (b'{"coordinates": [1, Infinity], "class": "House"}', "line 1"),
    "1e400": (b'{"coordinates": [1e400, 1], "class": "House"}', "line 1"),
    "10^400": (b'{"coordinates": [1' + b"0" * 400 + b', 1], "class": "House"}', "coordinate"),
    "5000 digits": (b'{"coordinates": [1' + b"0" * 5000 + b', 1], "class": "House"}', "line 1"),
    "swapped": (line(coordinates=HERE[::-1]), "swapped"),
    "one coordinate": (line(coordinates=[1]), "coordinates"),
    "no coordinates": (b'{"class": "House"}', "coordinates"),
    "text for a coordinate": (line(coordinates=["149.15", -35.25]), "coordinate"),
    "true for a coordinate": (line(coordinates=[True, -35.25]), "coordinate"),
    "neither class nor tags": (b'{"coordinates": [149.15, -35.25]}', "class"),
    "class is a number": (line(**{"class": 5}), "class"),
    "tags are a list": (line(tags=["a"]), "tags"),
    "confidence 0": (line(confidence=0), "confidence"),
    "confidence 1.1": (line(confidence=1.1), "confidence"),
    "confidence -1": (line(confidence=-1), "confidence"),
    "confidence is text": (line(confidence="0.5"), "confidence"),
    "confidence NaN": (line(confidence=float("nan")), "confidence"),
    "unknown member": (line(colour="red"), "colour"),
    "no time": (line(time="yesterday"), "yesterday"),
    "time is a number": (line(time=5), "time"),
    "13th month": (line(time="2026-13-01T00:00:00Z"), "2026-13"),
    "agent with a bell": (line(agent="a\u0007b"), "agent"),
    "agent with NUL": (line(agent="a\0b"), "agent"),
    "agent with a lone surrogate": (line(agent="\ud800"), "agent"),
    "id with NUL": (line(id="a\0b"), "id"),
    "id of 1000": (line(id="a" * 1000), "id"),
    "id is an object": (line(id={"a": 1}), "id"),
    "id is infinite": (b'{"id": 1e400, "coordinates": [149.15, -35.25], "class": "House"}', "id"),
    "agent is a number": (line(agent=5), "agent"),
    "UTF-16": ("\ufeff".encode("utf-16-le") + GOOD.decode().encode("utf-16-le"), "line 1"),
    "Latin-1": ('{"coordinates": [149.15, -35.25], "class": "Caf\xe9"}'.encode("latin-1"), "UTF-8"),
    "deep": (b"[" * 50_000, "line 1"),
    "the same name twice": (
        b'{"coordinates": [149.15, -35.25], "class": "House", "class": "Factory"}', "class",
    ),
    "a good one, then a bad one": (GOOD + b"\n" + line(confidence=2), "line 2"),
}  # fmt: skip
COLLECTIONS: dict[str, tuple[bytes, str]] = {
    "empty": (b"", "JSON"),
    "truncated": (collection(feature())[:-9], "cut short"),
    "a list": (b"[]", "FeatureCollection"),
    "null": (b"null", "FeatureCollection"),
    "a feature alone": (json.dumps(feature()).encode(), "FeatureCollection"),
    "no features": (b'{"type": "FeatureCollection"}', "features"),
    "a polygon": (collection(feature(geometry={"type": "Polygon", "coordinates": []})), "Polygon"),
    "no geometry": (collection(feature(geometry=None)), "geometry"),
    "NaN": (at(float("nan"), 1), "feature 0"),
    "swapped": (at(*HERE[::-1]), "swapped"),
    "metres": (at(693_000, 6_097_000), "metres"),
    "metres, said so": (collection(feature(), crs_units="m"), "map is in"),
    "unknown units": (collection(feature(), crs_units="ft"), "crs_units"),
    "unknown system": (
        collection(feature(), crs={"type": "name", "properties": {"name": "EPSG:0"}}), "EPSG:0",
    ),
    "coordinates nested deeply": (
        b'{"type": "FeatureCollection", "features": [' + b"[" * 99_000, "deep",
    ),
    "UTF-16": (collection(feature()).decode().encode("utf-16"), "body"),
    "a feature of another type": (collection(feature(), {**feature(), "type": "x"}), "feature 1"),
    "a feature without a type": (
        collection({k: v for k, v in feature().items() if k != "type"}), "feature 0",
    ),
    "a feature without properties": (
        collection(feature(), {**feature(), "properties": None}), "feature 1",
    ),
    "agent is a number": (
        collection(feature(), feature(properties={"class": "House", "agent": 5})), "feature 1",
    ),
    "the same name twice": (collection(feature())[:-1] + b', "features": []}', "features"),
}  # fmt: skip


@pytest.mark.parametrize("name", LINES)
def test_lines(fed: Service, town: str, name: str) -> None:
    before = state(fed)
    body, word = LINES[name]
    refused(
        fed.client.post(f"/v1/maps/{town}/observations", content=body, headers={**ADMIN, **NDJSON}),
        word,
    )
    assert state(fed) == before


@pytest.mark.parametrize("name", COLLECTIONS)
def test_collections(fed: Service, town: str, name: str) -> None:
    before = state(fed)
    body, word = COLLECTIONS[name]
    refused(
        fed.client.post(
            f"/v1/maps/{town}/observations", content=body, headers={**ADMIN, **GEOJSON}
        ),
        word,
    )
    assert state(fed) == before


WRONG_IN_A_LINE: dict[str, tuple[bytes, str]] = {
    "confidence": (line(confidence=True), "confidence"),
    "coordinate": (line(coordinates=["149.15", -35.25]), "coordinate"),
    "swapped": (line(coordinates=HERE[::-1]), "swapped"),
    "no class": (b'{"coordinates": [149.15, -35.25]}', "class"),
    "agent": (line(agent=["a"]), "agent"),
    "agent is a number": (line(agent=5), "agent"),
    "tags": (line(tags=["a"]), "tags"),
    "tag": (line(**{"class": "", "tags": {"building": ["a"]}}), "tags"),
    "time": (line(time="yesterday"), "yesterday"),
    "id": (line(id={}), "id"),
    "long id": (line(id="a" * 1000), "id"),
    "a feature": (json.dumps(feature(geometry=None)).encode(), "geometry"),
    "unknown member": (line(colour="red"), "colour"),
    "no JSON": (b'{"coordinates": [1, }', "column 21"),
    "Latin-1": (b'{"class": "Caf\xe9"}', "UTF-8"),
}


@pytest.mark.parametrize("name", WRONG_IN_A_LINE)
@pytest.mark.parametrize("end", [b"\n", b"\r\n"], ids=["LF", "CRLF"])
def test_the_line_is_that_of_the_body(fed: Service, town: str, name: str, end: bytes) -> None:
    wrong, word = WRONG_IN_A_LINE[name]
    body = end.join([b"", GOOD, b"  ", b"", GOOD, wrong, b"", GOOD])
    response = fed.client.post(
        f"/v1/maps/{town}/observations", content=body, headers={**ADMIN, **NDJSON}
    )
    refused(response, "body: line 6", word)
    assert response.json()["line"] == 6
    assert "feature" not in response.json()["detail"].replace("not a feature", "")


# Address parameters, headers, what the problem says.
AROUND: dict[str, tuple[dict[str, str], dict[str, str], str]] = {
    "no media type": ({}, {"Content-Type": ""}, "application/geo+json"),
    "another media type": ({}, {"Content-Type": "text/csv"}, "application/geo+json"),
    "UTF-16": ({}, {"Content-Type": "application/x-ndjson; charset=utf-16"}, "UTF-8"),
    "compressed": ({}, {**NDJSON, "Content-Encoding": "gzip"}, "gzip"),
    "unknown system": ({"crs": "EPSG:999999"}, NDJSON, "EPSG:999999"),
    "no system": ({"crs": "\0"}, NDJSON, "coordinate system"),
    "vertical system": ({"crs": "EPSG:5711"}, NDJSON, "EPSG:5711"),
    "metres": ({"crs": "m"}, NDJSON, "map is in"),
    "agent with NUL": ({"agent": "a\0"}, NDJSON, "agent"),
    "agent of 1000": ({"agent": "a" * 1000}, NDJSON, "agent"),
    "key of 1000": ({}, {**NDJSON, "Idempotency-Key": "k" * 1000}, "idempotency-key"),
    "another batch's key": ({}, {**NDJSON, "Idempotency-Key": "first"}, "first"),
}


@pytest.mark.parametrize("name", AROUND)
def test_what_is_around_a_batch(fed: Service, town: str, name: str) -> None:
    before = state(fed)
    parameters, headers, word = AROUND[name]
    refused(
        fed.client.post(
            f"/v1/maps/{town}/observations", content=GOOD, params=parameters,
            headers={**ADMIN, **headers},
        ),
        word,
    )  # fmt: skip
    assert state(fed) == before


def test_a_batch_that_is_too_large(fed: Service, town: str) -> None:
    before = state(fed)
    response = fed.client.post(
        f"/v1/maps/{town}/observations", content=b"\n".join([GOOD] * 5000),
        headers={**ADMIN, **NDJSON},
    )  # fmt: skip
    assert response.status_code == 413
    refused(response, "200000")
    assert state(fed) == before


MAPS: dict[str, tuple[Any, str]] = {
    "no name": ({"name": ""}, "name"),
    "name of 1000": ({"name": "a" * 1000}, "name"),
    "name with NUL": ({"name": "a\0b"}, "name"),
    "name with a line break": ({"name": "a\nb"}, "name"),
    "name with a lone surrogate": ({"name": "\ud800"}, "name"),
    "three numbers": ({"bbox": [1, 2, 3]}, "bbox"),
    "five numbers": ({"bbox": [1, 2, 3, 4, 5]}, "bbox"),
    "no numbers": ({"bbox": ["a", "b", "c", "d"]}, "bbox"),
    "a number as text": ({"bbox": [149.1, "-35.3", 149.2, -35.2]}, "bbox.1"),
    "true for a number": ({"bbox": [True, 1, 2, 2]}, "bbox.0"),
    "true for a radius": ({"merge_radius": True}, "merge_radius"),
    "a setting as text": ({"settings": {"bandwidth": "50"}}, "bandwidth"),
    "NaN": ({"bbox": [float("nan"), 2, 3, 4]}, "bbox"),
    "infinite": ({"bbox": [float("inf"), 2, 3, 4]}, "bbox"),
    "zero area": ({"bbox": [1, 2, 1, 3]}, "bbox"),
    "turned": ({"bbox": [149.2, -35.2, 149.1, -35.3]}, "minimum"),
    "swapped": ({"bbox": [-35.3, 149.1, -35.2, 149.2]}, "bbox"),
    "antimeridian": ({"bbox": [179, -1, -179, 1]}, "antimeridian"),
    "the world": ({"bbox": [-180, -90, 180, 90]}, "half the world"),
    "out of range": ({"bbox": [0, 0, 500, 500]}, "bbox"),
    "huge": ({"bbox": [0, 0, 1e300, 1e300], "crs": "m"}, "bbox"),
    "unknown system": ({"crs": "EPSG:0"}, "EPSG:0"),
    "no system": ({"crs": "\0"}, "crs"),
    "surveyed is a point": ({"surveyed": {"type": "Point", "coordinates": HERE}}, "surveyed"),
    "surveyed is nothing": ({"surveyed": {}}, "surveyed"),
    "surveyed crosses itself": (
        {"surveyed": {"type": "Polygon", "coordinates": [
            [[149.1, -35.3], [149.2, -35.2], [149.2, -35.3], [149.1, -35.2], [149.1, -35.3]]
        ]}}, "surveyed",
    ),
    "surveyed elsewhere": (
        {"surveyed": {"type": "Polygon", "coordinates": [[[0, 0], [1, 0], [1, 1], [0, 0]]]}},
        "surveyed",
    ),
    "unknown member": ({"colour": "red"}, "colour"),
    "unknown profile": ({"profile": "best"}, "profile"),
    "unknown scheme": ({"scheme": "none-such"}, "none-such"),
    "unknown setting": ({"settings": {"colour": 1}}, "colour"),
    "wrong setting": ({"settings": {"bandwidth": -1}}, "bandwidth"),
    "setting NaN": ({"settings": {"bandwidth": float("nan")}}, "bandwidth"),
    "too fine": ({"segmentation": {"cells": 100_000}}, "cells"),
    "radius": ({"merge_radius": -1}, "merge_radius"),
    "no such ontology": ({"ontology": "urn:no-such"}, "urn:no-such"),
    "an ontology that is no IRI": ({"ontology": "../../etc/passwd"}, "ontology"),
    "a graph that is no ontology": ({"ontology": "urn:none"}, "urn:none"),
    "an ontology that contradicts itself": ({"ontology": "urn:inconsistent"}, "inconsistent"),
}  # fmt: skip


@pytest.mark.parametrize("name", MAPS)
def test_maps(fed: Service, town: str, name: str) -> None:
    before = state(fed)
    members, word = MAPS[name]
    body = json.dumps(AREA | members)
    refused(fed.client.post("/v1/maps", content=body, headers={**ADMIN, **JSON}), word)
    assert state(fed) == before


@pytest.mark.parametrize(
    "body",
    [b"", b"{", b"[]", b"null", b'{"name": "\xff"}', b"[" * 100_000, b'{"a": 1' + b"0" * 9000],
)
@pytest.mark.parametrize("path", ["/v1/maps", "/v1/tokens"])
def test_bodies_that_are_no_json(fed: Service, path: str, body: bytes) -> None:
    before = state(fed)
    refused(fed.client.post(path, content=body, headers={**ADMIN, **JSON}), "body")
    assert state(fed) == before


# The body, status, line and column, what the problem says.
NOT_JSON: dict[str, tuple[bytes, int, int, str]] = {
    "cut short": (b"{", 1, 2, "property name"),
    "in the third line": (b'{\n  "name": "a",\n  "bbox": [1, 2,, 3]\n}', 3, 17, "value"),
    "two values": (b"{}\n{}", 2, 1, "Extra data"),
    "Latin-1": (b'{\n "n\xc3\xa4me": "\xff"}', 2, 11, "UTF-8"),
    "nested deeply": (b'{"a":\n' + b"[" * 100_000, 2, 100_000, "nested"),
    "a number without end": (b'{"a": 1' + b"0" * 9000 + b"}", 1, 7, "digits"),
}


@pytest.mark.parametrize("name", NOT_JSON)
@pytest.mark.parametrize("path", ["/v1/maps", "/v1/tokens"])
def test_where_a_body_is_no_json(fed: Service, path: str, name: str) -> None:
    body, row, column, word = NOT_JSON[name]
    response = fed.client.post(path, content=body, headers={**ADMIN, **JSON})
    refused(response, f"body: line {row} column {column}", word)
    found = response.json()
    assert (response.status_code, found["line"], found["column"]) == (400, row, column)


@pytest.mark.parametrize(
    ("path", "body"),
    [
        ("/v1/maps", b'{"name": "a", "name": "b", "bbox": [149.1, -35.3, 149.2, -35.2]}'),
        ("/v1/maps", b'{"name": "a", "bbox": [1, 1, 2, 2], "settings": {"name": 1, "name": 2}}'),
        ("/v1/tokens", b'{"name": "a", "name": "b", "scopes": ["query"]}'),
    ],
)
def test_a_member_that_is_there_twice(fed: Service, path: str, body: bytes) -> None:
    before = state(fed)
    response = fed.client.post(path, content=body, headers={**ADMIN, **JSON})
    refused(response, "'name' twice")
    assert response.status_code == 422
    assert state(fed) == before


@pytest.mark.parametrize("kind", ["text/plain", "application/x-www-form-urlencoded", None])
@pytest.mark.parametrize("path", ["/v1/maps", "/v1/tokens"])
def test_bodies_that_do_not_say_that_they_are_json(
    fed: Service, path: str, kind: str | None
) -> None:
    before = state(fed)
    body = json.dumps(AREA if path == "/v1/maps" else {"name": "a", "scopes": ["query"]})
    headers = ADMIN if kind is None else {**ADMIN, "Content-Type": kind}
    response = fed.client.post(path, content=body, headers=headers)
    refused(response, "application/json", kind or "Content-Type")
    assert response.status_code == 415
    assert response.headers["Accept"] == "application/json"
    assert state(fed) == before


def test_an_ontology_without_java(fed: Service, town: str, monkeypatch: pytest.MonkeyPatch) -> None:
    from symboslam.errors import ReasonerError
    from symboslam.reasoning.knowledge import Knowledge

    def none(*_: object) -> None:
        raise ReasonerError("there is no Java: pip install 'symboslam[reasoner]'")

    monkeypatch.setattr(Knowledge, "load", none)
    before = state(fed)
    body = AREA | {"ontology": "urn:none"}
    refused(fed.client.post("/v1/maps", json=body, headers=ADMIN), "Java")
    assert state(fed) == before


BAD_IDS = [
    "none", "%00", "..", "..%2f..%2fetc%2fpasswd", "%2e%2e", "a" * 10_000, "a%0d%0ab",
    "%ff%fe", "%ed%a0%80", "' OR 1=1 --", "{map_id}", "\u00fc\u4e16",
]  # fmt: skip


@pytest.mark.parametrize("identifier", BAD_IDS, ids=range(len(BAD_IDS)))
@pytest.mark.parametrize("rest", ["", "/landmarks", "/segments", "/events", "/export"])
def test_ids(fed: Service, town: str, identifier: str, rest: str) -> None:
    refused(fed.client.get(f"/v1/maps/{identifier}{rest}"))


@pytest.mark.parametrize("identifier", BAD_IDS, ids=range(len(BAD_IDS)))
def test_nothing_is_removed_under_a_wrong_id(fed: Service, town: str, identifier: str) -> None:
    before = state(fed)
    refused(fed.client.delete(f"/v1/maps/{identifier}", headers=ADMIN))
    refused(fed.client.delete(f"/v1/tokens/{identifier}", headers=ADMIN))
    refused(fed.client.delete(f"/v1/maps/{town}/segments/{identifier}/override", headers=ADMIN))
    refused(
        fed.client.put(
            f"/v1/maps/{town}/segments/{identifier}/override", headers=ADMIN,
            json={"environment": "Residential"},
        )
    )  # fmt: skip
    assert state(fed) == before


@pytest.mark.parametrize("path", ["//v1/maps", "/v1//maps", "/v1/maps/", "/v1/./../x", "/V1/maps"])
def test_paths(fed: Service, path: str) -> None:
    with httpx.Client() as client:
        refused(client.get(f"{fed.url}{path}"))


@pytest.mark.parametrize(
    ("path", "word"),
    [
        ("landmarks?limit=0", "limit"), ("landmarks?limit=1e9", "limit"),
        ("landmarks?offset=-1", "offset"), ("landmarks?class=UFO", "UFO"),
        ("landmarks?class=%00", "class"), ("segments?reasons=101", "reasons"),
        ("export?format=exe", "format"), ("export?reasons=x", "reasons"),
        ("segments/0-0-0/explanation?length=long", "length"),
        ("segments/9-9-9/explanation", "9-9-9"),
    ],
)  # fmt: skip
def test_parameters(fed: Service, town: str, path: str, word: str) -> None:
    refused(fed.client.get(f"/v1/maps/{town}/{path}"), word)


# Method, address, what the problem says.
UNKNOWN_PARAMETERS = [
    ("POST", "/v1/maps/{town}/observations?agnet=x", "'agnet'; did you mean agent?"),
    ("POST", "/v1/maps?name=x", "'name'"),
    ("POST", "/v1/jobs?name=x&format=csv&boxx=1", "'boxx'; did you mean bbox?"),
    ("POST", "/v1/tokens?name=x", "'name'"),
    ("GET", "/v1/tokens?limit=1", "'limit'"),
    ("GET", "/v1/maps?limt=1", "'limt'; did you mean limit?"),
    ("GET", "/v1/maps?colour=1", "'colour'; there are: limit, offset"),
    ("GET", "/v1/maps/{town}?x", "'x': this address takes none"),
    ("GET", "/v1/maps/{town}/landmarks?feature=House", "'feature'"),
    ("GET", "/v1/maps/{town}/landmarks?klass=House", "'klass'; did you mean class?"),
    ("GET", "/v1/maps/{town}/events?last_event_id=1", "'last_event_id'"),
    ("GET", "/v1/maps/{town}/export?fromat=ttl", "'fromat'; did you mean format?"),
    ("GET", "/v1/examples?example=1", "'example'"),
    ("POST", "/v1/backup?to=x", "'to'"),
    ("DELETE", "/v1/maps/{town}?force=true", "'force'"),
]


@pytest.mark.parametrize(("method", "address", "words"), UNKNOWN_PARAMETERS)
def test_parameters_that_nothing_declares(
    fed: Service, town: str, method: str, address: str, words: str
) -> None:
    before = state(fed)
    kind = NDJSON if "observations" in address else JSON
    body = GOOD if kind is NDJSON else json.dumps(AREA).encode()
    response = fed.client.request(
        method, address.format(town=town), content=body, headers={**ADMIN, **kind}
    )
    refused(response, words)
    assert response.status_code == 422
    assert response.json()["parameter"] in words
    assert state(fed) == before


def test_parameters_that_are_repeated_or_no_text(fed: Service, town: str) -> None:
    refused(fed.client.get("/v1/maps?limit=1&limit=2"), "'limit'", "2 times")
    refused(fed.client.get(f"/v1/maps/{town}/landmarks?class=%ff"), "UTF-8")


def test_parameters_that_are_declared_are_taken(fed: Service, town: str) -> None:
    for address in (
        "landmarks?class=House&limit=5&offset=0", "segments?reasons=2", "export?format=ttl",
        "export?format=html&reasons=1",
    ):  # fmt: skip
        assert fed.client.get(f"/v1/maps/{town}/{address}").status_code == 200, address
    assert fed.client.get("/v1/maps?limit=1&offset=0").status_code == 200
    assert fed.client.get("/query?query=ASK%7B%7D&example=maps").status_code == 200
    with fed.client.stream("GET", f"/v1/maps/{town}/events", headers={"Last-Event-ID": "0"}) as it:
        assert it.status_code == 200
        assert it.headers["content-type"].startswith("text/event-stream")
        assert next(it.iter_lines()).startswith(("event:", "id:", "data:", ":"))


@pytest.mark.parametrize(
    ("members", "word"),
    [
        ({}, "environment"), ({"environment": "Moon"}, "Moon"), ({"environment": 5}, "environment"),
        ({"environment": None, "reason": "a\0"}, "reason"),
        ({"environment": None, "operator": "\u0007"}, "operator"),
        ({"environment": None, "operator": ""}, "operator"),
        ({"environment": None, "colour": 1}, "colour"),
    ],
)  # fmt: skip
def test_overrides(fed: Service, town: str, members: dict[str, Any], word: str) -> None:
    before = state(fed)
    segments = fed.client.get(f"/v1/maps/{town}/segments").json()["features"]
    segment = segments[0]["properties"]["segment_id"]
    response = fed.client.put(
        f"/v1/maps/{town}/segments/{segment}/override", json=members, headers=ADMIN
    )
    refused(response, word)
    assert state(fed) == before


@pytest.mark.parametrize(
    ("parameters", "body", "word"),
    [
        ({}, b"x", "name"), ({"name": "a", "format": "exe"}, b"x", "format"),
        ({"name": "a", "format": "csv", "bbox": "1,2"}, b"x", "bbox"),
        ({"name": "a", "format": "csv", "bbox": "nan,1,2,3"}, b"x", "bbox"),
        ({"name": "a\0", "format": "csv"}, b"x", "name"),
        ({"name": "a", "format": "csv"}, b"", "body"),
        ({"name": "a", "format": "csv"}, b"x" * 300_000, "200000"),
    ],
)  # fmt: skip
def test_files(fed: Service, parameters: dict[str, str], body: bytes, word: str) -> None:
    before = state(fed)
    refused(fed.client.post("/v1/jobs", params=parameters, content=body, headers=ADMIN), word)
    assert state(fed) == before


@pytest.mark.parametrize(
    ("format", "kind"),
    [
        ("geojson", "text/csv"), ("csv", "application/geo+json"), ("osm", "application/json"),
        ("csv", "application/x-www-form-urlencoded"), ("csv", "text/plain"),
        ("geojson", "multipart/form-data; boundary=x"), ("csv", "text/csv; charset=latin-1"),
    ],
)  # fmt: skip
def test_files_that_are_called_something_else(fed: Service, format: str, kind: str) -> None:
    before = state(fed)
    response = fed.client.post(
        "/v1/jobs", params={"name": "a", "format": format}, content=b"class,x,y\n",
        headers={**ADMIN, "Content-Type": kind},
    )  # fmt: skip
    refused(response, "latin-1" if "latin" in kind else "application/octet-stream")
    assert response.status_code == 415
    assert state(fed) == before


@pytest.mark.parametrize(
    "kind", [None, "application/octet-stream", "text/csv", "Text/CSV; charset=UTF-8"]
)
def test_files_that_are_called_what_they_are(fed: Service, kind: str | None) -> None:
    headers = ADMIN if kind is None else {**ADMIN, "Content-Type": kind}
    response = fed.client.post(
        "/v1/jobs", params={"name": "good.csv", "format": "csv"},
        content=b"class,lon,lat\nHouse,149.1,-35.2\nHouse,149.11,-35.21\n", headers=headers,
    )  # fmt: skip
    assert response.status_code == 202, response.text
    job = response.json()
    while job["state"] == "running":
        job = fed.client.get(f"/v1/jobs/{job['id']}").json()
    assert job["state"] == "done", job
    assert fed.client.delete(f"/v1/maps/{job['map']}", headers=ADMIN).status_code == 204


@pytest.mark.parametrize(
    ("format", "body"),
    [
        ("csv", b"GIF89a\0\0"), ("csv", b"class,x,y\nHouse,nan,1"), ("geojson", b"[" * 100_000),
        ("osm", b"<osm><!DOCTYPE"), ("osm", b"\0" * 100), ("csv", b"\xff\xfeclass"),
    ],
)  # fmt: skip
def test_files_that_cannot_be_read(fed: Service, format: str, body: bytes) -> None:
    before = state(fed)
    response = fed.client.post(
        "/v1/jobs", params={"name": "bad.file", "format": format}, content=body, headers=ADMIN
    )
    job = response.json()
    while job["state"] == "running":
        job = fed.client.get(f"/v1/jobs/{job['id']}").json()
    assert job["state"] == "failed"
    assert "defect" not in job["problem"]
    assert job["problem"].startswith("bad.file")
    assert state(fed) == before


def test_what_is_good_is_still_taken(fed: Service, town: str) -> None:
    lines = [
        line(),
        line(time="2026-03-02T10:00:00", agent="rob\u00f6t \u4e16\u754c", id="\u00fc"),
        line(time="9999-12-31T23:59:59Z", confidence=1),
        line(**{"class": "FlyingSaucer"}),
        line(coordinates=[10, 10]),
    ]
    response = fed.client.post(
        f"/v1/maps/{town}/observations", content=b"\xef\xbb\xbf" + b"\n".join(lines),
        headers={**ADMIN, **NDJSON},
    )  # fmt: skip
    assert response.status_code == 200, response.text
    result = response.json()
    assert result["received"] == 5
    assert result["left_out"] == {"outside": 1, "unknown": {"FlyingSaucer": 1}}
