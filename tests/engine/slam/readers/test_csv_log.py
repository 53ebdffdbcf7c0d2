"""CSV logs."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from symboslam.engine.slam.log import ROBOT, Mission
from symboslam.engine.slam.readers import format_of, read_mission
from symboslam.errors import InputError
from symboslam.reasoning.knowledge import Knowledge

Write = Callable[..., Path]
ODOMETRY = "time,x,y,heading\n0,0,0,0\n1,1,0,0\n2,1,1,1.5\n"
DETECTIONS = (
    "time,range,bearing,class,confidence,key\n"
    "0,5,0.1,house,0.9,\n"
    "1.5,,0.2,Car,,\n"
    "1,3,,Wombat,0.5,No. 7\n"
)
TWO_AT_ONCE = "time,x,y,heading\n" + "".join(
    f"{t},{x},0,0\n" for t in range(12) for x in (t, 9 - t)
)
SIGMAS = "time,range,bearing,sigma_range,sigma_bearing\n"


def read(
    write: Write, knowledge: Knowledge | None = None, **files: str
) -> tuple[Mission, list[str]]:
    content = {"odometry": ODOMETRY, **files}
    for name, text in content.items():
        folder = write(f"logs/{name}.csv", text).parent
    return read_mission(folder, knowledge=knowledge)


@pytest.fixture(scope="session")
def knowledge() -> Knowledge:
    return Knowledge.load()


def test_a_folder_by_hand(write: Write) -> None:
    mission, notes = read(
        write,
        detections=DETECTIONS,
        fixes="t;x;y;sigma\n1;10;20;0.5\n0;9;19;\n",
        starts="robot,x,y,heading_deg\nRobot 1,10,20,90\n",
    )
    (log,) = mission.robots
    assert log.name == "Robot 1"
    assert log.start == pytest.approx((10, 20, np.pi / 2))
    assert log.odometry.pose.tolist() == [[0, 0, 0], [1, 0, 0], [1, 1, 1.5]]
    assert log.seen.time.tolist() == [0, 1, 1.5]
    assert mission.classes == ("house", "Wombat", "Car")
    assert log.seen.feature.tolist() == [0, 1, 2]
    assert log.seen.range[:2].tolist() == [5, 3]
    assert np.isnan(log.seen.range[2])
    assert np.isnan(log.seen.bearing[1])
    assert log.seen.confidence.tolist() == [0.9, 0.5, 1]
    assert log.seen.key.tolist() == ["", "No. 7", ""]
    assert log.fixes is not None
    assert log.fixes.time.tolist() == [0, 1]
    assert log.fixes.xy.tolist() == [[9, 19], [10, 20]]
    assert log.fixes.sigma.tolist() == [3, 0.5]
    assert notes == [
        "detections.csv: 1 row without a range (empty or NaN): read as a bearing alone",
        "detections.csv: 1 row without a bearing (empty or NaN): read as a range alone",
        "detections.csv: time goes back at 1 row, by up to 0.5 s; rows were sorted by time",
        "fixes.csv: time goes back at 1 row, by up to 1 s; rows were sorted by time",
    ]


def test_deviations_of_each_detection(write: Write) -> None:
    """Sorted with their rows; an empty cell is the usual; what was not measured needs none."""
    mission, _ = read(
        write,
        detections=f"{SIGMAS}1,5,0.1,0.3,0.01\n0,6,0.2,,0.04\n2,,0.3,nan,0.05\n2,7,,0.9,0\n",
    )
    seen = mission.robots[0].seen
    assert seen.time.tolist() == [0, 1, 2, 2]
    assert seen.sigmas.tolist() == [[0.5, 0.04], [0.3, 0.01], [0.5, 0.05], [0.9, 0.02]]


def test_a_deviation_of_one_column_alone(write: Write) -> None:
    mission, _ = read(write, detections="time,range,bearing,range_std\n0,5,0.1,0.3\n1,5,0.1,0.4\n")
    seen = mission.robots[0].seen
    assert seen.sigmas.tolist() == [[0.3, 0.02], [0.4, 0.02]]
    assert seen.sigma_bearing == 0.02


def test_classes_of_the_ontology(write: Write, knowledge: Knowledge) -> None:
    mission, notes = read(write, knowledge, detections=DETECTIONS + "2,1,0,robot,1,\n2,1,1,,1,\n")
    assert mission.classes == ("House", "Wombat", "Car", "unknown")
    assert mission.dynamic.tolist() == [False, False, True, False]
    assert mission.robots[0].seen.feature[-2:].tolist() == [ROBOT, 3]
    assert mission.similarity.tolist() == np.eye(4).tolist()
    assert notes[-2:] == [
        "classes that the ontology does not know, kept as they are: Wombat (1)",
        "detections without a class, now of class unknown: 1",
    ]


def test_velocities_are_integrated(write: Write) -> None:
    mission, _ = read(write, odometry="t,v,omega\n0,1,0\n2,0,0.5\n4,1,0\n5,9,9\n")
    end = [2 + np.cos(1), np.sin(1), 1]
    assert mission.robots[0].odometry.pose == pytest.approx(
        np.array([[0, 0, 0], [2, 0, 0], [2, 0, 1], end])
    )


def test_several_robots_and_degrees(write: Write) -> None:
    mission, notes = read(
        write,
        odometry="robot,time,x,y,yaw_deg\nB,0,0,0,90\nA,0,5,5,-180\nB,1,1,0,450\n",
        detections="robot,t,distance,angle_deg,label\nA,0,1,90,Tree\nC,0,1,0,Tree\nB,0,2,370,Tree\n",
    )
    assert [log.name for log in mission.robots] == ["B", "A"]
    b, a = mission.robots
    assert b.odometry.pose[:, 2] == pytest.approx([np.pi / 2, np.pi / 2])
    assert a.seen.bearing == pytest.approx([np.pi / 2])
    assert b.seen.bearing == pytest.approx([np.pi / 18])
    assert notes == ["detections.csv: 1 row of robots without odometry left out: C"]


def test_what_is_mended(write: Write) -> None:
    mission, notes = read(
        write,
        odometry="\ufefftime,x,y,heading,battery\n0,0,0,0,9\n\n0,0,0,0,9\n2,2,0,0,9\n1,1,0,0,9\n"
        "3,nan,0,0,9\n2,2,2,0,8\n",
        detections="time,range,bearing,class,confidence\n-1,1,0,Tree,1\n1,,,Tree,1\n1,nan,NaN,Tree,1\n"
        "1,-2,0,Tree,1\n,1,0,Tree,1\n9,1,0,Tree,nan\n1,1,0,Tree,1\n1,1,0,Tree,1\n",
    )
    (log,) = mission.robots
    assert log.odometry.time.tolist() == [0, 1, 2]
    assert log.odometry.pose[-1].tolist() == [2, 2, 0]
    assert log.seen.time.tolist() == [1, 9]
    assert notes == [
        "odometry.csv: columns that were not used: battery",
        "odometry.csv: 1 repeated row left out",
        "odometry.csv: 1 row with NaN or empty cells left out, the first in line 7",
        "odometry.csv, Robot 1: time goes back at 1 row, by up to 1 s; rows were sorted by time",
        "odometry.csv, Robot 1: 1 row left out that another row of the same time contradicts; the "
        "last one counts",
        "detections.csv: 1 repeated row left out",
        "detections.csv: 1 row without a time left out, the first in line 6",
        "detections.csv: 1 row from before the first odometry left out, the first in line 2",
        "detections.csv: 1 row with a range below 0 or infinity left out, the first in line 5",
        "detections.csv: 2 rows with neither range nor bearing left out, the first in line 3",
        "detections.csv: 1 row from after the last odometry",
        "detections.csv: 1 row with a confidence of NaN: read as 1",
        "detections.csv: time goes back at 1 row, by up to 8 s; rows were sorted by time",
    ]


def test_times_of_the_calendar(write: Write) -> None:
    mission, notes = read(
        write, odometry="time,x,y,heading\n1970-01-01T00:00:10Z,0,0,0\n1970-01-01T00:00:20,1,0,0\n"
    )
    assert mission.robots[0].odometry.time.tolist() == [10, 20]
    assert notes == ["odometry.csv: 1 time without a zone read as UTC"]


@pytest.mark.parametrize(
    ("files", "problem"),
    [
        ({"odometry": "time,x,y\n0,0,0\n"}, "odometry.csv: header: columns x, y, heading"),
        ({"odometry": "x,y,heading\n0,0,0\n"}, "header: there is no column 'time'"),
        ({"odometry": "time,t,x,y,heading\n0,0,0,0,0\n"}, "two columns are for the time"),
        ({"odometry": ""}, "the file is empty"),
        ({"odometry": "time,x,y,heading\n"}, "no robot has a row of odometry"),
        ({"odometry": "time,x,y,heading\n0,0,0\n"}, "line 2: this row has 3 cells, the header 4"),
        ({"odometry": "time,x,y,heading\n0,0,zero,0\n"}, "line 2: y is 'zero', not a number"),
        ({"odometry": "time,x,y,heading\nnow,0,0,0\n"}, "line 2: time is 'now', neither seconds"),
        ({"odometry": 'time,x,y,heading\n0,"0,0,0\n'}, "line 2: this is not valid CSV"),
        ({"detections": "time,class\n0,Tree\n"}, "a column range or bearing is needed"),
        ({"detections": "time,range,confidence\n0,1,1.5\n"}, "line 2: confidence is '1.5', not in"),
        ({"detections": f"{SIGMAS}0,1,0,0,0.1\n"}, "line 2: sigma_range is '0', not from"),
        ({"detections": f"{SIGMAS}0,1,0,1,-0.1\n"}, "line 2: sigma_bearing is '-0.1', not from"),
        ({"detections": f"{SIGMAS}0,1,0,1,1\n1,1,0,nan,1\n"}, "line 3: sigma_range is 'nan', not"),
        ({"detections": f"{SIGMAS}0,1,0,inf,1\n"}, "line 2: sigma_range is 'inf', not from"),
        ({"detections": f"{SIGMAS}0,1,0,1e-200,1\n"}, "line 2: sigma_range is '1e-200', not from"),
        ({"detections": "time,range,bearing\n0,1,170\n0,2,-95\n0,3,6\n0,4,8"},
         "bearings reach 170, and should be in radians; a column of degrees is called bearing_deg"),
        ({"odometry": TWO_AT_ONCE},
         "odometry.csv, Robot 1: in two places at once at 12 of 12 times: two robots under one"),
        ({"starts": "robot,x,y,heading\nRobot 1,1e300,0,0\n"}, "no farther than 1e+08"),
        ({"detections": "time,range,bearing,bearing_deg\n0,1,1,1\n"}, "both bearing and"),
        ({"fixes": "time,lon,lat\n0,1,1\n"}, "fixes.csv: header: columns x and y, in metres"),
        ({"starts": "robot,x,y,heading\nRobot 1,1,,0\n"}, "a start needs x, y and heading"),
        ({"odometry": "time,robot,x,y,heading\n0,A,0,0,0\n0,B,0,0,0\n", "detections": DETECTIONS},
         "there is no column 'robot', and there are 2"),
    ],
)  # fmt: skip
def test_what_is_refused(write: Write, files: dict[str, str], problem: str) -> None:
    with pytest.raises(InputError) as error:
        read(write, **files)  # type: ignore[arg-type]
    assert problem in str(error.value)


def test_bytes_that_are_no_text(write: Write) -> None:
    path = write("odometry.csv", b"time,x,y,heading\n0,0,0,0\n1,\xe9,0,0\n")
    with pytest.raises(InputError, match=r"odometry\.csv: line 3: this is not UTF-8 text"):
        read_mission(path)
    path = write("odometry.csv.gz", b"time,x,y,heading\n0,0,0,0\n1,\x001,0,0\x00\n")
    mission, notes = read_mission(path)
    assert mission.robots[0].odometry.pose[1].tolist() == [1, 0, 0]
    assert notes == ["odometry.csv.gz: 2 NUL bytes left out"]


def test_a_pair_of_files(write: Write) -> None:
    odometry = write("run1-odometry.csv", ODOMETRY)
    detections = write("run1-detections.csv", DETECTIONS)
    assert format_of([odometry, detections]) == "csv"
    assert len(read_mission([odometry, detections])[0].robots[0].seen) == 3
    with pytest.raises(InputError, match="the name must hold one of"):
        read_mission([odometry, write("other.csv", DETECTIONS)])


def test_what_tells_the_format(write: Write, tmp_path: Path) -> None:
    with pytest.raises(InputError, match="neither name nor first line tell the format"):
        format_of(write("a.txt", "hello\n"))
    with pytest.raises(InputError, match="there is no format 'bag'"):
        format_of(tmp_path, "bag")
    assert format_of(write("b.txt", "VERTEX_SE2 0 0 0 0\n")) == "g2o"
