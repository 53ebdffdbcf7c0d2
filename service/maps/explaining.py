"""Explanations in three lengths: a line, a paragraph, and everything that is known."""

from __future__ import annotations

from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.explanation import Explanation
from symboslam.engine.wording import summary, tell

_FEW, _ALL = 3, 10_000


def text_of(
    segment: EnvironmentMap, explanation: Explanation, length: str, against: str | None = None
) -> str:
    """An explanation in words.

    Args:
        segment: a map with the segment.
        explanation: of it.
        length: ``line``, ``paragraph``: the strongest reasons for it and for what comes second;
            or ``full``: all of them, the whole distribution, and where each reason is from.
        against: the environment to compare with; None takes the one that comes second.
    """
    why = segment.knowledge.find_indication
    if length == "line":
        return summary(explanation)
    if length == "paragraph":
        return tell(explanation, why, against=against, limit=_FEW)
    lines = [tell(explanation, why, against=against, limit=_ALL)]
    if explanation.probabilities:
        lines.append("All probabilities:")
        ranked = sorted(explanation.probabilities.items(), key=lambda pair: -pair[1])
        lines += [f"  {chance:.4f}  {name}" for name, chance in ranked]
    sources = {
        f"  {reason.label} > {name}: {found.source}"
        for reason in explanation.reasons
        for name in reason.contribution
        if (found := why(reason.feature, name)) is not None and found.source
    }
    if sources:
        lines += ["Where the strengths are from:", *sorted(sources)]
    return "\n".join(lines)
