"""The example queries over HTTP: our service, Apache Jena Fuseki and rdflib-endpoint, in turns."""

from __future__ import annotations

import json
import math
import shutil
import statistics
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import dataclass, field
from pathlib import Path
from threading import Thread

from bench.maps import maps
from bench.measure import table
from bench.servers import (
    GRAPH,
    SELECT,
    Server,
    UnavailableError,
    fuseki,
    rdflib_endpoint,
    symboslam,
)

TRIVIAL = "ASK {}"
_PLACES = 9  # of numbers that are compared: stores add up in other orders


@dataclass
class Timed:
    """What one server did with one query.

    Attributes:
        seconds: of each answer.
        answer: its lines, in no order; None: it was stopped.
    """

    seconds: list[float] = field(default_factory=list)
    answer: Counter[str] | None = None

    @property
    def rate(self) -> float:
        """Answers in a second."""
        return len(self.seconds) / sum(self.seconds)


def queries(towns: int, size_m: float, seconds: float, limit: float, peers: bool = True) -> str:
    """The examples on several maps.

    Args:
        towns: maps besides the two of which the examples speak.
        size_m: their size.
        seconds: how long each query is repeated at each server.
        limit: how long one answer may take.
        peers: whether other servers are asked, too.
    """
    from symboslam.service.examples import examples

    folder = maps(towns, size_m)
    file = folder / "maps.nq"
    with file.open("rb") as lines:
        size = sum(1 for _ in lines)
    with ExitStack() as stack:
        work = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        servers = [stack.enter_context(symboslam(copied(folder / "data", work)))]
        missing = []
        starts = (fuseki(work, file), rdflib_endpoint(file)) if peers else ()
        for start in starts:
            try:
                servers.append(stack.enter_context(start))
            except UnavailableError as error:
                missing.append(str(error))
        rows: list[list[object]] = []
        ratios: dict[str, list[float]] = {server.name: [] for server in servers[1:]}
        notes: list[str] = missing
        for example in examples():
            found = {s.name: measure(s, example.query, seconds, limit) for s in servers}
            ours = found[servers[0].name]
            row: list[object] = [f"`{example.name}`", _lines(ours), f"{_ms(ours):.1f}"]
            for server in servers[1:]:
                peer = found[server.name]
                geo = "geof:" in example.query
                same = peer.answer is None or peer.answer == ours.answer
                if geo and not same:
                    row += ["", "no GeoSPARQL"]
                    continue
                if not same:
                    notes.append(f"`{example.name}`: {server.name} answers differently")
                stopped = peer.answer is None
                ratio = ours.rate / peer.rate
                ratios[server.name].append(ratio)
                row += [f"{'over ' if stopped else ''}{_ms(peer):.1f}", f"{ratio:.2f}"]
            rows.append(row)
            print(*row, file=sys.stderr, flush=True)
        overhead = _overhead(servers, seconds)
    head = ["query", "lines", "ours ms"]
    last: list[object] = ["geometric mean", "", ""]
    for server in servers[1:]:
        head += [f"{server.name} ms", "times as fast"]
        values = ratios[server.name]
        last += ["", f"{math.exp(statistics.fmean(map(math.log, values))):.2f}"]
        notes.append(
            f"{server.name}: {len(values)} queries compared, from {min(values):.2f} to "
            f"{max(values):.2f} times as fast; "
            f"{sum(v < 1 / 1.5 for v in values)} below 1 / 1.5"
        )
    return (
        f"## The example queries at {size:,} triples\n\n"
        f"{towns + 2} maps. One client on the same machine, one connection, answers as JSON or "
        "N-Triples; milliseconds are the inverse of the throughput. The servers are asked in "
        f"turns: each query once to warm up, then {seconds:g} s long, 3 times or more; an answer "
        f"after {limit:g} s counts as one in {limit:g} s. Answers are compared line by "
        "line. Where a server lacks GeoSPARQL's functions, the query does not count for it.\n\n"
        + table(head, [*rows, last])
        + "\n\n"
        + "\n".join(f"- {note}" for note in notes)
        + f"\n\n### What every request costs (`{TRIVIAL}`)\n\n"
        + overhead
    )


def measure(server: Server, query: str, seconds: float, limit: float) -> Timed:
    """Ask a query again and again."""
    timed = Timed()
    accept = GRAPH if "CONSTRUCT" in query or "DESCRIBE" in query else SELECT
    try:
        timed.answer = lines_of(server.ask(query, accept, limit), accept)
        until = time.perf_counter() + seconds
        while len(timed.seconds) < 3 or time.perf_counter() < until:
            start = time.perf_counter()
            server.ask(query, accept, limit)
            timed.seconds.append(time.perf_counter() - start)
            if timed.seconds[-1] > seconds:
                break
    except TimeoutError:
        timed.seconds, timed.answer = [limit], None
        server.again()
    return timed


def lines_of(answer: bytes, accept: str) -> Counter[str]:
    """The solutions or triples of an answer, so that two servers' can be compared."""
    if accept == GRAPH:
        return Counter(line for line in answer.decode().splitlines() if line.strip())
    found = json.loads(answer)
    if "boolean" in found:
        return Counter([str(found["boolean"])])
    return Counter(
        json.dumps(sorted((name, _value(term)) for name, term in solution.items()))
        for solution in found["results"]["bindings"]
    )


def _value(term: dict[str, str]) -> str:
    """A term; numbers and times by their value, blank nodes all alike."""
    if term["type"] == "bnode":
        return "_"
    try:
        return f"{float(term['value']):.{_PLACES}g}"
    except ValueError:
        return term["value"].replace("+00:00", "Z")


def _overhead(servers: Sequence[Server], seconds: float) -> str:
    rows = []
    for server in servers:
        alone = _clients(server, 1, seconds)
        four = _clients(server, 4, seconds)
        cuts = statistics.quantiles(alone, n=20)
        rows.append(
            [server.name, f"{statistics.median(alone) * 1000:.2f}", f"{cuts[-1] * 1000:.2f}",
             f"{len(alone) / seconds:.0f}", f"{len(four) / seconds:.0f}"]
        )  # fmt: skip
    head = ("server", "p50 ms", "p95 ms", "a second, 1 client", "a second, 4 clients")
    return table(head, rows)


def _clients(server: Server, number: int, seconds: float) -> list[float]:
    """Seconds of each request that so many clients get through in a time."""
    found: list[float] = []

    def run() -> None:
        own = Server(server.name, server.port, server.path, server.process)
        own.ask(TRIVIAL, SELECT)
        until = time.perf_counter() + seconds
        while (start := time.perf_counter()) < until:
            own.ask(TRIVIAL, SELECT)
            found.append(time.perf_counter() - start)
        own.close()

    threads = [Thread(target=run) for _ in range(number)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return found


def copied(data: Path, folder: Path) -> Path:
    """A copy of a data folder, so that the one that is kept stays as it is."""
    return Path(shutil.copytree(data, folder / "data"))


def _ms(timed: Timed) -> float:
    return 1000 / timed.rate


def _lines(timed: Timed) -> object:
    return "stopped" if timed.answer is None else f"{timed.answer.total():,}"
