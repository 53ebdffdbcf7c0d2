"""A real store elsewhere for the tests: Apache Jena Fuseki in memory, at a free port."""

import os
import socket
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import httpx
import pytest

SCRIPT = Path(__file__).parents[2] / "scripts" / "fuseki"
CANNOT = 3  # the script's exit code where Fuseki cannot be run here
UNION = "urn:x-arq:UnionGraph,urn:x-arq:DefaultGraph"
QUERY_SECONDS = 4  # its own limit, so that nothing goes on after a test
_ATTEMPTS = 3  # a port that was free may be taken


@contextmanager
def fuseki(folder: Path) -> Iterator[str]:
    """Fuseki with an empty dataset, whose query endpoint this yields; skips where it cannot run."""
    for _ in range(_ATTEMPTS):
        port = _free_port()
        process = _start(folder, port)
        try:
            if _wait(process, url := f"http://127.0.0.1:{port}/ds/sparql"):
                yield url
                return
        finally:
            process.kill()
            process.wait()
        said = (folder / "fuseki.log").read_text()
        if process.returncode == CANNOT:
            pytest.skip(said.strip().rpartition("\n")[2])
        if "UnsupportedClassVersionError" in said:
            pytest.skip("Fuseki needs Java 17 or newer")
        if "in use" not in said:
            break
    pytest.fail(f"Fuseki did not start: {said}")


def _free_port() -> int:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        return int(taken.getsockname()[1])


def _start(folder: Path, port: int) -> "subprocess.Popen[bytes]":
    options = ["--mem", "--localhost", f"--port={port}", f"--timeout={QUERY_SECONDS * 1000}"]
    java = "-Xmx512m -XX:+UseSerialGC -XX:TieredStopAtLevel=1"
    environment = {**os.environ, "FUSEKI_BASE": str(folder / "run"), "FUSEKI_JAVA_ARGS": java}
    with (folder / "fuseki.log").open("wb") as log:
        return subprocess.Popen(
            [SCRIPT, *options, "/ds"], cwd=folder, env=environment, stdout=log, stderr=log
        )


def _wait(process: "subprocess.Popen[bytes]", url: str) -> bool:
    """Whether it answers, sooner or later; not if it ends."""
    while process.poll() is None:
        try:
            if httpx.get(url, params={"query": "ASK {}"}).is_success:
                return True
        except httpx.TransportError:
            time.sleep(0.05)
    return False
