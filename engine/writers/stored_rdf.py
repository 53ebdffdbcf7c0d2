"""Maps read back from Turtle or N-Quads; see ``stored.read_map``."""

from __future__ import annotations

import json
import math
from collections import defaultdict
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from symboslam.engine.chain import Chain, chain_of
from symboslam.engine.explanation import Explanation, Reason
from symboslam.engine.writers.rdf_index import Index, read_index
from symboslam.engine.writers.stored import StoredMap, in_order
from symboslam.engine.writers.vocabulary import DCTERMS, PROV, RDFS, SKOS, SOSA
from symboslam.errors import InputError
from symboslam.reasoning.knowledge import Environment, Indication
from symboslam.reasoning.vocabulary import SL, local_name


def read_rdf(path: Path) -> StoredMap:
    """Read a map from a Turtle or N-Quads file.

    Raises:
        InputError: it cannot be read, does not parse, or is no environment map.
    """
    return stored_map(read_index(path), path)


def stored_map(index: Index, path: Path) -> StoredMap:
    """The map among the statements of a file.

    Raises:
        InputError: there is none, or it is incomplete.
    """
    if not index.of_type(SL + "EnvironmentMap"):
        raise InputError(f"{path} holds no sl:EnvironmentMap")
    try:
        return _stored(index, str(path))
    except ValueError as error:
        raise InputError(f"{path} is no complete environment map: {error}") from error


def _stored(index: Index, source: str) -> StoredMap:
    """The map that the records of ``rdf_records`` and ``rdf_lineage`` describe."""
    mentioned = {index.one(c, SL + "featureClass") for c in index.of_type(SL + "Contribution")}
    features = [feature for feature in mentioned if feature is not None]
    environments = index.subjects(RDFS + "subClassOf", SL + "Environment")
    nodes = index.of_type(SL + "Segment")
    segments = [_segment(index, node) for node in nodes]
    return StoredMap(
        source=source,
        environments={_name(index, e): _environment(index, e) for e in environments},
        features={_name(index, f): index.text(f, RDFS + "label") for f in features},
        indications={
            (i.feature, i.environment): i for f in features for i in _indications(index, f)
        },
        segments={segment.segment_id: segment for segment in segments},
        config={
            index.text(node, SL + "settingName"): _value(index.text(node, SL + "settingValue"))
            for node in index.of_type(SL + "Setting")
        },
        knowledge_hash=next(
            (index.text(node, SL + "sha256") for node in index.of_type(SL + "OntologySource")), ""
        ),
        iris={_name(index, term): term for term in [*features, *environments, *_levels(index)]},
        segment_iris={
            segment.segment_id: node
            for segment, node in zip(segments, nodes, strict=True)
            if not node.startswith("_:")
        },
    )


def _levels(index: Index) -> list[str]:
    """The groups and zones that occur."""
    nodes = index.of_type(SL + "ChainedProbability")
    found = {index.one(node, SL + "environment") for node in nodes}
    return sorted(term for term in found if term is not None)


def _value(text: str) -> Any:
    """A setting as a plain value."""
    try:
        return json.loads(text)
    except ValueError:
        return text


def _name(index: Index, term: str) -> str:
    """The name that a class goes by in files."""
    return index.text(term, SKOS + "notation") or local_name(term)


def _named(index: Index, node: str, predicate: str) -> str:
    """The name of the class that a node points to."""
    term = index.one(node, predicate)
    if term is None:
        raise ValueError(f"{node} lacks {predicate}")
    return _name(index, term)


def _number(index: Index, node: str, predicate: str) -> float:
    """The finite number that a node has."""
    text = index.text(node, predicate)
    try:
        number = float(text)
    except ValueError as error:
        raise ValueError(f"{node} has {text[:40]!r} for {predicate}, not a number") from error
    if not math.isfinite(number):
        raise ValueError(f"{node} has {text[:40]!r} for {predicate}, not a finite number")
    return number


def _environment(index: Index, term: str) -> Environment:
    return Environment(
        iri=term,
        name=_name(index, term),
        label=index.text(term, RDFS + "label"),
        definition=index.text(term, SKOS + "definition"),
        colour=index.text(term, SL + "colour"),
    )


def _indications(index: Index, feature: str) -> list[Indication]:
    return [
        Indication(
            feature=_name(index, feature),
            environment=_named(index, node, SL + "environment"),
            strength=_number(index, node, SL + "strength"),
            steps=int(_number(index, node, SL + "steps")),
            path=tuple(filter(None, index.text(node, SL + "way").split(" > "))),
            reason=index.text(node, RDFS + "comment"),
            source=index.text(node, DCTERMS + "source"),
            source_iri=index.text(node, PROV + "wasDerivedFrom"),
            stands=index.text(node, SL + "statedAt"),
        )
        for node in index.all(feature, SL + "hasIndication")
    ]


def _segment(index: Index, segment: str) -> Explanation:
    """A segment with its distribution and reasons; without them where it is unknown."""
    environment = index.one(segment, SL + "environment")
    probabilities: dict[str, float] = {}
    reasons: list[Reason] = []
    groups: dict[str, float] = {}
    zones: dict[str, Mapping[str, float] | None] = {}
    for classification in index.subjects(SOSA + "hasFeatureOfInterest", segment):
        for distribution in index.all(classification, SOSA + "hasResult"):
            for node in index.all(distribution, SL + "hasProbability"):
                name = _named(index, node, SL + "environment")
                probabilities[name] = _number(index, node, SL + "probability")
                if below := _chained(index, node, "hasZoneProbability"):
                    zones[name] = below
                elif index.text(node, SL + "zonesToldApart") == "false":
                    zones[name] = None
            groups = _chained(index, distribution, "hasGroupProbability")
        reasons += _reasons(index, classification)
    return in_order(
        Explanation(
            segment_id=index.text(segment, DCTERMS + "identifier"),
            environment=None if environment is None else _name(index, environment),
            probabilities=probabilities,
            reasons=tuple(reasons),
            chain=_chain(index, probabilities, groups, zones),
        )
    )


def _chained(index: Index, node: str, link: str) -> dict[str, float]:
    """Zone or group -> the probability that a node links to."""
    return {
        _named(index, each, SL + "environment"): _number(index, each, SL + "probability")
        for each in index.all(node, SL + link)
    }


def _chain(
    index: Index,
    probabilities: Mapping[str, float],
    groups: Mapping[str, float],
    zones: Mapping[str, Mapping[str, float] | None],
) -> Chain | None:
    """The chain of a segment; None where the file tells none, as without reasons."""
    if not groups and not zones:
        return None
    by_name = {_name(index, e): e for e in index.subjects(RDFS + "subClassOf", SL + "Environment")}
    grouped = {
        name
        for name in probabilities
        if any(_name(index, c) in groups for c in index.all(by_name[name], RDFS + "subClassOf"))
    }
    alone = {name: p for name, p in probabilities.items() if p and name not in grouped}
    return chain_of({**groups, **alone}, zones)


def _reasons(index: Index, classification: str) -> list[Reason]:
    """The contributions to a segment, put together by feature."""
    shares: dict[str | None, dict[str, float]] = defaultdict(dict)
    described: dict[str | None, tuple[str, str, int]] = {}
    for node in index.all(classification, SL + "hasContribution"):
        feature = index.one(node, SL + "featureClass")
        name = "" if feature is None else _name(index, feature)
        label = index.text(feature or node, RDFS + "label")
        described[feature] = (name, label, int(_number(index, node, SL + "count")))
        environment = _named(index, node, SL + "environment")
        shares[feature][environment] = _number(index, node, SL + "share")
    return [Reason(*described[feature], shares[feature]) for feature in shares]
