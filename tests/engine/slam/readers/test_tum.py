"""Trajectories in TUM's format."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from symboslam.engine.slam.readers.tum import read_trajectory
from symboslam.errors import InputError


def test_rows_are_poses_seen_from_above(tmp_path: Path) -> None:
    file = tmp_path / "a.tum"
    file.write_text("# time x y z q\n0.5 1 2 3 0 0 0 1\n\n1.5 2 3 4 0 0 1 1 # a quarter turn\n")
    path, notes = read_trajectory(file)
    assert (path.time.tolist(), notes) == ([0.5, 1.5], [])
    np.testing.assert_allclose(path.pose, np.array([[1, 2, 0], [2, 3, np.pi / 2]]))


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("0 0 0 0 0 0 0 1\n1 2 3\n", "line 2: give eight numbers"),
        ("0 0 0 0 0 0 0 0\n", "line 1: give eight numbers"),
        ("0 nan 0 0 0 0 0 1\n", "line 1: give eight numbers"),
        ("0 0 0 0 0 0 0 1\n" * 2, "line 2: the time is not later"),
        ("# nothing\n", "there is no pose in it"),
    ],
)
def test_wrong_files(tmp_path: Path, text: str, message: str) -> None:
    (tmp_path / "a.tum").write_text(text)
    with pytest.raises(InputError, match=message):
        read_trajectory(tmp_path / "a.tum")
