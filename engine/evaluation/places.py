"""Places: the polygons or points of a truth or a map, read from GeoJSON and checked."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from symboslam.engine.landmarks import Box
from symboslam.engine.readers.area import parse_box
from symboslam.engine.readers.crs import CoordinateSystem, coordinate_system
from symboslam.engine.readers.geojson import crs_of, parse
from symboslam.engine.readers.source import open_source
from symboslam.errors import GeometryError, InputError
from symboslam.reasoning.knowledge import Environment

_POLYGONS = ("Polygon", "MultiPolygon")
_COLOUR = re.compile("#[0-9a-fA-F]{6}")
_FAULTS = (KeyError, TypeError, ValueError, AttributeError, IndexError, OverflowError)
_EXACT = 1e-3
"""Probabilities that sum to 1 within this are not worth a note."""


@dataclass(frozen=True)
class Places:
    """What a file says of places (n polygons or n points).

    Attributes:
        source: the file.
        system: coordinate system of all its coordinates.
        points: True if the geometries are points.
        geometry: (n,) valid polygons and multipolygons, or points.
        area: (n,) what decides which of overlapping polygons is the smallest.
        environment: names of the environments; None = unknown.
        probabilities: environment name -> number, for each place; empty where the file has none.
        bbox: the area that the file is about, if it says so.
        cells: finest cells along each side, if the file is a map that says so.
        environments: environments that the file describes, by name.
        notes: what a user should know about the reading.
    """

    source: str
    system: CoordinateSystem
    points: bool
    geometry: NDArray[Any]
    area: NDArray[np.float64]
    environment: tuple[str | None, ...]
    probabilities: tuple[Mapping[str, float], ...]
    bbox: Box | None
    cells: int | None
    environments: Mapping[str, Environment]
    notes: tuple[str, ...] = ()


def read_places(source: str | Path | Mapping[str, Any], *, points: bool = False) -> Places:
    """Read a truth or a map.

    Args:
        source: GeoJSON (may be gzipped), or a map that ``write_map`` wrote as Turtle or N-Quads;
            or a GeoJSON document as a dict.
        points: whether this is a truth: points are understood too, and ``area_m2``, the area of a
            polygon before it was cut to the box.

    Raises:
        InputError: it cannot be read, or a feature in it is wrong; names the file and the feature.
        GeometryError: its coordinate system or bounding box is wrong.
    """
    if isinstance(source, Mapping):
        return from_object(source, "GeoJSON", points=points)
    if str(source).lower().endswith((".ttl", ".nq")):
        from symboslam.engine.evaluation.places_rdf import read_rdf

        return read_rdf(Path(source))
    opened = open_source(source)
    data = opened.read()
    if not data.strip():
        raise InputError(f"{opened.name}: the file is empty")
    return from_object(parse(data, opened.name), opened.name, points=points)


def from_object(document: object, name: str, *, points: bool = False) -> Places:
    """Places of a GeoJSON document that is already in memory; see ``read_places``."""
    features = document.get("features") if isinstance(document, Mapping) else None
    if not isinstance(document, Mapping) or not isinstance(features, list):
        wanted = "polygons or points" if points else "polygons"
        raise InputError(f"{name}: this is no GeoJSON FeatureCollection of {wanted}")
    parts = [_parts(feature, index, name) for index, feature in enumerate(features)]
    if parts and not any("environment" in properties for _, properties in parts):
        raise InputError(f"{name}: no feature has a property `environment`")
    found = Found(name, coordinate_system(crs_of(document, name), name), points)
    areas = []
    shapes = _shapes([geometry for geometry, _ in parts], name)
    for index, (geometry, (_, properties)) in enumerate(zip(shapes, parts, strict=True)):
        place = _place(index)
        environment = properties.get("environment")
        if environment is not None and not isinstance(environment, str):
            raise InputError(f"{name}: {place}: its environment is {environment!r}, not text")
        if found.add(geometry, place):
            found.environment.append(environment)
            given = _probabilities(properties.get("probabilities"), f"{name}: {place}")
            found.probabilities.append(given)
            areas.append(properties.get("area_m2") if points else None)
    about = document.get("symboslam")
    about = about if isinstance(about, Mapping) else {}
    config = about.get("config")
    bbox = document.get("bbox")
    return found.places(
        areas=areas,
        bbox=None if bbox is None else parse_box(bbox, f"{name}: the bbox", found.system),
        cells=config.get("cells") if isinstance(config, Mapping) else None,
        environments=_environments(about.get("environments")),
    )


class Found:
    """The geometries of a file, one after the other, checked together at the end.

    Args:
        source: the file.
        system: its coordinate system.
        points: whether points are understood.
    """

    def __init__(self, source: str, system: CoordinateSystem, points: bool) -> None:
        self.source, self.system, self.points = source, system, points
        self.geometry: list[Any] = []
        self.place: list[str] = []
        self.environment: list[str | None] = []
        self.probabilities: list[Mapping[str, float]] = []
        self.left = 0

    def add(self, geometry: Any, place: str) -> bool:
        """Keep a geometry if it can be a place; others are counted."""
        kinds = (*_POLYGONS, "GeometryCollection", *(("Point",) if self.points else ()))
        if geometry is None or geometry.is_empty or geometry.geom_type not in kinds:
            self.left += 1
            return False
        self.geometry.append(geometry)
        self.place.append(place)
        return True

    def places(
        self,
        *,
        areas: Sequence[object],
        bbox: Box | None,
        cells: object,
        environments: Mapping[str, Environment],
    ) -> Places:
        """All that was found.

        Args:
            areas: what the file says of the areas; used if it is a number for every place.
            bbox: the file's own box.
            cells: the file's own number of cells.
            environments: those that the file describes.

        Raises:
            InputError: points beside polygons.
            GeometryError: coordinates that are not finite or out of range.
        """
        geometry = np.array(self.geometry, object)
        kinds = shapely.get_type_id(geometry)
        points = bool(len(kinds)) and bool((kinds == 0).all())
        if not points and (kinds == 0).any():
            raise InputError(f"{self.source}: it has points and polygons; give one kind alone")
        self._check_coordinates(geometry)
        notes = []
        environment, probabilities = self.environment, self.probabilities
        if not points:
            geometry, kept, repaired = _polygonal(geometry)
            self.left += int((~kept).sum())
            geometry = geometry[kept]
            rows = np.flatnonzero(kept).tolist()
            environment = [environment[i] for i in rows]
            probabilities = [probabilities[i] for i in rows]
            areas = [areas[i] for i in rows] if areas else ()
            if repaired:
                notes.append(f"{repaired} invalid polygons were repaired")
        if self.left:
            notes.append(f"{self.left} features without a polygon were left out")
        scaled = sum(abs(math.fsum(p.values()) - 1) > _EXACT for p in probabilities if p)
        if scaled:
            notes.append(f"{scaled} features have probabilities that do not sum to 1: scaled")
        return Places(
            source=self.source,
            system=self.system,
            points=points,
            geometry=geometry,
            area=_area(geometry, areas),
            environment=tuple(environment),
            probabilities=tuple(probabilities),
            bbox=bbox,
            cells=cells if isinstance(cells, int) and not isinstance(cells, bool) else None,
            environments=environments,
            notes=tuple(f"{self.source}: {note}" for note in notes),
        )

    def _check_coordinates(self, geometry: NDArray[Any]) -> None:
        xy, owner = shapely.get_coordinates(geometry, return_index=True)
        good = np.isfinite(xy).all(1)
        problem = "its coordinates are not finite numbers"
        if good.all() and self.system.degrees:
            good = (np.abs(xy) <= (180.0, 90.0)).all(1)
            problem = (
                "its coordinates are out of range for longitude and latitude in degrees: longitude "
                'comes first; if these are metres, add "crs_units": "m" to the file'
            )
        if not good.all():
            place = self.place[owner[int(np.argmin(good))]]
            raise GeometryError(f"{self.source}: {place}: {problem}")


def _polygonal(geometry: NDArray[Any]) -> tuple[NDArray[Any], NDArray[np.bool_], int]:
    """The polygons in the geometries, repaired; where there are any; how many were repaired."""
    broken = ~shapely.is_valid(geometry)
    geometry = geometry.copy()
    geometry[broken] = shapely.make_valid(geometry[broken])
    for i in np.flatnonzero(shapely.get_type_id(geometry) == 7):
        parts = [p for p in shapely.get_parts(geometry[i]) if p.geom_type in _POLYGONS]
        geometry[i] = shapely.union_all(parts) if parts else None
    kinds = shapely.get_type_id(geometry)
    kept = ((kinds == 3) | (kinds == 6)) & ~shapely.is_empty(geometry)
    return geometry, kept, int((broken & kept).sum())


def _area(geometry: NDArray[Any], given: Sequence[object]) -> NDArray[np.float64]:
    """The areas that a file states for every place, else those of the geometries."""
    numbers = [a for a in given if isinstance(a, int | float) and not isinstance(a, bool)]
    if len(numbers) == len(geometry) and all(map(math.isfinite, numbers)):
        return np.array(numbers, np.float64)
    return np.asarray(shapely.area(geometry), np.float64)


def _place(index: int) -> str:
    return f"feature {index} (counted from 0)"


def _parts(feature: object, index: int, name: str) -> tuple[object, Mapping[str, Any]]:
    """Geometry and properties of a feature."""
    if isinstance(feature, Mapping):
        properties = feature.get("properties")
        if properties is None or isinstance(properties, Mapping):
            return feature.get("geometry"), properties or {}
    raise InputError(f"{name}: {_place(index)}: this is no GeoJSON feature")


def _shapes(geometries: Sequence[object], name: str) -> NDArray[Any]:
    """The shapely geometries, in the plane; None for none.

    All are read at once; what that refuses is read alone, which closes open rings or says why not.
    """
    texts = [json.dumps(geometry, default=str) for geometry in geometries]
    found = shapely.force_2d(np.asarray(shapely.from_geojson(texts, on_invalid="ignore"), object))
    for i in np.flatnonzero(shapely.is_missing(found)).tolist():
        found[i] = _shape(geometries[i], f"{name}: {_place(i)}")
    return np.asarray(found)


def _shape(geometry: object, where: str) -> Any:
    """One shapely geometry, in the plane; None for none."""
    if geometry is None:
        return None
    try:
        with np.errstate(invalid="ignore"):
            return shapely.force_2d(shapely.geometry.shape(geometry))
    except (*_FAULTS, shapely.errors.ShapelyError) as error:
        kind = geometry.get("type") if isinstance(geometry, Mapping) else geometry
        raise InputError(f"{where}: its geometry, {kind!r}, cannot be read: {error}") from error


def _probabilities(given: object, where: str) -> Mapping[str, float]:
    """Numbers that can be probabilities, or could be if they were scaled."""
    if given is None:
        return {}
    if not isinstance(given, Mapping):
        raise InputError(f"{where}: its probabilities are no object of environments and numbers")
    for name, p in given.items():
        if isinstance(p, bool) or not isinstance(p, int | float) or not 0 <= p < 1e100:
            raise InputError(f"{where}: the probability of {name} is {p!r}, not a number from 0 on")
    return given


def _environments(given: object) -> dict[str, Environment]:
    """What a map says of its environments; nothing where it makes no sense."""
    if not isinstance(given, Mapping):
        return {}
    items: Iterable[tuple[str, Any]] = given.items()
    return {name: described(name, e) for name, e in items if isinstance(e, Mapping)}


def described(name: str, words: Mapping[str, object]) -> Environment:
    """An environment from what a file says of it."""
    colour = str(words.get("colour", ""))
    return Environment(
        iri=str(words.get("iri", "")),
        name=name,
        label=str(words.get("label") or name),
        definition=str(words.get("definition", "")),
        colour=colour if _COLOUR.fullmatch(colour) else Environment.colour,
    )
