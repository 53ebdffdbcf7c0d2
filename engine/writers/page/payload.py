"""Payload: an environment map as the small JSON document that the HTML page draws.

Lengths are integers, multiples of ``unit`` metres from ``origin``; probabilities and contributions
are integers, multiples of 1/10000. Environments and features are numbers into the lists ``envs``
and ``features``. docs/decisions tells why the page looks like this.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.explanation import Reason
from symboslam.engine.frame import Frame
from symboslam.engine.writers.content import ontology_name, source_name
from symboslam.engine.writers.page.features import Features
from symboslam.engine.writers.page.outlines import Quantiser, regions

Floats = NDArray[np.float64]
PARTS = 10_000
"""Probabilities and contributions are multiples of 1 / PARTS."""
REASONS = 60_000
"""Reasons for one environment in a page: a map of many segments gets fewer for each."""
DOTS = 250_000
"""Landmarks that a page can draw; a map with more is drawn without."""
LEAST = 5
"""Shares below this many parts are left to "everything else"."""
CHUNK = 1024
_EVERYDAY = {"landmarks", "map", "data", "input", "points"}
"""Names of files that say less than the name of their folder."""
_STREAMS = {"stdin", "standard input"}


def payload(environment_map: EnvironmentMap, reasons: int) -> dict[str, Any]:
    """Everything that the page shows, as plain values.

    Args:
        environment_map: the map.
        reasons: how many to tell at most for each environment of a segment; the page adds up the
            others itself. 0 = none.

    Returns:
        A document for ``json.dumps``; see ``page/data.js``, which reads it.
    """
    landmarks = environment_map.landmarks
    bounds = _bounds(environment_map)
    quantiser = Quantiser.for_bounds(bounds)
    features = Features(environment_map)
    segments = _segments(environment_map, quantiser)
    segments["reasons"], segments["zones"] = _told(environment_map, features, reasons)
    groups = {g.name: g.label for g in environment_map.knowledge.groups}
    zones = environment_map.knowledge.zones
    drawn = len(landmarks) <= DOTS
    surveyed = landmarks.surveyed
    return {
        "title": _title(environment_map),
        "facts": _facts(environment_map),
        "attribution": landmarks.report.attribution,
        "config": {k: _plain(v) for k, v in environment_map.config.items()},
        "report": {
            "unknown": landmarks.report.unknown.most_common(),
            "outside": landmarks.report.outside,
            "duplicates": landmarks.report.duplicates,
            "notes": list(landmarks.report.notes),
        },
        "geographic": landmarks.frame.geographic,
        "inverse": _inverse(landmarks.frame, bounds),
        "unit": quantiser.unit,
        "origin": list(quantiser.origin),
        "bounds": quantiser.points(np.reshape(bounds, (2, 2))).ravel().tolist(),
        "surveyed": [] if surveyed is None else quantiser.rings(surveyed),
        "envs": [
            {
                "name": e.name,
                "label": e.label or e.name,
                "definition": e.definition,
                "colour": colour(e.colour),
                "group": groups.get(environment_map.zoning.group_of[e.name], ""),
                "zoned": bool(zones is not None and e.name in zones.schemes),
            }
            for e in environment_map.environments
        ],
        "zones": _zones(environment_map),
        "segments": segments,
        "regions": regions(environment_map.geometry, environment_map.label, quantiser),
        "count": len(landmarks),
        "landmarks": _landmarks(environment_map, quantiser, features) if drawn else None,
        "features": features.rows,
    }


def colour(text: str) -> str:
    """A colour that is safe to draw with: ``#rrggbb``, else a grey."""
    return text.lower() if re.fullmatch(r"#[0-9a-fA-F]{6}", text) else "#888888"


def _plain(value: Any) -> Any:
    return value if value is None or isinstance(value, bool | int | float) else str(value)


def _title(environment_map: EnvironmentMap) -> str:
    given = environment_map.config.get("title")
    if given:
        return str(given)
    *folders, file = re.split(r"[\\/]", environment_map.landmarks.report.source)
    stem = file.split(".")[0]
    if stem.lower() in _EVERYDAY and folders and folders[-1].strip("."):
        stem = folders[-1]
    words = re.sub(r"[_\s]+", " ", stem).strip()
    named = re.match(r"\w", words) and words.lower() not in _STREAMS
    return words[0].upper() + words[1:] if named else "Environment map"


def _facts(environment_map: EnvironmentMap) -> dict[str, str]:
    knowledge, config = environment_map.knowledge, environment_map.config
    return {
        "Source": source_name(environment_map),
        "Profile": str(config.get("profile", "")),
        "Environment types": str(config.get("scheme", "")),
        "Segmentation": str(config.get("segmentation", "")),
        "Ontology": ontology_name(environment_map),
        "Ontology hash": knowledge.source_hash,
    }


def _bounds(environment_map: EnvironmentMap) -> tuple[float, float, float, float]:
    """The area to classify and all segments, in metres; never without extent."""
    import shapely

    boxes = [environment_map.landmarks.bbox]
    if len(environment_map):
        boxes.append(tuple(shapely.total_bounds(environment_map.geometry)))
    corners = np.array(boxes, np.float64)
    west, south = corners[:, :2].min(0)
    east, north = corners[:, 2:].max(0)
    grow = 0.5 if max(east - west, north - south) <= 0 else 0.0
    return float(west - grow), float(south - grow), float(east + grow), float(north + grow)


def _inverse(frame: Frame, bounds: tuple[float, float, float, float]) -> dict[str, Any] | None:
    """Metres -> degrees as two polynomials of degree 5, so that the page needs no projection.

    Over 100 km x 100 km they are within 1e-7 degrees; the page shows 5 decimals.
    """
    if not frame.geographic:
        return None
    west, south, east, north = bounds
    middle = ((west + east) / 2, (south + north) / 2)
    half = max(east - west, north - south) / 2
    u, v = (axis.ravel() for axis in np.meshgrid(np.linspace(-1, 1, 11), np.linspace(-1, 1, 11)))
    terms = np.column_stack([u**i * v**j for i in range(6) for j in range(6 - i)])
    lon, lat = frame.from_metres(middle[0] + half * u, middle[1] + half * v)
    lon = np.unwrap(lon - frame.origin[0], period=360) + frame.origin[0]
    solution = np.linalg.lstsq(terms, np.column_stack([lon, lat]), rcond=None)[0]
    return {
        "middle": middle,
        "half": half,
        "lon": solution[:, 0].tolist(),
        "lat": solution[:, 1].tolist(),
    }


def _segments(environment_map: EnvironmentMap, quantiser: Quantiser) -> dict[str, Any]:
    """The segments column by column; ``rings`` holds those that are not upright rectangles."""
    import shapely

    geometry, surveyed = environment_map.geometry, environment_map.landmarks.surveyed
    area = shapely.area(geometry) if len(geometry) else np.zeros(0)
    unknown = np.flatnonzero(environment_map.label < 0)
    beyond: list[int] = []
    if surveyed is not None and len(unknown):
        middles = shapely.point_on_surface(geometry[unknown])
        beyond = unknown[~shapely.intersects(surveyed, middles)].tolist()
    return {
        "id": [str(i) for i in environment_map.segment_id],
        "label": environment_map.label.tolist(),
        "p": np.rint(environment_map.probability * PARTS).astype(int).ravel().tolist(),
        "count": environment_map.landmark_count.tolist(),
        "area": [float(f"{a:.5g}") for a in area],
        "box": quantiser.boxes(geometry).ravel().tolist(),
        "rings": quantiser.shapes(geometry),
        "unsurveyed": beyond,
    }


def _told(
    environment_map: EnvironmentMap, features: Features, most: int
) -> tuple[list[Any] | None, list[Any] | None]:
    """For each segment its reasons and the zones of its environment; None without reasons.

    Reasons are [feature, count, environment, share, environment, share ...]; zones are [zone,
    share, zone, share ...], the most probable first, none where they are not told apart.
    """
    total = len(environment_map)
    limit = min(most, REASONS // max(total, 1))
    if limit < 1:
        return None, None
    env = {e.name: k for k, e in enumerate(environment_map.environments)}
    number = {zone["name"]: i for i, zone in enumerate(_zones(environment_map))}
    rows: list[Any] = []
    zones: list[Any] = []
    for start in range(0, total, CHUNK):
        positions = range(start, min(start + CHUNK, total))
        for i, (reasons, shares) in zip(positions, environment_map.told(positions), strict=True):
            rows.append([_reason(r, env, features) for r in _strongest(reasons, limit)])
            winner = environment_map.name_of(i)
            found = shares.get(winner) if winner else None
            chance = float(environment_map.probability[i].max())
            ranked = sorted((found or {}).items(), key=lambda pair: -pair[1])
            parts = [(number[zone], round(share * chance * PARTS)) for zone, share in ranked]
            zones.append([n for part in parts if part[1] for n in part])
    return rows, zones


def _zones(environment_map: EnvironmentMap) -> list[dict[str, str]]:
    """The plan zones of the map's environments."""
    table = environment_map.knowledge.zones
    return [
        {"name": z.name, "label": z.label or z.name, "definition": z.definition}
        for e in environment_map.environments
        if table is not None and e.name in table.schemes
        for z in table.scheme(e.name)
    ]


def _strongest(reasons: Sequence[Reason], limit: int) -> list[Reason]:
    """The strongest reasons for each environment, so that "why not" has an answer for all."""
    taken: set[int] = set()
    for name in {name for reason in reasons for name in reason.contribution}:
        parts = [abs(reason.contribution.get(name, 0.0)) for reason in reasons]
        best = sorted(range(len(reasons)), key=lambda i: -parts[i])[:limit]
        taken.update(i for i in best if parts[i] * PARTS >= LEAST)
    return [reasons[i] for i in sorted(taken)]


def _reason(reason: Reason, env: dict[str, int], features: Features) -> list[int]:
    row = [features.number(reason.feature, reason.label), int(reason.count)]
    for name, share in reason.contribution.items():
        parts = round(share * PARTS)
        if parts and name in env:
            row += [env[name], parts]
    return row


def _landmarks(
    environment_map: EnvironmentMap, quantiser: Quantiser, features: Features
) -> dict[str, Any]:
    """The landmarks column by column; ``segment`` is -1 where none holds the landmark."""
    landmarks = environment_map.landmarks
    known = environment_map.knowledge.features
    used, position = np.unique(landmarks.feature, return_inverse=True)
    number = np.array([features.number(known[i].name) for i in used], np.int64)
    columns: dict[str, Any] = {
        "xy": quantiser.points(landmarks.xy).ravel().tolist(),
        "feature": number[position].tolist(),
        "confidence": [round(float(c), 3) for c in landmarks.confidence],
        "id": [str(i) for i in landmarks.id],
        "segment": _homes(environment_map).tolist(),
    }
    for name, column in (("time", landmarks.time), ("agent", landmarks.agent)):
        if column is not None:
            columns[name] = [None if v is None else str(v) for v in column]
    return columns


def _homes(environment_map: EnvironmentMap) -> NDArray[np.int64]:
    """(n,) the segment that holds each landmark, or -1; on a border the one to the north-east."""
    import shapely

    landmarks, geometry = environment_map.landmarks, environment_map.geometry
    homes = np.full(len(landmarks), -1, np.int64)
    if not len(landmarks) or not len(geometry):
        return homes
    tree = shapely.STRtree(geometry)
    point, segment = tree.query(shapely.points(landmarks.xy), predicate="intersects")
    bounds = shapely.bounds(geometry)[segment]
    inside = (landmarks.x[point] < bounds[:, 2]).astype(int) + (landmarks.y[point] < bounds[:, 3])
    order = np.argsort(inside, kind="stable")
    homes[point[order]] = segment[order]
    return homes
