"""Evaluations of whole files: by hand, the benchmark's scorer, formats, and what is refused."""

from __future__ import annotations

import gzip
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely

from symboslam import Knowledge, SymboSlamError, classify, read_landmarks, write_map
from symboslam.engine.evaluation import Evaluation, Pair, evaluate, evaluate_pairs
from symboslam.engine.evaluation.evaluation import PLAN_ORDER
from symboslam.engine.sample import sample_area


def test_the_small_town(town: Any) -> None:
    got = evaluate(*town, cells=4)
    assert (got.result.cells, got.result.coverage) == (12, 10 / 12)
    scores = got.result.all
    # Of the four Commercial cells one is found, one is Residential in the map, two are unknown.
    assert scores.accuracy == 9 / 12
    assert scores.kappa == pytest.approx((9 / 12 - 40 / 144) / (1 - 40 / 144))
    r, c, n = (scores.classes[k] for k in ("Residential", "Commercial", "NonUrban"))
    assert (r.support, r.predicted, r.precision, r.recall) == (4, 5, 4 / 5, 1.0)
    assert (c.support, c.predicted, c.f1, c.iou) == (4, 1, 2 / 5, 1 / 4)
    assert (n.f1, n.iou, n.ap) == (1.0, 1.0, 1.0)
    # Commercial, ranked: 0.7 (right), then five times 0.4, one of them right; unknown never.
    assert c.ap == pytest.approx(1 / 4 + 1 / 4 * 2 / 6)
    # Residential: five times 0.6, four of them right; 0.3 once, wrong.
    assert r.ap == pytest.approx(4 / 5)
    assert scores.macro_f1 == pytest.approx((8 / 9 + 2 / 5 + 1) / 3)
    assert scores.mean_iou == pytest.approx((4 / 5 + 1 / 4 + 1) / 3)
    assert got.result.labelled is not None
    assert got.result.labelled.accuracy == 9 / 10


def test_confusion_matrix_of_the_small_town(town: Any) -> None:
    table = evaluate(*town, cells=4).as_dict()["all"]["confusion"]
    assert table["truth"] == ["Residential", "Commercial", "NonUrban"]
    assert table["map"] == [*table["truth"], "unknown"]
    assert table["cells"] == [[4, 0, 0, 0], [1, 1, 0, 2], [0, 0, 4, 0]]


def same(ours: Any, theirs: Any) -> None:
    """All that the benchmark's scorer says, to 1e-9."""
    assert ours["cells"] == theirs["cells"]
    assert ours["coverage"] == pytest.approx(theirs["coverage"], abs=1e-9)
    for mode in ("all", "labelled"):
        mine, other = ours[mode], theirs[mode]
        assert (mine is None) == (other is None)
        if other is None:
            continue
        for metric in ("accuracy", "kappa", "macro_f1", "mean_iou", "map"):
            assert mine[metric] == pytest.approx(other[metric], abs=1e-9), (mode, metric)
        present = {n: c for n, c in mine["classes"].items() if c["support"]}
        assert set(present) == set(other["classes"])
        for name, c in other["classes"].items():
            found = present[name]
            assert (found["support"], found["predicted"]) == (c["cells"], c["predicted"])
            for metric in ("iou", "f1", "ap"):
                assert found[metric] == pytest.approx(c[metric], abs=1e-9), (mode, name, metric)


@pytest.mark.proof
def test_same_as_the_benchmark_on_all_of_its_areas(
    benchmark: Any, tmp_path: Path, knowledge: Knowledge
) -> None:
    """Grid maps of every area, and the cells of all areas together."""
    scorer, areas, common = benchmark
    predictions, chosen = {}, areas.load("dev")
    pairs: dict[str, list[Pair]] = {"osm": [], "sim": []}
    assert len(chosen) >= 14
    for area in chosen:
        found = classify(read_landmarks(area["input"], knowledge), knowledge)
        path = tmp_path / f"{area['name']}.geojson"
        write_map(found, path, reasons=0)
        document = common.read_json(path)
        theirs = scorer.predicted_cells(document, area["bbox"], area["cells"])
        got = evaluate(area["truth_file"], document, cells=area["cells"], knowledge=knowledge)
        assert got.pairs[0].truth.tolist() == area["truth"].tolist()
        assert got.pairs[0].label.tolist() == theirs[0].tolist()
        np.testing.assert_allclose(got.pairs[0].probability, theirs[1], atol=2e-9)
        same(got.as_dict(), scorer.evaluate(area["truth"], *theirs))
        predictions[area["name"]] = theirs
        pairs[area["kind"]] += got.pairs
    for kind, expected in areas.pooled(chosen, predictions).items():
        same(Evaluation(got.environments, tuple(pairs[kind])).as_dict(), expected)


@pytest.mark.parametrize("seed", range(4))
def test_same_as_the_benchmark_where_polygons_overlap_and_leave_gaps(
    benchmark: Any, collection: Any, seed: int
) -> None:
    scorer = benchmark[0]
    rng = np.random.default_rng(seed)

    def polygons(count: int, *, probable: bool) -> list[Any]:
        found = []
        for i in range(count):
            centre, radius = rng.random(2) * 1000, 30 + rng.random() * 250
            angles = np.sort(rng.random(5 + i % 4)) * 2 * np.pi
            if i % 5 == 0:
                rng.shuffle(angles)  # most of these cross themselves
            ring = centre + radius * np.column_stack([np.cos(angles), np.sin(angles)])
            shape = shapely.Polygon(ring.tolist())
            name = PLAN_ORDER[rng.integers(len(PLAN_ORDER))]
            properties: dict[str, Any] = {"environment": name}
            if probable and i % 3:
                p = rng.dirichlet(np.ones(8)).round(4)
                properties["probabilities"] = dict(zip(PLAN_ORDER, p.tolist(), strict=True))
            if probable and i % 7 == 0:
                properties["environment"] = None
            geometry = json.loads(shapely.to_geojson(shape))
            found.append({"type": "Feature", "geometry": geometry, "properties": properties})
        return found

    box = [0, 0, 1000, 1000]
    truth = collection(*polygons(40, probable=False), bbox=box)
    found = collection(*polygons(60, probable=True), bbox=box)
    got = evaluate(truth, found, cells=20)
    cells = scorer.truth_cells(truth, box, 20)
    label, probability = scorer.predicted_cells(found, box, 20)
    assert got.pairs[0].label.tolist() == label.tolist()
    assert 0 < (label < 0).sum() < 400
    assert any("repaired" in note for note in got.notes)
    same(got.as_dict(), scorer.evaluate(cells, label, probability))


@pytest.fixture(scope="module")
def knowledge() -> Knowledge:
    return Knowledge.load()


def test_every_form_of_a_map_gives_the_same(tmp_path: Path, knowledge: Knowledge) -> None:
    area = sample_area(seed=3)
    area["features"] = area["features"][::20]
    found = classify(read_landmarks(area, knowledge), knowledge, cells=12)
    truth = tmp_path / "truth.geojson"
    write_map(classify(read_landmarks(area, knowledge), knowledge, cells=24), truth)
    reports = []
    for name in ("map.geojson", "map.ttl", "map.nq"):
        write_map(found, tmp_path / name, reasons=0)
        reports.append(evaluate(truth, tmp_path / name, knowledge=knowledge))
    packed = tmp_path / "map.geojson.gz"
    packed.write_bytes(gzip.compress((tmp_path / "map.geojson").read_bytes()))
    reports += [evaluate(truth, packed), evaluate(truth, found)]
    assert reports[0].pairs[0].cells == 12
    assert reports[0].result.all.accuracy > 0.5
    for report in reports[1:]:
        assert report.pairs[0].cells == 12
        assert report.pairs[0].label.tolist() == reports[0].pairs[0].label.tolist()
        np.testing.assert_allclose(
            report.pairs[0].probability, reports[0].pairs[0].probability, atol=1e-6
        )


def test_a_map_is_a_perfect_map_of_itself(tmp_path: Path, knowledge: Knowledge) -> None:
    found = classify(read_landmarks(sample_area(seed=3), knowledge), knowledge, cells=12)
    write_map(found, tmp_path / "map.geojson", reasons=0)
    got = evaluate(tmp_path / "map.geojson", tmp_path / "map.geojson")
    assert (got.result.all.accuracy, got.result.all.mean_iou) == (1.0, 1.0)


def test_the_plan_order_names_our_environments(knowledge: Knowledge) -> None:
    assert {e.name for e in knowledge.environments} == set(PLAN_ORDER)


def test_ties_go_to_the_first_of_the_plan(square: Any, collection: Any) -> None:
    points = [
        {"type": "Feature", "geometry": {"type": "Point", "coordinates": [5, 5]},
         "properties": {"environment": name}}
        for name in ("NonUrban", "Commercial", "Residential")
    ]  # fmt: skip
    found = collection(square(0, 0, 10, 10, "Residential"), bbox=[0, 0, 10, 10])
    assert evaluate(collection(*points), found, cells=1).result.all.accuracy == 1.0


def test_pairs_are_pooled(town: Any, square: Any, collection: Any) -> None:
    truth = collection(square(0, 0, 20, 20, "Industrial"), bbox=[0, 0, 20, 20])
    found = collection(square(0, 0, 20, 20, "Commercial"))
    got = evaluate_pairs([town, (truth, found)], cells=4)
    assert (got.result.cells, got.result.all.accuracy) == (28, 9 / 28)
    assert [p.result.cells for p in got.pairs] == [12, 16]
    assert got.result.all.classes["Commercial"].predicted == 17


def test_environments_that_a_map_describes_are_known(square: Any, collection: Any) -> None:
    about = {"environments": {"Kitchen": {"label": "kitchen", "colour": "#ff0000"}}}
    truth = collection(square(0, 0, 10, 10, "Kitchen"), bbox=[0, 0, 10, 10])
    found = collection(square(0, 0, 10, 10, "Kitchen"), symboslam=about)
    got = evaluate(truth, found, cells=2)
    assert got.result.all.accuracy == 1.0
    assert got.environments[-1].colour == "#ff0000"
    bad = collection(
        square(0, 0, 10, 10, "Kitchen"),
        symboslam={"environments": {"Kitchen": {"colour": '"/><script>'}}},
    )
    assert evaluate(truth, bad, cells=2).environments[-1].colour == "#888888"


def test_notes(square: Any, collection: Any) -> None:
    truth = collection(
        square(0, 0, 10, 10, "Military"),
        {"type": "Feature", "geometry": None, "properties": {"environment": "Military"}},
        bbox=[0, 0, 10, 10],
    )
    found = collection(
        square(0, 0, 10, 10, "Commercial", probabilities={"Commercial": 0.5, "Moon": 0.2}),
        symboslam={"environments": {"Commercial": {}}},
    )
    notes = " ".join(evaluate(truth, found, cells=1).notes)
    assert "1 features without a polygon were left out" in notes
    assert "do not sum to 1" in notes
    assert "'Moon'" in notes
    assert "its scheme lacks Military" in notes


def test_an_empty_map_is_a_map_that_knows_nothing(town: Any, collection: Any) -> None:
    got = evaluate(town[0], collection(), cells=4)
    assert (got.result.coverage, got.result.all.accuracy, got.result.labelled) == (0, 0, None)
    assert "no polygon" in got.notes[0]


RING = [[[0, 0], [0, 1], [1, 1], [0, 0]]]


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"features": []}, ["no polygon or point"]),
        ({"features": 3}, ["FeatureCollection"]),
        ({"features": [3]}, ["feature 0", "no GeoJSON feature"]),
        ({"crs_units": None}, ["OGC:CRS84", "local metres"]),
        ({"crs_units": "ft"}, ["crs_units"]),
        ({"crs_units": None, "crs": {"properties": {"name": "EPSG:28355"}}}, ["EPSG:28355"]),
        ({"bbox": [0, 0, 0, 40]}, ["bbox", "no area"]),
        ({"bbox": [500, 500, 600, 600]}, ["no cell of the area"]),
    ],
)
def test_a_truth_that_cannot_be(town: Any, change: Any, words: list[str]) -> None:
    refused({**town[0], **change}, town[1], *words)


@pytest.mark.parametrize(
    ("properties", "geometry", "words"),
    [
        ({"environment": "Residental"}, None, ["'Residental'", "Residential", "1 features"]),
        ({"environment": 3}, None, ["environment is 3"]),
        ({"kind": "x"}, None, ["no feature has a property `environment`"]),
        ({"probabilities": {"Commercial": "high"}}, None, ["'high'", "not a number"]),
        ({"probabilities": {"Commercial": None}}, None, ["None"]),
        ({"probabilities": {"Commercial": -0.1}}, None, ["-0.1"]),
        ({"probabilities": {"Commercial": float("nan")}}, None, ["nan"]),
        ({"probabilities": {"Commercial": 10**400}}, None, ["not a number from 0 on"]),
        ({"probabilities": [0.5, 0.5]}, None, ["no object"]),
        ({}, {"type": "Polygon", "coordinates": [[[0, 0]]]}, ["geometry, 'Polygon'"]),
        ({}, {"type": "Polygon", "coordinates": "here"}, ["geometry, 'Polygon'"]),
        ({}, {"type": "Blob"}, ["geometry, 'Blob'"]),
        ({}, "here", ["geometry"]),
        ({}, {"type": "Polygon", "coordinates": [[[0, 0], [0, 1e999], [1, 1], [0, 0]]]},
         ["feature 0", "not finite"]),
        ({}, {"type": "Polygon", "coordinates": [[[900, 900], [900, 901], [901, 901], [900, 900]]]},
         ["lies elsewhere"]),
    ],
)  # fmt: skip
def test_a_map_that_cannot_be(
    town: Any, collection: Any, properties: Any, geometry: Any, words: list[str]
) -> None:
    whole = properties if "kind" in properties else {"environment": "Commercial", **properties}
    shape = geometry or {"type": "Polygon", "coordinates": RING}
    feature = {"type": "Feature", "geometry": shape, "properties": whole}
    refused(town[0], collection(feature), *words)


def test_degrees_that_are_metres(town: Any) -> None:
    truth, found = ({**document, "crs_units": None} for document in town)
    truth["features"] = [point(7e5, 6e6)]
    refused(truth, found, "out of range", "crs_units")


def test_points_beside_polygons(town: Any) -> None:
    refused({**town[0], "features": [*town[0]["features"], point(5, 5)]}, town[1], "points and pol")


def test_same_system_by_another_name(town: Any) -> None:
    truth, found = ({**document, "crs_units": None} for document in town)
    truth["crs"] = {"properties": {"name": "urn:ogc:def:crs:EPSG::28355"}}
    found["crs"] = {"properties": {"name": "EPSG:28355"}}
    assert evaluate(truth, found, cells=4).result.cells == 12


@pytest.mark.parametrize("cells", [0, -1, 5000])
def test_cells_that_cannot_be(town: Any, cells: int) -> None:
    with pytest.raises(SymboSlamError, match="cells is"):
        evaluate(*town, cells=cells)


def test_no_pairs() -> None:
    with pytest.raises(SymboSlamError, match="no pair"):
        evaluate_pairs([])


def test_bbox_and_cells_of_the_caller_win(town: Any) -> None:
    got = evaluate(*town, bbox=(0, 20, 20, 40), cells=2)
    assert (got.pairs[0].bbox, got.result.cells) == ((0.0, 20.0, 20.0, 40.0), 4)
    assert got.result.all.accuracy == 1.0


def test_the_area_is_the_truths_else_the_maps_else_the_extent(town: Any) -> None:
    truth, found = town
    bare = {k: v for k, v in truth.items() if k != "bbox"}
    assert evaluate(bare, {**found, "bbox": [0, 0, 20, 40]}).pairs[0].bbox == (0, 0, 20, 40)
    assert evaluate(bare, found).pairs[0].bbox == (0, 10, 40, 40)
    assert evaluate(truth, {**found, "bbox": [0, 0, 20, 40]}).pairs[0].bbox == (0, 0, 40, 40)


def point(x: float, y: float) -> Any:
    return {
        "type": "Feature",
        "geometry": {"type": "Point", "coordinates": [x, y]},
        "properties": {"environment": "Commercial"},
    }


def refused(truth: Any, found: Any, *words: str) -> None:
    with pytest.raises(SymboSlamError) as caught:
        evaluate(truth, found, cells=4)
    assert caught.value.exit_code == 2
    message = str(caught.value)
    assert "\n" not in message
    for word in words:
        assert word in message
