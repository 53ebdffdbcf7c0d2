"""Landmarks that are set: exactly as said, removed, stated, kept; and as `classify` has them."""

from pathlib import Path
from typing import Any

import httpx
import numpy as np
import pytest

from symboslam.engine.classify import classify
from symboslam.engine.readers import read_landmarks
from symboslam.reasoning.knowledge import Knowledge
from tests.service.conftest import ADMIN, Service, running
from tests.service.kept import graphs_of, half_written, same
from tests.service.test_maps import at, get, make, send

CLASSES = ("House", "Factory", "BusStop", "Tree", "ConvenienceStore", "Warehouse", "Car")


def patch(
    service: Service, which: str, *wanted: dict[str, Any], removed: tuple[str, ...] = (),
    key: str | None = None,
) -> httpx.Response:  # fmt: skip
    headers = ADMIN if key is None else {**ADMIN, "Idempotency-Key": key}
    body = {"set": list(wanted), "removed": list(removed)}
    return service.client.patch(f"/v1/maps/{which}/landmarks", json=body, headers=headers)


def to(name: str, kind: str, x: float, y: float, **rest: Any) -> dict[str, Any]:
    return {"id": name, "class": kind, "xy": [x, y], **rest}


def landmarks(service: Service, which: str) -> dict[str, tuple[str, list[float], float]]:
    found = get(service, f"{which}/landmarks")["features"]
    return {
        f["id"]: (
            f["properties"]["class"], f["geometry"]["coordinates"], f["properties"]["confidence"]
        )
        for f in found
    }  # fmt: skip


def test_landmarks_are_set_and_not_merged(shared: Service) -> None:
    which = make(shared)
    one, two = to("a", "House", 10, 20, confidence=0.5), to("b", "House", 11, 20, agent="control")
    said = patch(shared, which, one, two).json()
    assert (said["received"], said["new"], said["changed"], said["removed"]) == (2, 2, 0, 0)
    assert landmarks(shared, which) == {
        "a": ("House", [10.0, 20.0], 0.5), "b": ("House", [11.0, 20.0], 1.0)
    }  # fmt: skip
    said = patch(
        shared, which, to("a", "Factory", 100, 200, confidence=0.25, sightings=4),
        removed=("b", "never"),
    ).json()  # fmt: skip
    assert (said["new"], said["changed"], said["removed"], said["revision"]) == (0, 1, 1, 2)
    assert landmarks(shared, which) == {"a": ("Factory", [100.0, 200.0], 0.25)}
    feature = get(shared, f"{which}/landmarks")["features"][0]
    assert feature["properties"]["observations"] == 4
    send(shared, which, at("Factory", 100, 200, confidence=1.0))  # merges with what was set
    assert landmarks(shared, which)["a"][2] == 1.0
    send(shared, which, at("House", 11, 20))  # nothing is left of b
    assert len(landmarks(shared, which)) == 2
    assert half_written(shared.client, which, 600.0) == []


def test_what_cannot_be_set_is_counted_and_gone(shared: Service) -> None:
    which = make(shared)
    patch(shared, which, to("a", "House", 1, 1), to("b", "House", 2, 2))
    said = patch(
        shared, which, to("a", "Flurb", 1, 1), to("b", "House", -500, 2), to("c", "Tree", 3, 3)
    ).json()
    assert said["left_out"] == {"outside": 1, "unknown": {"Flurb": 1}}
    assert (said["new"], said["changed"], said["removed"]) == (1, 0, 2)
    assert list(landmarks(shared, which)) == ["c"]
    assert get(shared, which)["left_out"] == {"outside": 1, "unknown Flurb": 1}
    tags = {"id": "s", "tags": {"amenity": "school"}, "xy": [5, 5]}
    assert patch(shared, which, tags).json()["new"] == 1
    assert patch(shared, which).json()["received"] == 0


def test_a_batch_is_taken_once(shared: Service) -> None:
    which = make(shared)
    first = patch(shared, which, to("a", "House", 1, 1), key="k").json()
    patch(shared, which, to("a", "House", 9, 9))
    assert patch(shared, which, to("a", "House", 1, 1), key="k").json() == first
    assert landmarks(shared, which)["a"][1] == [9.0, 9.0]
    assert patch(shared, which, to("a", "House", 5, 5), key="k").status_code == 409


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ({"set": [to("a", "House", 1, 1)] * 2}, "'a' is there twice"),
        ({"set": [to("a", "House", 1, 1)], "removed": ["a"]}, "'a' is there twice"),
        ({"set": [{"id": "a", "xy": [1, 1]}]}, "set.0"),
        ({"set": [to("a", "House", 1, 1, confidence=2)]}, "confidence"),
        ({"set": [to("a", "House", 1, 1e12)]}, "farther"),
        ({"set": [to("a", "House", 1, 1, time="noon")]}, "ISO 8601"),
        ({"set": [{"id": "a", "class": "House", "xy": [1]}]}, "xy"),
        ({"set": [{"id": "", "class": "House", "xy": [1, 1]}]}, "id"),
        ({"set": [to("a", "House", 1, 1, sigma=3)]}, "sigma"), ({"sett": []}, "sett"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_said(shared: Service, body: dict[str, Any], said: str) -> None:
    which = make(shared)
    response = shared.client.patch(f"/v1/maps/{which}/landmarks", json=body, headers=ADMIN)
    assert response.status_code == 422
    assert said in response.json()["detail"]
    assert get(shared, which)["revision"] == 0
    assert shared.client.patch(f"/v1/maps/{which}/landmarks", json={}).status_code == 401
    assert shared.client.patch("/v1/maps/no/landmarks", json={}, headers=ADMIN).status_code == 404


def test_metres_count_from_the_origin_that_the_map_tells(shared: Service) -> None:
    assert get(shared, make(shared))["origin"] is None
    which = make(shared, bbox=[149.1, -35.3, 149.12, -35.28], crs=None)
    longitude, latitude = get(shared, which)["origin"]
    assert (longitude, latitude) == pytest.approx((149.11, -35.29))
    patch(shared, which, to("a", "House", 0, 0), to("b", "House", 0, 111.0))
    found = landmarks(shared, which)
    assert found["a"][1] == pytest.approx([longitude, latitude], abs=1e-7)
    assert found["b"][1] == pytest.approx([longitude, latitude + 0.001], abs=1e-5)


def test_the_map_is_that_of_its_landmarks_and_is_kept(tmp_path: Path) -> None:
    chance, known = np.random.default_rng(3), dict[str, dict[str, Any]]()
    given = {
        "data": tmp_path / "data", "admin_token": "a-token-for-tests", "bundled_ontology": False,
        "workers": 1, "rate": "none",
    }  # fmt: skip
    with running(**given) as service:
        which = make(service, segmentation={"cells": 8})
        for _ in range(4):
            wanted = {
                f"L{chance.integers(60)}": to(
                    "", str(chance.choice(CLASSES)), *chance.uniform(5, 595, 2).round(3).tolist(),
                    confidence=round(float(chance.uniform(0.2, 1)), 2),
                )
                for _ in range(25)
            }  # fmt: skip
            gone = [name for name in known if chance.random() < 0.2 and name not in wanted]
            sent = [{**each, "id": name} for name, each in wanted.items()]
            assert patch(service, which, *sent, removed=tuple(gone)).status_code == 200
            known = {n: each for n, each in (known | wanted).items() if n not in gone}
        send(service, which, at("House", 300, 300, agent="robot", id="h"))
        assert half_written(service.client, which, 600.0) == []
        before = landmarks(service, which)
        expected = {n: (e["class"], e["xy"], e["confidence"]) for n, e in known.items()}
        assert {name: before[name] for name in expected} == expected
        stated = graphs_of(service.client, which)
        knowledge, export = Knowledge.load(), get(service, f"{which}/landmarks")
        read = read_landmarks(export, knowledge, bbox=(0, 0, 600, 600))
        whole = classify(read, knowledge, **get(service, which)["settings"])
        told = {
            f["properties"]["segment_id"]: f["properties"]
            for f in get(service, f"{which}/segments")["features"]
        }
        assert sorted(whole.segment_id.tolist()) == sorted(told)
        for i, name in enumerate(whole.segment_id.tolist()):
            assert told[name]["environment"] == whole.name_of(i)
            chances = [told[name]["probabilities"][e.name] for e in whole.environments]
            assert chances == pytest.approx(whole.probability[i].tolist(), abs=2e-4)
    with running(**given) as service:
        assert landmarks(service, which) == before
        assert same(graphs_of(service.client, which), stated)
        patch(service, which, removed=tuple(before))
        assert landmarks(service, which) == {}
        assert half_written(service.client, which, 600.0) == []
