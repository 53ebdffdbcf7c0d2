"""GeoJSON that classify reads, and scene graphs of Spark-DSG."""

from __future__ import annotations

import json
import sys
from datetime import timedelta
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from symboslam.engine.readers import read_landmarks
from symboslam.engine.slam.log import Mission
from symboslam.engine.slam.slam_map import SlamMap
from symboslam.engine.slam.writers import write_slam_map
from symboslam.engine.slam.writers.geojson import ellipse_of
from symboslam.errors import InputError, MissingExtraError
from symboslam.reasoning.knowledge import Knowledge


@pytest.fixture(scope="session")
def knowledge() -> Knowledge:
    return Knowledge.load()


def test_ellipses_by_hand() -> None:
    assert ellipse_of(np.array([[0.04, 0], [0, 0.01]])) == pytest.approx(
        {"major": 0.2, "minor": 0.1, "angle": 0}
    )
    turned = ellipse_of(np.array([[0.02, 0.01], [0.01, 0.02]]))
    assert turned == pytest.approx({"major": 0.03**0.5, "minor": 0.1, "angle": np.pi / 4})
    assert ellipse_of(np.full((2, 2), np.nan)) is None


def test_local_metres(
    mission: Mission, slam_map: SlamMap, tmp_path: Path, knowledge: Knowledge
) -> None:
    path, lines = tmp_path / "a.geojson", tmp_path / "paths.geojson"
    written = write_slam_map(path, slam_map, mission, paths=lines)
    assert written.files == (path, lines)
    document = json.loads(path.read_text())
    assert document["crs_units"] == "m"
    tree = document["features"][0]
    assert tree["id"] == "t1"
    assert tree["geometry"] == {"type": "Point", "coordinates": [6, 1]}
    assert tree["properties"] == {
        "class": "Tree", "confidence": 0.9, "sightings": 1, "dynamic": False,
        "covariance": [[0.04, 0], [0, 0.01]],
        "ellipse": pytest.approx({"major": 0.2, "minor": 0.1, "angle": 0}),
    }  # fmt: skip
    assert document["features"][1]["properties"]["key"] == "sign"
    assert "covariance" not in document["features"][2]["properties"]
    landmarks = read_landmarks(path, knowledge)
    assert landmarks.id.tolist() == ["t1", "t 2", "c1"]
    assert landmarks.confidence.tolist() == [0.9, 0.7, 0.8]
    assert landmarks.static.tolist() == [True, True, False]
    assert landmarks.surveyed is not None
    # Robot A's way of 2 m and the place of the other, each with 5 m of sight around.
    assert landmarks.surveyed.bounds == pytest.approx((-4, -4, 12, 13), abs=0.02)
    paths = json.loads(lines.read_text())["features"]
    assert paths[0]["geometry"] == {"type": "LineString", "coordinates": [[1, 1], [2, 1], [3, 1]]}
    assert paths[0]["properties"]["robot"] == "Robot A"
    assert paths[0]["properties"]["time"] == [10, 11, 12]
    assert len(paths[1]["geometry"]["coordinates"]) == 2


def test_with_an_origin(
    mission: Mission, slam_map: SlamMap, tmp_path: Path, knowledge: Knowledge
) -> None:
    """One minute of latitude at the equator is 1842.9 m on WGS 84."""
    path = tmp_path / "a.geojson"
    write_slam_map(path, slam_map, mission, origin=(10.0, 0.0))
    document = json.loads(path.read_text())
    assert "crs_units" not in document
    x, y = document["features"][0]["geometry"]["coordinates"]
    assert x - 10 == pytest.approx(6 / 111319.49, rel=1e-5)
    assert y == pytest.approx(1 / 1842.9 / 60, rel=1e-4)
    landmarks = read_landmarks(path, knowledge)
    first, second = landmarks.x[0] - landmarks.x[1], landmarks.y[0] - landmarks.y[1]
    assert (first, second) == pytest.approx((3, -3.5), abs=1e-3)


def test_wrong_options(mission: Mission, slam_map: SlamMap, tmp_path: Path) -> None:
    path = tmp_path / "a.geojson"
    with pytest.raises(InputError, match="origin"):
        write_slam_map(path, slam_map, mission, origin=(10.0, 95.0))
    with pytest.raises(InputError, match="a file of their own"):
        write_slam_map(path, slam_map, mission, paths=path)
    assert not path.exists()


def test_spark_dsg_loads_it_back(mission: Mission, slam_map: SlamMap, tmp_path: Path) -> None:
    dsg: Any = pytest.importorskip("spark_dsg", reason="it comes with symboslam[spark-dsg]")
    path = tmp_path / "a.dsg.json"
    write_slam_map(path, slam_map, mission)
    graph = dsg.DynamicSceneGraph.load(str(path))
    objects = list(graph.get_layer(dsg.DsgLayers.OBJECTS).nodes)
    assert [node.attributes.name for node in objects] == ["t1", "t 2", "c1"]
    assert objects[1].attributes.position.tolist() == [3, 4.5, 0]
    assert [node.attributes.semantic_label for node in objects] == [0, 0, 1]
    labels = graph.get_labelspace(dsg.DsgLayers.OBJECTS)
    assert [labels.get_category(i) for i in (0, 1)] == ["Tree", "Car"]
    assert objects[2].attributes.metadata.get()["dynamic"] is True
    layer = dsg.DsgLayers.name_to_layer_id(dsg.DsgLayers.AGENTS).layer
    agents = list(graph.get_layer(layer, ord("a")).nodes)
    assert [node.attributes.position.tolist() for node in agents] == [
        [1, 1, 0],
        [2, 1, 0],
        [3, 1, 0],
    ]
    assert [node.attributes.timestamp for node in agents] == [
        timedelta(seconds=t) for t in (10, 11, 12)
    ]
    turn = agents[2].attributes.world_R_body
    assert (turn.w, turn.z) == pytest.approx((0.5**0.5, 0.5**0.5))
    assert graph.has_edge(agents[0].id.value, agents[1].id.value)
    assert len(list(graph.get_layer(layer, ord("b")).nodes)) == 1


def test_without_spark_dsg(
    mission: Mission, slam_map: SlamMap, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "spark_dsg", None)
    with pytest.raises(MissingExtraError, match=r"symboslam\[spark-dsg\]"):
        write_slam_map(tmp_path / "a.dsg.json", slam_map, mission)
