"""Environment maps as GeoJSON: one polygon a segment, written feature by feature."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any, BinaryIO

import shapely

from symboslam import __version__
from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.writers.content import (
    MILLION,
    Block,
    ChainPart,
    Content,
    Part,
    source_name,
)
from symboslam.engine.writers.options import WriteOptions, reasons_wanted


def write(environment_map: EnvironmentMap, stream: BinaryIO, options: WriteOptions) -> None:
    """Write a map as a GeoJSON FeatureCollection (design 8).

    Args:
        environment_map: the map.
        stream: where to write, as UTF-8.
        options: ``reasons`` and ``progress`` are used.
    """
    for text in _collection(environment_map, options):
        # A file name may hold bytes that are no text; JSON can carry them as \\udcXX.
        stream.write(text.encode("utf-8", "backslashreplace"))


def to_geojson(environment_map: EnvironmentMap, reasons: int | None = None) -> dict[str, Any]:
    """A map as a GeoJSON FeatureCollection, just as ``write`` puts it into a file.

    Args:
        environment_map: the map.
        reasons: how many reasons each segment lists; 0 = none; None = 8, or none where there are
            more than 20,000 segments.
    """
    options = WriteOptions(reasons_wanted(reasons, len(environment_map)))
    collection: dict[str, Any] = json.loads("".join(_collection(environment_map, options)))
    return collection


def _collection(environment_map: EnvironmentMap, options: WriteOptions) -> Iterator[str]:
    """The text of the collection, piece by piece; what only the end can know comes last."""
    content = Content(environment_map, options.reasons)
    head = {"type": "FeatureCollection", "bbox": content.bbox}
    if not environment_map.landmarks.frame.geographic:
        head["crs_units"] = "m"
    if environment_map.landmarks.report.attribution:
        head["attribution"] = environment_map.landmarks.report.attribution
    yield _json(head)[:-1] + ',"features":[\n'
    names = [_json(name) for name in content.environment_names]
    distribution = "{" + ",".join(f"{n.replace('%', '%%')}:%.6g" for n in names) + "}"
    written = 0
    for block in content.blocks():
        yield (",\n" if written else "") + ",\n".join(_features(block, names, distribution))
        written += len(block.segment_id)
        options.tell("writing GeoJSON", written / len(environment_map))
    yield "\n]" + _json({"symboslam": _about(content)}).replace("{", ",", 1) + "\n"


def _features(block: Block, names: list[str], distribution: str) -> Iterator[str]:
    """The text of each feature.

    Args:
        block: the segments.
        names: names of the environments, as JSON.
        distribution: a template for the probabilities.
    """
    outlines = shapely.to_geojson(block.geometry).tolist()
    probabilities = (block.probability / MILLION).tolist()
    for i, label in enumerate(block.environment):
        count = block.landmark_count[i]
        known = label >= 0
        single = ',"single_landmark":true' if count == 1 else ""
        reasons = "" if block.parts is None else f',"reasons":{_reasons(block.parts[i])}'
        chain = None if block.chains is None else block.chains[i]
        reasons += "" if chain is None else f',"chain":{_chain(chain)}'
        yield (
            f'{{"type":"Feature","geometry":{outlines[i]},"properties":{{'
            f'"segment_id":{_json(block.segment_id[i])},'
            f'"environment":{names[label] if known else "null"},'
            f'"probabilities":{distribution % tuple(probabilities[i]) if known else "null"},'
            f'"landmark_count":{count},"depth":{block.depth[i]}{single}{reasons}}}}}'
        )


def _reasons(parts: list[Part]) -> str:
    return _json(
        [
            {
                "feature": part.feature,
                "label": part.label,
                "count": part.count,
                "contribution": {e: n / MILLION for e, n in part.shares.items()},
            }
            for part in parts
        ]
    )


def _chain(chain: ChainPart) -> str:
    return _json(
        {
            "groups": {name: n / MILLION for name, n in chain.groups.items()},
            "zones": {
                name: zones and {zone: n / MILLION for zone, n in zones.items()}
                for name, zones in chain.zones.items()
            },
        }
    )


def _about(content: Content) -> dict[str, Any]:
    """The member ``symboslam``: what the map was made of and with."""
    m = content.map
    return {
        "version": __version__,
        "config": dict(m.config),
        "knowledge_hash": m.knowledge.source_hash,
        "source": source_name(m),
        "report": content.report(),
        "environments": content.environments(),
        "levels": content.levels(),
        "features": content.features(),
    }


_json = json.JSONEncoder(ensure_ascii=False, separators=(",", ":"), default=str).encode
