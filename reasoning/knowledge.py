"""Knowledge: the table that reasoning leaves behind, which is all that the engine needs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from symboslam.reasoning.matching import TagMatcher, name_index, unknown_name

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class PlanZone:
    """A zone of a land-use plan below an environment type, such as RZ1."""

    iri: str
    name: str
    label: str


@dataclass(frozen=True)
class Environment:
    """An environment type.

    Attributes:
        iri: its class.
        name: local name, the word used in files.
        label: words for people.
        definition: one sentence.
        colour: ``#rrggbb`` for maps.
        zones: plan zones below it.
    """

    iri: str
    name: str
    label: str
    definition: str = ""
    colour: str = "#888888"
    zones: tuple[PlanZone, ...] = ()


@dataclass(frozen=True)
class EnvironmentGroup:
    """A coarser kind of area that brings environment types together, such as urban land.

    Attributes:
        iri: its class.
        name: local name.
        label: words for people.
        definition: one sentence.
        members: names of its environment types; none is in two groups.
    """

    iri: str
    name: str
    label: str
    definition: str = ""
    members: tuple[str, ...] = ()


@dataclass(frozen=True)
class Feature:
    """A class of landmarks.

    Attributes:
        iri: its class.
        name: local name.
        label: words for people.
        definition: one sentence.
        static: whether it stays where it is.
        detector_label: what the detector calls it, or None.
        osm_tags: ``key=value`` or ``key=*``.
        kinds: names of the classes above it, nearest first; ``Feature`` itself is left out.
        aliases: IRIs of classes that mean the same, such as those of the ontology of 2022.
        site: radius in metres of the ground that goes with one such landmark; 0 if not stated.
    """

    iri: str
    name: str
    label: str
    definition: str = ""
    static: bool = True
    detector_label: str | None = None
    osm_tags: tuple[str, ...] = ()
    kinds: tuple[str, ...] = ()
    aliases: tuple[str, ...] = ()
    site: float = 0.0


@dataclass(frozen=True)
class Indication:
    """The strongest way in which a feature points to an environment (design 4, ``path``).

    Attributes:
        feature: name of the feature f.
        environment: name of the environment e.
        strength: of the axiom ``g indicates p`` on the way, in (0, 1].
        steps: h, is-a and part-of steps beyond that axiom; 0 = direct.
        path: local names along the way, f ... g, p ... e.
        reason: the axiom's sentence.
        source: where the axiom comes from, in words.
        axioms: the axioms along the way, in words.
        source_iri: where the axiom comes from, if that has an IRI.
        is_direct: whether f also indicates e itself by an axiom of its own (then h is 0, or this
            longer way is the stronger one).
        stands: file and line of the axiom ``g indicates p``, in words; empty if not known.
    """

    feature: str
    environment: str
    strength: float
    steps: int
    path: tuple[str, ...]
    reason: str = ""
    source: str = ""
    axioms: tuple[str, ...] = ()
    source_iri: str = ""
    is_direct: bool = False
    stands: str = ""

    @property
    def proximity(self) -> float:
        """SP(e, f) = strength / (1 + h)."""
        return self.strength / (1 + self.steps)


@dataclass(frozen=True, eq=False, repr=False)
class Knowledge:
    """Environments, features and how strongly the latter indicate the former.

    Attributes:
        environments: all environment types; the order is that of every K axis.
        features: all feature classes; the order is that of every F axis.
        indications: the best way for each (feature, environment) with proximity above 0.
        proximities: measure name -> (F, K) semantic proximity in [0, 1].
        schemes: scheme name -> names of its environments; the first is the default.
        absence: names of the features that stand for ground without landmarks.
        source_hash: SHA-256 of the sources.
        source: where it was loaded from.
        labels: local name of any class on a path -> words for people.
        bandwidths: scheme name -> how far in metres its landmarks speak for the ground around
            them, where the ontology states it.
        notes: what a user should know about the loading, such as imports that were not found.
        groups: coarser kinds of area above the environment types.
        zones: the same table with the plan zones in the place of the environment types, and with
            a scheme for each environment type that has zones: those zones. None without zones.
    """

    environments: tuple[Environment, ...]
    features: tuple[Feature, ...]
    indications: tuple[Indication, ...]
    proximities: Mapping[str, Floats]
    schemes: Mapping[str, tuple[str, ...]]
    absence: tuple[str, ...] = ()
    source_hash: str = ""
    source: str = "bundled"
    labels: Mapping[str, str] = field(default_factory=dict)
    bandwidths: Mapping[str, float] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    groups: tuple[EnvironmentGroup, ...] = ()
    zones: Knowledge | None = None

    @classmethod
    def load(
        cls, source: str | Path | Sequence[str | Path] | None = None, *, cache: bool = True
    ) -> Knowledge:
        """Knowledge from an ontology; reasoned once and kept, so that only the first time is slow.

        Args:
            source: None for the bundled ontology, or the OWL file or files of another one (Turtle,
                RDF/XML, OWL/XML, functional syntax, N-Triples, JSON-LD).
                ``docs/your-own-ontology.md`` says what it must state.
            cache: whether a stored result may be used and a new one is stored: the one in the
                package, or those in the user's cache folder (``SYMBOSLAM_CACHE`` names another).

        Raises:
            InputError: a file cannot be read.
            OntologySyntaxError: a file does not parse.
            InconsistentOntologyError: the ontology contradicts itself.
            EmptyOntologyError: it declares no environments or no indications.
            OntologyError: it is outside OWL 2 DL or has a strength outside (0, 1].
            ReasonerError: there is no Java, or HermiT failed.
        """
        from symboslam.reasoning.loading import load

        if source is None:
            return load(None, cache)
        given = [source] if isinstance(source, str | Path) else list(source)
        return load([Path(path) for path in given], cache)

    def index_of(self, name: str) -> int | None:
        """Position of a feature in ``features``, or None; upper and lower case are alike.

        Looked up in this order: detector label, local name, IRI, name or IRI in the SymboSLAM
        ontology of 2022 (or another ontology that is stated to mean the same), label.
        """
        return self._names.get(name.strip().casefold())

    def find_feature(self, name: str) -> Feature | None:
        """The feature of that name (see :meth:`index_of`), or None."""
        index = self.index_of(name)
        return None if index is None else self.features[index]

    def get_feature(self, name: str) -> Feature:
        """The feature of that name (see :meth:`index_of`).

        Raises:
            UnknownNameError: there is none; the message lists what comes close.
        """
        if (feature := self.find_feature(name)) is None:
            known = [n for f in self.features for n in (f.name, f.detector_label or f.name)]
            raise unknown_name("feature", name, known)
        return feature

    def match_tags(self, tags: Mapping[str, str]) -> int | None:
        """Position of the feature that OpenStreetMap tags describe best, or None.

        For each key an exact ``key=value`` beats ``key=*``; of several values (``a;b``) each is
        tried. Among the features so found, one that is a kind of another beats that other; of the
        rest the most informative wins, by importance times its largest proximity.
        ``key=no`` never matches ``key=*``.
        """
        return self._tags.match(tags)

    @property
    def tag_keys(self) -> frozenset[str]:
        """The keys that occur in the features' OpenStreetMap tags."""
        return self._tags.keys

    def indications_of(self, feature: str) -> tuple[Indication, ...]:
        """What a feature indicates, the strongest first.

        Raises:
            UnknownNameError: there is no such feature.
        """
        return self._indications.get(self.get_feature(feature).name, ())

    def find_indication(self, feature: str, environment: str) -> Indication | None:
        """The strongest way from a feature, by its local name, to an environment; or None."""
        ways = self._indications.get(feature, ())
        return next((way for way in ways if way.environment == environment), None)

    def bandwidth(self, scheme: str | None = None) -> float | None:
        """How far in metres landmarks speak for the ground around them; None if not stated."""
        return self.bandwidths.get(next(iter(self.schemes)) if scheme is None else scheme)

    def scheme(self, name: str | None = None) -> tuple[Environment, ...]:
        """The environment types of a scheme, in the order of ``environments``; None: the default.

        Raises:
            UnknownNameError: there is no such scheme.
        """
        return tuple(self.environments[k] for k in self._columns(name))

    def proximity(self, measure: str = "path", scheme: str | None = None) -> Floats:
        """(F, K) SP(e, f) in [0, 1] for the scheme's environments (see ``reasoning.proximity``).

        Raises:
            UnknownNameError: there is no such measure or scheme.
        """
        if measure not in self.proximities:
            raise unknown_name("proximity measure", measure, list(self.proximities))
        return self.proximities[measure][:, self._columns(scheme)]

    def importance(self, measure: str = "path", scheme: str | None = None) -> Floats:
        """(F,) I(f) = 1 - H(p(.|f)) / log|E| in [0, 1], with p(e|f) proportional to SP(e, f).

        1 for a feature that points to one environment, 0 for one that points to all alike or to
        none (design 4). Where the scheme has a single environment log|E| is 0, and I is 1 for
        every feature that indicates it.

        Raises:
            UnknownNameError: there is no such measure or scheme.
        """
        proximity = self.proximity(measure, scheme)
        total = proximity.sum(axis=1, keepdims=True)
        p = np.divide(proximity, total, out=np.zeros_like(proximity), where=total > 0)
        entropy = -(p * np.log(np.where(p > 0, p, 1.0))).sum(axis=1)
        most = np.log(proximity.shape[1]) if proximity.shape[1] > 1 else 1.0
        return np.where(total[:, 0] > 0, np.clip(1.0 - entropy / most, 0.0, 1.0), 0.0)

    def weights(
        self, measure: str = "path", scheme: str | None = None, importance: str = "entropy"
    ) -> Floats:
        """(F, K) SP(e, f) I(f), or SP(e, f) alone with ``importance="none"`` (design 4).

        Raises:
            UnknownNameError: there is no such measure, scheme or importance.
        """
        if importance not in ("entropy", "none"):
            raise unknown_name("importance", importance, ["entropy", "none"])
        proximity = self.proximity(measure, scheme)
        if importance == "none":
            return proximity
        return proximity * self.importance(measure, scheme)[:, None]

    def direct(self, scheme: str | None = None) -> Floats:
        """(F, K) 1 where an axiom says that a feature itself indicates an environment, else 0.

        Raises:
            UnknownNameError: there is no such scheme.
        """
        links = np.zeros((len(self.features), len(self.environments)))
        rows = {feature.name: i for i, feature in enumerate(self.features)}
        columns = {environment.name: k for k, environment in enumerate(self.environments)}
        for way in self.indications:
            if way.is_direct:
                links[rows[way.feature], columns[way.environment]] = 1.0
        return links[:, self._columns(scheme)]

    def __repr__(self) -> str:
        return (
            f"Knowledge({self.source}: {len(self.features)} features, "
            f"{len(self.environments)} environments, {len(self.indications)} indications)"
        )

    def _repr_html_(self) -> str:
        from html import escape

        rows = "".join(
            f'<tr><td style="background:{escape(e.colour)}">&nbsp;&nbsp;</td><td>{escape(e.label)}'
            f"</td><td>{sum(i.environment == e.name for i in self.indications)}</td>"
            f'<td style="text-align:left">{escape(e.definition)}</td></tr>'
            for e in self.environments
        )
        head = "<tr><th></th><th>environment</th><th>features</th><th>definition</th></tr>"
        return f"<div>{escape(repr(self))}<table>{head}{rows}</table></div>"

    @cached_property
    def _names(self) -> dict[str, int]:
        return name_index(self.features)

    @cached_property
    def _tags(self) -> TagMatcher:
        informativeness = self.importance() * self.proximity().max(axis=1, initial=0.0)
        return TagMatcher(self.features, informativeness.tolist())

    @cached_property
    def _indications(self) -> dict[str, tuple[Indication, ...]]:
        found: dict[str, tuple[Indication, ...]] = {}
        for way in sorted(self.indications, key=lambda i: (-i.proximity, i.environment)):
            found[way.feature] = (*found.get(way.feature, ()), way)
        return found

    def _columns(self, scheme: str | None) -> list[int]:
        name = next(iter(self.schemes)) if scheme is None else scheme
        if name not in self.schemes:
            raise unknown_name("scheme", name, list(self.schemes))
        return [k for k, e in enumerate(self.environments) if e.name in self.schemes[name]]
