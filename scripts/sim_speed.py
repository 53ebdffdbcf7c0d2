"""Figures of whole missions: sim_speed.py [WORLD:ROBOTS:MINUTES ...], a row of a table for each."""

from __future__ import annotations

import json
import os
import platform
import resource
import subprocess
import sys
import time

RUNS = ("city:3:40", "city:10:10", "kingston:3:14.6", "demo:3:5")
HEAD = (
    "| world | robots | min | times real time | by processor | coverage | found | landmarks | "
    "mean error m | grid IoU | AP | branch IoU | AP | map building s | peak MB |"
)


def measure(text: str, *options: str) -> str:
    """A row of the table."""
    world, robots, minutes = text.split(":")
    command = [
        sys.executable, "-m", "symboslam", "sim", "run", world, "--robots", robots,
        "--time-limit", minutes, "--json", *options,
    ]  # fmt: skip
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
    done = subprocess.run(command, stdout=subprocess.PIPE, check=True)
    peak = max(before, resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss) / 1024
    m = json.loads(done.stdout)
    slam = m["slam"]
    error = slam["landmark_mean_m"]
    scores = [
        f"{m['map'][name]['all'][figure]:.3f}" if name in m["map"] else ""
        for name in ("grid", "branch")
        for figure in ("mean_iou", "mean_ap")
    ]
    cells = [
        m["world"], robots, f"{m['time_s'] / 60:.1f}", f"{m['real_time_factor']:.1f}",
        f"{m['time_s'] / max(m['processor_s'], 1e-9):.1f}", f"{m['coverage']:.1%}",
        f"{m['objects_found']} of {m['objects']}", str(slam["landmarks_mapped"]),
        "" if error is None else f"{error:.2f}", *scores, f"{slam['seconds']:.0f}", f"{peak:.0f}",
    ]  # fmt: skip
    return "| " + " | ".join(cells) + " |"


def main() -> None:
    """Print a table; arguments that begin with -- are options of ``symboslam sim run``."""
    options = [a for a in sys.argv[1:] if a.startswith("--") and "=" in a]
    runs = [a for a in sys.argv[1:] if a not in options] or list(RUNS)
    print(
        f"{time.strftime('%Y-%m-%d')}, {platform.machine()}, {os.cpu_count()} processors, load "
        f"{os.getloadavg()[0]:.1f} at the beginning, Python {platform.python_version()}"
        f"{', ' + ' '.join(options) if options else ''}\n"
    )
    print(HEAD)
    print("|" + "---|" * (HEAD.count("|") - 1))
    for text in runs:
        print(measure(text, *options), flush=True)


if __name__ == "__main__":
    main()
