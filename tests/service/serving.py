"""``symboslam serve`` in a process of its own, and how much memory it and its workers take."""

import os
import socket
import subprocess
import sys
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import httpx

_PAGE = os.sysconf("SC_PAGE_SIZE")


@dataclass
class Served:
    """A server.

    Attributes:
        url: its address.
        process: it.
    """

    url: str
    process: "subprocess.Popen[bytes]"

    @property
    def alive(self) -> bool:
        """Whether it runs."""
        return self.process.poll() is None

    def memory(self) -> int:
        """Bytes of memory of it and all its children (where there is ``/proc``)."""
        return sum(map(_resident, [self.process.pid, *_children(self.process.pid)]))


def _children(pid: int) -> list[int]:
    found: list[int] = []
    for file in Path(f"/proc/{pid}/task").glob("*/children"):
        try:
            found += map(int, file.read_text().split())
        except OSError:  # a thread that has ended
            continue
    return found


def _resident(pid: int) -> int:
    try:
        return int(Path(f"/proc/{pid}/statm").read_text().split()[1]) * _PAGE
    except (OSError, IndexError):  # it has ended
        return 0


@contextmanager
def serving(data: Path, settings: Mapping[str, object]) -> Iterator[Served]:
    """Run ``symboslam serve`` with some variables."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    environment = {**os.environ, **{name: str(value) for name, value in settings.items()}}
    command = [
        sys.executable, "-m", "symboslam", "serve", "--data", str(data), "--port", str(port),
    ]  # fmt: skip
    with (data.parent / f"{data.name}.log").open("wb") as log:
        process = subprocess.Popen(command, env=environment, stdout=log, stderr=log)
        try:
            served = Served(f"http://127.0.0.1:{port}", process)
            while True:
                assert served.alive, "the server did not start"
                try:
                    if httpx.get(f"{served.url}/readyz").status_code == 200:
                        break
                except httpx.TransportError:
                    time.sleep(0.05)
            yield served
        finally:
            process.terminate()
            process.wait(30)
