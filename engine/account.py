"""Account: everything that is told of a segment, from which all words, JSON and RDF are made."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from symboslam.engine._base import normalised
from symboslam.engine.explanation import Explanation, Reason
from symboslam.errors import InputError
from symboslam.reasoning.knowledge import Indication

if TYPE_CHECKING:
    from symboslam.engine.changes import Counterfactual
    from symboslam.engine.environment_map import EnvironmentMap
    from symboslam.engine.local import LocalEvidence

Why = Callable[[str, str], Indication | None]
"""(feature name, environment name) -> the indication behind it, if there is one."""
LEAST = 0.005
"""Parts of P below this are summed up instead of named."""
LANDMARKS = 20
"""Landmarks, and pairs of them, that a full account lists."""
AMONG = 400
"""Landmarks among which the strongest pairs are looked for: those that add most."""


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
class LandmarkPart:
    """What one landmark adds to the winner's P.

    Attributes:
        id: the landmark.
        feature: its class.
        label: the same for people.
        position: in the input's coordinates.
        contribution: what it adds in all.
        own: what it adds by itself.
        pairs: what it adds, or loses, through others.
        without: P(winner) if it were not there, worked out anew; None where that is not known.
    """

    id: str
    feature: str
    label: str
    position: tuple[float, float]
    contribution: float
    own: float
    pairs: float
    without: float | None = None


@dataclass(frozen=True)
class PairPart:
    """What two landmarks add to the winner's P, or take from it, by being together."""

    first: str
    second: str
    features: tuple[str, str]
    contribution: float


@dataclass(frozen=True)
class Taken:
    """Landmarks of one class that a counterfactual takes away or adds."""

    feature: str
    label: str
    count: int
    ids: tuple[str, ...] = ()


@dataclass(frozen=True)
class Change:
    """A counterfactual in names; see ``counterfactual.Counterfactual``."""

    environment: str | None
    probability: float
    without: tuple[Taken, ...]
    plus: Taken | None
    place: tuple[float, float] | None
    minimal: bool
    tried: int


@dataclass(frozen=True)
class Account:
    """Everything that is told of a segment.

    Attributes:
        explanation: probabilities, reasons by class, and the chain.
        runner_up: the environment that comes second, or None.
        why: what speaks for the segment's environment; None if it is unknown.
        against: what speaks for the environment that it is compared with; None without one.
        differences: why the one rather than the other, the largest first.
        indications: the axioms behind the reasons: module, line, strength, sentence, source.
        landmarks: the strongest landmarks; none where the landmarks are not at hand.
        pairs: the strongest pairs among them.
        counterfactuals: changes after which it would be something else; None if not looked for.
    """

    explanation: Explanation
    runner_up: str | None = None
    why: Side | None = None
    against: Side | None = None
    differences: tuple[Difference, ...] = ()
    indications: tuple[Indication, ...] = ()
    landmarks: tuple[LandmarkPart, ...] = ()
    pairs: tuple[PairPart, ...] = ()
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
    """
    name, p = explanation.environment, explanation.probabilities
    if name is None:
        return Account(explanation)
    other = against or explanation.runner_up
    found = [
        indication
        for reason in explanation.reasons
        for environment in p
        if reason.contribution.get(environment)
        and (indication := why(reason.feature, environment)) is not None
    ]
    compared = other if other and other != name else None
    return Account(
        explanation,
        explanation.runner_up,
        _side(explanation, name, why, limit),
        _side(explanation, compared, why, (limit + 1) // 2) if compared else None,
        _differences(explanation.reasons, name, compared) if compared else (),
        tuple(found),
    )


def full_account(
    environment_map: EnvironmentMap,
    segment_id: str,
    *,
    against: str | None = None,
    limit: int = 6,
    counterfactual: bool = False,
) -> Account:
    """All that a map with its landmarks tells of a segment; nothing but the segment is touched.

    Args:
        environment_map: the map.
        segment_id: the segment.
        against: the environment to compare with, and that counterfactuals shall lead to; None
            takes the runner-up, and any other.
        limit: how many classes to name for the winner; half as many for the other.
        counterfactual: whether to look for changes that make it something else.

    Raises:
        UnknownNameError: no such segment or environment.
        InputError: counterfactuals of evidence that cannot be weighed anew.
    """
    from symboslam.engine.counterfactual import counterfactuals
    from symboslam.engine.local import local_evidence

    m = environment_map
    if against is not None:
        m.column_of(against)
    told = account_of(
        m.explain(segment_id), m.knowledge.find_indication, against=against, limit=limit
    )
    i = m.position_of(segment_id)
    if m.label[i] < 0:
        return replace(told, counterfactuals=() if counterfactual else None)
    told = replace(told, indications=told.indications + _of_zones(m, told.explanation))
    try:
        local = local_evidence(m, i)
    except InputError:
        if counterfactual:
            raise
        return told
    landmarks, pairs = _strongest(m, local, int(m.label[i]))
    changes = None
    if counterfactual:
        found = counterfactuals(m, segment_id, against=against, local=local)
        changes = tuple(_change(m, each) for each in found)
    return replace(told, landmarks=landmarks, pairs=pairs, counterfactuals=changes)


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


def _strongest(
    m: EnvironmentMap, local: LocalEvidence, label: int
) -> tuple[tuple[LandmarkPart, ...], tuple[PairPart, ...]]:
    """The landmarks that add most to the winner's P, and the pairs that do most to it."""
    total, marks, known = local.total.sum(), m.landmarks, m.knowledge.features
    own, pairs = local.own[:, label] / total, local.pairs[:, label] / total
    order = np.argsort(-np.abs(own + pairs), kind="stable")
    order = order[np.abs(own + pairs)[order] > 0]
    shown = order[:LANDMARKS]
    alone = normalised(local.without(shown, np.eye(len(shown), dtype=np.bool_)))[:, label]
    first, second = marks.frame.from_metres(
        marks.x[local.landmark[shown]], marks.y[local.landmark[shown]]
    )
    landmarks = []
    for at, row in enumerate(shown.tolist()):
        position = int(local.landmark[row])
        feature = known[int(marks.feature[position])]
        landmarks.append(
            LandmarkPart(
                str(marks.id[position]),
                feature.name,
                feature.label,
                (float(first[at]), float(second[at])),
                float(own[row] + pairs[row]),
                float(own[row]),
                float(pairs[row]),
                float(alone[at]),
            )
        )
    loudest = np.abs(local.own + local.pairs).max(1, initial=0)
    among = np.argsort(-loudest, kind="stable")[:AMONG]
    through = local.between(among, label)[among] / total
    together = np.triu(through + through.T, 1)
    rows, columns = np.nonzero(together)
    parts = together[rows, columns]
    best = np.argsort(-np.abs(parts), kind="stable")[:LANDMARKS]
    found = []
    for j in best.tolist():
        ends = [int(local.landmark[among[k]]) for k in (rows[j], columns[j])]
        one, two = (known[int(marks.feature[e])].name for e in ends)
        found.append(
            PairPart(str(marks.id[ends[0]]), str(marks.id[ends[1]]), (one, two), float(parts[j]))
        )
    return tuple(landmarks), tuple(found)


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
        found.environment, found.probability, without, plus, place, found.minimal, found.tried
    )
