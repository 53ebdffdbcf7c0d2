"""The classes of a reasoned ontology: which are equal, and their taxonomies."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property

from symboslam.reasoning import vocabulary as v
from symboslam.reasoning._base import Hierarchy
from symboslam.reasoning.statements import Stated, Statements
from symboslam.reasoning.taxonomy import Taxonomy

_TAGS = (v.DETECTOR_LABEL, v.OSM_TAG, v.ABSENCE_FEATURE)


class Classes:
    """Classes by their IRIs; equal classes are one, under the IRI that stands for them.

    Args:
        stated: what the ontology states.
        hierarchy: what a reasoner inferred from it.
    """

    def __init__(self, stated: Statements, hierarchy: Hierarchy) -> None:
        self.stated, self.hierarchy = stated, hierarchy

    def one(self, name: str) -> str:
        """The IRI for a class and its equals: ours, else of the one that most is stated about."""
        return self._standing.get(name, name)

    def group(self, name: str) -> list[str]:
        """A class and its equals, the one that stands for them first."""
        one = self.one(name)
        return [one, *sorted(self.hierarchy.equals.get(one, frozenset({one})) - {one})]

    def is_tagged(self, name: str) -> bool:
        """Whether programs know the class by a detector label, an OSM tag, or as absence."""
        return any(self.stated.texts(member, tag) for member in self.group(name) for tag in _TAGS)

    @cached_property
    def _standing(self) -> dict[str, str]:
        indicating = {s.feature for s in self.stated.indications}

        def rank(name: str) -> tuple[bool, bool, bool, str]:
            tagged = any(self.stated.texts(name, tag) for tag in _TAGS)
            return not name.startswith(v.SL), name not in indicating, not tagged, name

        return {name: min(group, key=rank) for name, group in self.hierarchy.equals.items()}

    @cached_property
    def views(self) -> frozenset[str]:
        """Classes that only sort others.

        Features by what these indicate, such as ResidentialFeature; environments, such as Urban.
        They are kept out of the taxonomies: to be one is no reason for an indication, but its
        consequence.
        """
        return self.environment_groups | frozenset(
            name
            for name in self.stated.classes
            if self.stated.defined_by_indicating(name) and not self.is_tagged(name)
        )

    @cached_property
    def environment_groups(self) -> frozenset[str]:
        """Classes that bring environment types together (``sl:environmentGroup``)."""
        return frozenset(
            name for name in self.stated.classes if self.stated.is_true(name, v.ENVIRONMENT_GROUP)
        )

    def groups_above(self, name: str) -> list[str]:
        """The groups that a class is inferred to be in, sorted."""
        return sorted(self.environment_groups & self.hierarchy.above(name))

    @cached_property
    def indications(self) -> dict[str, list[Stated]]:
        """Class -> what is stated that it indicates."""
        found: dict[str, list[Stated]] = {}
        for stated in self.stated.indications:
            if stated.feature not in self.views:
                found.setdefault(self.one(stated.feature), []).append(stated)
        return found

    @cached_property
    def stated_kinds(self) -> dict[str, set[str]]:
        """Class -> classes that it is stated to be a kind of."""
        return self._steps(self.stated.kinds)

    @cached_property
    def stated_wholes(self) -> dict[str, set[str]]:
        """Class -> classes that it is stated to be a part of."""
        return self._steps(self.stated.wholes)

    @cached_property
    def kinds(self) -> dict[str, set[str]]:
        """Class -> classes one is-a step up: stated, and inferred if nothing stated leads there."""
        stated = _taxonomy(self.stated_kinds, v.THING)
        steps = {name: set(above) for name, above in self.stated_kinds.items()}
        for name, above in steps.items():
            above |= self._inferred(name) - stated.ways_up(name).keys()
        return steps

    @cached_property
    def taxonomy(self) -> Taxonomy:
        """Is-a among all classes."""
        return _taxonomy(self.kinds, v.THING)

    @cached_property
    def features(self) -> Taxonomy:
        """Is-a at and below ``sl:Feature``."""
        members = {self.one(v.FEATURE), *self.below(v.FEATURE)}
        return _taxonomy({c: self.kinds[c] & members for c in members}, self.one(v.FEATURE))

    @cached_property
    def places(self) -> Taxonomy:
        """Is-a and part-of among places, and whatever else is indicated, up to ``sl:Place``."""
        root = self.one(v.PLACE)
        indicated = {self.one(s.place) for found in self.indications.values() for s in found}
        members = {*self.below(v.PLACE), *indicated} - {root}
        steps: dict[str, set[str]] = {}
        while waiting := members - steps.keys():
            for name in waiting:
                steps[name] = self.kinds.get(name, set()) | self.stated_wholes.get(name, set())
                members |= steps[name] - {root}
        return _taxonomy(steps, root)

    def below(self, name: str) -> list[str]:
        """The classes strictly below a class, sorted."""
        top = self.one(name)
        return sorted(c for c in self.kinds if c != top and top in self.taxonomy.ways_up(c))

    @cached_property
    def environments(self) -> list[str]:
        """Environment types: directly below ``sl:Environment``, and no zones of a plan; sorted."""
        found = [c for c in self.below(v.ENVIRONMENT) if not self.stated.is_true(c, v.PLAN_ZONE)]
        return [c for c in found if not (self.taxonomy.ways_up(c).keys() - {c}) & set(found)]

    def _steps(self, above: Callable[[str], frozenset[str]]) -> dict[str, set[str]]:
        steps: dict[str, set[str]] = {}
        for name in self.stated.classes:
            if name not in self.views:
                parents = {self.one(p) for p in above(name) if p not in self.views}
                steps.setdefault(self.one(name), set()).update(parents - {self.one(name)})
        return steps

    def _inferred(self, name: str) -> set[str]:
        """The nearest inferred superclasses that are no views."""
        found: set[str] = set()
        seen: set[str] = set()
        waiting = self.group(name)
        while waiting:
            member = waiting.pop()
            if member in seen:
                continue
            seen.add(member)
            for parent in self.hierarchy.parents.get(member, ()):
                if parent in self.views:
                    waiting.extend(self.group(parent))
                else:
                    found.add(self.one(parent))
        return found - {self.one(name)}


def _taxonomy(steps: dict[str, set[str]], root: str) -> Taxonomy:
    return Taxonomy({c: frozenset(above) for c, above in steps.items()}, root)
