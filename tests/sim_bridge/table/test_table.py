"""``symboslam sim table``: figures by hand, pages of a record, missions end to end."""

from __future__ import annotations

import importlib.util
import json
import math
import multiprocessing
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from typer.testing import CliRunner

from symboslam.cli.main import app
from symboslam.engine.slam.log import Measurements, Mission, Odometry, RobotLog, Truth
from symboslam.engine.slam.slam_map import MappedLandmarks, SlamMap, Trajectory
from symboslam.errors import InputError, OutputError, SymboSlamError
from symboslam.reasoning.knowledge import Knowledge
from symboslam.sim_bridge.table.along import errors_along, first_seen
from symboslam.sim_bridge.table.area_run import is_finished
from symboslam.sim_bridge.table.figures import from_true_landmarks, pooled, verdicts, wall_minutes
from symboslam.sim_bridge.table.finished import Finished, finished_in
from symboslam.sim_bridge.table.page import MARKS, around, write_page
from symboslam.sim_bridge.table.plan import MANY, REACH, SPEED, Plan, plans
from symboslam.sim_bridge.table.tables import mas_table

ROOT = Path(__file__).parents[3]


@pytest.fixture(scope="module")
def knowledge() -> Knowledge:
    return Knowledge.load()


# ---- errors along a mission


def mission_and_map() -> tuple[Mission, SlamMap]:
    """A robot that drives east at 1 m/s for 20 s; its map is 1 m off to the north, then 3 m."""
    time = np.array([0.0, 10.0, 20.0])
    truth = np.column_stack([time, time, np.zeros(3), np.zeros(3)])
    seen = Measurements(
        np.array([0.0, 10.0, 20.0]), np.ones(3), np.zeros(3), np.zeros(3, np.int64), np.ones(3),
        np.full(3, "", object), 1.0, 0.1,
    )  # fmt: skip
    log = RobotLog("r", Odometry(time, truth[:, 1:]), seen, (0.0, 0.0, 0.0))
    mission = Mission(
        (log,), ("Tree",), np.zeros(1, bool), np.eye(1),
        {"r": np.array(["a", "a", "b"], object)},
        Truth({"a": (5.0, 0.0), "b": (9.0, 0.0)}, {"r": truth}, {"a": "Tree", "b": "Tree"}),
    )  # fmt: skip
    pose = np.column_stack([time, [1.0, 1.0, 3.0], np.zeros(3)])
    landmarks = MappedLandmarks(
        np.array(["L1", "L2"], object), np.array([[5.0, 2.0], [9.0, 6.0]]),
        np.full((2, 2, 2), np.nan), np.zeros(2, np.int64), np.ones(2), np.array([2, 1]),
        np.zeros(2, bool), np.full(2, "", object),
    )  # fmt: skip
    of = {"r": np.array([0, 0, 1])}
    return mission, SlamMap({"r": Trajectory(time, pose)}, landmarks, of)


def test_errors_along_a_mission() -> None:
    mission, slam_map = mission_and_map()
    beliefs = {"r": [(0.0, 0.0, 0.0), (20.0, 20.0, 4.0)]}
    rows = errors_along(slam_map, mission, beliefs, step=10.0)
    # By hand: the belief is off by 0, 2, 4 m; the map by 1, 1, 3; L1 by 2, L2 by 6, seen at 20 s.
    assert rows.tolist() == [[0, 0, 1, 2], [10, 2, 1, 2], [20, 4, 3, 4]]
    assert first_seen(slam_map, mission).tolist() == [0.0, 20.0]


def test_errors_along_a_mission_in_which_the_map_lost_the_robot() -> None:
    mission, slam_map = mission_and_map()
    nothing = SlamMap({}, slam_map.landmarks, {"r": np.array([-1, -1, -1])})
    rows = errors_along(nothing, mission, {"r": []}, step=10.0)
    assert np.isnan(rows[:, 1:]).all()
    assert np.isinf(first_seen(nothing, mission)).all()


# ---- figures


def square(environment: str | None, west: float, east: float) -> dict[str, Any]:
    ring = [[west, 0.0], [east, 0.0], [east, 240.0], [west, 240.0], [west, 0.0]]
    return {
        "type": "Feature",
        "geometry": {"type": "Polygon", "coordinates": [ring]},
        "properties": {"environment": environment},
    }


def recorded(folder: Path, name: str, zones: list[Any], found: list[Any], **more: Any) -> Finished:
    """A finished mission that nobody flew, of 240 m x 240 m."""
    here = folder / name
    (here / "record").mkdir(parents=True)
    head = {"type": "FeatureCollection", "crs_units": "m", "bbox": [0, 0, 240, 240]}
    (here / "record" / "zones.geojson").write_text(json.dumps(head | {"features": zones}))
    for segmentation in ("grid", "branch"):
        text = json.dumps(head | {"features": found})
        (here / f"{segmentation}.geojson").write_text(text)
    world = {
        "format": "symboslam-world", "version": 1, "name": name, "extent": [0, 0, 240, 240],
        "zones": [
            {"environment": z["properties"]["environment"],
             "polygon": z["geometry"]["coordinates"]} for z in zones
        ],
        "objects": [], "starts": [{"x": 1, "y": 1, "heading": 0}],
    }  # fmt: skip
    (here / "record" / "world.json").write_text(json.dumps(world))
    coverage = (
        "time,coverage,formula,found,dispersion\n0,0.1,0,0,9\n60,0.5,0.4,1,9\n120,0.9,0.8,2,9\n"
    )
    (here / "record" / "coverage.csv").write_text(coverage)
    plan = {"name": name, "world": name, "minutes": 14.6, "mapped": True, "robots": 3, "speed": 15,
            "reach": 80, "search": "frontier", "slam": "ours", "seed": 0,
            "world_seed": 7}  # fmt: skip
    metrics = {
        "area_km2": 0.0576, "robots": 3, "time_s": 120.0, "wall_s": 10.0, "processor_s": 8.0,
        "real_time_factor": 12.0, "coverage": 0.9, "coverage_formula": 0.8, "dispersion_m": 9.0,
        "dispersion_normalised": 0.03, "objects": 2, "objects_found": 2, "time_all_found_s": 90.0,
        "ended": "time", "notes": [],
        "run": {"plan": plan, "begun": 0.0, "ended": 60.0, "peak_mb": 500.0, "load": 1.0,
                "processors": 2, "machine": "test"},
    } | more  # fmt: skip
    (here / "metrics.json").write_text(json.dumps(metrics))
    return Finished(here, metrics)


def test_figures_over_all_areas_are_over_their_cells(tmp_path: Path, knowledge: Knowledge) -> None:
    homes = recorded(
        tmp_path, "kingston", [square("Residential", 0, 240)],
        [square("Residential", 0, 120), square("Commercial", 120, 240)],
    )  # fmt: skip
    shops = recorded(
        tmp_path, "city", [square("Commercial", 0, 240)],
        [square("Commercial", 0, 120), square(None, 120, 240)],
    )  # fmt: skip
    result = pooled([homes, shops], "grid", knowledge)
    assert result is not None
    # By hand, 576 cells each. Residential: 288 right of 576 true, 288 said. Commercial: 288 right
    # of 576 true, 576 said, so 288 / 864. Unknown counts as wrong.
    assert result.cells == 1152
    assert result.all.mean_iou == pytest.approx((1 / 2 + 1 / 3) / 2)
    assert result.all.mean_ap == pytest.approx((1 / 2 + 1 / 2 * 1 / 2) / 2)
    assert result.all.accuracy == 0.5


def test_an_area_without_a_map_is_unknown_everywhere(tmp_path: Path, knowledge: Knowledge) -> None:
    homes = [square("Residential", 0, 240)]
    good = recorded(tmp_path, "kingston", homes, homes)
    none = recorded(tmp_path, "city", homes, [])
    result = pooled([good, none], "branch", knowledge)
    assert result is not None
    assert (result.all.mean_iou, result.all.mean_ap) == (0.5, 0.5)


def test_verdicts(tmp_path: Path) -> None:
    slam = {"landmark_mean_m": 5.0}
    kingston = recorded(tmp_path, "kingston", [], [], slam=slam)
    city = recorded(tmp_path, "city", [], [], slam={"landmark_mean_m": 4.9}, real_time_factor=9.9)
    told = {v.target: v for v in verdicts([kingston, city], {})}
    assert told["mean landmark error, kingston"].met is False  # below 5 m is asked, not 5 m
    assert told["mean landmark error, city"].met is True
    assert told["mean landmark error, train-depot"].met is None
    assert told["coverage in 14.6 min, kingston"].met is True
    assert told["coverage in 40 min, city"].met is False
    assert told["City, 3 robots: simulated over real time"].text == "**missed**"
    assert told["City, 10 robots: simulated over real time"].text == "not measured"
    assert told["IoU of all six areas together, grid"].met is None  # two areas are not six


def test_wall_time_counts_missions_side_by_side_once(tmp_path: Path) -> None:
    first = recorded(tmp_path, "a", [], [])
    second, later = recorded(tmp_path, "b", [], []), recorded(tmp_path, "c", [], [])
    second.run.update(begun=30.0, ended=90.0)
    later.run.update(begun=1000.0, ended=1030.0)
    assert wall_minutes([later, first, second]) == 2.0


def test_coverage_at_a_time(tmp_path: Path) -> None:
    one = recorded(tmp_path, "kingston", [], [])
    assert [one.coverage_at(t) for t in (0, 59.9, 60, 119, 876)] == [0.1, 0.1, 0.5, 0.5, 0.9]


def test_the_team_beside_the_papers_where_it_is_known(tmp_path: Path) -> None:
    known, unknown = (recorded(tmp_path, name, [], []) for name in ("kingston", "airport"))
    _, _, one, other = mas_table([known, unknown]).splitlines()
    assert "| 14.6 | 87.7% |" in one
    assert "84" not in other  # minutes that we chose are not told as the paper's
    assert "| 2 of 2 | 1.5 |" in one


def test_true_landmarks_do_not_depend_on_the_map(tmp_path: Path, knowledge: Knowledge) -> None:
    none = recorded(tmp_path, "city", [square("Residential", 0, 240)], [])
    at = {"type": "Point", "coordinates": [120, 120]}
    house = {"type": "Feature", "geometry": at, "properties": {"class": "House"}}
    objects = {"type": "FeatureCollection", "crs_units": "m", "bbox": [0, 0, 240, 240]}
    (none.folder / "record" / "objects.geojson").write_text(
        json.dumps(objects | {"features": [house]})
    )
    assert from_true_landmarks([none], "branch", knowledge) is None  # a world of no objects
    world = none.folder / "record" / "world.json"
    document = json.loads(world.read_text())
    document["objects"] = [{"id": "h", "class": "House", "x": 120, "y": 120}]
    world.write_text(json.dumps(document))
    again = Finished(none.folder, none.metrics)
    true = from_true_landmarks([again], "branch", knowledge)
    mapped = pooled([again], "branch", knowledge)
    assert true is not None
    assert mapped is not None
    assert mapped.all.accuracy == 0
    assert true.all.accuracy > 0.2


# ---- plans, folders, pages


def test_plans() -> None:
    every = plans()
    assert [p.name for p in every][-1] == MANY
    assert {p.name: p.minutes for p in every}["kingston"] == 14.6
    assert not every[-1].mapped
    assert [p.minutes for p in plans(["city", "yard.json"], 2.0)] == [2.0, 2.0]
    with pytest.raises(InputError, match="twice"):
        plans(["city", "City"])


def test_nothing_to_draw(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no finished mission"):
        finished_in(tmp_path)
    recorded(tmp_path, "city", [], [])
    with pytest.raises(InputError, match="kingston"):
        finished_in(tmp_path, ["kingston"])


def test_a_page_without_marks_is_refused(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text("mine\n")
    with pytest.raises(OutputError, match="marks"):
        around(page)
    page.write_text(f"mine\n{MARKS[0]}\nold\n{MARKS[1]}\nalso mine\n")
    assert around(page) == (f"mine\n{MARKS[0]}", f"{MARKS[1]}\nalso mine\n")


def test_make_results_keeps_the_part_about_missions(tmp_path: Path) -> None:
    spec = importlib.util.spec_from_file_location("results", ROOT / "scripts" / "results.py")
    assert spec is not None
    assert spec.loader is not None
    results = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(results)
    page = tmp_path / "page.md"
    page.write_text(f"tables\n{MARKS[0]}\nflown\n{MARKS[1]}\n")
    assert results.missions(page) == f"{MARKS[0]}\nflown\n{MARKS[1]}"
    fresh = results.missions(tmp_path / "none.md")
    (tmp_path / "none.md").write_text(fresh)
    assert around(tmp_path / "none.md")
    assert around(ROOT / "docs" / "results.md")


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["city", "--time-limit", "0"], "--time-limit 0"),
        (["city", "--speed", "99"], "--speed 99"),
        (["city", "--range", "0"], "--range 0"),
        (["city", "--search", "magic"], "magic"),
        (["atlantis"], "atlantis"),
        (["--from", "nowhere"], "no finished mission"),
    ],
)
def test_what_is_refused_before_anything_is_flown(
    words: list[str], told: str, tmp_path: Path
) -> None:
    pytest.importorskip("pybullet")
    folder, page = tmp_path / "record", tmp_path / "page.md"
    _, _, error = table(*words, "--record", folder, "--out", page)
    assert isinstance(error, SymboSlamError)
    assert told in str(error)
    assert not folder.exists()
    assert not page.exists()


# ---- end to end


def yard(path: Path, starts: int = 1) -> Path:
    """A small world with a house in its middle."""
    ring = [[0, 0], [120, 0], [120, 120], [0, 120], [0, 0]]
    document = {
        "format": "symboslam-world", "version": 1, "name": path.stem, "extent": [0, 0, 120, 120],
        "zones": [{"environment": "Residential", "polygon": [ring]}],
        "objects": [
            {"id": "house", "class": "House", "x": 60, "y": 60},
            {"id": "tree", "class": "Tree", "x": 90, "y": 30},
            {"id": "cat", "class": "Cat", "x": 118, "y": 118},
        ],
        "starts": [{"x": 20 + 10 * n, "y": 20, "heading": 0.8} for n in range(starts)],
    }  # fmt: skip
    path.write_text(json.dumps(document))
    return path


def table(*arguments: object) -> tuple[int, str, BaseException | None]:
    """Exit code, output and error of the command."""
    result = CliRunner().invoke(app, ["sim", "table", *map(str, arguments)])
    return result.exit_code, result.output, result.exception


def test_missions_are_flown_once_and_drawn_again(tmp_path: Path) -> None:
    pytest.importorskip("pybullet")
    pytest.importorskip("gtsam")
    one, crowd = yard(tmp_path / "yard.json"), yard(tmp_path / "crowd.json", starts=0)
    folder, page = tmp_path / "record", tmp_path / "docs" / "results.md"
    words = (one, "--time-limit", 0.15, "--robots", 1, "--record", folder, "--out", page)
    code, _, error = table(*words)
    assert code == 0, error
    text = page.read_text()
    assert "| yard | 0.01 | 1 | 0.1 |" in text or "| yard | 0.01 | 1 | 0.2 |" in text
    images = sorted(path.name for path in (page.parent / "images").iterdir())
    assert images == ["sim-coverage.png", "sim-errors.png", "sim-yard.png"]
    (mission,) = finished_in(folder)
    assert (mission.plan["speed"], mission.plan["reach"]) == (SPEED, REACH)
    assert mission.errors[-1, 0] == mission.metrics["time_s"]
    assert mission.errors[-1, 3] == pytest.approx(
        mission.metrics["slam"]["landmark_mean_m"], abs=1e-3
    )
    assert len(mission.object_seen) == 3
    assert math.isfinite(mission.object_seen[0])
    scores = pooled([mission], "branch")
    assert scores is not None
    best = from_true_landmarks([mission], "branch", Knowledge.load())
    assert best is not None
    assert best.cells == scores.cells == 576
    assert "| pooled, true landmarks | 576 |" in text
    assert scores.all.mean_iou == pytest.approx(mission.metrics["map"]["branch"]["all"]["mean_iou"])

    flown = (folder / "yard" / "metrics.json").read_bytes()
    page.write_text(page.read_text().replace("# Results", "# Mine"))
    assert table(*words)[0] == 0  # goes on where it was: nothing is left to fly
    assert (folder / "yard" / "metrics.json").read_bytes() == flown
    assert page.read_text() == text.replace("# Results", "# Mine")
    assert table("--from", folder, "--out", page)[0] == 0
    assert page.read_text() == text.replace("# Results", "# Mine")

    code, _, error = table(*words, "--seed", 3)
    assert isinstance(error, OutputError)
    assert "seed 0, not 3" in str(error)
    assert (folder / "yard" / "metrics.json").read_bytes() == flown

    many = ("--robots", 99, "--time-limit", 0.1, "--record", folder, "--out", page)
    code, _, error = table(crowd, *many)  # one that fails is told
    assert isinstance(error, SymboSlamError)
    assert "crowd failed: InputError: 99 robots" in str(error)
    assert not (folder / "crowd" / "metrics.json").exists()
    assert "Traceback" in (folder / "crowd" / "error.txt").read_text()
    assert table("--from", folder, "--out", page)[0] == 0
    assert "**Failed, and in no figure: crowd (InputError: 99 robots" in page.read_text()


def test_ctrl_c_keeps_what_is_finished(tmp_path: Path) -> None:
    pytest.importorskip("pybullet")
    pytest.importorskip("gtsam")
    from symboslam.sim_bridge.table.workers import run_all

    first = Plan("first", str(yard(tmp_path / "a.json")), 0.1, robots=1, mapped=False)
    second = Plan("second", str(yard(tmp_path / "b.json")), 1000.0, robots=1, mapped=False)

    def tell(name: str, stage: str, share: float) -> None:
        if name == "first" and share == 1:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run_all([first, second], tmp_path / "record", 2, tell)
    assert is_finished(first, tmp_path / "record")
    assert not is_finished(second, tmp_path / "record")
    assert not multiprocessing.active_children()
    second = replace(second, minutes=0.05)
    assert run_all([second], tmp_path / "record", 1, lambda *_: None) == {}
    assert is_finished(second, tmp_path / "record")
    code, output, error = table("--from", tmp_path / "record", "--out", tmp_path / "page.md")
    assert code == 0, (output, error)  # without maps there are tables alone
    assert "not measured" in (tmp_path / "page.md").read_text()


def test_a_film(tmp_path: Path, knowledge: Knowledge, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("pybullet")
    pytest.importorskip("gtsam")
    from PIL import Image

    from symboslam.sim_bridge.table import film as films
    from symboslam.sim_bridge.table.area_run import run_area
    from symboslam.sim_bridge.table.film import STILL, draw_film

    plan = Plan("city", str(yard(tmp_path / "a.json")), 0.1, robots=1)
    run_area(plan, tmp_path, lambda *_: None)
    (mission,) = finished_in(tmp_path)
    draw_film(mission, knowledge, tmp_path / "film.gif", frames=5)
    with Image.open(tmp_path / "film.gif") as film:
        assert 3 <= getattr(film, "n_frames") <= 5 + STILL  # noqa: B009 - of GIFs alone
        assert film.width > 600
    monkeypatch.setattr(films, "draw_film", lambda one, knows, target: target.write_bytes(b"GIF"))
    written = write_page([mission], knowledge, tmp_path / "page.md")
    assert tmp_path / "images" / "sim-city.gif" in written
    assert "(images/sim-city.gif)" in (tmp_path / "page.md").read_text()
