"""``symboslam evaluate slam`` through the command line."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

TRUE_PATH = "# time x y z qx qy qz qw\n" + "".join(f"{i} {i} 0 0 0 0 0 1\n" for i in range(5))
PATH = TRUE_PATH.replace("2 2 0", "2.004 2 1.5")
TRUE_MARKS = "id,class,x,y\na,House,0,0\nb,House,10,0\nc,Tree,20,0\n"
MARKS = "id,class,x,y\n1,House,3,4\n2,Tree,10,0\n3,Tree,20,1\n4,Tree,90,1\n"
SQUARE_TURN = "0 0 0 0 0 0 0 1\n1 1 0 0 0 0 0.7071067811865476 0.7071067811865476\n"


@pytest.fixture
def files(tmp_path: Path) -> Path:
    """Two folders, ``estimate`` and ``truth``, with a path and landmarks each."""
    for folder, path, marks in (("estimate", PATH, MARKS), ("truth", TRUE_PATH, TRUE_MARKS)):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "r1.tum").write_text(path)
        (tmp_path / folder / "landmarks.csv").write_text(marks)
    return tmp_path


def test_two_trajectories(run: Any, files: Path) -> None:
    other = (files / "truth" / "r1.tum").rename(files / "ground.txt")
    done = run("evaluate", "slam", files / "estimate" / "r1.tum", other, "--json")
    assert (done.code, done.err) == (0, "")
    found = json.loads(done.out)
    assert found["robots"]["r1"]["poses"] == 5
    assert found["robots"]["r1"]["ate_raw_rmse_m"] == pytest.approx((1.5**2 / 5) ** 0.5)
    assert found["ate_mean_m"] == found["ate_max_m"] == pytest.approx(0.6)
    assert found["landmark_rmse_m"] is None


def test_folders_with_landmarks_and_a_picture(run: Any, files: Path) -> None:
    out = files / "out.png"
    done = run(
        "evaluate", "slam", files / "estimate", files / "truth", "--radius", 6, "--picture", out,
        "--delta", "2f",
    )  # fmt: skip
    assert done.code == 0, done
    assert "Paths, aligned; RPE over 2f" in done.out
    assert "3 true landmarks, 4 in the map; matched within 6 m" in done.out
    row = next(line for line in done.out.splitlines() if "as mapped" in line)
    assert row.split()[2:] == ["2", "0.667", "0.500", "3.000", "3.606", "3.000", "5.000"]
    assert out.read_bytes().startswith(b"\x89PNG")


def test_no_align(run: Any, files: Path) -> None:
    paths = (files / "estimate" / "r1.tum", files / "truth" / "r1.tum")
    done = run("evaluate", "slam", *paths, "--no-align")
    assert "not aligned" in done.out
    assert "0.671" in done.out
    assert "landmarks" not in done.out


def test_landmarks_alone_as_geojson(run: Any, files: Path, points: Any) -> None:
    rows = [({"class": "House", "id": "x"}, [0, 1]), ({"class": "Tree"}, [20, 0])]
    found = points(rows, crs_units="m")
    truth = files / "truth" / "landmarks.csv"
    done = run("evaluate", "slam", found, truth, "--json", "--picture", files / "out.png")
    assert done.code == 0, done
    values = json.loads(done.out)
    assert values["raw"]["coverage"] == pytest.approx(2 / 3)
    assert (values["landmarks_matched"], values["matched_by"]) == (2, "position")
    assert values["ate_mean_m"] is None
    assert "wrote" in done.err


def test_landmarks_by_option(run: Any, files: Path) -> None:
    words = []
    for side in ("estimate", "truth"):
        words.append(files / side / "r1.tum")
    marks = [files / side / "landmarks.csv" for side in ("estimate", "truth")]
    done = run(
        "evaluate", "slam", *words, "--landmarks", marks[0], "--true-landmarks", marks[1], "--json"
    )
    assert json.loads(done.out)["landmarks_true"] == 3
    done = run("evaluate", "slam", *words, "--landmarks", marks[0])
    assert done.code == 2
    assert "without: give both or none" in done.err
    (files / "truth" / "landmarks.csv").unlink()  # found in a folder, but with nothing to compare
    done = run("evaluate", "slam", files / "estimate", files / "truth", "--json")
    assert json.loads(done.out)["landmarks_true"] is None


def test_the_turn_of_a_path_is_in_its_quaternion(run: Any, tmp_path: Path) -> None:
    one, two = tmp_path / "a.tum", tmp_path / "b.tum"
    one.write_text(SQUARE_TURN)
    two.write_text(SQUARE_TURN.replace("0.7071067811865476", "0").replace("0 0\n", "0 1\n"))
    done = run("evaluate", "slam", one, two, "--json")
    robot = json.loads(done.out)["robots"]["a"]
    assert robot["rpe_rmse_rad"] == pytest.approx(1.5707963)
    assert robot["rpe_rmse_m"] == 0


def test_other_clocks_are_told(run: Any, files: Path) -> None:
    paths = (files / "estimate" / "r1.tum", files / "truth" / "r1.tum")
    late = TRUE_PATH.replace("\n", "\n100").removesuffix("100")
    paths[1].write_text(late)
    done = run("evaluate", "slam", *paths)
    assert done.code == 0
    assert "no pose within 0.01 s of a true one" in done.out.replace("\n", " ")


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["estimate", "nowhere"], "nowhere"),
        (["empty", "truth"], "the folder has no .tum or .txt files and no landmarks"),
        (["bad.tum", "truth"], "bad.tum"),
        (["none.tum", "truth"], "none.tum"),
        (["other", "truth"], "no trajectory of the estimate has the name of a true one: b, c"),
        (["degrees.geojson", "truth/landmarks.csv"], "compared in metres"),
        (["truth/landmarks.csv", "truth/r1.tum"], "no trajectory of the estimate"),
        (["estimate", "truth", "--delta", "1km"], "delta '1km'"),
        (["estimate", "truth", "--radius", "0"], "radius is 0"),
        (["estimate", "truth", "--picture", "x.gif"], "a picture is a .png file"),
        (["estimate", "truth", "--picture", "no/x.png"], "no/x.png"),
    ],
)
def test_bad_input(run: Any, files: Path, words: list[str], message: str, points: Any) -> None:
    (files / "empty").mkdir()
    (files / "bad.tum").write_text("This is prose.\n")
    (files / "none.tum").write_text("# nothing\n")
    (files / "other").mkdir()
    for name in "bc":
        (files / "other" / f"{name}.tum").write_text(TRUE_PATH)
    points([({"class": "House"}, [0, 1])]).rename(files / "degrees.geojson")
    given = [files / word if "/" in word or (files / word).exists() else word for word in words]
    done = run("evaluate", "slam", *given)
    assert done.code == 2, done
    assert message in done.err
    assert done.out == ""


def test_evaluate_still_takes_files(
    run: Any, points: Any, tmp_path: Path, monkeypatch: Any
) -> None:
    box = {"type": "Polygon", "coordinates": [[[0, 0], [8, 0], [8, 8], [0, 8], [0, 0]]]}
    path = points([({"environment": "Commercial"}, box)], bbox=[0, 0, 8, 8], crs_units="m")
    path.rename(tmp_path / "slam")  # a file of that name needs its folder
    monkeypatch.chdir(tmp_path)
    done = run("evaluate", "./slam", "./slam", "--out", "-", "-q")
    assert json.loads(done.out)["all"]["accuracy"] == 1
    done = run("evaluate", "--quiet", "--out", "-", "slam", "slam")
    assert json.loads(done.out)["all"]["accuracy"] == 1
