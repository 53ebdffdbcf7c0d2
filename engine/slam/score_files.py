"""Scores of files: TUM trajectories and lists of landmarks against true ones."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from symboslam.engine.readers import csv_table, geojson
from symboslam.engine.readers.checks import check_positions, make_ids
from symboslam.engine.readers.columns import Codes, Columns
from symboslam.engine.readers.crs import METRES, CoordinateSystem
from symboslam.engine.readers.source import open_source, sniff
from symboslam.engine.slam.landmark_error import Points
from symboslam.engine.slam.metrics import Options, compare
from symboslam.engine.slam.readers.tum import read_trajectory
from symboslam.engine.slam.score import SlamScore
from symboslam.engine.slam.slam_map import Trajectory
from symboslam.errors import InputError, LandmarkError

PATHS = (".tum", ".txt")
LANDMARKS = (".geojson", ".json", ".csv")


@dataclass(frozen=True)
class Side:
    """What is compared: an estimate, or a truth.

    Attributes:
        paths: name of the file without its ending -> trajectory.
        points: landmarks; None for none.
        notes: what was mended on reading.
    """

    paths: Mapping[str, Trajectory]
    points: Points | None
    notes: tuple[str, ...] = ()


class _NoFeatures:
    """Readers of landmarks ask which features there are; here any class will do."""

    features = ()
    tag_keys: frozenset[str] = frozenset()

    def index_of(self, name: str, /) -> None:
        return None

    def match_tags(self, tags: Mapping[str, str], /) -> None:
        return None


def read_sides(
    estimate: Path, truth: Path, landmarks: Path | None, true_landmarks: Path | None
) -> tuple[Side, Side]:
    """Read an estimate and its truth; two single trajectories belong together whatever their names.

    Args:
        estimate: a TUM file; a landmark file (by its ending); or a folder of TUM files (.tum,
            .txt), in which a file ``landmarks`` (.geojson, .json, .csv) is read too if the truth
            has landmarks as well.
        truth: the same.
        landmarks: a landmark file besides, which then counts in place of that in the folder.
        true_landmarks: the same of the truth.

    Raises:
        InputError: a file is missing or wrong; names it and the line or feature. Or the two have
            nothing in common that could be compared.
    """
    classes = Codes()
    ours, true = _side(estimate, landmarks, classes), _side(truth, true_landmarks, classes)
    if len(ours.paths) == len(true.paths) == 1:
        true = replace(true, paths=dict(zip(ours.paths, true.paths.values(), strict=True)))
    if (ours.paths or true.paths) and not ours.paths.keys() & true.paths.keys():
        raise InputError(
            "no trajectory of the estimate has the name of a true one: "
            f"{', '.join(ours.paths) or 'none'} against {', '.join(true.paths) or 'none'}"
        )
    if (ours.points is None) != (true.points is None):
        if landmarks or true_landmarks or not ours.paths:
            has, lacks = (estimate, truth) if true.points is None else (truth, estimate)
            raise InputError(f"{has} comes with landmarks, and {lacks} without: give both or none")
        ours, true = replace(ours, points=None), replace(true, points=None)
    return ours, true


def score_sides(estimate: Side, truth: Side, options: Options) -> SlamScore:
    """Compare what ``read_sides`` read; classes agree if their names do, spaces and case aside."""
    none = Points(np.empty(0, object), np.empty((0, 2)), np.empty(0, np.int64))
    points = [side.points or none for side in (estimate, truth)]
    classes = 1 + max((int(p.feature.max(initial=0)) for p in points), default=0)
    score = compare(
        estimate.paths,
        {name: np.column_stack([path.time, path.pose]) for name, path in truth.paths.items()},
        points[0],
        truth.points,
        np.eye(classes),
        options,
    )
    return replace(score, notes=(*estimate.notes, *truth.notes, *score.notes))


def _side(source: Path, landmarks: Path | None, classes: Codes) -> Side:
    if source.is_dir():
        files = sorted(p for p in source.iterdir() if p.suffix in PATHS and p.is_file())
        beside = [source / f"landmarks{ending}" for ending in LANDMARKS]
        landmarks = landmarks or next((p for p in beside if p.is_file()), None)
        if not files and landmarks is None:
            raise InputError(f"{source}: the folder has no .tum or .txt files and no landmarks")
    elif source.suffix in LANDMARKS:
        files = []
        landmarks = landmarks or source
    else:
        files = [source]
    paths: dict[str, Trajectory] = {}
    notes: list[str] = []
    for file in files:
        if file.stem in paths:
            raise InputError(f"{file}: another trajectory there has the same name {file.stem}")
        paths[file.stem], mended = read_trajectory(file)
        notes += mended
    points = None if landmarks is None else read_points(landmarks, classes)
    return Side(paths, points, tuple(notes))


def _plain(label: str) -> str:
    """A class without case, spaces and punctuation: map building writes BusStop for Bus Stop."""
    return "".join(c for c in label.casefold() if c.isalnum()) or label


def read_points(path: Path, classes: Codes) -> Points:
    """Landmarks of a GeoJSON or CSV file (class, x, y, maybe id), in metres.

    Raises:
        LandmarkError: the file is wrong, or in degrees.
    """
    source = open_source(path)
    kind = sniff(source.head())
    if kind == "osm":
        raise LandmarkError("landmarks are read from GeoJSON or CSV here", source=str(path))
    read = geojson.read if kind == "geojson" else csv_table.read
    columns: Columns = read(source, _NoFeatures(), lambda stage, share: None)
    if columns.crs != METRES:
        raise LandmarkError(
            "landmarks are compared in metres: give columns x and y in CSV, or "
            '"crs_units": "m" in GeoJSON',
            source=str(path),
        )
    check_positions(columns, CoordinateSystem(METRES, degrees=False))
    number = np.array([classes[_plain(label)] for label, _ in columns.kinds], np.int64)
    return Points(
        make_ids(columns).astype(object),
        np.column_stack([columns.x, columns.y]),
        number[columns.kind] if len(columns) else np.empty(0, np.int64),
    )
