"""Print a comparison with upstream: as text, as JSON, or as a Markdown table."""

from __future__ import annotations

import json
from itertools import groupby

from symboslam.reasoning.fidelity import Comparison, Finding, Status


def as_text(found: Comparison) -> str:
    """One line a term under each status, changes first."""
    lines = [*_head(found)]
    for status, group in groupby(found.findings, key=lambda finding: finding.status):
        findings = list(group)
        lines += ["", f"{status.value} ({len(findings)})"]
        if status is Status.NOT_SUPPLIED:
            lines += _not_supplied(findings)
            continue
        width = max(len(finding.term.name) for finding in findings)
        for finding in findings:
            parts = (f"{finding.term.name:{width}}", _where(finding), finding.note)
            lines.append("  " + "  ".join(part for part in parts if part))
    return "\n".join(lines)


def as_markdown(found: Comparison) -> str:
    """A table with a row for each term, changes first."""
    head, *rest = _head(found)
    lines = [
        head,
        "",
        *(f"- {name.strip()}" for name in rest),
        "",
        "| status | term | our module | upstream file | note |",
    ]
    lines.append("|---|---|---|---|---|")
    for finding in found.findings:
        term = finding.term
        cells = (
            finding.status.value,
            f"[{term.name}]({term.iri})",
            term.module,
            ", ".join(finding.files),
            finding.note,
        )
        lines.append("| " + " | ".join(_cell(cell) for cell in cells) + " |")
    return "\n".join(lines)


def as_json(found: Comparison) -> str:
    """``{"folder", "files", "ok", "counts", "terms": [...]}``."""
    terms = [
        {
            "iri": finding.term.iri,
            "name": finding.term.name,
            "kind": finding.term.kind,
            "status": finding.status.value,
            "module": finding.term.module,
            "files": list(finding.files),
            "unexpanded_iri": finding.literally or None,
            "upstream_label": finding.term.label or None,
            "note": finding.note,
        }
        for finding in found.findings
    ]
    whole = {
        "folder": str(found.folder),
        "files": list(found.files),
        "ok": found.ok,
        "counts": found.counts,
        "terms": terms,
    }
    return json.dumps(whole, indent=2, ensure_ascii=False)


def _head(found: Comparison) -> list[str]:
    counts = ", ".join(f"{number} {status}" for status, number in found.counts.items() if number)
    files = f"{len(found.files)} upstream file{'' if len(found.files) == 1 else 's'}"
    return [
        f"{len(found.findings)} reused terms, {files} in {found.folder}: {counts}",
        *(f"  {name}" for name in found.files),
    ]


def _where(finding: Finding) -> str:
    """The upstream files that hold a term, or else our module that reuses it."""
    return ", ".join(finding.files) or f"reused in {finding.term.module}"


def _not_supplied(findings: list[Finding]) -> list[str]:
    return [
        f"  {module}: no file holds any of its {len(list(terms))} terms; they were not compared"
        for module, terms in groupby(findings, key=lambda finding: finding.term.module)
    ]


def _cell(text: str) -> str:
    return text.replace("|", r"\|").replace("\n", " ")
