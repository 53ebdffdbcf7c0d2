"""The spool: nothing lost, nothing twice, however its agent ends; bounded, one agent at a time."""

import json
import os
import signal
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from symboslam.engine.slam.increment import EdgeIncrement
from symboslam.errors import InputError, OutputError
from symboslam.sim_bridge.agents.spool import Spool, SpoolFullError
from tests.service.increments import increment

MIB = 1024 * 1024


def made(sequence: int = 0, run: str = "a", last: bool = False) -> EdgeIncrement:
    return EdgeIncrement.from_json(increment("r1", run, sequence, last))


def opened(folder: Path, limit: int = MIB) -> Spool:
    return Spool(folder, "r1", "m1", limit)


def waiting(spool: Spool) -> list[tuple[str, int, bool]]:
    found = [json.loads(letter.content) for letter in spool.next(1000, MIB)]
    return [(each["run"], each["sequence"], each["last"]) for each in found]


def test_what_is_put_waits_until_it_is_delivered(tmp_path: Path) -> None:
    spool = opened(tmp_path)
    assert spool.begin("a")
    assert [spool.put(made(n)) for n in range(5)] == [True] * 5
    first = spool.next(2, MIB)
    assert [letter.name for letter in first] == ["increment 0 of run a", "increment 1 of run a"]
    assert len(spool.next(9, 10)) == 1
    spool.delivered(first)
    spool.close()
    spool = opened(tmp_path)
    assert spool.waiting == 3
    assert waiting(spool) == [("a", 2, False), ("a", 3, False), ("a", 4, False)]
    spool.refuse(spool.next(1, MIB)[0], "no")
    assert spool.waiting == 2
    spool.close()


def test_a_run_goes_on_where_it_was(tmp_path: Path) -> None:
    spool = opened(tmp_path)
    spool.begin("a")
    for n in range(3):
        spool.put(made(n))
    spool.delivered(spool.next(2, MIB))
    spool.close()
    spool = opened(tmp_path)
    assert spool.begin("a")
    assert [spool.put(made(n)) for n in range(5)] == [False] * 3 + [True] * 2
    spool.put(made(5, last=True))
    assert [n for _, n, _ in waiting(spool)] == [2, 3, 4, 5]
    assert not spool.begin("a")
    spool.close()


def test_a_run_that_was_cut_short_ends_when_another_begins(tmp_path: Path) -> None:
    spool = opened(tmp_path)
    spool.begin("none")
    spool.begin("a")
    for n in range(2):
        spool.put(made(n))
    spool.begin("b")
    assert waiting(spool) == [("a", 0, False), ("a", 1, False), ("a", 2, True)]
    last = EdgeIncrement.from_json(json.loads(spool.next(9, MIB)[-1].content))
    assert (last.first, len(last.time), last.start) == (4, 0, (1.0, 2.0, 0.0))
    with pytest.raises(InputError, match="--run"):
        spool.begin("a")
    spool.close()


def test_it_is_bounded(tmp_path: Path) -> None:
    size = len(json.dumps(made().to_json(), separators=(",", ":")))
    spool = opened(tmp_path, int(2.5 * size))
    spool.begin("a")
    spool.put(made(0))
    spool.put(made(1))
    with pytest.raises(SpoolFullError, match="is full: 2 increments wait"):
        spool.put(made(2))
    assert spool.waiting == 2
    spool.delivered(spool.next(1, MIB))
    assert spool.put(made(2))
    spool.close()
    small = Spool(tmp_path, "r2", "m1", 10)
    small.begin("a")
    assert small.put(replace(made(), robot="r2")), "one alone goes through, or nothing ever would"
    small.close()


def test_one_agent_at_a_time(tmp_path: Path) -> None:
    spool = opened(tmp_path)
    with pytest.raises(OutputError, match="another agent of robot 'r1'"):
        opened(tmp_path)
    Spool(tmp_path, "../r/2", "m1", MIB).close()
    assert all(path.parent == tmp_path for path in tmp_path.rglob("*"))
    spool.close()
    (tmp_path / "file").touch()
    with pytest.raises(OutputError, match="no spool can be kept there"):
        opened(tmp_path / "file")
    (tmp_path / "r1@m1.sqlite3").write_bytes(b"no database" * 100)
    with pytest.raises(OutputError, match="cannot be read"):
        opened(tmp_path)


KILLED = """
import sys
from pathlib import Path
from symboslam.sim_bridge.agents.spool import Spool
from tests.sim_bridge.agents.test_spool import made
spool = Spool(Path(sys.argv[1]), "r1", "m1", 10**9)
spool.begin("a")
for n in range(100000):
    if spool.put(made(n)):
        print(n, flush=True)
"""


def test_what_was_put_survives_kill_9(tmp_path: Path) -> None:
    said: list[int] = []
    for _ in range(2):
        with subprocess.Popen(
            [sys.executable, "-c", KILLED, str(tmp_path)], stdout=subprocess.PIPE, text=True,
            cwd=Path(__file__).parents[3], env={**os.environ},
        ) as process:  # fmt: skip
            assert process.stdout is not None
            for line in process.stdout:
                said.append(int(line))
                if len(said) % 30 == 0:
                    process.send_signal(signal.SIGKILL)
                    break
            said += [int(line) for line in process.stdout.read().split()]
    spool = opened(tmp_path, 10**9)
    found = [n for _, n, _ in waiting(spool)]
    assert found == list(range(len(found)))
    assert set(said) <= set(found)
    assert len(said) >= 60
    spool.close()
