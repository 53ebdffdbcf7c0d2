"""Maps as GeoJSON: landmarks as points that ``symboslam classify`` reads, paths as lines."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

import numpy as np

from symboslam.engine.frame import Frame
from symboslam.engine.slam.log import Floats
from symboslam.engine.slam.writers.output import Output, Written, write_files
from symboslam.errors import InputError

NO_REACH = 10.0
"""Metres around a robot that count as seen where no range was measured."""
_json = json.JSONEncoder(ensure_ascii=False, separators=(",", ":"), allow_nan=False).encode


def write(output: Output) -> Written:
    """Write the landmarks, and the paths to a second file if one is named.

    Raises:
        InputError: the origin is no longitude and latitude, or both files are one.
        OutputError: a file cannot be written.
    """
    frame = _frame(output.origin)
    area = _surveyed(output, frame)
    files = [(output.path, _collection(frame, _landmarks(output, frame), area))]
    if output.paths is not None:
        if output.paths.resolve() == output.path.resolve():
            raise InputError(
                f"{output.paths}: paths need a file of their own: classify reads points"
            )
        files.append((output.paths, _collection(frame, _paths(output, frame), None)))
    write_files(files)
    return Written(tuple(path for path, _ in files))


def ellipse_of(covariance: Floats) -> dict[str, float] | None:
    """The ellipse of one standard deviation, or None where there is no covariance.

    Args:
        covariance: (2, 2) square metres.

    Returns:
        Half axes ``major`` and ``minor`` in metres, and ``angle`` of the major one in radians from
        x towards y.
    """
    if not np.isfinite(covariance).all():
        return None
    values, vectors = np.linalg.eigh(covariance)
    minor, major = np.sqrt(np.maximum(values, 0)).tolist()
    angle = float(np.arctan2(vectors[1, 1], vectors[0, 1])) % np.pi
    return {"major": major, "minor": minor, "angle": angle}


def _frame(origin: tuple[float, float] | None) -> Frame:
    if origin is None:
        return Frame.metric()
    longitude, latitude = origin
    if not (-180 <= longitude <= 180 and -90 <= latitude <= 90):
        raise InputError(f"origin {origin}: give a longitude in [-180, 180] and a latitude")
    return Frame.around(longitude, latitude)


def _collection(
    frame: Frame, features: Iterator[dict[str, Any]], area: dict[str, Any] | None
) -> Iterator[str]:
    head: dict[str, Any] = {"type": "FeatureCollection"}
    if not frame.geographic:
        head["crs_units"] = "m"
    head.update(area or {})
    yield _json(head)[:-1] + ',"features":['
    for i, feature in enumerate(features):
        yield (",\n" if i else "\n") + _json({"type": "Feature", **feature})
    yield "\n]}\n"


def _surveyed(output: Output, frame: Frame) -> dict[str, Any] | None:
    """Members ``surveyed`` and ``bbox``: the ground within reach of the robots' sensors."""
    import shapely

    reach = _reach(output)
    lines = [
        shapely.LineString(path.pose[[*range(len(path.pose)), -1], :2])
        for path in output.slam_map.trajectories.values()
        if len(path.pose)
    ]
    if not lines:
        return None
    swept = shapely.union_all([line.simplify(reach / 100).buffer(reach, 4) for line in lines])
    digits = 7 if frame.geographic else 2  # 1 cm
    placed = shapely.transform(
        swept, lambda xy: np.round(np.column_stack(frame.from_metres(*xy.T)), digits)
    )
    spots = np.column_stack(frame.from_metres(*output.slam_map.landmarks.xy.T))
    corners = np.concatenate([spots, np.reshape(placed.bounds, (2, 2))])
    box = [*corners.min(0).tolist(), *corners.max(0).tolist()]
    return {"bbox": box, "surveyed": json.loads(shapely.to_geojson(placed))}


def _reach(output: Output) -> float:
    """Metres of the farthest sighting, or 10 where there is none."""
    ranges = [log.seen.range for log in output.mission.robots]
    known = np.concatenate([r[np.isfinite(r) & (r > 0)] for r in ranges] or [np.zeros(0)])
    return float(known.max()) if len(known) else NO_REACH


def _landmarks(output: Output, frame: Frame) -> Iterator[dict[str, Any]]:
    marks, classes = output.slam_map.landmarks, output.mission.classes
    x, y = frame.from_metres(marks.xy[:, 0], marks.xy[:, 1])
    for i, name in enumerate(marks.id.tolist()):
        properties: dict[str, Any] = {
            "class": classes[marks.feature[i]],
            "confidence": float(marks.confidence[i]),
            "sightings": int(marks.sightings[i]),
            "dynamic": bool(marks.dynamic[i]),
        }
        if marks.key[i]:
            properties["key"] = str(marks.key[i])
        ellipse = ellipse_of(marks.covariance[i])
        if ellipse is not None:
            properties["covariance"] = marks.covariance[i].tolist()
            properties["ellipse"] = ellipse
        point = {"type": "Point", "coordinates": [float(x[i]), float(y[i])]}
        yield {"id": str(name), "geometry": point, "properties": properties}


def _paths(output: Output, frame: Frame) -> Iterator[dict[str, Any]]:
    for name, path in output.slam_map.trajectories.items():
        x, y = frame.from_metres(path.pose[:, 0], path.pose[:, 1])
        line = np.column_stack([x, y]).tolist()
        line = line * 2 if len(line) == 1 else line  # GeoJSON wants two positions at least
        yield {
            "geometry": {"type": "LineString", "coordinates": line},
            "properties": {
                "robot": name,
                "time": path.time.tolist(),
                "heading": path.pose[:, 2].tolist(),
            },
        }
