"""``symboslam agent edge``: map what one robot drives and sees, and send it."""

from __future__ import annotations

import math
import sys
from collections.abc import Iterator
from datetime import UTC, datetime
from pathlib import Path
from secrets import token_hex
from typing import Annotated, Any

import typer

from symboslam.cli.agent_stop import Stop, leaving
from symboslam.cli.client import TimeoutOption, TokenOption
from symboslam.cli.common import OntologyOption, Progress, load_knowledge, progress_bar
from symboslam.cli.slam_common import needs_slam
from symboslam.errors import InputError, ServiceError

EXAMPLES = """
[bold]Examples[/]

symboslam agent edge drive.ndjson --robot r1 --map 7f3a --to http://127.0.0.1:8080 --start 0,0,90

ros-to-lines | symboslam agent edge - --robot r2 --map 7f3a --to https://maps.example/town
"""
_MIB = 1024 * 1024
_GRACE = 5.0
"""Seconds in which an agent that is stopped still delivers what it can."""
ToOption = Annotated[str, typer.Option("--to", metavar="URL", help="Address of the service.")]
QuietOption = Annotated[bool, typer.Option("--quiet", "-q", help="Tell only what is odd.")]


def edge(
    log: Annotated[
        str,
        typer.Argument(
            metavar="LOG",
            help="What the robot wrote down, a line of JSON for each record; - is standard input, "
            "from a robot that drives. Or a file or folder that `symboslam slam` reads.",
        ),
    ],
    robot: Annotated[str, typer.Option(metavar="NAME", help="Its name; no other has it.")],
    map_: Annotated[str, typer.Option("--map", metavar="ID", help="A map that is there.")],
    to: ToOption,
    start: Annotated[
        str | None,
        typer.Option(
            metavar="X,Y,DEGREES",
            help="Where its odometry began: metres east and north of the map's origin, and its "
            "heading from east to north.",
            show_default="what the log says",
        ),
    ] = None,
    every: Annotated[
        float, typer.Option(metavar="SECONDS", min=0.1, help="Of the log, between increments.")
    ] = 2.0,
    speed: Annotated[
        float | None,
        typer.Option(
            metavar="N",
            min=1e-3,
            help="Replay so many times faster than the robot drove.",
            show_default="as fast as possible",
        ),
    ] = None,
    sigma_range: Annotated[
        float | None,
        typer.Option(
            metavar="METRES",
            min=1e-6,
            help="Standard deviation of ranges.",
            show_default="0.5, or what the log says",
        ),
    ] = None,
    sigma_bearing: Annotated[
        float | None,
        typer.Option(
            metavar="RADIANS",
            min=1e-6,
            help="Standard deviation of bearings.",
            show_default="0.02, or what the log says",
        ),
    ] = None,
    run: Annotated[
        str | None,
        typer.Option(
            metavar="NAME",
            help="Of this run; a log that is sent again counts as another one.",
            show_default="made from the log",
        ),
    ] = None,
    spool: Annotated[
        Path, typer.Option(metavar="DIR", help="Where increments wait while the link is down.")
    ] = Path("symboslam-spool"),
    spool_limit: Annotated[
        int, typer.Option(metavar="MIB", min=1, help="What may wait there at most.")
    ] = 1024,
    wait: Annotated[
        float | None,
        typer.Option(
            metavar="SECONDS",
            min=0,
            show_default="no limit",
            help="How long to wait for the service after the end of the log.",
        ),
    ] = None,
    ontology: OntologyOption = None,
    token: TokenOption = None,
    timeout: TimeoutOption = 30.0,
    quiet: QuietOption = False,
) -> None:
    """Map what one robot drives and sees, and send it to a map of a service.

    What is mapped is on the disk before it is sent, and is deleted when the service has it: the
    link may be down, the service and this agent may be killed. A replay that was cut short goes on
    where it was when it is started again. Exit code 0: all is delivered; 2: the log is wrong, or
    the service refuses it; 3: it was not delivered in time and waits in the spool.
    """  # fmt: skip
    from symboslam import __version__

    with needs_slam():
        from symboslam.engine.slam.edge import EdgeMapper
        from symboslam.engine.slam.readers import records
        from symboslam.sim_bridge.agents import replay
        from symboslam.sim_bridge.agents.classes import Classes
        from symboslam.sim_bridge.agents.edge import EdgeAgent
        from symboslam.sim_bridge.agents.link import Link
        from symboslam.sim_bridge.agents.sender import Sender, check_map
        from symboslam.sim_bridge.agents.spool import Spool

    live, begin, link = log == "-", _start(start), Link(to, token, timeout)
    if run is None and live:
        run = f"{datetime.now(UTC):%Y%m%dT%H%M%SZ}-{token_hex(3)}"
    elif run is None:
        how = (begin, every, sigma_range, sigma_bearing, ontology, __version__)
        run = replay.run_of(Path(log), robot, map_, *how)
    stop = Stop()
    with leaving(), progress_bar(quiet or live) as progress:
        knowledge = load_knowledge(ontology, progress)
        with stop.possible():
            check_map(link, map_, tell)
        waiting = Spool(spool, robot, map_, spool_limit * _MIB)
        sender = Sender(waiting, link, map_, tell)
        sender.start()
        try:
            if waiting.begin(run):
                classes, known = Classes.of(knowledge), dict[str, Any]()
                if live or not replay.is_mission(Path(log)):
                    source = records.read(_lines(log, progress), log, tell)
                else:
                    source, known = replay.read(Path(log), robot, knowledge, tell)
                given = {"start": begin, "sigma_range": sigma_range, "sigma_bearing": sigma_bearing}
                known |= {name: value for name, value in given.items() if value is not None}
                mapper = EdgeMapper(robot, classes.names, classes.dynamic, run=run, **known)
                agent = EdgeAgent(
                    mapper, waiting, knowledge.index_of, every, tell, lambda: stop.wanted
                )
                paced_source = iter(replay.paced(source, None if live else speed))
                try:
                    while True:
                        with stop.possible():
                            record = next(paced_source, None)
                        if record is None:
                            break
                        agent.feed(record)
                        sender.check()
                except KeyboardInterrupt:
                    if live:
                        agent.end()
                        sender.empty(_GRACE)
                    raise
                agent.end()
            else:
                tell(f"run {run} was mapped before; --run NAME sends it again as another one")

            def waited(left: int) -> None:
                stop.check()
                progress(f"{left} to send", 1.0)

            done = sender.empty(wait, waited)
        finally:
            sender.stop()
            if waiting.waiting:
                tell(f"{waiting.waiting} increments wait in {spool}; the next start sends them")
            waiting.close()
            link.close()
    if not done:
        raise ServiceError(f"{to} has not taken everything within {wait:g} seconds")
    if sender.refused:
        raise InputError(f"{sender.refused} increments were refused; they lie in {spool}")
    if not quiet:
        tell(f"robot {robot}: run {run} is delivered")


def tell(line: str) -> None:
    """Say something on standard error."""
    print(f"symboslam: {line}", file=sys.stderr, flush=True)


def _start(text: str | None) -> tuple[float, float, float] | None:
    """x, y in metres and the heading in radians of ``X,Y,DEGREES``.

    Raises:
        InputError: not three numbers.
    """
    if text is None:
        return None
    try:
        x, y, degrees = (float(v) for v in text.replace(" ", "").split(","))
        if not all(map(math.isfinite, (x, y, degrees))):
            raise ValueError
    except ValueError:
        raise InputError(f"--start {text!r}: give three numbers X,Y,DEGREES") from None
    return x, y, math.radians(degrees)


def _lines(log: str, progress: Progress) -> Iterator[str]:
    """The lines of a log.

    Raises:
        InputError: it cannot be read.
    """
    if log == "-":
        for line in sys.stdin.buffer:
            yield line.decode(errors="replace")
        return
    try:
        with Path(log).open("rb") as file:
            size, read = max(Path(log).stat().st_size, 1), 0
            for number, line in enumerate(file):
                read += len(line)
                if number % 256 == 0:
                    progress("mapping", read / size)
                yield line.decode(errors="replace")
    except OSError as error:
        raise InputError(f"{log} cannot be read: {error.strerror or error}") from error
