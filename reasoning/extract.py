"""From a reasoned ontology to the table of knowledge (design 3 and 4)."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator
from functools import cached_property
from itertools import pairwise

import numpy as np

from symboslam.errors import EmptyOntologyError, OntologyError
from symboslam.reasoning import vocabulary as v
from symboslam.reasoning.classes import Classes
from symboslam.reasoning.knowledge import (
    Environment,
    EnvironmentGroup,
    Feature,
    Floats,
    Indication,
    Knowledge,
    PlanZone,
)
from symboslam.reasoning.proximity import MEASURES, Way
from symboslam.reasoning.statements import Stated

_DIGITS = 12  # of stored proximities, so that they are equal on every platform
_COLOUR = re.compile(r"#[0-9a-fA-F]{6}")
_PALETTE = (
    "#e07b39", "#3f7fbf", "#5aa469", "#b1549c", "#e2b93b", "#7f6bb5", "#c8504b", "#4aa6a6",
    "#8c7356", "#9a9fa3",
)  # fmt: skip


def extract(classes: Classes) -> Knowledge:
    """The table of knowledge; ``source``, ``source_hash`` and ``notes`` are left to the caller.

    Raises:
        EmptyOntologyError: no environments, or no feature that indicates one.
        OntologyError: a strength outside (0, 1].
    """
    return _Extraction(classes).knowledge()


def is_colour(text: str) -> bool:
    """Whether a text is a colour as ``#rrggbb``."""
    return bool(_COLOUR.fullmatch(text))


class _Extraction:
    def __init__(self, classes: Classes) -> None:
        self.classes, self.stated = classes, classes.stated

    def knowledge(self) -> Knowledge:
        if not self.classes.environments:
            raise EmptyOntologyError(
                "the ontology declares no environments: make each kind of place that a map is "
                f"divided into a subclass of <{v.ENVIRONMENT}>"
            )
        for stated in self.stated.indications:
            if not stated.is_valid:
                raise OntologyError(
                    f"the strength of '{v.local_name(stated.feature)} indicates "
                    f"{v.local_name(stated.place)}' is not a number above 0 and at most 1"
                )
        features = [c for c in self.classes.features.classes if self._is_landmark(c)]
        features.sort(key=self.name)
        environments = sorted(self.classes.environments, key=self.name)
        indications, proximities = self._table(features, environments)
        if not indications:
            raise EmptyOntologyError(
                "no feature of the ontology indicates an environment: state for example that "
                f"':Stove rdfs:subClassOf [ owl:onProperty <{v.INDICATES}> ; owl:someValuesFrom "
                ":Kitchen ]'"
            )
        used = {name for way in indications for name in way.path}
        return Knowledge(
            environments=tuple(self._environment(c, i) for i, c in enumerate(environments)),
            features=tuple(self._feature(c) for c in features),
            indications=tuple(indications),
            proximities=proximities,
            schemes=self._schemes(environments),
            absence=tuple(self.name(c) for c in features if self._is_absence(c)),
            bandwidths=self._bandwidths(),
            labels={n: self.stated.label(c) for c, n in sorted(self._names.items()) if n in used},
            groups=self._groups(environments),
            zones=self._zones(features, environments),
        )

    def _table(
        self, features: list[str], places: list[str]
    ) -> tuple[list[Indication], dict[str, Floats]]:
        """The best way from each feature to each place, and all proximities, (F, K) each."""
        proximities = {measure: np.zeros((len(features), len(places))) for measure in MEASURES}
        indications = []
        for i, feature in enumerate(features):
            for k, place in enumerate(places):
                ways = list(self._ways(feature, place))
                if not ways:
                    continue
                for name, factor in MEASURES.items():
                    best = max(stated.strength * factor(way) for way, stated in ways)
                    proximities[name][i, k] = round(best, _DIGITS)
                is_direct = any(way.steps == 0 for way, _ in ways)
                indications.append(self._indication(*min(ways, key=_best_first), is_direct))
                proximities["path"][i, k] = indications[-1].proximity  # to the last digit
        return indications, proximities

    def _groups(self, environments: list[str]) -> tuple[EnvironmentGroup, ...]:
        """The groups that have members.

        Raises:
            OntologyError: an environment type is in two groups, so that sums would count it twice.
        """
        members: dict[str, list[str]] = {}
        for environment in environments:
            above = self.classes.groups_above(environment)
            if len(above) > 1:
                names = " and ".join(map(v.local_name, above))
                raise OntologyError(
                    f"{v.local_name(environment)} is in the groups {names}; a type can be in one"
                )
            for group in above:
                members.setdefault(group, []).append(self.name(environment))
        return tuple(
            EnvironmentGroup(
                group, v.local_name(group), self.stated.label(group), self.stated.definition(group),
                tuple(names),
            )
            for group, names in sorted(members.items())
        )  # fmt: skip

    def _zones(self, features: list[str], environments: list[str]) -> Knowledge | None:
        """The table of the plan zones of all environments."""
        found = [self._environment(c, i) for i, c in enumerate(environments)]
        whole = {z.iri: e for e in found for z in e.zones}
        if not whole:
            return None
        zones = sorted(whole, key=self.name)
        indications, proximities = self._table(features, zones)
        return Knowledge(
            environments=tuple(
                Environment(
                    c, self.name(c), self.stated.label(c), self.stated.definition(c),
                    whole[c].colour,
                )
                for c in zones
            ),
            features=tuple(self._feature(c) for c in features),
            indications=tuple(indications),
            proximities=proximities,
            schemes={e.name: tuple(z.name for z in e.zones) for e in found if e.zones},
        )  # fmt: skip

    @cached_property
    def _names(self) -> dict[str, str]:
        """Class -> local name, or the whole IRI where two classes share the local name."""
        every = self.classes.features.classes | self.classes.places.classes
        count = Counter(v.local_name(c) for c in every)
        return {c: c if count[v.local_name(c)] > 1 else v.local_name(c) for c in every}

    def name(self, name: str) -> str:
        """The word for a class in files."""
        return self._names[name]

    def _is_landmark(self, name: str) -> bool:
        """Whether a class is one that landmarks can have, and not merely a group of such."""
        if name in {self.classes.one(c) for c in (v.FEATURE, v.STATIC_FEATURE, v.DYNAMIC_FEATURE)}:
            return False
        above = self.classes.features.ways_up(name)
        return self.classes.is_tagged(name) or any(c in self.classes.indications for c in above)

    def _is_absence(self, name: str) -> bool:
        return any(self.stated.is_true(c, v.ABSENCE_FEATURE) for c in self.classes.group(name))

    def _ways(self, feature: str, environment: str) -> Iterator[tuple[Way, Stated]]:
        """All ways from a feature to an environment; is-a and part-of parts are shortest ones."""
        features, places = self.classes.features, self.classes.places
        for general, up in features.ways_up(feature).items():
            for stated in self.classes.indications.get(general, ()):
                on = places.ways_up(self.classes.one(stated.place)).get(environment)
                if on is not None:
                    yield Way(up, on, features, places), stated

    def _indication(self, way: Way, stated: Stated, is_direct: bool) -> Indication:
        label = self.stated.label
        axioms = [
            *self._steps_in_words(way.up),
            f"{label(way.up[-1])} indicates {label(way.on[0])} (strength {stated.strength:g})",
            *self._steps_in_words(way.on),
        ]
        is_iri = "://" in stated.source or stated.source.startswith("urn:")
        return Indication(
            feature=self.name(way.up[0]),
            environment=self.name(way.on[-1]),
            strength=stated.strength,
            steps=way.steps,
            path=tuple(self.name(c) for c in (*way.up, *way.on)),
            reason=stated.reason,
            source=(self.stated.given_label(stated.source) or stated.source),
            axioms=tuple(axioms),
            source_iri=stated.source if is_iri else "",
            is_direct=is_direct,
            stands=stated.stands,
        )

    def _steps_in_words(self, way: tuple[str, ...]) -> Iterator[str]:
        for low, high in pairwise(way):
            words, inferred = "is a kind of", ""
            if high not in self.classes.stated_kinds.get(low, ()):
                if high in self.classes.stated_wholes.get(low, ()):
                    words = "is part of"
                else:
                    inferred = " (inferred)"
            yield f"{self.stated.label(low)} {words} {self.stated.label(high)}{inferred}"

    def _environment(self, name: str, position: int) -> Environment:
        colour = next(iter(self.stated.texts(name, v.COLOUR)), "")
        zones = [c for c in self.classes.below(name) if self.stated.is_true(c, v.PLAN_ZONE)]
        return Environment(
            iri=name,
            name=self.name(name),
            label=self.stated.label(name),
            definition=self.stated.definition(name),
            colour=colour if is_colour(colour) else _PALETTE[position % len(_PALETTE)],
            zones=tuple(PlanZone(c, self.name(c), self.stated.label(c)) for c in zones),
        )

    def _feature(self, name: str) -> Feature:
        group = self.classes.group(name)
        above = self.classes.features.ways_up(name)
        top = self.classes.one(v.FEATURE)
        kinds = sorted((c for c in above if c not in (name, top)), key=lambda c: (len(above[c]), c))
        aliases = {*group[1:], *(s for c in group for s in self.stated.same_names(c))} - {name}
        return Feature(
            iri=name,
            name=self.name(name),
            label=self.stated.label(name),
            definition=self.stated.definition(name),
            static=self.classes.one(v.DYNAMIC_FEATURE) not in above,
            detector_label=next(self._texts(group, v.DETECTOR_LABEL), None),
            osm_tags=tuple(sorted(set(self._texts(group, v.OSM_TAG)))),
            kinds=tuple(self.name(c) for c in kinds),
            aliases=tuple(sorted(aliases)),
            site=self._site(name),
        )

    def _site(self, name: str) -> float:
        """The site radius of the nearest class at or above a feature that states one; else 0."""
        above = self.classes.features.ways_up(name)
        for kind in sorted(above, key=lambda c: (len(above[c]), c)):
            if (radius := self.stated.number(kind, v.SITE_RADIUS)) is not None:
                return radius
        return 0.0

    def _texts(self, group: Iterable[str], predicate: str) -> Iterator[str]:
        return (text for member in group for text in self.stated.texts(member, predicate))

    def _schemes(self, environments: list[str]) -> dict[str, tuple[str, ...]]:
        """Scheme name -> environments; the default one first, then by name."""
        found: dict[str, tuple[str, ...]] = {}
        for scheme in sorted(self.stated.schemes, key=lambda s: not s.is_default):
            members = tuple(self.name(c) for c in environments if c in scheme.members)
            if members:
                found.setdefault(scheme.name, members)
        return found or {"all": tuple(self.name(c) for c in environments)}

    def _bandwidths(self) -> dict[str, float]:
        return {s.name: s.bandwidth for s in self.stated.schemes if s.bandwidth is not None}


def _best_first(way: tuple[Way, Stated]) -> tuple[float, int, tuple[str, ...], str]:
    """Orders ways by ``path`` proximity, then the fewest steps, then the names along them."""
    chain, stated = way
    proximity = stated.strength * MEASURES["path"](chain)
    return -proximity, chain.steps, (*chain.up, *chain.on), stated.reason
