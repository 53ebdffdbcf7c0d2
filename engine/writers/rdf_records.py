"""Landmarks, segments and classifications as RDF records: subjects with what is said of them."""

from __future__ import annotations

from collections.abc import Iterator
from datetime import datetime
from typing import TypeAlias

import numpy as np
import shapely

from symboslam.engine.writers.content import OTHER, ChainPart, Content, Part
from symboslam.engine.writers.options import WriteOptions
from symboslam.engine.writers.rdf_syntax import Properties, Syntax
from symboslam.engine.writers.vocabulary import (
    CRS84,
    DCTERMS,
    GEO,
    LOCAL_METRES,
    PROV,
    RDF,
    RDFS,
    SOSA,
    XSD,
)
from symboslam.reasoning.vocabulary import SL

Property: TypeAlias = "tuple[str, list[str | Properties]]"
Record: TypeAlias = "tuple[str, Properties]"


class Records:
    """A map's landmarks and segments.

    Args:
        content: the map.
        syntax: how terms are written.

    Attributes:
        features: terms of all features, in the knowledge's order.
        feature_named: name of a feature -> term.
        environments: terms of the K environments.
        environment_named: name of an environment -> term.
        level_named: name of a group or zone -> term.
    """

    def __init__(self, content: Content, syntax: Syntax) -> None:
        self.content, self.map, self.syntax = content, content.map, syntax
        known = content.map.knowledge.features
        self.features = [syntax.iri(f.iri) for f in known]
        self.feature_named = dict(zip((f.name for f in known), self.features, strict=True))
        self.environments = [syntax.iri(e.iri) for e in content.map.environments]
        self.environment_named = dict(
            zip(content.environment_names, self.environments, strict=True)
        )
        self.level_named = {n: syntax.iri(e["iri"]) for n, e in content.levels().items()}
        environment = syntax.iri(SL + "environment")
        self._of_environment: dict[str, Property] = {
            name: (environment, [term]) for name, term in self.environment_named.items()
        }
        self._crs = CRS84 if content.map.landmarks.frame.geographic else LOCAL_METRES
        self._type = syntax.iri(RDF + "type")

    def a(self, *classes: str) -> Property:
        """rdf:type."""
        return self._type, [self.syntax.iri(c) for c in classes]

    def geometry(self, wkt: str) -> Property:
        """geo:hasGeometry; GeoSPARQL wants the coordinate system in front of the text."""
        s = self.syntax
        literal = s.typed(f"<{self._crs}> {wkt}", GEO + "wktLiteral")
        node: Properties = [self.a(GEO + "Geometry"), (s.iri(GEO + "asWKT"), [literal])]
        return s.iri(GEO + "hasGeometry"), [node]

    def landmarks(self) -> Iterator[Record]:
        """Each landmark and the observation of its class."""
        s, marks = self.syntax, self.map.landmarks
        first, second = marks.frame.from_metres(marks.x, marks.y)
        identifier, of, observed, has_result, part, feature_class, confidence = (
            s.iri(DCTERMS + "identifier"),
            s.iri(SOSA + "hasFeatureOfInterest"),
            s.iri(SOSA + "observedProperty"),
            s.iri(SOSA + "hasResult"),
            s.iri(DCTERMS + "isPartOf"),
            s.iri(SL + "featureClass"),
            s.iri(SL + "confidence"),
        )
        d = self.content.decimals
        for i, name in enumerate(marks.id.tolist()):
            kind = self.features[marks.feature[i]]
            landmark = s.own("landmark", name)
            types = [*self.a(SL + "Landmark", GEO + "Feature")[1], kind]
            yield (
                landmark,
                [
                    (self._type, types),
                    (identifier, [s.text(name)]),
                    (feature_class, [kind]),
                    self.geometry(f"POINT ({first[i]:.{d}f} {second[i]:.{d}f})"),
                ],
            )
            result: Properties = [
                self.a(SL + "Detection"),
                (feature_class, [kind]),
                (confidence, [s.decimal(digits(float(marks.confidence[i])))]),
            ]
            observation: Properties = [
                self.a(SL + "LandmarkObservation", SOSA + "Observation"),
                (part, [s.own("landmarks")]),
                (of, [landmark]),
                (observed, [feature_class]),
                (has_result, [result]),
            ]
            if marks.time is not None and marks.time[i]:
                observation.append(self._when(str(marks.time[i])))
            if marks.agent is not None and marks.agent[i]:
                agent = s.own("agent", str(marks.agent[i]))
                observation.append((s.iri(PROV + "wasAssociatedWith"), [agent]))
            yield s.own("observation", name), observation

    def _when(self, time: str) -> Property:
        """A time of observation; one that is no full date and time stays a text."""
        try:
            moment = datetime.fromisoformat(time).isoformat()
        except ValueError:
            return self.syntax.iri(DCTERMS + "date"), [self.syntax.text(time)]
        return self.syntax.iri(SOSA + "resultTime"), [self.syntax.typed(moment, XSD + "dateTime")]

    def segments(self, options: WriteOptions) -> Iterator[Record]:
        """Each segment and, unless it is unknown, how it was classified."""
        s, written = self.syntax, 0
        for block in self.content.blocks():
            outlines = shapely.to_wkt(block.geometry, rounding_precision=self.content.decimals)
            rows = block.probability.tolist()
            for i, name in enumerate(block.segment_id):
                segment, label = s.own("segment", name), block.environment[i]
                found: Properties = [
                    self.a(SL + "Segment", GEO + "Feature"),
                    (s.iri(DCTERMS + "identifier"), [s.text(name)]),
                    (s.iri(DCTERMS + "isPartOf"), [s.own("map")]),
                    (s.iri(SL + "landmarkCount"), [s.integer(block.landmark_count[i])]),
                    (s.iri(SL + "depth"), [s.integer(block.depth[i])]),
                    self.geometry(str(outlines[i])),
                ]
                if label >= 0:
                    found.insert(3, (s.iri(SL + "environment"), [self.environments[label]]))
                yield segment, found
                if label >= 0:
                    parts = block.parts[i] if block.parts is not None else []
                    chain = None if block.chains is None else block.chains[i]
                    yield self._classification(
                        name, segment, rows[i], parts, chain or ChainPart({}, {})
                    )
            written += len(block.segment_id)
            options.tell("writing RDF", written / len(self.map))

    def _classification(
        self, name: str, segment: str, row: list[int], parts: list[Part], chain: ChainPart
    ) -> Record:
        s = self.syntax
        kind, probability = self.a(SL + "EnvironmentProbability"), s.iri(SL + "probability")
        distribution: list[str | Properties] = [
            [
                kind,
                self._of_environment[e],
                (probability, [s.decimal(fraction(p))]),
                *self._zones(e, chain),
            ]
            for e, p in zip(self.content.environment_names, row, strict=True)
        ]
        found: Properties = [
            self.a(SL + "SegmentClassification", SOSA + "Observation"),
            (s.iri(SOSA + "hasFeatureOfInterest"), [segment]),
            (s.iri(SOSA + "observedProperty"), [s.iri(SL + "environment")]),
            (
                s.iri(SOSA + "hasResult"),
                [
                    [
                        self.a(SL + "EnvironmentDistribution"),
                        (s.iri(PROV + "wasGeneratedBy"), [s.own("run")]),
                        (s.iri(SL + "hasProbability"), distribution),
                        *self._groups(chain),
                    ]
                ],
            ),
        ]
        contributions = [node for part in parts for node in self._contributions(part)]
        if contributions:
            found.append((s.iri(SL + "hasContribution"), list(contributions)))
        return s.own("classification", name), found

    def _zones(self, environment: str, chain: ChainPart) -> Properties:
        """How the zones of an environment share its probability, or that nothing tells."""
        if environment not in chain.zones:
            return []
        zones = chain.zones[environment]
        if zones is None:
            return [
                (
                    self.syntax.iri(SL + "zonesToldApart"),
                    [self.syntax.typed("false", XSD + "boolean")],
                )
            ]
        return [self._chained("hasZoneProbability", zones)] if zones else []

    def _groups(self, chain: ChainPart) -> Properties:
        """The probabilities of groups; a type that is in none has its own among the others."""
        own = self.environment_named
        groups = {name: n for name, n in chain.groups.items() if name not in own}
        return [self._chained("hasGroupProbability", groups)] if groups else []

    def _chained(self, link: str, found: dict[str, int]) -> Property:
        s = self.syntax
        return s.iri(SL + link), [
            [
                self.a(SL + "ChainedProbability"),
                (s.iri(SL + "environment"), [self.level_named[name]]),
                (s.iri(SL + "probability"), [s.decimal(fraction(n))]),
            ]
            for name, n in found.items()
        ]

    def _contributions(self, part: Part) -> Iterator[Properties]:
        """A node for each environment that a reason adds something to."""
        s = self.syntax
        what: Property = (
            (s.iri(RDFS + "label"), [s.text(OTHER, "en")])
            if part.feature is None
            else (s.iri(SL + "featureClass"), [self.feature_named[part.feature]])
        )
        kind, share = self.a(SL + "Contribution"), s.iri(SL + "share")
        count: Property = (s.iri(SL + "count"), [s.integer(part.count)])
        for name, n in part.shares.items():
            yield [
                kind,
                what,
                self._of_environment[name],
                (share, [s.decimal(fraction(n))]),
                count,
            ]


def digits(value: float) -> str:
    """All digits of a number, without an exponent: what xsd:decimal can hold."""
    return np.format_float_positional(value, trim="0")


def fraction(millionths: int) -> str:
    """A number of millionths as a decimal number, without trailing zeros but the first.

    >>> fraction(250_000), fraction(-1), fraction(1_000_000)
    ('0.25', '-0.000001', '1.0')
    """
    short = f"{millionths / 1e6:.6f}".rstrip("0")
    return short + "0" if short.endswith(".") else short
