"""``python -m bench``: measure and write the report."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from datetime import UTC, datetime
from pathlib import Path

from bench import cases
from bench.evaluation import evaluation
from bench.explanations import explanations
from bench.ingest import ingest
from bench.measure import machine
from bench.pitfalls import pitfalls
from bench.queries import queries
from bench.ready import ready
from bench.reasoning import reasoning
from bench.segmentation import segmentation
from bench.slam import slam

CASES: dict[str, tuple[Callable[[], str], Callable[[], str]]] = {
    # name: (full size, toy size)
    "evidence": (
        lambda: cases.evidence((100, 300, 1000, 3000, 5000)),
        lambda: cases.evidence((20, 60)),
    ),
    "classification": (
        lambda: cases.classification((1500.0, 3000.0, 4500.0)),
        lambda: cases.classification((1000.0,)),
    ),
    "growth": (
        lambda: cases.growth((10_000, 100_000, 1_000_000)),
        lambda: cases.growth((300, 900)),
    ),
    "explanations": (lambda: explanations(4000.0, 12), lambda: explanations(1000.0, 60)),
    "segmentation": (
        lambda: segmentation((1_000, 10_000, 100_000), (300, 1000, 3000)),
        lambda: segmentation((300, 900), (60,)),
    ),
    "slam": (lambda: slam(5, 3000), lambda: slam(1, 60, tiny=True)),
    "start-up": (lambda: cases.start_up(11), lambda: cases.start_up(1)),
    "evaluation": (
        lambda: evaluation((24, 200, 800), 3000),
        lambda: evaluation((6, 12), 20),
    ),
    "knowledge": (cases.knowledge, cases.knowledge),
    "reasoning": (lambda: reasoning(5), lambda: reasoning(1)),
    "pitfalls": (
        lambda: pitfalls((10_000, 30_000, 100_000, 300_000), 5),
        lambda: pitfalls((500, 1000), 1),
    ),
    "queries": (
        lambda: queries(8, 1000.0, 2.0, 60.0),
        lambda: queries(0, 1000.0, 0.1, 20.0, peers=False),
    ),
    "ready": (lambda: ready((8, 18), 1000.0, 7), lambda: ready((0,), 1000.0, 1)),
    "ingest": (lambda: ingest(6600.0, 60), lambda: ingest(1000.0, 1)),
}

MARKS = "<!-- bench -->", "<!-- end of bench -->"


def main(arguments: list[str] | None = None) -> None:
    """Run the chosen cases one after the other."""
    parser = argparse.ArgumentParser(prog="python -m bench", description=__doc__)
    parser.add_argument("--out", type=Path, help="file to write; standard output if left out")
    parser.add_argument(
        "--into", type=Path, help=f"page to write into, between {MARKS[0]} and {MARKS[1]}"
    )
    parser.add_argument("--tiny", action="store_true", help="toy sizes: does everything still run?")
    parser.add_argument("--only", choices=CASES, action="append", help="this case alone")
    chosen = parser.parse_args(arguments)
    if chosen.into is not None:
        around(chosen.into)
    command = " ".join(["python -m bench", *(f"--only {name}" for name in chosen.only or ())])
    made = f"`{command} --into docs/{chosen.into.name}`" if chosen.into else "`make bench`"
    parts = [
        *([] if chosen.into else ["# How fast, how large"]),
        f"Made by {made}. Do not edit.",
        "\n".join(
            f"- {line}" for line in (f"Date: {datetime.now(UTC):%Y-%m-%d %H:%M} UTC", *machine())
        ),
    ]
    if chosen.tiny:
        parts.append("**Toy sizes: these figures say nothing about speed.**")
    for name in chosen.only or CASES:
        print(f"{name} ...", file=sys.stderr, flush=True)
        parts.append(CASES[name][chosen.tiny]())
    text = "\n\n".join(parts) + "\n"
    if chosen.into is not None:
        write_into(chosen.into, text)
    elif chosen.out is None:
        print(text)
    else:
        chosen.out.write_text(text, encoding="utf-8")
        print(f"wrote {chosen.out}", file=sys.stderr)


def around(page: Path) -> tuple[str, str]:
    """What a page says up to the first mark, and from the second on; ends if one is missing."""
    before, mark, rest = page.read_text(encoding="utf-8").partition(MARKS[0])
    _, end, after = rest.partition(MARKS[1])
    if not mark or not end:
        sys.exit(f"{page}: the marks {MARKS[0]} and {MARKS[1]} are missing")
    return before + mark, end + after


def write_into(page: Path, text: str) -> None:
    """Put a report between the marks of a page."""
    before, after = around(page)
    page.write_text(f"{before}\n\n{text}\n{after}", encoding="utf-8")
    print(f"wrote into {page}", file=sys.stderr)


if __name__ == "__main__":
    main()
