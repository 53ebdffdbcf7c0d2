"""Scan our own ontology for pitfalls and write the reports, module by module and as a whole.

    pitfall_reports.py [--out pitfall_reports] [--upstream FOLDER]

With a folder of published ontologies their counts go into docs/upstream-pitfalls.md.
"""

from __future__ import annotations

import argparse
import os
import platform
import sys
from collections.abc import Iterable, Mapping
from datetime import UTC, datetime
from pathlib import Path

import symboslam
from symboslam.reasoning.pitfalls.model import Report, Result, Settings, Severity, Status
from symboslam.reasoning.pitfalls.report import render
from symboslam.reasoning.pitfalls.scan import scan_pitfalls
from symboslam.reasoning.sources import closure_files
from symboslam.reasoning.vocabulary import local_name

ROOT = Path(__file__).resolve().parents[1]
OUT = ROOT / "pitfall_reports"
PAGE = ROOT / "docs" / "upstream-pitfalls.md"
FORMATS = {"md": "md", "json": "json", "sarif": "sarif", "rdf": "oops-rdf"}
WHOLE = "closure"
MARKS = {Status.NOT_CHECKED: "-", Status.ERRORED: "error"}
UPSTREAM = ("SymboSLAM.owl", "ontoSLAM.owl", "Onto4MAT.owl")


def main() -> int:
    """Write all reports; 1 if our ontology has a pitfall that is not accepted with a reason."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--out", type=Path, default=OUT)
    parser.add_argument("--upstream", type=Path)
    chosen = parser.parse_args()
    reports = scan_all()
    write(reports, chosen.out)
    print(f"wrote {len(reports) * len(FORMATS) + 1} files into {chosen.out}")
    if chosen.upstream and chosen.upstream.is_dir():
        text = upstream_page(chosen.upstream, reports[WHOLE])
        if not PAGE.is_file() or undated(PAGE.read_text(encoding="utf-8")) != undated(text):
            PAGE.write_text(text, encoding="utf-8")
        print(f"{PAGE} is up to date")
    failing = [
        f"{o.place}: {o.iri}: {o.finding.message}"
        for report in reports.values()
        for o in report.failing(Severity.MINOR)
    ]
    print("\n".join(failing))
    return int(bool(failing))


def scan_all() -> dict[str, Report]:
    """Name -> report of each module, and of all modules as one ontology."""
    os.chdir(ROOT)  # places in reports are relative to the repository
    names = sorted(closure_files(), key=lambda name: (name != "symboslam.ttl", name))
    modules = {name.removesuffix(".ttl"): scan_pitfalls([f"ontology/{name}"]) for name in names}
    asked = Settings(questions=Path("competency_questions/manifest.ttl"))  # of all modules together
    return {**modules, WHOLE: scan_pitfalls([f"ontology/{name}" for name in names], asked)}


def write(reports: Mapping[str, Report], out: Path) -> None:
    """Each report in all formats, and a page that lists them; what is there from before goes."""
    for old in sorted(out.rglob("*")):
        if old.is_file() and old.suffix.lstrip(".") in FORMATS:
            old.unlink()
    for name, report in reports.items():
        for ending, form in FORMATS.items():
            path = out / f"{name}.{ending}"
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(render(report, form), encoding="utf-8")
    (out / "README.md").write_text(index(reports), encoding="utf-8")


def index(reports: Mapping[str, Report]) -> str:
    """The page that lists the reports."""
    head = ["critical", "important", "minor", "accepted with a reason", "not checked"]
    rows = [
        [f"[{name}]({name}.md)", *(str(n) for n in counts(report))]
        for name, report in sorted(reports.items(), key=lambda item: (item[0] != WHOLE, item[0]))
    ]
    return (
        "# Pitfalls in our own ontology\n\n"
        "Made by `make pitfalls`. Do not edit. Each module is scanned with what it imports, and "
        f"reports what it has a part in; `{WHOLE}` is all modules as one ontology. Beside each "
        "page stand the same results as JSON, SARIF and RDF in the vocabulary of OOPS!. What the "
        "codes mean: [docs/pitfalls.md](../docs/pitfalls.md).\n\n"
        + table(["ontology", *head], rows)
        + "\n"
    )


def counts(report: Report) -> tuple[int, ...]:
    """Findings of each severity, accepted ones, and pitfalls that were not checked."""
    found = {severity: 0 for severity in Severity}
    for result in report.results:
        found[result.pitfall.severity] += len(result.counting)
    accepted = sum(o.accepted is not None for r in report.results for o in r.occurrences)
    skipped = sum(result.status is not Status.CHECKED for result in report.results)
    return (*found.values(), accepted, skipped)


def upstream_page(folder: Path, ours: Report) -> str:
    """Counts for each code in the published ontologies and in ours, as a page."""
    os.chdir(folder)
    scans = {name: scan_pitfalls([name], follow=False) for name in UPSTREAM}
    columns = {**scans, "our closure": ours}
    rows = []
    for at, result in enumerate(ours.results):
        pitfall = result.pitfall
        cells = [cell(report.results[at]) for report in columns.values()]
        note = " (advisory)" if pitfall.advisory else ""
        rows.append([pitfall.code, pitfall.title + note, pitfall.severity, *cells])
    for severity in Severity:
        totals = [str(sum_of(report.results, severity)) for report in columns.values()]
        rows.append(["", f"**all {severity}, without advisory**", severity, *totals])
    return (
        "# Pitfalls in the published ontologies that we build on\n\n"
        f"Made by `make pitfalls`. Do not edit. {datetime.now(UTC):%Y-%m-%d}, "
        f"symboslam {symboslam.__version__}, {os.cpu_count()} processors, "
        f"{platform.system()}.\n\n"
        "The files as published, each scanned alone by our rules; findings for each code, `-` "
        "where it was not checked. `n accepted` are findings in ours that the ontology itself "
        "accepts with a reason.\n\n"
        + table(["code", "pitfall", "severity", *columns], rows)
        + "\n\nThe critical ones:\n\n"
        + "\n".join(critical(scans))
        + "\n\nOOPS! cannot report the cycle: its check for P06 stops without a word where a class "
        "has an asserted superclass of a superclass "
        "([more](pitfalls.md#where-we-differ-from-oops-on-purpose)).\n"
    )


def undated(page: str) -> list[str]:
    """The page without the line that says when and where it was made."""
    return [line for line in page.splitlines() if not line.startswith("Made by")]


def critical(scans: Mapping[str, Report]) -> list[str]:
    """The critical findings as lines of a list."""
    return [
        f"- {o.place.file}, line {o.place.line}, {result.pitfall.code}: "
        f"{', '.join(map(local_name, o.finding.elements))}: {o.finding.message}"
        for report in scans.values()
        for result in report.results
        if result.pitfall.severity is Severity.CRITICAL and not result.pitfall.advisory
        for o in result.counting
    ]


def cell(result: Result) -> str:
    """A result in the table."""
    if result.status is not Status.CHECKED:
        return MARKS[result.status]
    counting = len(result.counting)
    accepted = len(result.occurrences) - counting
    return f"{counting}, {accepted} accepted" if accepted else str(counting)


def sum_of(results: Iterable[Result], severity: Severity) -> int:
    """Findings of a severity that count, advisory ones left out."""
    chosen = (r for r in results if r.pitfall.severity is severity and not r.pitfall.advisory)
    return sum(len(result.counting) for result in chosen)


def table(head: list[str], rows: list[list[str]]) -> str:
    """A Markdown table."""
    lines = [head, ["---"] * 2 + ["---:"] * (len(head) - 2), *rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


if __name__ == "__main__":
    sys.exit(main())
