"""Results as text: a line for each question, and below it why it did not pass."""

from __future__ import annotations

from symboslam.reasoning.questions.model import PASSED, Report
from symboslam.reasoning.questions.report import summary


def render(report: Report) -> str:
    """The report as text."""
    lines = [report.title]
    for group, results in report.groups.items():
        lines += ["", group]
        for result in results:
            question = result.question
            text = " ".join(question.text.split())
            lines.append(f"  {result.status:13} {question.id}: {text}")
            told = result.status != PASSED or question.known_failing
            if told and result.message:
                lines += (f"                {line}" for line in result.message.split("\n"))
    lines += ["", f"{summary(report)} in {report.seconds:.1f} s"]
    return "\n".join(lines) + "\n"
