"""True processes: two edge agents, a control agent, a service that stops, one that is killed."""

import json
import math
import os
import random
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import httpx
import numpy as np
import pytest

pytest.importorskip("fastapi", reason="needs symboslam[service]")

from symboslam.cli.agent_edge import _start
from symboslam.errors import InputError
from tests.service.conftest import ADMIN, TOKEN
from tests.service.test_durability import serve

pytestmark = pytest.mark.proof

ROOT = Path(__file__).parents[3]
HOUSES = [(float(x), float(y)) for x in range(10, 100, 20) for y in (10, 30)]


def records(y: float, seconds: float) -> Iterator[dict[str, Any]]:
    """A drive along a street at ten metres a second, seeing the houses that are near."""
    for n in range(int(seconds * 10) + 1):
        t, x = n / 10, float(n)
        yield {"time": t, "odometry": [x, 0.0, 0.0]}
        for a, b in HOUSES:
            if math.hypot(a - x, b - y) < 25:
                yield {
                    "time": t, "class": "House", "confidence": 0.9,
                    "range": math.hypot(a - x, b - y), "bearing": math.atan2(b - y, a - x),
                }  # fmt: skip


class Agents:
    """Processes of ``symboslam agent`` with a quick mapper, which end with the test."""

    def __init__(self, folder: Path) -> None:
        self.folder, self.running = folder, list["subprocess.Popen[str]"]()

    def __call__(
        self, *options: object, true: bool = False, **given: Any
    ) -> "subprocess.Popen[str]":
        module = "symboslam" if true else "tests.sim_bridge.agents.fakes"
        command = [sys.executable, "-m", module, "agent"]
        process = subprocess.Popen(
            [*command, *map(str, options)], cwd=ROOT, text=True, stderr=subprocess.PIPE,
            env={**os.environ, "SYMBOSLAM_TOKEN": TOKEN}, **given,
        )  # fmt: skip
        self.running.append(process)
        return process

    def edge(
        self, log: object, robot: str, which: str, url: str, *options: object, **given: Any
    ) -> Any:
        where = ("--map", which, "--to", url, "--spool", self.folder / "spool")
        return self("edge", log, "--robot", robot, *where, "--every", 0.2, *options, **given)


@pytest.fixture
def agents(tmp_path: Path) -> Iterator[Agents]:
    found = Agents(tmp_path)
    yield found
    for process in found.running:
        process.kill()
        process.communicate()


def make(client: httpx.Client) -> str:
    wanted = {
        "name": "street", "bbox": [-50, -50, 150, 100], "crs": "m", "segmentation": {"cells": 8}
    }  # fmt: skip
    made = client.post("/v1/maps", json=wanted, headers=ADMIN).raise_for_status()
    return str(made.json()["id"])


def fetched(client: httpx.Client, which: str) -> list[dict[str, Any]]:
    text = client.get(f"/v1/maps/{which}/increments", params={"limit": 10_000}).text
    return [json.loads(line)["increment"] for line in text.splitlines()]


def until(condition: Callable[[], object], seconds: float = 60.0) -> None:
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.05)


def heard(client: httpx.Client, which: str, count: int) -> int:
    """How many runs have sent so many increments or more."""
    runs = client.get(f"/v1/maps/{which}/robots").json()
    return sum(run["increments"] >= count for run in runs)


def written(folder: Path, name: str, y: float, seconds: float) -> Path:
    file = folder / f"{name}.ndjson"
    file.write_text("".join(json.dumps(each) + "\n" for each in records(y, seconds)))
    return file


def check(client: httpx.Client, which: str, robots: dict[str, int]) -> list[dict[str, Any]]:
    """Every increment is there once, and the map has all houses."""
    found = fetched(client, which)
    for robot, poses in robots.items():
        mine = [each for each in found if each["robot"] == robot]
        assert sorted(each["sequence"] for each in mine) == list(range(len(mine)))
        assert len({each["run"] for each in mine}) == 1
        times = [t for each in sorted(mine, key=lambda e: e["sequence"]) for t in each["time"]]
        assert times == [n / 10 for n in range(poses)]
        assert [each["last"] for each in mine].count(True) == 1
    landmarks = client.get(f"/v1/maps/{which}/landmarks").json()["features"]
    places = sorted(f["geometry"]["coordinates"] for f in landmarks)
    np.testing.assert_allclose(places, sorted(HOUSES), atol=1e-2)
    assert {f["properties"]["agent"] for f in landmarks} == {"control"}
    return found


def has_spool(process: "subprocess.Popen[str]") -> bool:
    """Whether an agent has opened its spool."""
    files = Path(f"/proc/{process.pid}/fd").glob("*")
    return any(os.readlink(file).endswith(".sqlite3") for file in files if file.is_symlink())


def test_two_robots_a_control_agent_and_everything_that_breaks(
    agents: Agents, tmp_path: Path
) -> None:
    data, log = tmp_path / "data", written(tmp_path, "r1", 20.0, 10.0)
    with serve(data, rate="none") as (server, client):
        which, url, port = make(client), str(client.base_url), str(client.base_url.port)
        control = agents(
            "control", "--map", which, "--to", url, "--every", 0.2, "--once", "--robots", 2,
            "--silent", 40,
        )  # fmt: skip
        slowly = ("--start", "0,20,0", "--speed", 4)
        one = agents.edge(log, "r1", which, url, *slowly)
        two = agents.edge("-", "r2", which, url, "--start", "0,0,0", stdin=subprocess.PIPE)
        lines = [json.dumps(each) + "\n" for each in records(0.0, 10.0)]
        assert two.stdin is not None
        two.stdin.write("".join(lines[: len(lines) // 3]) + "what is that?\n")
        two.stdin.flush()
        until(lambda: {each["robot"] for each in fetched(client, which)} == {"r1", "r2"})
        early = fetched(client, which)
        client.post(  # the network gives them again, in another order
            f"/v1/maps/{which}/increments",
            headers={**ADMIN, "Content-Type": "application/x-ndjson"},
            content="\n".join(json.dumps(each) for each in reversed(early)),
        ).raise_for_status()  # fmt: skip
        server.send_signal(signal.SIGKILL)
        server.wait()
    two.stdin.write("".join(lines[len(lines) // 3 : len(lines) // 2]))
    two.stdin.flush()
    assert one.poll() is None, "it was too quick for the test"
    one.send_signal(signal.SIGKILL)
    one.wait()
    one = agents.edge(log, "r1", which, url, *slowly)
    time.sleep(0.5)
    with serve(data, "--port", port, rate="none") as (_, client):
        two.stdin.write("".join(lines[len(lines) // 2 :]))
        out = [process.communicate(timeout=60)[1] for process in (one, two, control)]
        assert [process.returncode for process in (one, two, control)] == [0, 0, 0], out
        check(client, which, {"r1": 101, "r2": 101})
        assert "cannot be reached" in out[1]
        assert "the service answers again" in out[1]
        assert "is left out: it is no JSON" in out[1]
        assert "is delivered" in out[0]
        assert "the test doubts it" in out[2]
        assert "robot r1 (run replay-" in out[2]
        again = agents.edge(log, "r1", which, url, *slowly)
        assert "was mapped before" in again.communicate(timeout=60)[1]
        assert again.returncode == 0
        check(client, which, {"r1": 101, "r2": 101})


def test_robots_of_one_name_and_signals(agents: Agents, tmp_path: Path) -> None:
    with serve(tmp_path / "data", rate="none") as (_, client):
        which, url = make(client), str(client.base_url)
        control = agents("control", "--map", which, "--to", url, "--every", 0.2)
        start = ("--start", "0,20,0")
        one = agents.edge("-", "r1", which, url, *start, stdin=subprocess.PIPE)
        elsewhere = ("--spool", tmp_path / "other", *start)
        two = agents.edge("-", "r1", which, url, *elsewhere, stdin=subprocess.PIPE)
        lines = [json.dumps(each) + "\n" for each in records(20.0, 4.0)]
        half = len(lines) // 2
        for part, count in ((lines[:half], 1), (lines[half:], 8)):
            for process in (one, two):
                process.stdin.write("".join(part))
                process.stdin.flush()
            until(lambda count=count: heard(client, which, count) == 2)  # type: ignore[misc]
        for process in (one, two):
            process.send_signal(signal.SIGTERM)
            said = process.communicate(timeout=60)[1]
            assert (process.returncode, said) == (130, "")
        runs = client.get(f"/v1/maps/{which}/robots").json()
        assert [each["finished"] for each in runs] == [True, True]
        time.sleep(0.7)
        control.send_signal(signal.SIGTERM)
        said = control.communicate(timeout=60)[1]
        assert control.returncode == 130, said
        assert "two robots at a time are called r1" in said


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
def test_signals_at_any_time_end_agents_without_a_word(
    agents: Agents, tmp_path: Path, number: signal.Signals
) -> None:
    """With the true mapper and a service that hangs now and then, so that threads are waiting."""
    chance, log = random.Random(3), written(tmp_path, "r1", 20.0, 10.0)
    with serve(tmp_path / "data", rate="none") as (server, client):
        which, url = make(client), str(client.base_url)
        control = agents("control", "--map", which, "--to", url, "--every", 0.2, true=True)
        for n in range(6):
            one = agents.edge(
                log, "r1", which, url, "--start", "0,20,0", "--speed", 2, true=True
            )  # fmt: skip
            until(lambda one=one: has_spool(one))  # type: ignore[misc]
            time.sleep(chance.uniform(0.0, 1.5))
            if n % 2:
                server.send_signal(signal.SIGSTOP)
                time.sleep(0.3)
            one.send_signal(number)
            said = one.communicate(timeout=60)[1]
            server.send_signal(signal.SIGCONT)
            assert one.returncode == 130, said
            assert "Traceback" not in said
            assert "xception" not in said
            assert "Fatal" not in said
        time.sleep(1.0)
        control.send_signal(number)
        said = control.communicate(timeout=60)[1]
        assert control.returncode == 130, said
        assert "Traceback" not in said
        assert "xception" not in said
        last = agents.edge(log, "r1", which, url, "--start", "0,20,0", true=True)
        assert last.communicate(timeout=60)[1].endswith("is delivered\n")
        mine = fetched(client, which)
        assert sorted(each["sequence"] for each in mine) == list(range(len(mine)))
        times = [t for each in sorted(mine, key=lambda e: e["sequence"]) for t in each["time"]]
        assert times == [n / 2 for n in range(21)]


@pytest.mark.slow
def test_killed_again_and_again(agents: Agents, tmp_path: Path) -> None:
    """Whatever is killed and whenever: each increment is there once, and none is missing."""
    chance, data, port = random.Random(5), tmp_path / "data", "0"
    log = written(tmp_path, "r1", 20.0, 10.0)
    one: Any = None
    which = url = ""
    for n in range(12):
        with serve(data, "--port", port, rate="none") as (server, client):
            url, port = str(client.base_url), str(client.base_url.port)
            which = which or make(client)
            if one is None or one.poll() is not None:
                one = agents.edge(log, "r1", which, url, "--start", "0,20,0", "--speed", 2)
            time.sleep(chance.uniform(1.0, 2.5))
            if n % 2:
                one.send_signal(signal.SIGKILL)
                one.wait()
            server.send_signal(signal.SIGKILL)
            server.wait()
    with serve(data, "--port", port, rate="none") as (_, client):
        one.kill()
        last = agents.edge(log, "r1", which, url, "--start", "0,20,0", "--speed", 2)
        err = last.communicate(timeout=60)[1]
        assert last.returncode == 0, err
        control = agents("control", "--map", which, "--to", url, "--every", 0.2, "--once")
        assert control.wait(60) == 0
        check(client, which, {"r1": 101})


@pytest.mark.slow
def test_what_cannot_be(agents: Agents, tmp_path: Path) -> None:
    def said(process: "subprocess.Popen[str]", code: int) -> str:
        err = process.communicate(timeout=60)[1]
        assert process.returncode == code, err
        return err

    log = written(tmp_path, "r1", 20.0, 1.0)
    (tmp_path / "bad.ndjson").write_text("x\n")
    with serve(tmp_path / "data", rate="none") as (_, client):
        which, url = make(client), str(client.base_url)
        assert "there is no map 'none'" in said(agents.edge(log, "r1", "none", url), 2)
        assert "is no log of a robot" in said(
            agents.edge(tmp_path / "bad.ndjson", "r1", which, url), 2
        )
        assert "there is no map 'none'" in said(agents("control", "--map", "none", "--to", url), 2)
    late = said(agents.edge(log, "r1", which, url, "--wait", 0.2), 3)
    assert "increments wait in" in late
    assert "within 0.2 seconds" in late
    with serve(tmp_path / "data", rate="none") as (_, client):
        # The address is part of nothing: what waits for the map goes to where it is now.
        done = agents.edge(log, "r1", which, str(client.base_url))
        assert "is delivered" in said(done, 0)
        mine = [each for each in fetched(client, which) if each["robot"] == "r1"]
        assert sorted(each["sequence"] for each in mine) == list(range(len(mine)))


def test_starts() -> None:
    assert _start(None) is None
    assert _start("1, 2,90") == (1.0, 2.0, math.pi / 2)
    for text in ("1,2", "1,2,x", "1,2,nan"):
        with pytest.raises(InputError, match="give three numbers"):
            _start(text)
