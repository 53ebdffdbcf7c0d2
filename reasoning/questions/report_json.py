"""Results as JSON, for programs."""

from __future__ import annotations

import json

from symboslam.reasoning.questions.model import STATUSES, Report
from symboslam.reasoning.questions.report import record
from symboslam.reasoning.vocabulary import local_name

_ROWS = 1000  # of an answer


def render(report: Report) -> str:
    """The report as JSON: ``results`` in the order of the manifest, and ``counts``."""
    results = [
        {
            "id": result.question.id,
            "question": result.question.text,
            "status": result.status,
            "group": result.question.group,
            "kind": result.question.kind,
            "regime": local_name(result.question.regime),
            "seconds": round(result.seconds, 4),
            "message": result.message,
            "query": result.question.query.text if result.question.query else None,
            "expected": record(result.question.expected),
            "answer": record(result.answer, _ROWS),
            "manifest": str(result.question.manifest),
            "line": result.question.line,
        }
        for result in report.results
    ]
    counts = {status: report.counts[status] for status in STATUSES}
    found = {
        "title": report.title,
        "counts": {**counts, "total": len(results)},
        "seconds": round(report.seconds, 3),
        "results": results,
    }
    return json.dumps(found, indent=1, ensure_ascii=False) + "\n"
