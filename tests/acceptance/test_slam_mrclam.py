"""``symboslam slam mrclam`` through the command line, with a stand-in for the estimator."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from tests.acceptance.mrclam_set import LANDMARKS, write_set
from tests.acceptance.slam_stand_in import DOUBT, stand_in

FIGURES = {
    "landmark_rmse_m",
    "landmark_rmse_raw_m",
    "ate_mean_m",
    "ate_max_m",
    "landmarks_matched",
    "landmarks_true",
    "landmarks_mapped",
    "wrong_merges",
    "duplicates",
    "wrong_sightings_share",
    "robots_missing",
    "seconds",
}


@pytest.fixture(autouse=True)
def _stand_in(monkeypatch: pytest.MonkeyPatch) -> None:
    stand_in(monkeypatch)


def test_json_of_a_set_without_drift(run: Any, tmp_path: Path) -> None:
    done = run("slam", "mrclam", write_set(tmp_path / "set"), "--json")
    assert (done.code, done.err) == (0, f"doubt: {DOUBT}\n")
    found = json.loads(done.out)
    assert found.keys() == FIGURES | {
        "dead_reckoning", "paper_rule", "doubts", "notes", "starts", "robots_lost"
    }  # fmt: skip
    assert found["doubts"] == [DOUBT]
    assert found["notes"] == ["stood in"]
    for figures in (found, found["dead_reckoning"], found["paper_rule"]):
        assert figures.keys() >= FIGURES
        assert figures["landmark_rmse_m"] < 1e-6
        assert figures["landmark_rmse_raw_m"] < 1e-6
        assert 0 <= figures["ate_mean_m"] <= figures["ate_max_m"] < 1e-6
        assert figures["landmarks_matched"] == figures["landmarks_true"] == LANDMARKS
        assert figures["landmarks_mapped"] == LANDMARKS
        assert figures["wrong_merges"] == figures["duplicates"] == 0
        assert figures["robots_missing"] == []
        assert figures["seconds"] >= 0


def test_drift_shows_in_all_errors(run: Any, tmp_path: Path) -> None:
    done = run("slam", "mrclam", write_set(tmp_path / "set", drift=0.02), "--json")
    found = json.loads(done.out)
    for figures in (found, found["dead_reckoning"]):
        assert 0.1 < figures["landmark_rmse_m"] <= figures["landmark_rmse_raw_m"]
        assert 0.1 < figures["ate_mean_m"] <= figures["ate_max_m"]
    # by keys and by identity dead reckoning is the same map
    names = FIGURES - {"seconds"}
    assert {n: found[n] for n in names} == {n: found["dead_reckoning"][n] for n in names}


def test_hidden_identities(run: Any, tmp_path: Path) -> None:
    done = run("slam", "mrclam", write_set(tmp_path / "set"), "--classes", 4, "--json")
    found = json.loads(done.out)
    assert found["landmarks_mapped"] > LANDMARKS  # the stand-in takes each sighting for another one
    assert found["landmarks_matched"] == LANDMARKS
    assert found["dead_reckoning"]["landmarks_mapped"] == LANDMARKS
    assert found["paper_rule"]["landmark_rmse_m"] < 1e-6


@pytest.mark.parametrize(
    ("starts", "missing", "used"),
    [("all", 0, ["known"] * 2), ("first", 1, ["known", "none"]), ("none", 1, ["first", "none"])],
)
def test_starts(run: Any, tmp_path: Path, starts: str, missing: int, used: list[str]) -> None:
    source = write_set(tmp_path / "set")
    found = json.loads(run("slam", "mrclam", source, "--starts", starts, "--json").out)
    assert found["starts"] == dict(zip(("Robot 1", "Robot 2"), used, strict=True))
    assert found["robots_lost"] == ["Robot 2"][:missing]
    again = json.loads(run("slam", "run", source, "--starts", starts, "--json").out)
    assert again["starts"] == found["starts"]
    assert again["robots_lost"] == found["robots_lost"]
    table = run("slam", "mrclam", source, "--starts", starts).out
    said = "SymboSLAM: lost and in none of the errors of paths: Robot 2"
    assert (said in table) == (missing == 1)
    for figures in (found, found["dead_reckoning"], found["paper_rule"]):
        assert figures["robots_missing"] == ["Robot 2"][:missing]
        assert figures["landmark_rmse_m"] < 1e-6
        assert (figures["landmark_rmse_raw_m"] > 0.1) == (starts == "none")


def test_table_outputs_and_picture(run: Any, tmp_path: Path) -> None:
    geojson, paths, picture = tmp_path / "m.geojson", tmp_path / "m.tum", tmp_path / "m.png"
    done = run(
        "slam", "mrclam", write_set(tmp_path / "set"), "--out", geojson, "--out", paths,
        "--picture", picture, "--origin", "149.1,-35.2",
    )  # fmt: skip
    assert (done.code, done.err) == (0, f"doubt: {DOUBT}\n")
    rows = [line.split() for line in done.out.splitlines()]
    assert ["SymboSLAM", *["0.000"] * 4, "8", "of", "8", "0", "0", "0", "0.0"] in rows
    assert [row[0] for row in rows if row[-1:] and row[-5:-4] == ["8"]] == [
        "SymboSLAM",
        "dead",
        "the",
    ]
    assert len(json.loads(geojson.read_text())["features"]) == LANDMARKS
    assert (tmp_path / "m-Robot_2.tum").stat().st_size > 100
    assert picture.read_bytes().startswith(b"\x89PNG")
    assert done.out.count("wrote ") == 4


def test_without_truth_there_are_no_figures(run: Any, tmp_path: Path) -> None:
    folder = write_set(tmp_path / "set")
    for file in folder.glob("*Groundtruth.dat"):
        file.unlink()
    done = run("slam", "mrclam", folder, "--json")
    assert done.code == 0, done
    found = json.loads(done.out)
    assert found["landmark_rmse_m"] is found["ate_mean_m"] is None
    assert any("no truth of the landmarks" in note for note in found["notes"])
    assert "-" in run("slam", "mrclam", folder, "--picture", tmp_path / "a.png").out


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["nowhere"], "nowhere: there is no such folder; an MRCLAM set is a folder with"),
        (["file"], "file: this is a file; an MRCLAM set is a folder with Barcodes.dat"),
        (["empty"], "empty: this is no MRCLAM set: there is no Barcodes.dat in it"),
        (["codes"], "codes: no robot has odometry"),
        (["set", "--classes", "0"], "classes is 0"),
        (["set", "--starts", "last"], "start is 'last'; it can be all, first, none"),
        (["set", "--picture", "a.gif"], "a picture is a .png file"),
        (["set", "--out", "a.bin"], "no format has this ending"),
        (["set", "--out", "a.tum", "--out", "a.tum"], "named twice"),
        (["set", "--out", "a.tum", "--origin", "1,2"], "--origin is for GeoJSON"),
    ],
)
def test_bad_input(
    run: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, words: list[str], message: str
) -> None:
    monkeypatch.chdir(tmp_path)
    write_set(tmp_path / "set")
    for name in ("empty", "codes"):
        (tmp_path / name).mkdir()
    (tmp_path / "file").write_text("1 2 3\n")
    (tmp_path / "codes" / "Barcodes.dat").write_text("6 72\n")
    done = run("slam", "mrclam", *words)
    assert (done.code, done.out) == (2, "")
    assert message in done.err
