"""What a scan found as SARIF 2.1.0, which code hosts and editors show beside the lines."""

from __future__ import annotations

import json
import re
from collections import Counter
from collections.abc import Iterator, Mapping
from hashlib import sha256
from pathlib import Path
from typing import Any
from urllib.parse import quote

from symboslam import __version__
from symboslam.reasoning.pitfalls.model import Occurrence, Pitfall, Report, Result, Severity, Status
from symboslam.reasoning.pitfalls.report import subject
from symboslam.reasoning.vocabulary import DOCUMENTS, local_name

TOOL = "SymboSLAM pitfalls"
_SCHEMA = (
    "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json"
)
_LEVELS = {Severity.CRITICAL: "error", Severity.IMPORTANT: "warning", Severity.MINOR: "note"}
_PROBLEMS = {"error": "error", "warning": "warning", "note": "recommendation"}
_ROOT = "%SRCROOT%"


def render(report: Report) -> str:
    """The report as SARIF.

    Advisory pitfalls have the level ``note``, whatever their severity, so that they fail nothing.
    What the ontology accepts is suppressed, with the reason as justification. If the report was
    compared with a baseline, its findings are ``unchanged``, others ``new``.
    """
    run = {
        "tool": {
            "driver": {
                "name": TOOL,
                "version": __version__,
                "semanticVersion": __version__,
                "informationUri": DOCUMENTS,
                "rules": [_rule(result.pitfall) for result in report.results],
            }
        },
        "invocations": [
            {
                "executionSuccessful": not report.out_of_time
                and all(result.status is not Status.ERRORED for result in report.results),
                "toolExecutionNotifications": list(_notifications(report)),
            }
        ],
        "originalUriBaseIds": {
            _ROOT: {"description": {"text": "The folder in which the scan was run."}}
        },
        "results": list(_results(report)),
        "properties": {"ontology": report.ontology, "strictOops": report.settings.strict_oops},
    }
    found = {"$schema": _SCHEMA, "version": "2.1.0", "runs": [run]}
    return json.dumps(found, indent=1, ensure_ascii=False) + "\n"


def level(pitfall: Pitfall) -> str:
    """The level of a pitfall's results."""
    return "note" if pitfall.advisory else _LEVELS[pitfall.severity]


def _rule(pitfall: Pitfall) -> dict[str, Any]:
    words = re.findall(r"[A-Za-z0-9]+", pitfall.title)
    advisory = ["advisory"] if pitfall.advisory else []
    return {
        "id": pitfall.code,
        "name": "".join(word[0].upper() + word[1:] for word in words),
        "shortDescription": {"text": pitfall.title},
        "fullDescription": {"text": pitfall.description},
        "help": {
            "text": f"{pitfall.description} {pitfall.remedy}",
            "markdown": f"{_literal(pitfall.description)}\n\n**Mend:** {_literal(pitfall.remedy)}",
        },
        "defaultConfiguration": {"level": level(pitfall)},
        "properties": {
            "tags": ["ontology", str(pitfall.severity), *advisory, *pitfall.categories],
            "problem.severity": _PROBLEMS[level(pitfall)],
            "severity": str(pitfall.severity),
        },
    }


def _literal(text: str) -> str:
    """Text that Markdown takes as it is."""
    return re.sub(r"([\\`*_\[\]<>#])", r"\\\1", text)


def _notifications(report: Report) -> Iterator[dict[str, Any]]:
    for index, result in enumerate(report.results):
        if result.status is not Status.CHECKED:
            crashed = result.status is Status.ERRORED
            what = f"{result.pitfall.code} {result.status}: {result.reason}"
            yield {
                "level": "error" if crashed else "note",
                "message": {"text": what},
                "associatedRule": {"id": result.pitfall.code, "index": index},
            }
    for note in report.notes:
        yield {"level": "warning", "message": {"text": note}}


def _results(report: Report) -> Iterator[dict[str, Any]]:
    seen: Counter[str] = Counter()
    for index, result in enumerate(report.results):
        for o in result.occurrences:
            print_ = _fingerprint(result, o)
            seen[print_] += 1
            found = _result(result, o, index, f"{print_}:{seen[print_]}")
            if report.compared:
                found["baselineState"] = "unchanged" if o.known else "new"
            yield found


def _result(result: Result, o: Occurrence, index: int, fingerprint: str) -> dict[str, Any]:
    finding = o.finding
    text = f"{subject(o)}: {finding.message}. {finding.mend or result.pitfall.remedy}"
    return {
        "ruleId": result.pitfall.code,
        "ruleIndex": index,
        "level": level(result.pitfall),
        "message": {"text": text},
        "locations": [_location(o)],
        "partialFingerprints": {"symboslamPitfall/v1": fingerprint},
        "suppressions": _suppressions(o),
        "properties": {
            "elements": list(map(str, finding.elements)),
            "variant": finding.variant,
            "axiom": o.axiom,
        },
    }


def _suppressions(o: Occurrence) -> list[dict[str, str]]:
    """Why it fails nothing: not all readers of SARIF look at ``baselineState``."""
    if o.accepted is not None:
        return [{"kind": "inSource", "status": "accepted", "justification": o.accepted}]
    if o.known:
        known = "known: it is in the baseline"
        return [{"kind": "external", "status": "accepted", "justification": known}]
    return []


def _fingerprint(result: Result, o: Occurrence) -> str:
    """The same wherever in the file the finding is and however its message is worded."""
    parts = [result.pitfall.code, o.finding.variant, *sorted(map(str, o.finding.elements))]
    return sha256("\n".join(parts).encode("utf-8", "replace")).hexdigest()[:32]


def _location(o: Occurrence) -> dict[str, Any]:
    physical: dict[str, Any] = {"artifactLocation": _artifact(o.place.file)}
    if o.place.line is not None:
        physical["region"] = {"startLine": o.place.line}
    named = o.finding.elements or (o.iri,)
    return {
        "physicalLocation": physical,
        "logicalLocations": [
            {"name": local_name(iri) or iri, "fullyQualifiedName": iri} for iri in map(str, named)
        ],
    }


def _artifact(file: str) -> Mapping[str, str]:
    path = Path(file)
    if path.is_relative_to(Path.cwd()):
        path = path.relative_to(Path.cwd())
    if path.is_absolute():
        return {"uri": path.as_uri()}
    return {"uri": quote(path.as_posix(), errors="replace"), "uriBaseId": _ROOT}
