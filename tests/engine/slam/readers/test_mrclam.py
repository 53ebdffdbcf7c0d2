"""MRCLAM sets: a tiny one by hand, what can be wrong with one, and set 6."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from symboslam.engine.slam.log import ROBOT, Mission
from symboslam.engine.slam.readers import format_of, read_mission
from symboslam.errors import InputError

Write = Callable[..., Path]
FILES = {
    "Barcodes.dat": "# Subject # Barcode #\n 1 \t 5 \n 2 14\n 6 72\n 8 27\n",
    "Landmark_Groundtruth.dat": "6 1.5 -2 0.0001 0.0002\n8 3 4 0.0001 0.0002\n",
    "Robot1_Odometry.dat": "100 1 0\n101 0 1.5\n102 1 0\n104 0 0\n",
    "Robot1_Measurement.dat": "100 72 2.5 0.1\n101 27 3 -0.2\n101 14 1 0\n102 99 1 1\n103 5 1 1\n",
    "Robot1_Groundtruth.dat": "99 0 0 3.0\n101 2 4 -3.0\n105 2 4 -3.0\n",
    "Robot2_Odometry.dat": "100 0 0\n101 0 0\n",
    "Robot2_Groundtruth.dat": "100 5 5 1\n101 5 5 1\n",
}


def make(write: Write, **changed: str | bytes | None) -> Path:
    """The set, with some files changed or left out; names have _ for the point."""
    files: dict[str, str | bytes | None] = dict(FILES)
    files |= {name.replace("_dat", ".dat"): content for name, content in changed.items()}
    for name, content in files.items():
        if content is not None:
            folder = write(f"set/{name}", content).parent
    return folder


def test_known_identities(write: Write) -> None:
    mission, notes = read_mission(make(write))
    first, second = mission.robots
    assert (first.name, second.name) == ("Robot 1", "Robot 2")
    assert first.odometry.time.tolist() == [100, 101, 102, 104]
    one = [[0, 0, 0], [1, 0, 0], [1, 0, 1.5], [1 + 2 * np.cos(1.5), 2 * np.sin(1.5), 1.5]]
    assert first.odometry.pose == pytest.approx(np.array(one))
    assert first.start == pytest.approx((1, 2, -np.pi)) or first.start == pytest.approx(
        (1, 2, np.pi)
    )
    assert second.start == pytest.approx((5, 5, 1))
    assert mission.classes == ("Landmark 6", "Landmark 8")
    assert first.seen.key.tolist() == ["6", "8", "Robot 2"]
    assert first.seen.feature.tolist() == [0, 1, ROBOT]
    assert first.seen.range.tolist() == [2.5, 3, 1]
    assert first.seen.bearing.tolist() == [0.1, -0.2, 0]
    assert (first.seen.sigma_range, first.seen.sigma_bearing) == (0.15, 0.02)
    assert first.odometry.noise.floor == (0.004, 0.001, 0.008)
    assert len(second.seen) == 0
    truth = mission.truth
    assert truth is not None
    assert truth.landmarks == {"6": (1.5, -2), "8": (3, 4)}
    assert truth.features == {"6": "Landmark 6", "8": "Landmark 8"}
    assert truth.trajectories["Robot 1"][1].tolist() == [101, 2, 4, -3]
    assert notes == [
        "Robot1_Measurement.dat: 1 measurement with a barcode that nobody has left out, the first "
        "in line 4",
        "Robot1_Measurement.dat: 1 measurement of the robot itself left out, the first in line 5",
        "Robot2_Measurement.dat is missing: Robot 2 saw nothing",
    ]


def test_hidden_identities(write: Write) -> None:
    mission, _ = read_mission(make(write), classes=5)
    seen = mission.robots[0].seen
    assert mission.classes == ("class 0", "class 1", "class 2", "class 3", "class 4")
    assert seen.key.tolist() == ["", "", ""]
    assert seen.feature.tolist() == [1, 3, ROBOT]
    assert mission.identity["Robot 1"].tolist() == ["6", "8", "Robot 2"]
    assert mission.truth is not None
    assert mission.truth.features == {"6": "class 1", "8": "class 3"}


@pytest.mark.parametrize(
    ("start", "known"), [("all", [True, True]), ("first", [True, False]), ("none", [False, False])]
)
def test_whose_start_is_known(write: Write, start: str, known: list[bool]) -> None:
    mission, _ = read_mission(make(write), start=start)
    assert [log.start is not None for log in mission.robots] == known


def test_late_truth_is_driven_back(write: Write) -> None:
    """Truth begins 0.5 s, or 0.5 m of way, after odometry."""
    mission, notes = read_mission(make(write, Robot1_Groundtruth_dat="100.5 2 3 0\n105 9 9 0\n"))
    assert mission.robots[0].start == pytest.approx((1.5, 3, 0))
    assert "Robot 1: truth begins 0.50 s late; odometry leads back to the start" in notes


def test_truth_that_is_elsewhere_in_time(write: Write) -> None:
    mission, notes = read_mission(make(write, Robot1_Groundtruth_dat="200 2 3 0\n205 9 9 0\n"))
    assert mission.robots[0].start is None
    assert "Robot 1: no truth near the first odometry, so its start is not known" in notes
    mission, notes = read_mission(make(write, Robot1_Groundtruth_dat="90 2 3 0\n100 9 9 0\n",
                                       Robot1_Odometry_dat="100 0 0\n106 0 0\n"))  # fmt: skip
    assert mission.robots[0].start == pytest.approx((9, 9, 0))
    assert "Robot 1: its truth ends 6 s before its odometry" in notes


def test_what_is_mended(write: Write) -> None:
    mission, notes = read_mission(
        make(
            write,
            Robot1_Odometry_dat=b"100 1 0\n\x00\x00\n102 1 0\n101 0 1.5\n101 0 1.5\n102 2 0\n"
            b"109 0 0\n",
            Robot1_Measurement_dat=None,
            Landmark_Groundtruth_dat=None,
            Robot2_Odometry_dat=None,
        )
    )
    (log,) = mission.robots
    assert log.odometry.time.tolist() == [100, 101, 102, 109]
    assert log.odometry.pose[-1] == pytest.approx([1 + 14 * np.cos(1.5), 14 * np.sin(1.5), 1.5])
    assert mission.classes == ("Landmark 6", "Landmark 8")
    assert notes == [
        "Landmark_Groundtruth.dat is missing: no truth of the landmarks",
        "Robot1_Odometry.dat: 1 repeated row left out",
        "Robot1_Odometry.dat: time goes back at 1 row, by up to 1 s; rows were sorted by time",
        "Robot1_Odometry.dat: 1 row left out that another row of the same time contradicts; the "
        "last one counts",
        "Robot1_Odometry.dat: 1 gap of more than 2 s, the longest 7 s; the last velocity holds "
        "through it",
        "Robot1_Measurement.dat is missing: Robot 1 saw nothing",
        "Robot2_Odometry.dat is missing or has no rows: Robot 2 is left out",
    ]


def test_gzipped_files_are_read(write: Write) -> None:
    for name, content in FILES.items():
        folder = write(f"set/{name}.gz", content).parent
    assert format_of(folder) == "mrclam"
    assert len(read_mission(folder)[0].robots) == 2


@pytest.mark.parametrize(
    ("changed", "problem"),
    [
        ({"Barcodes_dat": None}, "none of the files that tell a format"),
        ({"Barcodes_dat": "1 5\n6 5\n"}, "line 2: barcode 5 is of two subjects"),
        ({"Robot1_Odometry_dat": "1 2\n3 4 5\n"}, "line 1: this row has 2 columns, 3 are needed"),
        ({"Robot1_Odometry_dat": None, "Robot2_Odometry_dat": None}, "no robot has odometry"),
        ({"Robot1_Measurement_dat": ""}, "Robot1_Measurement.dat: the file is empty"),
    ],
)
def test_what_is_refused(write: Write, changed: dict[str, str | None], problem: str) -> None:
    folder = make(write, **changed)
    with pytest.raises(InputError) as error:
        read_mission(folder)
    assert problem in str(error.value)


def test_wrong_options(write: Write) -> None:
    folder = make(write)
    with pytest.raises(InputError, match="start is 'some'; it can be all, first, none"):
        read_mission(folder, start="some")
    with pytest.raises(InputError, match="classes is 0; it must be 1 or more"):
        read_mission(folder, classes=0)
    with pytest.raises(InputError, match="has no option 'identities', only: g2o, gtsam"):
        read_mission(folder, identities="hidden")


@pytest.fixture(scope="session")
def set6(shared: Path) -> tuple[Mission, list[str]]:
    return read_mission(shared / "data" / "mrclam6", classes=5)


def test_set_6(set6: tuple[Mission, list[str]]) -> None:
    mission, notes = set6
    assert [log.name for log in mission.robots] == [f"Robot {n}" for n in range(1, 6)]
    assert sum(len(log.seen) for log in mission.robots) == 19371
    assert sum("barcode that nobody has" in note for note in notes) == 3
    truth = mission.truth
    assert truth is not None
    assert len(truth.landmarks) == 15
    # The first measurement of Robot 1 in the file is barcode 14, at 3.787 m: subject 2.
    first = mission.robots[0]
    assert mission.identity["Robot 1"][0] == "Robot 2"
    assert first.seen.range[0] == 3.787
    assert (first.seen.feature == ROBOT).sum() > 0
    # Truth and odometry agree on how far the robots went in the first minute.
    for log in mission.robots:
        t0 = log.odometry.time[0]
        path = truth.trajectories[log.name]
        true = path[(path[:, 0] >= t0) & (path[:, 0] < t0 + 60), 1:3][::50]
        own = log.odometry.pose[log.odometry.time < t0 + 60, :2][::50]
        ways = [np.hypot(*np.diff(xy, axis=0).T).sum() for xy in (own, true)]
        assert ways[0] == pytest.approx(ways[1], rel=0.25)


def test_sightings_of_set_6_point_at_the_truth(set6: tuple[Mission, list[str]]) -> None:
    """Seen from the true poses, landmarks lie where they are, to about 0.3 m."""
    from symboslam.engine.slam.odometry import pose_at
    from symboslam.engine.slam.planar import place

    mission, _ = set6
    assert mission.truth is not None
    log = mission.robots[2]
    names = mission.identity[log.name]
    rows = np.flatnonzero(log.seen.feature != ROBOT)
    path = mission.truth.trajectories[log.name]
    at = pose_at(path[:, 0], path[:, 1:], log.seen.time[rows])
    reach, angle = log.seen.range[rows], log.seen.bearing[rows]
    spots = place(at, np.column_stack([reach * np.cos(angle), reach * np.sin(angle)]))
    true = np.array([mission.truth.landmarks[str(n)] for n in names[rows]])
    assert np.median(np.hypot(*(spots - true).T)) < 0.3
