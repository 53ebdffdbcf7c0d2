"""Places of a map in Turtle or N-Quads; see ``places.read_places``."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import shapely

from symboslam.engine.evaluation.places import Found, Places, described
from symboslam.engine.landmarks import Box
from symboslam.engine.readers.area import parse_box
from symboslam.engine.readers.crs import DEGREES, METRES, CoordinateSystem, coordinate_system
from symboslam.engine.writers.rdf_index import Index, read_index
from symboslam.engine.writers.stored_rdf import stored_map
from symboslam.engine.writers.vocabulary import CRS84, DCTERMS, GEO, LOCAL_METRES
from symboslam.errors import GeometryError
from symboslam.reasoning.vocabulary import SL

_LITERAL = re.compile(r"\s*(?:<([^>]*)>)?\s*(.*)", re.DOTALL)


def read_rdf(path: Path) -> Places:
    """The segments of a map that ``write_map`` wrote.

    Raises:
        InputError: it cannot be read, does not parse, or is no environment map.
        GeometryError: an outline cannot be read, or there are several coordinate systems.
    """
    index = read_index(path)
    stored = stored_map(index, path)
    outlines = {
        index.text(segment, DCTERMS + "identifier"): _outline(index, segment, path)
        for segment in index.of_type(SL + "Segment")
    }
    systems = {system for system, _ in outlines.values()}
    if len(systems) > 1:
        raise GeometryError(f"{path}: several coordinate systems: {', '.join(sorted(systems))}")
    system = next(iter(systems), METRES)
    found = Found(str(path), coordinate_system(system, str(path)), points=False)
    for name, (_, geometry) in outlines.items():
        if found.add(geometry, f"segment {name}"):
            found.environment.append(stored.segments[name].environment)
            found.probabilities.append(stored.segments[name].probabilities)
    return found.places(
        areas=(),
        bbox=_box(index, path, found.system),
        cells=_cells(index),
        environments={name: described(name, vars(e)) for name, e in stored.environments.items()},
    )


def _outline(index: Index, feature: str, path: Path) -> tuple[str, Any]:
    """Coordinate system and outline of a segment or area."""
    text = index.text(index.text(feature, GEO + "hasGeometry"), GEO + "asWKT")
    match = _LITERAL.fullmatch(text)
    system, wkt = match.groups() if match else (None, "")
    try:
        geometry = shapely.from_wkt(wkt)
    except shapely.errors.ShapelyError as error:
        raise GeometryError(f"{path}: the outline of {feature} cannot be read: {error}") from error
    names = {LOCAL_METRES: METRES, CRS84: DEGREES, None: DEGREES}
    return names.get(system) or str(system), geometry


def _box(index: Index, path: Path, system: CoordinateSystem) -> Box | None:
    """The area that the map was made for."""
    for spatial in index.all(index.of_type(SL + "EnvironmentMap")[0], DCTERMS + "spatial"):
        named, area = _outline(index, spatial, path)
        if named == system.name and not area.is_empty:
            return parse_box(area.bounds, f"{path}: its area", system)
    return None


def _cells(index: Index) -> int | None:
    """The setting ``cells`` of the run that made the map."""
    for setting in index.subjects(SL + "settingName", "cells"):
        value = index.text(setting, SL + "settingValue")
        if value.isdecimal():
            return int(value)
    return None
