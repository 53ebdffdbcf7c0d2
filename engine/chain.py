"""Chaining: probabilities of plan zones below, and of coarser groups above, environment types.

P(group) is the sum of P(e) over its members; a type that is in no group stands for itself.
P(zone) = P(e) * Z(zone) / sum of Z over the zones of e, and Z passes on what e is made of: each
landmark's part of P~(e) times SP(zone, f) / SP(e, f), so that a landmark that indicates a zone
half as strongly as its environment counts half, and one that indicates no zone counts for none.

The evidence *tells the zones of e apart* if e has a single zone, or if landmarks that indicate some
zone of e make up more than half of P~(e), and one zone has strictly more than each of the others.
Otherwise no zone of e has a probability (docs/decisions/0018-chains-and-explanations.md).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from symboslam.reasoning.knowledge import Knowledge

Floats = NDArray[np.float64]
T = TypeVar("T", int, float)
Shares = Mapping[str, Mapping[str, float] | None]
"""Environment name -> zone name -> share of it; None where the zones are not told apart."""
MAJORITY = 0.5
"""The share of P~(e) that must come from landmarks that indicate some zone of e."""
LEAD = 1e-9
"""How much larger, relatively, the strongest zone's evidence must be: beyond rounding."""


@dataclass(frozen=True)
class Chain:
    """A segment's probabilities at the levels above and below environment types.

    Attributes:
        groups: coarser area -> P, over all groups and the types that are in none; sums to 1.
        zones: environment name -> zone name -> P, where the zones are told apart; the zones of an
            environment sum to its P. Zones without evidence are left out.
        untold: environments with P > 0 whose zones the evidence does not tell apart.
    """

    groups: Mapping[str, float] = field(default_factory=dict)
    zones: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    untold: tuple[str, ...] = ()

    def zone_of(self, environment: str) -> str | None:
        """The most probable zone of an environment, or None where they are not told apart."""
        found = self.zones.get(environment, {})
        return max(found, key=found.__getitem__) if found else None


def chain_of(groups: Mapping[str, float], zones: Shares) -> Chain:
    """The chain that a file tells: as in it, zones that are not told apart are None."""
    return Chain(
        groups={name: float(p) for name, p in sorted(groups.items())},
        zones={
            name: {zone: float(p) for zone, p in sorted(found.items())}
            for name, found in sorted(zones.items())
            if found is not None
        },
        untold=tuple(sorted(name for name, found in zones.items() if found is None)),
    )


class Zoning:
    """What landmarks of each feature pass on from environment types to their zones.

    Args:
        knowledge: environments, groups and zones.
        scheme: the set of environment types in use, K of them.
        measure: semantic proximity: ``path``, ``wu_palmer``, ``lin``, or ``direct``.

    Attributes:
        group_of: environment name -> name of its group, or its own where it is in none.
    """

    def __init__(self, knowledge: Knowledge, scheme: str | None, measure: str = "path") -> None:
        self._names = [e.name for e in knowledge.scheme(scheme)]
        group = {member: g.name for g in knowledge.groups for member in g.members}
        self.group_of = {name: group.get(name, name) for name in self._names}
        self._zones: list[tuple[int, slice, tuple[str, ...]]] = []
        table = knowledge.zones
        columns, owner = [np.zeros((len(knowledge.features), 0))], list[int]()
        whole = _proximity(knowledge, measure, scheme) if table else None
        for k, name in enumerate(self._names):
            if table is None or whole is None or name not in table.schemes:
                continue
            zones = tuple(e.name for e in table.scheme(name))
            below, above = _proximity(table, measure, name), whole[:, k, None]
            self._zones.append((k, slice(len(owner), len(owner) + len(zones)), zones))
            columns.append(np.divide(below, above, out=np.zeros_like(below), where=above > 0))
            owner += [k] * len(zones)
        self._passed = np.concatenate(columns, axis=1)  # (F, Z) SP(zone, f) / SP(e, f)
        self._owner = np.array(owner, np.int64)
        # (F, K) whether f indicates a zone of e
        self._says = np.zeros((len(knowledge.features), len(self._names)), np.bool_)
        for k, part, _ in self._zones:
            self._says[:, k] = self._passed[:, part].any(1)

    def groups(self, chances: Mapping[str, T]) -> dict[str, T]:
        """Coarser area -> P, from environment name -> P; those with 0 are left out.

        P may be in any unit, such as whole millionths.
        """
        found: dict[str, T] = {}
        for name, p in chances.items():
            if p:
                group = self.group_of[name]
                found[group] = found[group] + p if group in found else p
        return found

    def shares(self, classes: NDArray[np.int64], parts: Floats, total: Floats) -> Shares:
        """How the zones of each environment that has evidence share it.

        Args:
            classes: (c,) feature classes that have a say in a segment.
            parts: (c, K) what each adds to P~.
            total: (K,) P~, which ground without landmarks may have a part in.

        Returns:
            environment name -> zone name -> share, which sum to 1, or None where the evidence does
            not tell them apart; an environment without zones or evidence is left out.
        """
        evidence = (parts[:, self._owner] * self._passed[classes]).sum(0)
        says = (parts * self._says[classes]).sum(0)
        found: dict[str, Mapping[str, float] | None] = {}
        for k, part, zones in self._zones:
            if total[k] > 0:
                enough = says[k] > MAJORITY * total[k]
                found[self._names[k]] = _shares(zones, evidence[part].tolist(), enough)
        return found

    def chain(self, probability: Floats, shares: Shares) -> Chain | None:
        """The chain of a segment with these (K,) probabilities and `shares`.

        None where it is unknown, and where there are neither groups nor zones to tell of.
        """
        p = dict(zip(self._names, probability.tolist(), strict=True))
        groups = self.groups(p)
        if not self.tells_more(groups, shares):
            return None
        return Chain(
            groups=groups,
            zones={
                name: {zone: p[name] * share for zone, share in found.items() if share}
                for name, found in shares.items()
                if found is not None and p[name] > 0
            },
            untold=tuple(sorted(n for n, found in shares.items() if found is None and p[n] > 0)),
        )

    def tells_more(self, groups: Mapping[str, object], shares: Shares) -> bool:
        """Whether a segment with such groups and zones is in any."""
        return bool(shares or groups.keys() - self.group_of.keys())


def _proximity(knowledge: Knowledge, measure: str, scheme: str | None) -> Floats:
    """(F, K) SP(e, f) by the measure in use."""
    if measure == "direct":
        return knowledge.direct(scheme)
    return knowledge.proximity(measure, scheme)


def _shares(zones: tuple[str, ...], evidence: list[float], enough: bool) -> dict[str, float] | None:
    """Zone -> share of the evidence for zones; None where it does not tell them apart."""
    if len(zones) == 1:
        return {zones[0]: 1.0}
    second, first = sorted(evidence)[-2:]
    if not enough or first - second <= LEAD * first:
        return None
    total = sum(evidence)
    return {zone: part / total for zone, part in zip(zones, evidence, strict=True)}
