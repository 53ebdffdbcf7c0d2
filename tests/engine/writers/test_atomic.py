"""Files appear whole or not at all, whatever goes wrong while they are written."""

from __future__ import annotations

import errno
import os
import stat
import subprocess
import sys
import textwrap
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.writers import write_map
from symboslam.engine.writers.atomic import atomic_file, check_writable
from symboslam.errors import OutputError


def files_in(folder: Path) -> list[str]:
    return sorted(entry.name for entry in folder.iterdir())


def test_new_file_appears_when_the_block_ends(tmp_path: Path) -> None:
    target = tmp_path / "map.txt"
    with atomic_file(target) as stream:
        stream.write(b"new")
        assert not target.exists()
    assert target.read_bytes() == b"new"
    assert files_in(tmp_path) == ["map.txt"]


@pytest.mark.parametrize("error", [ValueError("bug"), KeyboardInterrupt()])
def test_any_error_keeps_the_old_file(tmp_path: Path, error: BaseException) -> None:
    target = tmp_path / "map.txt"
    target.write_bytes(b"old")

    def fail() -> None:
        with atomic_file(target) as stream:
            stream.write(b"half")
            raise error

    with pytest.raises(type(error)):
        fail()
    assert target.read_bytes() == b"old"
    assert files_in(tmp_path) == ["map.txt"]


def test_new_files_have_the_usual_mode_and_old_ones_keep_theirs(tmp_path: Path) -> None:
    plain, new, old = tmp_path / "plain", tmp_path / "new", tmp_path / "old"
    plain.write_bytes(b"")
    old.write_bytes(b"")
    old.chmod(0o640)
    for target in (new, old):
        with atomic_file(target) as stream:
            stream.write(b"x")
    assert new.stat().st_mode == plain.stat().st_mode
    assert stat.S_IMODE(old.stat().st_mode) == 0o640


def test_a_link_stays_a_link(tmp_path: Path) -> None:
    (tmp_path / "real.txt").write_bytes(b"old")
    (tmp_path / "link.txt").symlink_to("real.txt")
    with atomic_file(tmp_path / "link.txt") as stream:
        stream.write(b"new")
    assert (tmp_path / "link.txt").is_symlink()
    assert (tmp_path / "real.txt").read_bytes() == b"new"


@pytest.mark.parametrize(
    ("name", "problem"),
    [
        ("missing/map.geojson", "missing"),
        ("file.txt/map.geojson", "cannot be written"),
        ("", "it is a folder"),
        ("x" * 300 + ".geojson", "File name too long"),
    ],
)
def test_impossible_targets_are_refused(tmp_path: Path, name: str, problem: str) -> None:
    (tmp_path / "file.txt").write_bytes(b"old")
    with pytest.raises(OutputError, match=problem), atomic_file(tmp_path / name) as stream:
        stream.write(b"x")
    assert files_in(tmp_path) == ["file.txt"]


@pytest.mark.parametrize("name", ["missing/map.geojson", "file.txt/map.geojson", ""])
def test_impossible_targets_are_found_beforehand(tmp_path: Path, name: str) -> None:
    (tmp_path / "file.txt").write_bytes(b"old")
    with pytest.raises(OutputError, match="cannot be written"):
        check_writable(tmp_path / name)


def test_checking_changes_nothing(tmp_path: Path) -> None:
    check_writable(tmp_path / "new.txt")
    assert files_in(tmp_path) == []
    check_writable("/dev/null")


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write everywhere")
def test_no_permission_keeps_the_old_file(tmp_path: Path) -> None:
    target = tmp_path / "map.txt"
    target.write_bytes(b"old")
    target.chmod(0o400)
    with pytest.raises(OutputError, match="write-protected"):
        check_writable(target)
    with pytest.raises(OutputError, match="write-protected"), atomic_file(target) as stream:
        stream.write(b"new")
    assert target.read_bytes() == b"old"


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs /dev/full")
def test_a_full_device_is_reported_and_not_replaced() -> None:
    with pytest.raises(OutputError, match="/dev/full cannot be written: No space left"):
        with atomic_file("/dev/full") as stream:
            stream.write(b"x" * 100_000)
    assert stat.S_ISCHR(os.stat("/dev/full").st_mode)


def test_no_room_in_mid_write_keeps_the_old_file(tmp_path: Path) -> None:
    """The system refuses to let the file grow beyond 64 kB, as a full quota does."""
    target = tmp_path / "map.txt"
    target.write_bytes(b"old")
    script = """
        import resource, sys
        from symboslam.engine.writers.atomic import atomic_file
        from symboslam.errors import OutputError

        resource.setrlimit(resource.RLIMIT_FSIZE, (65_536, 65_536))
        try:
            with atomic_file(sys.argv[1]) as stream:
                for _ in range(100):
                    stream.write(b"x" * 10_000)
        except OutputError as error:
            sys.exit(str(error))
    """
    ran = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(script), str(target)],
        capture_output=True,
        text=True,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
    )
    assert (ran.returncode, ran.stderr) == (1, f"{target} cannot be written: File too large\n")
    assert target.read_bytes() == b"old"
    assert files_in(tmp_path) == ["map.txt"]


@pytest.fixture
def small_disk(tmp_path: Path) -> Iterator[Path]:
    """A file system with room for two pages."""
    disk = tmp_path / "disk"
    disk.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=8k", "tmpfs", str(disk)]
    try:
        mounted = subprocess.run(mount, capture_output=True, text=True)
    except FileNotFoundError:
        pytest.skip("there is no mount command")
    if mounted.returncode:
        pytest.skip(f"no right to mount a small disk: {mounted.stderr.strip()}")
    yield disk
    subprocess.run(["umount", str(disk)], check=True)


@pytest.mark.parametrize("ending", ["geojson", "ttl", "nq", "png"])
def test_full_disk_keeps_the_old_map(
    small_disk: Path, make_town: Callable[[], EnvironmentMap], ending: str
) -> None:
    target = small_disk / f"map.{ending}"
    target.write_bytes(b"old")
    (small_disk / "filler").write_bytes(b"x" * 4096)
    with pytest.raises(OutputError, match="No space left on device"):
        write_map(make_town(), target)
    assert target.read_bytes() == b"old"
    assert files_in(small_disk) == ["filler", target.name]


@pytest.mark.parametrize("ending", ["geojson", "ttl", "nq", "png"])
def test_a_disk_that_is_full_at_the_very_end_keeps_the_old_map(
    tmp_path: Path, town: EnvironmentMap, ending: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Some file systems only notice when the content is flushed."""

    def full(handle: int) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    target = tmp_path / f"map.{ending}"
    target.write_bytes(b"old")
    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(OutputError, match="No space left on device"):
        write_map(town, target)
    assert target.read_bytes() == b"old"
    assert files_in(tmp_path) == [target.name]
