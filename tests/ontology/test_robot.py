"""``scripts/robot`` says clearly why it cannot run, and leaves nothing half fetched."""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

ROBOT = Path(__file__).parents[2] / "scripts" / "robot"
TOOLS = ("bash", "dirname", "env", "grep", "mkdir", "mktemp", "mv", "rm", "sed")

Run = Callable[..., subprocess.CompletedProcess[str]]


@pytest.fixture
def run(tmp_path: Path) -> Run:
    """Run the script where there are only the named programs, each a line of shell."""
    tools = tmp_path / "bin"
    tools.mkdir()
    for name in TOOLS:
        found = shutil.which(name)
        if found is None:
            pytest.skip(f"no {name} here")
        (tools / name).symlink_to(found)

    def call(**programs: str) -> subprocess.CompletedProcess[str]:
        for name, line in programs.items():
            (tools / name).write_text(f"#!/usr/bin/env bash\n{line}\n")
            (tools / name).chmod(0o755)
        environment = {"PATH": str(tools), "XDG_CACHE_HOME": str(tmp_path / "cache")}
        return subprocess.run(
            [ROBOT, "report"], env=environment, capture_output=True, text=True, check=False
        )

    return call


def left(folder: Path) -> list[str]:
    return sorted(os.listdir(folder)) if folder.exists() else []


def test_without_java(run: Run, tmp_path: Path) -> None:
    done = run()
    assert (done.returncode, done.stdout) == (3, "")
    assert "no Java" in done.stderr
    assert left(tmp_path / "cache") == []


def test_without_maven(run: Run, tmp_path: Path) -> None:
    done = run(java="exit 0")
    assert done.returncode == 3
    assert "no Maven" in done.stderr
    assert left(tmp_path / "cache") == []


def test_when_maven_fails(run: Run, tmp_path: Path) -> None:
    done = run(java="exit 0", mvn="echo 'no network' >&2; exit 1")
    assert done.returncode == 3
    assert "no network" in done.stderr
    assert "Maven could not fetch ROBOT 1.9.8" in done.stderr
    assert left(tmp_path / "cache" / "symboslam") == []


FETCH = 'for a in "$@"; do case $a in -DoutputDirectory=*) mkdir -p "${a#*=}";; esac; done'


def test_fetched_once_and_passed_on(run: Run, tmp_path: Path) -> None:
    """The arguments reach ROBOT, and so does its exit code."""
    done = run(java='echo "$@"; exit 1', mvn=FETCH)
    assert done.returncode == 1
    assert done.stdout.endswith("org.obolibrary.robot.CommandLineInterface report\n")
    assert left(tmp_path / "cache" / "symboslam") == ["robot-1.9.8"]
    again = run(mvn="exit 1")
    assert (again.returncode, again.stderr) == (1, "")
