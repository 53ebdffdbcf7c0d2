"""Wording: explanations in sentences that can be read aloud."""

from __future__ import annotations

from collections.abc import Callable

from symboslam.engine.explanation import Explanation, Reason
from symboslam.reasoning.knowledge import Indication

Why = Callable[[str, str], Indication | None]
"""(feature name, environment name) -> the indication behind it, if there is one."""
LEAST = 0.005
"""Parts of P below this are summed up instead of told."""


def tell(explanation: Explanation, why: Why, *, against: str | None = None, limit: int = 6) -> str:
    """Why a segment is what it is, and why not what comes second.

    Args:
        explanation: of one segment.
        why: finds the sentence behind a feature and an environment.
        against: the environment to compare with; None takes the runner-up.
        limit: how many feature classes to name for the winner; half as many for the other.
    """
    p = explanation.probabilities
    name = explanation.environment
    if name is None:
        return (
            f"Segment {explanation.segment_id} is unknown: it was not looked at, "
            "or nothing in and around it says anything."
        )
    first = f"Segment {explanation.segment_id} is {name} (P = {p[name]:.2f})"
    if not explanation.reasons:
        return f"{first}. The map was written without reasons: classify with --reasons 8."
    lines = [f"{first}. What stands in and around it adds up to that:"]
    lines += _told(explanation, name, why, limit)
    other = against or explanation.runner_up
    if other and other != name:
        chance = p.get(other, 0.0)
        found = _told(explanation, other, why, (limit + 1) // 2)
        place = "comes second" if other == explanation.runner_up else "is further behind"
        lines.append(f"Why not {other}? It {place} (P = {chance:.2f}); what speaks for it:")
        lines += found or ["  nothing in or around the segment."]
    return "\n".join(lines)


def _told(explanation: Explanation, environment: str, why: Why, limit: int) -> list[str]:
    """A line for each of the strongest reasons for one environment, and one for the rest."""
    reasons = explanation.speaking_for(environment)
    named = [r for r in reasons if r.feature and r.contribution[environment] >= LEAST][:limit]
    lines = [_line(r, environment, why) for r in named]
    rest = sum(r.contribution[environment] for r in reasons if r not in named)
    if abs(rest) >= LEAST:
        lines.append(f"  {rest:+.2f}  other kinds of landmarks")
    return lines


def _line(reason: Reason, environment: str, why: Why) -> str:
    subject = f"{reason.count} x {reason.label}" if reason.count else reason.label
    indication = why(reason.feature, environment)
    because = f": {indication.reason}" if indication and indication.reason else ""
    if indication and indication.steps:
        because += f" [{' > '.join(indication.path)}]"
    return f"  {reason.contribution[environment]:+.2f}  {subject}{because}"


def summary(explanation: Explanation, limit: int = 3) -> str:
    """Why a segment is what it is, in one line.

    Args:
        explanation: of one segment.
        limit: how many kinds of landmarks to name.
    """
    name = explanation.environment
    if name is None:
        return f"Segment {explanation.segment_id} is unknown."
    parts = [
        f"{reason.count} x {reason.label}" if reason.count else reason.label
        for reason in explanation.speaking_for(name)[:limit]
        if reason.contribution[name] >= LEAST
    ]
    because = f": {', '.join(parts)}" if parts else ""
    chance = explanation.probabilities[name]
    return f"Segment {explanation.segment_id} is {name} (P = {chance:.2f}){because}."
