"""Maps read back from their files, as far as explaining their segments needs."""

from __future__ import annotations

import difflib
import json
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from symboslam.engine.chain import chain_of
from symboslam.engine.explanation import Explanation, Reason
from symboslam.errors import InputError, UnknownNameError
from symboslam.reasoning.knowledge import Environment, Indication


@dataclass(frozen=True)
class StoredMap:
    """A written map: what each segment is and why, without landmarks and outlines.

    Attributes:
        source: the file.
        environments: environment types by name.
        features: labels of the features that are named in reasons, by name.
        indications: (feature name, environment name) -> what the one says of the other.
        segments: explanations by segment id.
        config: the settings that it was made with, as keywords of ``classify``.
        knowledge_hash: of the ontology that it was made with.
        iris: IRIs of environments, features, groups and zones by name.
        segment_iris: IRIs of segments by segment id; none in formats without IRIs.
    """

    source: str
    environments: Mapping[str, Environment]
    features: Mapping[str, str]
    indications: Mapping[tuple[str, str], Indication]
    segments: Mapping[str, Explanation]
    config: Mapping[str, Any] = field(default_factory=dict)
    knowledge_hash: str = ""
    iris: Mapping[str, str] = field(default_factory=dict)
    segment_iris: Mapping[str, str] = field(default_factory=dict)

    def __len__(self) -> int:
        return len(self.segments)

    def explain(self, segment_id: str) -> Explanation:
        """Why a segment is what it is, as far as the file tells.

        What the reasons that are not listed add is a reason without a feature name.

        Raises:
            UnknownNameError: no such segment; names the closest ids.
        """
        found = self.segments.get(segment_id)
        if found is None:
            close = difflib.get_close_matches(segment_id, self.segments, 3, 0)
            raise UnknownNameError(
                f"{self.source}: no segment {segment_id!r} among its {len(self)}"
                + (f"; close: {', '.join(close)}" if close else "")
            )
        return found

    def environment_of(self, word: str) -> str:
        """Name of the environment with this name or label; upper and lower case are alike.

        Raises:
            UnknownNameError: there is none; lists those that there are.
        """
        for name, environment in self.environments.items():
            if word.casefold() in (name.casefold(), environment.label.casefold()):
                return name
        raise UnknownNameError(
            f"{self.source}: no environment {word!r}; there are: {', '.join(self.environments)}"
        )

    def find_indication(self, feature: str, environment: str) -> Indication | None:
        """What a feature says of an environment, or None if the file tells nothing of it."""
        return self.indications.get((feature, environment))


def read_map(path: str | Path) -> StoredMap:
    """Read a map that ``write_map`` wrote as GeoJSON, Turtle or N-Quads; all give the same.

    Args:
        path: the file; its ending tells the format.

    Raises:
        InputError: it cannot be read, has another format, or is no environment map.
    """
    suffix = Path(path).suffix.lower()
    try:
        if suffix in (".geojson", ".json"):
            return _read_geojson(Path(path))
        if suffix in (".ttl", ".nq"):
            from symboslam.engine.writers.stored_rdf import read_rdf

            return read_rdf(Path(path))
    except OSError as error:
        raise InputError(f"{path} cannot be read: {error.strerror or error}") from error
    raise InputError(f"{path}: only maps in .geojson, .json, .ttl and .nq can be read back")


def _read_geojson(path: Path) -> StoredMap:
    try:
        collection = json.loads(path.read_bytes())
    except json.JSONDecodeError as error:
        raise InputError(f"{path} is no JSON, or it is cut short: {error}") from error
    except (ValueError, RecursionError) as error:
        problem = "no text, nested too deeply, or with a number of thousands of digits"
        raise InputError(f"{path} is no JSON of a map: {problem}") from error
    try:
        about = collection.get("symboslam", {})
        features: dict[str, Any] = about.get("features", {})
        environments: dict[str, Any] = about.get("environments", {})
        segments = [_segment(feature["properties"]) for feature in collection["features"]]
        return StoredMap(
            source=str(path),
            environments={n: Environment(name=n, **e) for n, e in environments.items()},
            features={name: feature["label"] for name, feature in features.items()},
            indications={
                (name, environment): Indication(
                    name, environment, **{**given, "path": tuple(given["path"])}
                )
                for name, feature in features.items()
                for environment, given in feature["indications"].items()
            },
            segments={segment.segment_id: segment for segment in segments},
            config=dict(about.get("config", {})),
            knowledge_hash=str(about.get("knowledge_hash", "")),
            iris={
                name: str(given["iri"])
                for table in (features, environments, about.get("levels", {}))
                for name, given in table.items()
            },
        )
    except (AttributeError, KeyError, TypeError, ValueError, OverflowError) as error:
        problem = f"it lacks {error}" if isinstance(error, KeyError) else "a part has a wrong type"
        raise InputError(
            f"{path} is no environment map written by symboslam, or it is damaged: {problem}"
        ) from error


def _segment(properties: dict[str, Any]) -> Explanation:
    return in_order(
        Explanation(
            segment_id=str(properties["segment_id"]),
            environment=properties["environment"],
            probabilities={e: float(p) for e, p in (properties["probabilities"] or {}).items()},
            reasons=tuple(
                Reason(
                    given["feature"] or "",
                    given["label"],
                    given["count"],
                    {e: float(share) for e, share in given["contribution"].items()},
                )
                for given in properties.get("reasons", ())
            ),
            chain=chain_of(**properties["chain"]) if properties.get("chain") else None,
        )
    )


def in_order(explanation: Explanation) -> Explanation:
    """The same with the strongest reason first, ties by name, and the rest last."""
    winner = explanation.environment or ""

    def rank(reason: Reason) -> tuple[bool, float, str]:
        return not reason.feature, -abs(reason.contribution.get(winner, 0.0)), reason.feature

    return replace(explanation, reasons=tuple(sorted(explanation.reasons, key=rank)))
