"""Wording: accounts in sentences that can be read aloud, in three lengths.

Nothing is said that the account lacks: each name is in it, and each number, rounded.
"""

from __future__ import annotations

from collections.abc import Iterator

from symboslam.engine.account import LEAST, Account, Change, Named, Side, Taken

LENGTHS = ("line", "paragraph", "full")
_IN_A_LINE = 3
"""Classes in a line, and landmarks of each class that a counterfactual names."""
SMALLEST = 0.00005
"""Differences below this are zeros in four digits."""


def text_of(account: Account, length: str = "paragraph") -> str:
    """An account in words.

    Args:
        account: of one segment.
        length: ``line``; ``paragraph``: the strongest reasons for it and for the other; or
            ``full``: all that the account has. Counterfactuals, if they were looked for, are told
            in any length, a line each.
    """
    lines = [_line(account)] if length == "line" else list(_paragraph(account))
    if length == "full":
        lines += _more(account)
    lines += _changes(account)
    return "\n".join(lines)


def _line(account: Account) -> str:
    found, why = account.explanation, account.why
    if why is None:
        return f"Segment {found.segment_id} is unknown."
    parts = [_subject(n) for n in why.named[:_IN_A_LINE]]
    because = f": {', '.join(parts)}" if parts else ""
    other = account.against if account.asked else None
    rather = f", rather than {other.environment} (P = {other.probability:.2f})" if other else ""
    first = f"Segment {found.segment_id} is {why.environment} (P = {why.probability:.2f})"
    return f"{first}{rather}{because}."


def _paragraph(account: Account) -> Iterator[str]:
    found, why = account.explanation, account.why
    if why is None:
        yield (
            f"Segment {found.segment_id} is unknown: it was not looked at, "
            "or nothing in and around it says anything."
        )
        return
    first = f"Segment {found.segment_id} is {why.environment} (P = {why.probability:.2f})"
    if not found.reasons:
        yield f"{first}. The map was written without reasons: classify with --reasons 8."
        return
    yield f"{first}. What stands in and around it adds up to that:"
    yield from _side(why)
    yield from _levels(account, why.environment)
    other = account.against
    if other is not None:
        place = "comes second" if other.environment == account.runner_up else "is further behind"
        yield (
            f"Why not {other.environment}? It {place} (P = {other.probability:.2f}); "
            "what speaks for it:"
        )
        lines = list(_side(other))
        yield from lines or ["  nothing in or around the segment."]


def _side(side: Side) -> Iterator[str]:
    """A line for each class that is named, and one for the rest."""
    for each in side.named:
        because = f": {each.reason}" if each.reason else ""
        if each.path:
            because += f" [{' > '.join(each.path)}]"
        yield f"  {each.contribution:+.2f}  {_subject(each)}{because}"
    if abs(side.rest) >= LEAST:
        yield f"  {side.rest:+.2f}  other kinds of landmarks"


def _subject(named: Named | Taken) -> str:
    return f"{named.count} x {named.label}" if named.count else named.label


def _levels(account: Account, name: str) -> Iterator[str]:
    """The zone that it is most probably, and the group that it is in."""
    chain = account.explanation.chain
    if chain is None:
        return
    zones = chain.zones.get(name, {})
    if zones:
        ranked = sorted(zones.items(), key=lambda pair: -pair[1])
        told = ", ".join(f"{zone} {p:.2f}" for zone, p in ranked if p >= LEAST)
        yield f"By plan zone: {told}."
    elif name in chain.untold:
        yield f"Which zone of {name} it is, the evidence does not tell."
    groups = [f"{group} {p:.2f}" for group, p in chain.groups.items() if p >= LEAST]
    if chain.groups.keys() - account.explanation.probabilities.keys():
        yield f"By kind of area: {', '.join(groups)}."


def _more(account: Account) -> Iterator[str]:
    """All that a paragraph leaves out."""
    found, why, other = account.explanation, account.why, account.against
    if found.probabilities:
        yield "All probabilities:"
        ranked = sorted(found.probabilities.items(), key=lambda pair: -pair[1])
        yield from (f"  {p:.4f}  {name}" for name, p in ranked)
    if why is not None and other is not None:
        gap = why.probability - other.probability
        yield (
            f"Why {why.environment} rather than {other.environment}: "
            f"{why.probability:.4f} - {other.probability:.4f} = {gap:+.4f}, which is the sum of "
            "(smaller parts are left out):"
        )
        for d in account.differences:
            if abs(d.difference) < SMALLEST:
                break  # the largest come first
            subject = f"{d.count} x {d.label}" if d.count else d.label
            yield f"  {d.difference:+.4f}  {subject} ({d.winner:+.4f} less {d.other:+.4f})"
    yield from _parts(account)
    if account.indications:
        yield "What the ontology states:"
        for i in account.indications:
            where = ", ".join(filter(None, (i.source, i.stands)))
            way = "" if not i.steps else f", {i.steps} steps: {' > '.join(i.path)}"
            yield (
                f"  {i.feature} indicates {i.environment} (strength {i.strength:g}{way})"
                + (f": {i.reason}" if i.reason else "")
                + (f" [{where}]" if where else "")
            )


def _parts(account: Account) -> Iterator[str]:
    """What landmarks and pairs add, with what is not listed."""
    parts, name = account.parts, account.explanation.environment
    own = "by being counted" if parts.counted else "by itself"
    if parts.landmarks:
        held = " (P without one: of the fragment otherwise as it is)" if parts.held else ""
        yield f"The strongest landmarks for {name}{held}:"
        for mark in parts.landmarks:
            without = "" if mark.without is None else f"; without it P = {mark.without:.4f}"
            yield (
                f"  {mark.contribution:+.4f}  {mark.label} {mark.id} "
                f"({own} {mark.own:+.4f}, through others {mark.pairs:+.4f}{without})"
            )
        others = parts.other_landmarks
        if others and others.count:
            many = f"{others.count} other landmark{'s' if others.count > 1 else ''}"
            yield f"  {others.contribution:+.4f}  {many}"
        if parts.ground:
            yield f"  {parts.ground:+.4f}  ground without landmarks"
    if parts.pairs:
        yield "The strongest pairs:"
        for pair in parts.pairs:
            one, two = pair.features
            yield f"  {pair.contribution:+.4f}  {one} {pair.first} and {two} {pair.second}"
        if parts.other_pairs and abs(parts.other_pairs) >= SMALLEST:
            yield f"  {parts.other_pairs:+.4f}  all other pairs"


def _changes(account: Account) -> Iterator[str]:
    """The counterfactuals, if they were looked for."""
    if account.counterfactuals is None or account.why is None:
        return
    if not account.counterfactuals:
        yield (
            "No change of landmarks within the bounds of the search was found that would make it "
            "something else."
        )
        return
    yield "It would be something else"
    yield from (f"  {_change(each)}" for each in account.counterfactuals)
    if not any(each.without for each in account.counterfactuals):
        yield "No landmarks whose loss would do it were found within the bounds of the search."


def _change(change: Change) -> str:
    to = "unknown" if change.environment is None else change.environment
    then = f"{to} (P = {change.probability:.2f})" if change.environment else to
    if not change.anew:
        then += ", if the segment's outline stays as it is"
    if change.plus is not None:
        more = f"{change.plus.count} more landmark{'s' if change.plus.count > 1 else ''}"
        return f"with {more} in its middle ({change.plus.label}): {then}."
    taken = ", ".join(f"{_subject(each)} ({_ids(each)})" for each in change.without)
    proof = "no smaller set does it" if change.minimal else "a smaller set may do it too"
    return f"without {taken}: {then}; {proof}."


def _ids(taken: Taken) -> str:
    """The first few of the landmarks."""
    return ", ".join([*taken.ids[:_IN_A_LINE], *(["..."] if taken.count > _IN_A_LINE else [])])
