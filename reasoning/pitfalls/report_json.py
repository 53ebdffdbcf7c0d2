"""What a scan found as JSON, for programs; ``baseline.py`` reads it."""

from __future__ import annotations

import json
from dataclasses import fields
from pathlib import Path
from typing import Any

from symboslam import __version__
from symboslam.reasoning.pitfalls.model import Occurrence, Report, Result, Settings
from symboslam.reasoning.pitfalls.report import counts


def render(report: Report) -> str:
    """The report as JSON: ``ontology``, and ``pitfalls`` with all 41 by code."""
    found = {
        "ontology": report.ontology,
        "files": list(report.files),
        "version": __version__,
        "settings": _settings(report.settings),
        "summary": counts(report),
        "out_of_time": report.out_of_time,
        "notes": list(report.notes),
        "pitfalls": [_pitfall(result) for result in report.results],
    }
    return json.dumps(found, indent=1, ensure_ascii=False) + "\n"


def _settings(settings: Settings) -> dict[str, Any]:
    values = {field.name: getattr(settings, field.name) for field in fields(settings)}
    return {n: v.as_posix() if isinstance(v, Path) else v for n, v in values.items()}


def _pitfall(result: Result) -> dict[str, Any]:
    pitfall = result.pitfall
    return {
        "code": pitfall.code,
        "title": pitfall.title,
        "severity": str(pitfall.severity),
        "status": str(result.status),
        "reason": result.reason,
        "advisory": pitfall.advisory,
        "affected": [_affected(result, o) for o in result.occurrences],
    }


def _affected(result: Result, o: Occurrence) -> dict[str, Any]:
    finding = o.finding
    return {
        "iri": o.iri,
        "file": o.place.file,
        "line": o.place.line,
        "message": finding.message,
        "elements": list(map(str, finding.elements)),
        "variant": finding.variant,
        "axiom": o.axiom,
        "mend": finding.mend or result.pitfall.remedy,
        "accepted": o.accepted,
        "known": o.known,
    }
