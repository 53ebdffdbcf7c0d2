"""Timing: of calls, and of whole processes with their peak memory."""

from __future__ import annotations

import os
import platform
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Any, TypeVar

import symboslam

Result = TypeVar("Result")
LAUNCH = Path(__file__).with_name("launch.py")
PACKAGES = (
    "numpy", "scipy", "scikit-learn", "shapely", "pyproj", "rdflib", "owlready2", "matplotlib",
    "typer",
)  # fmt: skip


@dataclass(frozen=True)
class Run:
    """One finished process: wall-clock seconds, peak resident megabytes, standard output."""

    seconds: float
    peak_mb: float
    output: str


def call(
    function: Callable[..., Result],
    *arguments: Any,
    repeat: int = 1,
    cpu: bool = False,
    **options: Any,
) -> tuple[float, Result]:
    """Median seconds of calling a function ``repeat`` times, and what it returned.

    ``cpu`` counts processor time, which other processes on the machine do not lengthen.
    """
    clock = time.process_time if cpu else time.perf_counter
    seconds = []
    for _ in range(repeat):
        start = clock()
        result = function(*arguments, **options)
        seconds.append(clock() - start)
    return statistics.median(seconds), result


def process(command: Sequence[str], environment: dict[str, str] | None = None) -> Run:
    """Run a command to its end; peak memory is that of the largest process in it.

    Raises:
        RuntimeError: it failed; the message holds what it wrote.
    """
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "report"
        done = subprocess.run(
            [sys.executable, "-I", "-S", str(LAUNCH), str(report), *command],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            env={**os.environ, **(environment or {})},
            check=True,
        )
        seconds, peak, code = report.read_text().split()
    if code != "0":
        raise RuntimeError(f"{' '.join(command)}: exit code {code}\n{done.stdout}")
    unit = 1 if sys.platform == "darwin" else 1024  # bytes there, else kB
    return Run(float(seconds), int(peak) * unit / 1e6, done.stdout)


def machine() -> list[str]:
    """What was measured on, one line each."""
    model = ""
    info = Path("/proc/cpuinfo")
    if info.exists():
        names = [line for line in info.read_text().splitlines() if line.startswith("model name")]
        model = f", {names[0].partition(':')[2].strip()}" if names else ""
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 1e9
    packages = ", ".join(f"{name} {version(name)}" for name in PACKAGES)
    return [
        f"Machine: {os.cpu_count()} processors{model}, {memory:.0f} GB, {platform.system()}",
        f"Python {platform.python_version()}, symboslam {symboslam.__version__}, {packages}",
    ]


def table(head: Sequence[str], rows: Sequence[Sequence[object]]) -> str:
    """A Markdown table, numbers to the right."""
    lines = [head, ["---"] + ["---:"] * (len(head) - 1), *rows]
    return "\n".join(f"| {' | '.join(map(str, line))} |" for line in lines)
