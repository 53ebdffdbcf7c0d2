"""Whatever is done to a file, it is read or refused with an InputError that names it."""

from __future__ import annotations

import tempfile
import warnings
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from symboslam.engine.slam.dead_reckoning import dead_reckoned
from symboslam.engine.slam.readers import read_estimate, read_mission
from symboslam.engine.slam.writers import write_slam_map
from symboslam.errors import InputError

FILES = {
    "g2o": b"VERTEX_SE2 0 1 2 0\nVERTEX_XY 7 5 5\nEDGE_SE2 0 1 1 0 1.5 4 0 0 4 0 4\n"
    b"EDGE_SE2_XY 1 7 3 4 25 0 25\nEDGE_SE3:QUAT 1 2 1 0 0 0 0 0 1 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 "
    b"0 0 1 0 1\nEDGE_PRIOR_SE2_XY 1 2 3 4 0 4\nEDGE_BEARING_SE2_XY 0 7 0.5 9\nFIX 0\n",
    "gtsam": b"VERTEX2 0 0 0 0\nODOMETRY 0 2 1 0 0 1 0 0 4 0 9\nLANDMARK 2 0 0 2 0.4 0 0.1\n"
    b"BR 2 1 0.5 3 0.01 0.3\nEDGE2 2 4 1 0 0 1 0 4 2 0 0\n",
    "csv": b"time,robot,x,y,heading\n0,A,0,0,0\n1,A,1,0,0\n0,B,1,0,0\n2,A,2,0,1\n",
    "tum": b"1 0 0 0 0 0 0 1\n2 1 0 0 0 0 0.1 1\n3 2 0 0 0 0 0.2 1\n",
}
junk = st.sampled_from(
    [
        b"",
        b"\x00",
        b"\xff",
        b"nan",
        b"-",
        b" ",
        b"\n",
        b",",
        b"1e999",
        b"9" * 400,
        b"-1",
        b'"',
        b"#",
    ]
)
damage = st.lists(st.tuples(st.floats(0, 1), st.integers(0, 6), junk), max_size=4)


def damaged(data: bytes, changes: list[tuple[float, int, bytes]]) -> bytes:
    for where, length, put in changes:
        at = int(where * len(data))
        data = data[:at] + put + data[at + length :]
    return data


@pytest.mark.parametrize("name", FILES)
@settings(max_examples=60)
@given(changes=damage)
def test_damaged_files(name: str, changes: list[tuple[float, int, bytes]]) -> None:
    with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)  # overflow of absurd numbers
        path = Path(folder) / "odometry"
        path.write_bytes(damaged(FILES[name], changes))
        try:
            mission, _ = read_mission(path, name)
        except InputError as error:
            refused = str(error)
            mission = None
        if mission is None:
            assert str(path) in refused
            return
        found = read_estimate(path, mission, name) or dead_reckoned(mission)
        assert set(found.trajectories) == {log.name for log in mission.robots}
        write_slam_map(path.with_suffix(".g2o"), found, mission)
