"""Truth and landmarks of worlds: what evaluate and classify read; GeoJSON as worlds."""

import json
import re
from pathlib import Path
from typing import Any

import pytest

from symboslam.engine.evaluation.places import read_places
from symboslam.engine.readers import read_landmarks
from symboslam.reasoning.knowledge import Knowledge
from symboslam.sim_bridge.worlds.formats import read_any
from symboslam.sim_bridge.worlds.generator import world_by_name
from symboslam.sim_bridge.worlds.geojson_world import read_geojson_world
from symboslam.sim_bridge.worlds.picture import draw_world
from symboslam.sim_bridge.worlds.truth import landmarks_geojson, write_geojson, zones_geojson
from symboslam.sim_bridge.worlds.world import Extent, Road, Start, World

ROOT = Path(__file__).parents[3]
BENCHMARK = ROOT.parent / "shared/benchmark/dev"


def test_zones_are_a_truth(tmp_path: Path) -> None:
    world = world_by_name("city")
    write_geojson(zones_geojson(world), tmp_path / "zones.geojson")
    places = read_places(tmp_path / "zones.geojson", points=True)
    assert not places.points
    assert places.notes == ()
    assert places.bbox == (0.0, 0.0, 1350.0, 1350.0)
    assert list(places.environment) == [z.environment for z in world.zones]
    assert places.area.sum() == pytest.approx(1.8225e6, abs=len(world.zones))


def test_objects_are_landmarks(tmp_path: Path) -> None:
    world = world_by_name("demo")
    write_geojson(landmarks_geojson(world), tmp_path / "landmarks.geojson")
    knowledge = Knowledge.load()
    read = read_landmarks(tmp_path / "landmarks.geojson", knowledge)
    assert len(read) == len(world.objects)
    assert not read.report.unknown
    assert [knowledge.features[i].detector_label for i in read.feature] == [
        o.kind for o in world.objects
    ]


def test_geojson_round_trip(tmp_path: Path) -> None:
    world = world_by_name("demo")
    write_geojson(zones_geojson(world), tmp_path / "zones.geojson")
    write_geojson(landmarks_geojson(world), tmp_path / "landmarks.geojson")
    read, notes = read_any(tmp_path / "landmarks.geojson")
    assert [(o.id, o.kind, o.x, o.y) for o in read.objects] == [
        (o.id, o.kind, o.x, o.y) for o in world.objects
    ]
    assert read.extent == world.extent
    assert read.zone_areas_km2() == pytest.approx(world.zone_areas_km2(), abs=1e-5)
    assert len(read.starts) == 10
    assert not [note for note in notes if not re.search("start|overlap|zones of", note)]


def collection(*features: tuple[float, float, dict[str, Any]], **members: Any) -> str:
    """The text of a collection of points."""
    return json.dumps(
        {
            "type": "FeatureCollection",
            "crs_units": "m",
            "features": [
                {
                    "type": "Feature",
                    "geometry": {"type": "Point", "coordinates": [x, y]},
                    "properties": properties,
                }
                for x, y, properties in features
            ],
            **members,
        }
    )


def test_labelled_points_become_zones(tmp_path: Path) -> None:
    points = [(100, 500, "Residential"), (120, 520, "Residential"), (800, 500, "Industrial")]
    (tmp_path / "landmarks.geojson").write_text(
        collection(
            *((x, y, {"class": "Tree"}) for x, y, _ in points),
            (500, 900, {"tags": {"amenity": "restaurant"}}),
            bbox=[0, 0, 1000, 1000],
        )
    )
    (tmp_path / "truth_points.geojson").write_text(
        collection(*((x, y, {"environment": e}) for x, y, e in points))
    )
    world, notes = read_geojson_world(tmp_path / "landmarks.geojson")
    assert world.environments_at(world.positions) == ("Residential", "Residential", "Industrial")
    assert len(world.zones) == 2
    assert "1 features of which a robot sees nothing were left out" in notes
    assert "zones are the ground nearest to 3 labelled points" in notes


def test_landmarks_alone_have_no_truth(tmp_path: Path) -> None:
    path = tmp_path / "seen.geojson"
    path.write_text(collection((1, 1, {"class": "Tree"}), (9, 9, {"class": "House"})))
    world, notes = read_any(path)
    assert world.zones == ()
    assert world.name == "seen"
    assert "no zones beside it: the world has no truth" in notes


@pytest.mark.parametrize("area", ["city", "airport", "vaduz"])
def test_converted_areas(area: str) -> None:
    path = BENCHMARK / area / "landmarks.geojson"
    if not path.exists():
        pytest.skip(f"needs the benchmark's areas: {BENCHMARK}")
    world, _ = read_any(path)
    assert len(world.objects) > 150
    assert len(world.zones) > 3
    document = json.loads(path.read_text())
    if document.get("crs_units") == "m":
        assert len(world.objects) == len(document["features"])


@pytest.mark.parametrize(
    "world",
    [
        world_by_name("demo"),
        World("empty $x$", Extent(-5, -5, 5, 30)),
        World("wide", Extent(0, 0, 900, 100), roads=(Road(((0, 50), (900, 50))),),
              starts=(Start(1, 50),)),
    ],
    ids=lambda w: w.name.split()[0],
)  # fmt: skip
def test_picture(world: World, tmp_path: Path) -> None:
    draw_world(world, tmp_path / "w.png")
    assert (tmp_path / "w.png").read_bytes().startswith(b"\x89PNG")
