"""Account: everything that is told of a segment, from which all words, JSON and RDF are made."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

from symboslam.engine.evidence import one_thread
from symboslam.engine.explanation import Explanation, Reason
from symboslam.engine.landmark_parts import LANDMARKS, LandmarkParts, parts_of
from symboslam.errors import InputError
from symboslam.reasoning.knowledge import Indication

if TYPE_CHECKING:
    from symboslam.engine.changes import Counterfactual
    from symboslam.engine.environment_map import EnvironmentMap

Why = Callable[[str, str], Indication | None]
"""(feature name, environment name) -> the indication behind it, if there is one."""
LEAST = 0.005
"""Parts of P below this are summed up instead of named."""


@dataclass(frozen=True)
class Named:
    """A feature class that is named for an environment, with the sentence behind it."""

    feature: str
    label: str
    count: int
    contribution: float
    reason: str = ""
    path: tuple[str, ...] = ()


@dataclass(frozen=True)
class Side:
    """What speaks for one environment.

    Attributes:
        environment: its name.
        probability: P; the contributions named and the rest add up to it.
        named: the strongest classes.
        rest: what all that is not named adds.
    """

    environment: str
    probability: float
    named: tuple[Named, ...]
    rest: float


@dataclass(frozen=True)
class Difference:
    """What one class adds to the winner and to the other environment.

    Over all classes the differences, winner less other, add up to P(winner) - P(other).
    """

    feature: str
    label: str
    count: int
    winner: float
    other: float
    difference: float


@dataclass(frozen=True)
class Taken:
    """Landmarks of one class that a counterfactual takes away or adds."""

    feature: str
    label: str
    count: int
    ids: tuple[str, ...] = ()


@dataclass(frozen=True)
class Change:
    """A counterfactual in names; see ``changes.Counterfactual``."""

    environment: str | None
    probability: float
    without: tuple[Taken, ...]
    plus: Taken | None
    place: tuple[float, float] | None
    minimal: bool
    tried: int
    anew: bool


@dataclass(frozen=True)
class Account:
    """Everything that is told of a segment.

    Attributes:
        explanation: probabilities, reasons by class, and the chain.
        runner_up: the environment that comes second, or None.
        why: what speaks for the segment's environment; None if it is unknown.
        against: what speaks for the environment that it is compared with; None without one.
        asked: whether the comparison was asked for, and not only made with the runner-up.
        differences: why the one rather than the other, the largest first.
        indications: the axioms behind the reasons: module, line, strength, sentence, source.
        parts: what landmarks and pairs add; empty where the landmarks are not at hand.
        counterfactuals: changes after which it would be something else; None if not looked for.
    """

    explanation: Explanation
    runner_up: str | None = None
    why: Side | None = None
    against: Side | None = None
    asked: bool = False
    differences: tuple[Difference, ...] = ()
    indications: tuple[Indication, ...] = ()
    parts: LandmarkParts = field(default_factory=LandmarkParts)
    counterfactuals: tuple[Change, ...] | None = None


def account_of(
    explanation: Explanation, why: Why, *, against: str | None = None, limit: int = 6
) -> Account:
    """What an explanation tells by itself, be it from a map or from its file.

    Args:
        explanation: of one segment.
        why: finds the sentence behind a feature and an environment.
        against: the environment to compare with; None takes the runner-up.
        limit: how many classes to name for the winner; half as many for the other.

    Raises:
        InputError: it is to be compared with what it is.
    """
    name, p = explanation.environment, explanation.probabilities
    if name is None:
        return Account(explanation)
    if against == name:
        raise InputError(
            f"segment {explanation.segment_id} is {name} itself: compare it with another type"
        )
    other = against or explanation.runner_up
    found = [
        indication
        for reason in explanation.reasons
        for environment in p
        if reason.contribution.get(environment)
        and (indication := why(reason.feature, environment)) is not None
    ]
    return Account(
        explanation,
        explanation.runner_up,
        _side(explanation, name, why, limit),
        _side(explanation, other, why, (limit + 1) // 2) if other else None,
        against is not None,
        _differences(explanation.reasons, name, other) if other else (),
        tuple(found),
    )


def full_account(
    environment_map: EnvironmentMap,
    segment_id: str,
    *,
    against: str | None = None,
    limit: int = 6,
    listed: int = LANDMARKS,
    counterfactual: bool = False,
) -> Account:
    """All that a map with its landmarks tells of a segment; nothing but the segment is touched.

    Args:
        environment_map: the map.
        segment_id: the segment.
        against: the environment to compare with, and that counterfactuals shall lead to; None
            takes the runner-up, and any other.
        limit: how many classes to name for the winner; half as many for the other.
        listed: how many landmarks, and how many pairs, to list; the rest is summed up.
        counterfactual: whether to look for changes that make it something else.

    Raises:
        UnknownNameError: no such segment or environment.
        InputError: it is to be compared with what it is; counterfactuals of evidence that cannot
            be weighed anew.
    """
    from symboslam.engine.counterfactual import counterfactuals
    from symboslam.engine.local import local_evidence

    m = environment_map
    if against is not None:
        m.column_of(against)
    with one_thread():
        explained = m.explain(segment_id)
    told = account_of(explained, m.knowledge.find_indication, against=against, limit=limit)
    i = m.position_of(segment_id)
    if m.label[i] < 0:
        return replace(told, counterfactuals=() if counterfactual else None)
    told = replace(told, indications=told.indications + _of_zones(m, told.explanation))
    with one_thread():
        try:
            local = local_evidence(m, i)
        except InputError:
            if counterfactual:
                raise
            return told
        told = replace(told, parts=parts_of(m, local, int(m.label[i]), listed))
        if not counterfactual:
            return told
        found = counterfactuals(m, segment_id, against=against, local=local)
    return replace(told, counterfactuals=tuple(_change(m, each) for each in found))


def _of_zones(m: EnvironmentMap, explanation: Explanation) -> tuple[Indication, ...]:
    """The axioms behind the zones of the segment's environment, where they are told apart."""
    table, chain = m.knowledge.zones, explanation.chain
    if table is None or chain is None or explanation.environment is None:
        return ()
    zones = chain.zones.get(explanation.environment, {})
    found = (table.find_indication(r.feature, zone) for r in explanation.reasons for zone in zones)
    return tuple(indication for indication in found if indication is not None)


def _side(explanation: Explanation, environment: str, why: Why, limit: int) -> Side:
    reasons = explanation.speaking_for(environment)
    shown = [r for r in reasons if r.feature and r.contribution[environment] >= LEAST][:limit]
    named = []
    for reason in shown:
        indication = why(reason.feature, environment)
        named.append(
            Named(
                reason.feature,
                reason.label,
                reason.count,
                reason.contribution[environment],
                indication.reason if indication else "",
                indication.path if indication and indication.steps else (),
            )
        )
    rest = sum(r.contribution[environment] for r in reasons if r not in shown)
    return Side(environment, explanation.probabilities.get(environment, 0.0), tuple(named), rest)


def _differences(reasons: tuple[Reason, ...], name: str, other: str) -> tuple[Difference, ...]:
    found = []
    for reason in reasons:
        one, two = reason.contribution.get(name, 0.0), reason.contribution.get(other, 0.0)
        if one or two:
            found.append(
                Difference(reason.feature, reason.label, reason.count, one, two, one - two)
            )
    return tuple(sorted(found, key=lambda d: -abs(d.difference)))


def _change(m: EnvironmentMap, found: Counterfactual) -> Change:
    known, marks = m.knowledge.features, m.landmarks
    removed = [int(marks.feature[i]) for i in found.removed]
    without = tuple(
        Taken(
            known[f].name,
            known[f].label,
            count,
            tuple(str(marks.id[i]) for i, g in zip(found.removed, removed, strict=True) if g == f),
        )
        for f, count in Counter(removed).most_common()
    )
    plus = place = None
    if found.added is not None:
        plus = Taken(known[found.added].name, known[found.added].label, found.count)
        x, y = marks.frame.from_metres(np.array([found.place[0]]), np.array([found.place[1]]))
        place = (float(x[0]), float(y[0]))
    return Change(
        found.environment,
        found.probability,
        without,
        plus,
        place,
        found.minimal,
        found.tried,
        found.anew,
    )
