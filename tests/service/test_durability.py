"""A true server process: what was acknowledged survives it, however it ends."""

import os
import re
import signal
import socket
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import httpx
import pytest

from symboslam.cli.serve import listen
from symboslam.errors import InputError
from tests.service.conftest import ADMIN, TOKEN, UPDATE, MakeService, Service, running

COUNT = {"query": "SELECT (COUNT(*) AS ?n) { GRAPH ?g { ?s <urn:p> ?o } }"}


@contextmanager
def serve(
    data: Path, *options: str, log: str = "none", **settings: str
) -> Iterator[tuple["subprocess.Popen[str]", httpx.Client]]:
    """``symboslam serve`` as a process with some settings, and a client of it."""
    environment = {
        **os.environ, "SYMBOSLAM_ADMIN_TOKEN": TOKEN, "SYMBOSLAM_BUNDLED_ONTOLOGY": "false",
        "SYMBOSLAM_WORKERS": "1", "SYMBOSLAM_LOG": log,
        **{f"SYMBOSLAM_{name.upper()}": value for name, value in settings.items()},
    }  # fmt: skip
    command = [sys.executable, "-m", "symboslam", "serve", "--data", str(data), "--port", "0"]
    process = subprocess.Popen(
        [*command, *options], env=environment, text=True,
        stdout=subprocess.PIPE, stderr=subprocess.PIPE,
    )  # fmt: skip
    with process:
        try:
            assert process.stdout is not None
            address = ""
            for line in process.stdout:
                if "SPARQL" in line:
                    address = line.split()[1]
                if "Ctrl-C" in line:
                    break
            assert address, process.stderr and process.stderr.read()
            with httpx.Client(base_url=address.removesuffix("/sparql"), timeout=60) as client:
                yield process, client
        finally:
            process.kill()


def count(client: httpx.Client) -> int:
    response = client.get("/sparql", params=COUNT)
    return int(response.json()["results"]["bindings"][0]["n"]["value"])


def test_acknowledged_writes_survive_kill_9(tmp_path: Path) -> None:
    acknowledged = 0
    for _ in range(2):
        with serve(tmp_path) as (process, client):
            assert count(client) == acknowledged
            for _ in range(10):
                text = f"INSERT DATA {{ GRAPH <urn:g> {{ <urn:s> <urn:p> {acknowledged} }} }}"
                response = client.post("/sparql", content=text, headers=UPDATE)
                assert response.status_code == 204
                acknowledged += 1
            turtle = {**ADMIN, "Content-Type": "text/turtle"}
            body = f"<urn:a> <urn:p> {acknowledged} ."
            response = client.post("/graphs?graph=urn:h", content=body, headers=turtle)
            assert response.status_code in (201, 204)
            acknowledged += 1
            process.send_signal(signal.SIGKILL)
            process.wait()
    with serve(tmp_path) as (_, client):
        assert count(client) == acknowledged == 22


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
def test_a_signal_stops_it_in_good_order(tmp_path: Path, number: signal.Signals) -> None:
    with serve(tmp_path) as (process, client):
        assert client.get("/readyz").status_code == 200
        process.send_signal(number)
        out, err = process.communicate(timeout=60)
        assert (process.returncode, out.strip(), err) == (0, "stopped", "")


def test_what_cannot_be_had_is_said(tmp_path: Path) -> None:
    def refused(*options: str, **environment: str) -> str:
        done = subprocess.run(
            [sys.executable, "-m", "symboslam", "serve", *options], check=False, text=True,
            capture_output=True, env={**os.environ, **environment}, timeout=60,
        )  # fmt: skip
        assert done.returncode == 2
        assert done.stderr.count("\n") == 1
        return done.stderr

    (tmp_path / "file").touch()
    with serve(tmp_path / "data") as (_, client):
        port = str(client.base_url.port)
        other = str(tmp_path / "other")
        assert "another process" in refused("--data", str(tmp_path / "data"), "--port", "0")
        assert f"127.0.0.1:{port}: Address already" in refused("--data", other, "--port", port)
        assert "file" in refused("--data", str(tmp_path / "file"), "--port", "0")
        said = refused("--data", other, "--port", "0", SYMBOSLAM_WORKERS="none")
        assert "SYMBOSLAM_WORKERS: " in said


def test_what_a_killed_server_left_is_cleared(make_service: MakeService, tmp_path: Path) -> None:
    spool = tmp_path / "data" / "spool"
    spool.mkdir(parents=True)
    (spool / "7.result").write_text("left")
    make_service()
    assert not list(spool.iterdir())


def test_the_ontology_is_there(with_ontology: Service) -> None:
    rows = with_ontology.values(
        "PREFIX sl: <https://w3id.org/symboslam#>"
        "PREFIX rdfs: <http://www.w3.org/2000/01/rdf-schema#>"
        "SELECT ?g { GRAPH ?g { sl:House rdfs:subClassOf sl:ResidentialFeature } }"
    )
    assert rows == [["https://w3id.org/symboslam/graph/inferences"]]
    rows = with_ontology.values(
        "PREFIX sl: <https://w3id.org/symboslam#>"
        "PREFIX rdfs: <http://www.w3.org/2000/01/rdf-schema#>"
        "SELECT ?label { sl:House rdfs:subClassOf sl:Feature ; rdfs:label ?label }"
    )
    assert rows == [["House"]]
    response = with_ontology.client.get(
        "/graphs", params={"graph": "https://w3id.org/symboslam/graph/ontology"}
    )
    assert "@prefix sl: <https://w3id.org/symboslam#>" in response.text


def test_the_ontology_is_put_there_once(tmp_path: Path) -> None:
    def writes() -> int:
        """How often a start wrote."""
        with running(data=tmp_path, workers=1) as service:
            assert service.values(
                "SELECT ?o { ?o a <http://www.w3.org/2002/07/owl#Class> } LIMIT 1"
            )
            return int(service.app.state.store.version.partition(".")[2])

    assert [writes(), writes()] == [2, 0]


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("file", "file is no folder; take another --data"),
        ("file/x/y", "cannot be made in {here}/file: Not a directory"),
        pytest.param(
            "/proc/x", "/proc/x cannot be made in /proc: it takes no new folders",
            marks=pytest.mark.skipif(not Path("/proc/self").is_dir(), reason="needs /proc"),
        ),
    ],
)  # fmt: skip
def test_a_folder_that_cannot_be_made(tmp_path: Path, name: str, told: str) -> None:
    (tmp_path / "file").write_text("mine")
    found = subprocess.run(
        [sys.executable, "-m", "symboslam", "serve", "--data", tmp_path / name, "--port", "0"],
        check=False, text=True, capture_output=True,
    )  # fmt: skip
    assert found.returncode == 2
    assert told.format(here=tmp_path) in found.stderr
    assert "damaged" not in found.stderr
    assert found.stderr.count("\n") == 1
    assert (tmp_path / "file").read_text() == "mine"


@pytest.mark.parametrize(
    ("host", "told"),
    [
        ("999.1.1.1", "--host '999.1.1.1' is no address to listen at"),
        ("a" * 70, "is no address to listen at"),
        ("198.51.100.7", "--host '198.51.100.7' is no address of this machine"),
    ],
)  # fmt: skip
def test_hosts_that_are_none(host: str, told: str) -> None:
    with pytest.raises(InputError, match=re.escape(told)) as error:
        listen(host, 0)
    assert "--port" not in str(error.value)


def test_a_port_that_is_taken() -> None:
    with listen("127.0.0.1", 0) as listening:
        listening.listen()
        with pytest.raises(InputError, match="take another --port"):
            listen("127.0.0.1", listening.getsockname()[1])


def test_small_packets_are_sent_at_once() -> None:
    """Else every response waits 40 ms: asyncio switches Nagle's algorithm off for TCP only."""
    with listen("127.0.0.1", 0) as listening:
        assert listening.proto == socket.IPPROTO_TCP
