"""Every example query answers, and what it answers is what Python finds in the same maps."""

from __future__ import annotations

import re
from collections import Counter, defaultdict
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from pyproj import Geod

from symboslam import __version__, service
from symboslam.engine.environment_map import EnvironmentMap
from symboslam.errors import UnknownNameError
from symboslam.reasoning.knowledge import Knowledge
from symboslam.reasoning.vocabulary import SL
from symboslam.service.examples import ORDER, examples, get_example
from tests.service.conftest import ADMIN, TOKEN, Service, running
from tests.service.town import BASE, IN_FORCE, OVERRIDES, TAKEN_BACK, document, put, town_map

FILES = Path(next(iter(service.__path__))) / "examples"
AUDIENCES = {"operator", "analyst", "ontology engineer"}
SEGMENT = "3-11-10"
POINT = (149.1008, -35.2007)
Row = dict[str, str]


@pytest.fixture(scope="module")
def town(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Service]:
    """A service with the ontology, the town by two profiles, and overrides."""
    with running(data=tmp_path_factory.mktemp("town"), admin_token=TOKEN, workers=2) as found:
        put(found, "town", town_map(), **ADMIN)
        put(found, "town-paper", town_map("paper"), **ADMIN)
        found.update(OVERRIDES).raise_for_status()
        yield found


@pytest.fixture
def rows(town: Service, request: pytest.FixtureRequest) -> list[Row]:
    """The solutions of the example that the test's name begins with."""
    name = request.node.originalname.removeprefix("test_").partition("__")[0].replace("_", "-")
    return ask(town, name)


def ask(town: Service, name: str) -> list[Row]:
    response = town.ask(get_example(name).query)
    assert response.status_code == 200, response.text
    solutions = response.json()["results"]["bindings"]
    return [{name: term["value"] for name, term in s.items()} for s in solutions]


def segments(m: EnvironmentMap) -> dict[str, int]:
    return {str(name): i for i, name in enumerate(m.segment_id)}


def lonlat(m: EnvironmentMap) -> tuple[np.ndarray[Any, Any], np.ndarray[Any, Any]]:
    return m.landmarks.frame.from_metres(m.landmarks.x, m.landmarks.y)


def features(m: EnvironmentMap) -> list[str]:
    return [m.knowledge.features[i].name for i in m.landmarks.feature]


def short(iri: str) -> str:
    return iri.removeprefix(SL)


def test_every_file_is_listed_and_each_says_who_asks_what() -> None:
    assert {path.stem for path in FILES.glob("*.rq")} == set(ORDER)
    assert len(ORDER) == len(set(ORDER)) >= 30
    for example in examples():
        assert len(example.title) <= 80, example.name
        assert example.description.endswith(".")
        assert set(example.audience) <= AUDIENCES
        assert example.audience
        assert "NOT EXISTS" not in example.query, "takes the square of the data"
    assert len({example.title for example in examples()}) == len(ORDER)
    with pytest.raises(UnknownNameError, match="what-is-here"):
        get_example("nothing")


def test_they_are_served(town: Service) -> None:
    found = town.client.get("/v1/examples").json()
    assert [each["name"] for each in found] == list(ORDER)
    assert found[0] == {
        "name": "maps",
        "title": "Which maps are there?",
        "description": examples()[0].description,
        "audience": ["operator", "analyst"],
        "query": (FILES / "maps.rq").read_text(),
    }


@pytest.mark.parametrize("name", ORDER)
def test_each_answers_something_once(town: Service, name: str) -> None:
    """Each line once: what several graphs say must not be told several times."""
    response = town.client.get(
        "/sparql",
        params={"query": get_example(name).query},
        headers={"Accept": "text/tab-separated-values, application/n-triples"},
    )
    assert response.status_code == 200, response.text
    lines = response.text.splitlines()[0 if "triples" in response.headers["content-type"] else 1 :]
    assert lines
    assert Counter(lines).most_common(1)[0][1] == 1


def test_maps(rows: list[Row]) -> None:
    assert {row["map"] for row in rows} == {f"{BASE}town/map", f"{BASE}town-paper/map"}
    assert {(r["version"], r["landmarks"], r["made"], r["source"]) for r in rows} == {
        (__version__, str(len(town_map().landmarks)), "2026-03-02T12:00:00Z", "GeoJSON")
    }


def test_what_is_here(rows: list[Row]) -> None:
    m = town_map()
    x, y = m.landmarks.frame.to_metres(*([v] for v in POINT))
    (i,) = np.flatnonzero(shapely.contains_xy(m.geometry, x[0], y[0]))
    (row,) = rows
    assert row["segment"] == m.segment_id[i]
    assert short(row["environment"]) == m.environments[m.label[i]].name
    assert float(row["probability"]) == pytest.approx(m.probability[i].max(), abs=1e-6)


def test_why(rows: list[Row]) -> None:
    found = town_map().explain(SEGMENT)
    assert found.environment
    by_label = {r.label: r for r in found.speaking_for(found.environment)}
    assert sum(float(row["share"]) for row in rows) == pytest.approx(
        found.probabilities[found.environment], abs=1e-5
    )
    assert [row["feature"] for row in rows].count("other") == 1
    known = {f.label: f.name for f in town_map().knowledge.features}
    for row in rows:
        if row["feature"] == "other":
            continue
        reason = by_label[row["feature"]]
        assert int(row["landmarks"]) == reason.count
        assert float(row["share"]) == pytest.approx(reason.contribution["Commercial"], abs=2e-6)
        way = town_map().knowledge.find_indication(known[row["feature"]], "Commercial")
        assert way
        assert row["reason"] == way.reason


def test_second(rows: list[Row]) -> None:
    m = town_map()
    labels = {e.name: e.label for e in m.environments}
    expected = {labels[n]: p for n, p in m.explain(SEGMENT).probabilities.items()}
    assert {r["environment"]: float(r["probability"]) for r in rows} == pytest.approx(
        expected, abs=1e-6
    )
    runner_up = m.explain(SEGMENT).runner_up
    assert runner_up
    assert rows[1]["environment"] == labels[runner_up]


def test_why_not(rows: list[Row]) -> None:
    by_label = {r.label: r.contribution for r in town_map().explain(SEGMENT).reasons}
    for row in rows:
        one, two = (by_label[row["feature"]].get(e, 0.0) for e in ("Commercial", "Residential"))
        assert float(row["lead"]) == pytest.approx(one - two, abs=4e-6)
    leads = [float(row["lead"]) for row in rows]
    assert leads == sorted(leads, reverse=True)
    assert min(leads) < 0 < max(leads)


def test_uncertain(rows: list[Row]) -> None:
    m = town_map()
    expected = {
        name: m.probability[i, m.label[i]]
        for name, i in segments(m).items()
        if m.label[i] >= 0 and m.probability[i, m.label[i]] < 0.5
    }
    found = {row["segment"]: float(row["probability"]) for row in rows}
    assert found == pytest.approx(expected, abs=1e-6)
    assert list(found.values()) == sorted(found.values())


def test_unknown(rows: list[Row]) -> None:
    m = town_map()
    expected = {name for name, i in segments(m).items() if m.label[i] < 0}
    assert {row["segment"] for row in rows} == expected


def test_overridden(rows: list[Row]) -> None:
    assert rows == [
        {
            "segment": IN_FORCE, "computed": SL + "Commercial", "given": SL + "CommunityFacility",
            "operator": "Alice", "reason": "It is the town hall.", "since": "2026-03-02T12:10:00Z",
        }
    ]  # fmt: skip


def test_override_history(rows: list[Row]) -> None:
    assert [(row["segment"], row.get("until")) for row in rows] == [
        (IN_FORCE, None), (TAKEN_BACK, "2026-03-02T12:06:00Z"),
    ]  # fmt: skip


def test_in_force(rows: list[Row]) -> None:
    m = town_map()
    expected = {
        name: m.environments[m.label[i]].name for name, i in segments(m).items() if m.label[i] >= 0
    } | {IN_FORCE: "CommunityFacility"}
    assert {row["segment"]: short(row["environment"]) for row in rows} == expected
    assert [row["segment"] for row in rows if row["overridden"] == "true"] == [IN_FORCE]


def test_agents(rows: list[Row]) -> None:
    times = defaultdict(list)
    for feature in document()["features"]:
        if "agent" in feature["properties"]:
            times[feature["properties"]["agent"]].append(feature["properties"]["time"])
    assert {row["agent"]: (int(row["landmarks"]), row["first"], row["last"]) for row in rows} == {
        agent: (len(t), min(t).replace("+00:00", "Z"), max(t).replace("+00:00", "Z"))
        for agent, t in times.items()
    }


def test_seen_lately(rows: list[Row]) -> None:
    seen = [f for f in document()["features"] if f["properties"].get("agent") == "robot-1"]
    last = sorted(seen, key=lambda f: str(f["properties"]["time"]), reverse=True)[:20]
    assert [row["landmark"] for row in rows] == [f["id"] for f in last]
    assert [float(row["confidence"]) for row in rows] == [
        f["properties"]["confidence"] for f in last
    ]


def test_near(rows: list[Row]) -> None:
    """To 0.5 m: the store measures on a sphere, Python on the ellipsoid."""
    m = town_map()
    first, second = lonlat(m)
    here = np.full(len(first), POINT[0]), np.full(len(first), POINT[1])
    metres = Geod(ellps="WGS84").inv(first, second, *here)[2]
    expected = {str(m.landmarks.id[i]): metres[i] for i in np.flatnonzero(metres <= 100)}
    found = {row["landmark"]: float(row["metres"]) for row in rows}
    assert found.keys() == expected.keys()
    assert found == pytest.approx(expected, abs=0.5)
    assert list(found.values()) == sorted(found.values())


def test_for_or_against(rows: list[Row]) -> None:
    by_label = {r.label: r for r in town_map().explain(SEGMENT).reasons}
    for row in rows:
        shares = by_label[row["feature"]].contribution
        share = shares.get("Commercial", 0.0)
        assert float(row["share"]) == pytest.approx(share, abs=2e-6)
        assert float(row["lead"]) == pytest.approx(share - max(shares.values()), abs=4e-6)
    assert float(rows[-1]["lead"]) < 0 == float(rows[0]["lead"])


def inside(m: EnvironmentMap, segment: str) -> list[int]:
    geometry = m.geometry[segments(m)[segment]]
    found = shapely.contains_xy(geometry, m.landmarks.x, m.landmarks.y)
    return [int(i) for i in np.flatnonzero(found)]


@pytest.mark.parametrize("environment", ["Commercial", "Industrial"])
def test_landmarks_for(town: Service, environment: str) -> None:
    m, names = town_map(), features(town_map())
    expected = {
        str(m.landmarks.id[i])
        for i in inside(m, SEGMENT)
        if m.knowledge.find_indication(names[i], environment)
    }
    query = get_example("landmarks-for").query.replace("CommercialFeature", f"{environment}Feature")
    found = [row[0] for row in town.values(query)]
    assert set(found) == expected
    assert len(found) == len(expected) > 0


def test_doubtful_landmarks(rows: list[Row]) -> None:
    lowest = sorted(town_map().landmarks.confidence)[:20]
    assert [float(row["confidence"]) for row in rows] == pytest.approx(lowest)


def test_area_shares(rows: list[Row]) -> None:
    m = town_map()
    hectares: Counter[str] = Counter()
    for i, polygon in enumerate(m.geometry):
        name = m.environments[m.label[i]].name if m.label[i] >= 0 else "unknown"
        hectares[name] += polygon.area / 10_000
    found = {row["environment"]: float(row["hectares"]) for row in rows}
    assert found == pytest.approx(dict(hectares), rel=0.005, abs=0.1)
    total = hectares.total()
    assert {row["environment"]: float(row["percent"]) for row in rows} == pytest.approx(
        {name: 100 * area / total for name, area in hectares.items()}, abs=0.2
    )


def test_segments_of(rows: list[Row]) -> None:
    m = town_map()
    expected = [
        n for n, i in segments(m).items() if m.label[i] >= 0
        and m.environments[m.label[i]].name == "Industrial"
    ]  # fmt: skip
    assert [row["segment"] for row in rows] == sorted(expected)
    first, i = rows[0], segments(m)[rows[0]["segment"]]
    assert float(first["probability"]) == pytest.approx(m.probability[i].max(), abs=1e-6)
    polygon = shapely.from_wkt(first["outline"].partition("> ")[2])
    x, y = m.landmarks.frame.to_metres(*np.array(polygon.exterior.coords).T)
    assert shapely.Polygon(np.column_stack([x, y])).symmetric_difference(m.geometry[i]).area < 50


def test_landmarks_of_class(rows: list[Row]) -> None:
    m, names = town_map(), features(town_map())
    kinds = {f.name for f in m.knowledge.features if "Building" in (f.name, *f.kinds)}
    expected = {str(m.landmarks.id[i]) for i in inside(m, SEGMENT) if names[i] in kinds}
    assert {row["landmark"] for row in rows} == expected
    assert len(rows) == len(expected) > 1


def test_landmark_classes(rows: list[Row]) -> None:
    labels = {f.name: f.label for f in town_map().knowledge.features}
    expected = Counter(labels[name] for name in features(town_map()))
    assert {row["feature"]: int(row["landmarks"]) for row in rows} == expected


def test_distributions(rows: list[Row]) -> None:
    m = town_map()
    sums: Counter[str] = Counter()
    for row in rows:
        sums[row["segment"]] += round(float(row["probability"]) * 1e6)
    assert sums == {n: 1_000_000 for n, i in segments(m).items() if m.label[i] >= 0}
    assert len(rows) == len(sums) * len(m.environments)


def test_provenance(rows: list[Row]) -> None:
    (row,) = rows
    assert row["software"] == "SymboSLAM"
    assert row["version"] == __version__
    assert row["sha256"] == Knowledge.load().source_hash
    assert row["rights"] == document()["attribution"]
    assert row["made"] == "2026-03-02T12:00:00Z"


def test_settings(rows: list[Row]) -> None:
    config = {name: value for name, value in town_map().config.items() if value is not None}
    assert {row["setting"] for row in rows} == set(config)
    found = {row["setting"]: row["value"] for row in rows}
    assert found["profile"] == "default"
    assert float(found["threshold"]) == config["threshold"]


def test_left_out(rows: list[Row]) -> None:
    assert rows == [{"cause": "not in the ontology", "what": "FlyingSaucer", "landmarks": "2"}]


def test_compare(rows: list[Row]) -> None:
    maps = (town_map(), town_map("paper"))
    one, two = (
        {n: m.environments[m.label[i]].name for n, i in segments(m).items() if m.label[i] >= 0}
        for m in maps
    )
    assert {row["segment"]: (short(row["one"]), short(row["two"])) for row in rows} == {
        name: (one[name], two[name]) for name in one.keys() & two.keys() if one[name] != two[name]
    }


def test_compare_settings(rows: list[Row]) -> None:
    one, two = town_map().config, town_map("paper").config
    expected = {n for n in one.keys() | two.keys() if one.get(n) != two.get(n)}
    assert {row["setting"] for row in rows} == expected
    (profile,) = (row for row in rows if row["setting"] == "profile")
    assert (profile["one"], profile["two"]) == ("default", "paper")


def test_segment_as_graph(town: Service) -> None:
    response = town.client.get(
        "/sparql",
        params={"query": get_example("segment-as-graph").query},
        headers={"Accept": "application/n-triples"},
    )
    m = town_map()
    count = Counter(re.findall(rf"type> <{re.escape(SL)}(\w+)>", response.text))
    assert count["Segment"] == count["SegmentClassification"] == 1
    assert count["EnvironmentDistribution"] == 1
    assert count["EnvironmentProbability"] == len(m.environments)
    assert count["Contribution"] > 8
    assert f"<{BASE}town/segment/{SEGMENT}>" in response.text
    assert "wktLiteral" in response.text


def test_feature(rows: list[Row]) -> None:
    known = Knowledge.load()
    assert known.zones is not None
    ways = [*known.indications_of("House"), *known.zones.indications_of("House")]
    assert {way.environment for way in ways} >= {"Residential", "RZ1", "RZ2", "RZ3"}
    found = [(short(r["place"]), float(r["strength"]), r["reason"], r["source"]) for r in rows]
    stated = [(w.environment, w.strength, w.reason, w.source) for w in ways if not w.steps]
    assert sorted(found) == sorted(stated)


def test_environment(rows: list[Row]) -> None:
    known = Knowledge.load()
    direct = {
        f.name: i.strength
        for f in known.features
        if (i := known.find_indication(f.name, "Industrial")) and i.path == (f.name, "Industrial")
    }
    assert direct
    found = {short(row["feature"]): float(row["strength"]) for row in rows}
    assert {name: found[name] for name in direct} == direct
    assert all(row["reason"] and row["source"] for row in rows)


def test_no_indication(rows: list[Row]) -> None:
    known = Knowledge.load()
    found = {short(row["feature"]) for row in rows}
    telling = {f.name for f in known.features if known.indications_of(f.name)}
    assert not found & telling
    assert {f.name for f in known.features} - telling <= found


def test_inferred(rows: list[Row]) -> None:
    above = {short(row["above"]): row["from"] for row in rows}
    assert above["Dwelling"] == "stated"
    assert above["ResidentialFeature"] == above["Building"] == above["Feature"] == "inferred"
    assert set(Knowledge.load().get_feature("House").kinds) <= set(above)


def test_zones(rows: list[Row]) -> None:
    (residential,) = (e for e in Knowledge.load().environments if e.name == "Residential")
    zones = {short(row["kind"]): row for row in rows if row.get("zone") == "true"}
    assert set(zones) == {zone.name for zone in residential.zones}
    assert len(rows) > len(zones)


def test_osm_tags(rows: list[Row]) -> None:
    house = Knowledge.load().get_feature("House")
    assert sorted(row["tag"] for row in rows) == sorted(house.osm_tags)
    assert {row["detector"] for row in rows} == {house.detector_label}


def test_tag(rows: list[Row]) -> None:
    known = Knowledge.load()
    position = known.match_tags({"building": "barn"})
    assert position is not None
    barn = known.features[position]
    assert [(r["feature"], r["label"], r["definition"]) for r in rows] == [
        (barn.iri, barn.label, barn.definition)
    ]


def test_sources(rows: list[Row]) -> None:
    assert sum(int(row["indications"]) for row in rows) > 600
    assert {i.source for i in Knowledge.load().indications} == {row["source"] for row in rows}
