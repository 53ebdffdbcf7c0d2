"""Servers to measure, each a process of its own, and one client for all of them."""

from __future__ import annotations

import http.client
import os
import signal
import socket
import subprocess
import sys
import time
import venv
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from importlib.metadata import version
from pathlib import Path
from typing import IO, Any
from urllib.parse import quote

from bench.maps import ROOT, cache

SECRET = "a-token-for-the-bench"
ADMIN = {"Authorization": f"Bearer {SECRET}"}
RDFLIB_ENDPOINT = "0.6.3"
SELECT, GRAPH = "application/sparql-results+json", "application/n-triples"
_FUSEKI_CANNOT = 3
_PATIENCE = 600.0  # seconds until a server has to be there


class UnavailableError(Exception):
    """A server that cannot be run here."""


@dataclass
class Server:
    """A server that runs.

    Attributes:
        name: what it is called in the report.
        port: where it listens, at 127.0.0.1.
        path: where it takes queries.
        process: it, or what started it.
        seconds: from its start to its first answer.
        control: what takes a line to start it anew, if that is possible.
    """

    name: str
    port: int
    path: str
    process: subprocess.Popen[bytes]
    seconds: float = 0.0
    control: IO[bytes] | None = None
    _connection: http.client.HTTPConnection | None = field(default=None, repr=False)

    def send(
        self,
        method: str,
        path: str,
        body: bytes | None = None,
        headers: Mapping[str, str] | None = None,
        seconds: float = 60.0,
    ) -> tuple[int, bytes]:
        """Status and body of the response to a request; the connection is kept."""
        kept = self._connection is not None
        try:
            if self._connection is None:
                self._connection = http.client.HTTPConnection("127.0.0.1", self.port)
                self._connection.connect()
                self._connection.sock.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            self._connection.sock.settimeout(seconds)
            self._connection.request(method, path, body, headers or {})
            response = self._connection.getresponse()
            content = response.read()
        except ConnectionError:
            self.close()
            if kept:  # the server has closed a connection that was idle
                return self.send(method, path, body, headers, seconds)
            raise
        except BaseException:
            self.close()
            raise
        if response.will_close:
            self.close()
        return response.status, content

    def ask(self, query: str, accept: str, seconds: float = 60.0) -> bytes:
        """The answer to a query.

        Raises:
            TimeoutError: there is none in time.
            RuntimeError: the server refuses it.
        """
        path = f"{self.path}?query={quote(query)}"
        status, content = self.send("GET", path, None, {"Accept": accept}, seconds)
        if status != http.client.OK:
            raise RuntimeError(f"{self.name}: {status} {content[:300].decode('utf-8', 'replace')}")
        return content

    def close(self) -> None:
        """Close the connection."""
        if self._connection is not None:
            self._connection.close()
            self._connection = None

    def again(self) -> None:
        """Start it anew, where its last request cannot be stopped otherwise."""
        if self.control is not None:
            self.close()
            self.control.write(b"\n")
            self.control.flush()
            _wait(self, f"{self.path}?query={quote('ASK {}')}")


@contextmanager
def symboslam(data: Path, **settings: str) -> Iterator[Server]:
    """Our service on a folder.

    Args:
        data: the folder.
        **settings: ``SYMBOSLAM_*`` without that beginning, in small letters.
    """
    port = free_port()
    given = {f"SYMBOSLAM_{name.upper()}": value for name, value in settings.items()}
    command = [sys.executable, "-m", "symboslam", "serve", "--data", data, "--port", str(port)]
    environment = {"SYMBOSLAM_ADMIN_TOKEN": SECRET, "SYMBOSLAM_LOG": "json", **given}
    with _started("symboslam", port, "/sparql", command, environment, "/readyz") as server:
        yield server


@contextmanager
def fuseki(folder: Path, file: Path) -> Iterator[Server]:
    """Fuseki in memory, with a file loaded.

    Raises:
        UnavailableError: there is no Java or no Maven.
    """
    port = free_port()
    options = ["--mem", "--localhost", f"--port={port}", "--timeout=60000"]
    command = [ROOT / "scripts" / "fuseki", *options, "/ds"]
    environment = {
        "FUSEKI_BASE": str(folder / "fuseki"),
        "FUSEKI_JAVA_ARGS": "-Xmx6g -XX:+UseParallelGC",
    }
    ready = f"/ds/sparql?query={quote('ASK {}')}"
    with _started("Fuseki", port, "/ds/sparql", command, environment, ready) as server:
        kind = {"Content-Type": "application/n-quads"}
        status, content = server.send("POST", "/ds/data", file.read_bytes(), kind, 600)
        if status >= http.client.BAD_REQUEST:
            raise RuntimeError(f"Fuseki: {status} {content[:300]!r}")
        yield server


@contextmanager
def rdflib_endpoint(file: Path) -> Iterator[Server]:
    """rdflib-endpoint with its default store, with a file loaded.

    Raises:
        UnavailableError: it cannot be installed.
    """
    python = _rdflib_python()
    port = free_port()
    command: list[Any] = [python, ROOT / "bench" / "rdflib_server.py", file, str(port)]
    process = subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL
    )
    try:
        assert process.stdin is not None
        assert process.stdout is not None
        start = time.perf_counter()
        if process.stdout.readline() != b"loaded\n":
            raise RuntimeError("rdflib-endpoint did not load the file")
        name = f"rdflib-endpoint {RDFLIB_ENDPOINT}"
        server = Server(name, port, "/", process, control=process.stdin)
        server.again()
        server.seconds = time.perf_counter() - start
        yield server
    finally:
        if process.stdin is not None:
            process.stdin.close()  # it ends, and its child
        process.wait()


@contextmanager
def _started(
    name: str, port: int, path: str, command: list[Any], given: Mapping[str, str], ready: str
) -> Iterator[Server]:
    start = time.perf_counter()
    process = subprocess.Popen(
        command, env={**os.environ, **given}, cwd=ROOT,
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    )  # fmt: skip
    server = Server(name, port, path, process)
    try:
        _wait(server, ready)
        server.seconds = time.perf_counter() - start
        yield server
    finally:
        server.close()
        process.send_signal(signal.SIGTERM)
        try:
            process.wait(30)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


def _wait(server: Server, ready: str) -> None:
    """Wait until a server answers."""
    until = time.perf_counter() + _PATIENCE
    while time.perf_counter() < until:
        if server.process.poll() is not None:
            if server.process.returncode == _FUSEKI_CANNOT:
                raise UnavailableError(f"{server.name} cannot be run here")
            raise RuntimeError(f"{server.name} ended with {server.process.returncode}")
        try:
            if server.send("GET", ready)[0] == http.client.OK:
                return
        except (OSError, http.client.HTTPException):
            pass
        time.sleep(0.005)
    raise RuntimeError(f"{server.name} does not answer")


def free_port() -> int:
    """A port where nobody listens."""
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        return int(taken.getsockname()[1])


def _rdflib_python() -> Path:
    """The Python of an environment with rdflib-endpoint, made once."""
    folder = cache() / f"rdflib-endpoint-{RDFLIB_ENDPOINT}"
    python = folder / "bin" / "python"
    if (folder / "complete").exists():
        return python
    wanted = [f"rdflib-endpoint=={RDFLIB_ENDPOINT}", "uvicorn", f"rdflib=={version('rdflib')}"]
    venv.create(folder, with_pip=True, clear=True)
    done = subprocess.run(
        [python, "-m", "pip", "install", "--quiet", *wanted],
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False,
    )  # fmt: skip
    if done.returncode:
        raise UnavailableError(f"rdflib-endpoint cannot be installed: {done.stdout[-300:]}")
    (folder / "complete").touch()
    return python
