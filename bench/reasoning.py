"""What reasoning over the whole ontology and asking all questions costs; a section in Markdown."""

from __future__ import annotations

import json
import statistics
import sys
from pathlib import Path

from bench.measure import Run, process, table

ROOT = Path(__file__).resolve().parents[1]
SYMBOSLAM = [sys.executable, "-m", "symboslam"]
SWARM = ROOT / "ontology" / "examples" / "swarm.ttl"

# Reads an ontology with all its imports and lets HermiT classify it, in a process of its own.
CLASSIFY = """
import json, resource, sys, time
from symboslam.reasoning.axioms import split
from symboslam.reasoning.hermit import Hermit
from symboslam.reasoning.sources import CLOSURE, read_closure
declared, axioms = split(read_closure([CLOSURE, *sys.argv[1:]]).graph)
triples = [*declared, *(t for axiom in axioms for t in axiom.triples)]
start = time.perf_counter()
found = Hermit().classify(triples)
seconds = time.perf_counter() - start
assert found is not None and not found.unsatisfiable, "the ontology is not sound"
unit = 1 if sys.platform == "darwin" else 1024
peak = {
    name: resource.getrusage(who).ru_maxrss * unit / 1e6
    for name, who in (("python", resource.RUSAGE_SELF), ("java", resource.RUSAGE_CHILDREN))
}
print(json.dumps({"axioms": len(axioms), "seconds": seconds, **peak}))
"""


def reasoning(repeat: int) -> str:
    """HermiT over the import closure, and the competency questions, as whole processes."""
    rows: list[list[object]] = []
    axioms = 0
    for name, data in {
        "HermiT over the whole import closure": [],
        "the same, with three robots, two operators and a swarm": [str(SWARM)],
    }.items():
        runs = [process([sys.executable, "-c", CLASSIFY, *data]) for _ in range(repeat)]
        inside = [json.loads(run.output.splitlines()[-1]) for run in runs]
        hermit = statistics.median(found["seconds"] for found in inside)
        peaks = [max(found[who] for found in inside) for who in ("python", "java")]
        rows.append([name, _median(runs), f"{hermit:.2f}", *(f"{peak:.0f}" for peak in peaks)])
        axioms = axioms or inside[0]["axioms"]
    for name, options in {
        "`symboslam cq run --no-reasoner`": ["--no-reasoner"],
        "`symboslam cq run`": [],
    }.items():
        runs = [process([*SYMBOSLAM, "cq", "run", *options]) for _ in range(repeat)]
        peak = max(run.peak_mb for run in runs)
        rows.append([name, _median(runs), "", f"{peak:.0f}", ""])
    head = ("what", "seconds", "of them HermiT with start of Java", "peak MB", "peak MB of Java")
    return (
        f"## Reasoning and questions (whole processes, medians of {repeat})\n\n"
        f"The closure is what `ontology/symboslam.ttl` imports: {axioms:,} axioms. Seconds are "
        "from the start of Python to its end, parsing included. Of questions, the peak is that of "
        "the largest process.\n\n" + table(head, rows)
    )


def _median(runs: list[Run]) -> str:
    return f"{statistics.median(run.seconds for run in runs):.2f}"
