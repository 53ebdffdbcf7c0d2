"""GeoJSON landmarks: a FeatureCollection of points with ``class`` or OSM ``tags``."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from symboslam.engine.readers.columns import (
    Codes,
    Columns,
    FeatureIndex,
    Floats,
    Kind,
    Progress,
    Tags,
)
from symboslam.engine.readers.crs import DEGREES, METRES
from symboslam.engine.readers.source import Source
from symboslam.errors import GeometryError, LandmarkError, SymboSlamError

_RESERVED = frozenset({"class", "tags", "confidence", "id", "time", "agent"})
Place = Callable[[int], str]
_FAULTS = (KeyError, TypeError, ValueError, AttributeError)


def read(source: Source, knowledge: FeatureIndex, progress: Progress) -> Columns:
    """Columns of a GeoJSON file.

    Raises:
        LandmarkError: the file is empty, no JSON, no FeatureCollection, or a feature is wrong.
        GeometryError: its coordinate system is unclear.
    """
    progress("reading", 0.0)
    data = source.read()
    if not data.strip():
        raise LandmarkError("the file is empty", source=source.name)
    return from_object(parse(data, source.name), source.name, knowledge)


def place_of(index: int) -> str:
    """The place of a feature in a GeoJSON file, in words."""
    return f"feature {index} (counted from 0)"


def from_object(
    document: object, name: str, knowledge: FeatureIndex, place: Place = place_of
) -> Columns:
    """Columns of a GeoJSON document that is already in memory; see ``read``.

    Args:
        document: it.
        name: where it comes from, for messages.
        knowledge: which features there are.
        place: position of a feature -> words that name its place in what was sent.
    """
    collection, features = _collection(document, name)
    keys = knowledge.tag_keys - _RESERVED
    first: list[Any] = []
    second: list[Any] = []
    confidence: list[Any] = []
    ids: list[Any] = []
    times: list[Any] = []
    agents: list[Any] = []
    kinds, codes = Codes(), []
    typed = flat = False
    bare: int | None = None
    for index, feature in enumerate(features):
        try:
            geometry = feature["geometry"]
            if geometry["type"] != "Point" or "crs" in feature or "crs" in geometry:
                raise TypeError
            x, y, *_ = geometry["coordinates"]
            properties = feature.get("properties") or {}
            label = properties.get("class") or ""
            tags = properties.get("tags")
            if tags:
                kind = (label, _tags(tags, keys) or tuple(sorted(tags.items())))
            elif label:
                kind = (label, ())
            else:
                kind = ("", _tags(properties, keys))
                flat = flat or bool(kind[1])
                if bare is None and not kind[1]:
                    bare = index
            typed = typed or bool(label or tags)
            codes.append(kinds[kind])
            number = feature.get("id")
            if number is None:
                number = properties.get("id", properties.get("@id"))
            sure = properties.get("confidence")
            time, agent = properties.get("time"), properties.get("agent")
        except _FAULTS as error:
            raise _fault(feature, name, place(index)) from error
        first.append(x)
        second.append(y)
        confidence.append(1.0 if sure is None else sure)
        ids.append(number)
        times.append(time)
        agents.append(agent)
    if bare is not None and (typed or not flat):
        problem = "has neither a class nor tags: give it one of the two"
        raise LandmarkError(problem, source=name, where=place(bare))
    return Columns(
        source=name,
        x=_numbers(first, "coordinate", name, place),
        y=_numbers(second, "coordinate", name, place),
        kind=np.array(codes, np.int32),
        kinds=_kinds(kinds, codes, name, place),
        place=place,
        crs=crs_of(collection, name),
        crs_from="file" if collection.get("crs_units") or collection.get("crs") else "default",
        confidence=_numbers(confidence, "confidence", name, place),
        id=_texts(ids, "id", name, place),
        time=_texts(times, "time", name, place),
        agent=_texts(agents, "agent", name, place),
        bbox=collection.get("bbox"),
        surveyed=collection.get("surveyed"),
        attribution=_attribution(collection),
    )


def parse(
    data: bytes | str,
    name: str,
    hook: Callable[[list[tuple[str, Any]]], dict[str, Any]] | None = None,
) -> object:
    """The JSON of a file.

    Args:
        data: its content.
        name: the file, for messages.
        hook: makes an object of its members.

    Raises:
        LandmarkError: it is none.
    """
    try:
        return json.loads(data, object_pairs_hook=hook)
    except json.JSONDecodeError as error:
        cut = error.pos >= len(error.doc.rstrip()) or "Unterminated" in error.msg
        problem = f"this is not valid JSON ({error.msg})"
        if cut:
            problem += ": the file seems to be cut short"
        elif error.msg == "Extra data":
            problem += ": put all features into one FeatureCollection"
        where = f"line {error.lineno} column {error.colno}"
        raise LandmarkError(problem, source=name, where=where) from error
    except RecursionError as error:
        raise LandmarkError("this JSON is nested too deeply", source=name) from error
    except UnicodeDecodeError as error:
        raise LandmarkError("this is not valid JSON: it is not UTF-8 text", source=name) from error
    except ValueError as error:  # the only other one: Python reads whole numbers up to a length
        problem = "this is not valid JSON for a map: a number has thousands of digits"
        raise LandmarkError(problem, source=name) from error


def _collection(document: object, name: str) -> tuple[Mapping[str, Any], list[Any]]:
    if not isinstance(document, Mapping):
        found = f"a JSON {_json_type(document)}"
    elif document.get("type") != "FeatureCollection":
        found = f"a {_name(document)}"
        if document.get("type") == "Feature":
            found += " on its own"
    elif not isinstance(document.get("features"), list):
        found = "a FeatureCollection without a list of features"
    else:
        return document, document["features"]
    problem = f"this is {found}; a GeoJSON FeatureCollection of points is needed"
    raise LandmarkError(problem, source=name)


def crs_of(collection: Mapping[str, Any], name: str) -> str:
    """The coordinate system that the collection names: ``crs_units``, or the old ``crs``.

    Raises:
        GeometryError: what it says is none, or it says both.
    """
    units, crs = collection.get("crs_units"), collection.get("crs")
    if units not in (None, METRES):
        raise GeometryError(
            f'{name}: crs_units is {_show(units)}; "m" (local metres) is the only value that it '
            "can have, leave it out for longitude and latitude"
        )
    if crs is None:
        return METRES if units else DEGREES
    if units:
        raise GeometryError(f"{name}: names both crs_units and crs: keep the one that holds")
    try:
        text = crs["properties"]["name"]
    except (KeyError, TypeError):
        text = None
    if not isinstance(text, str):
        raise GeometryError(
            f"{name}: the crs member does not name a coordinate system: "
            'write {"type": "name", "properties": {"name": "EPSG:..."}} or leave it out'
        )
    return text


def _attribution(collection: Mapping[str, Any]) -> str:
    """The licence line under the first of its usual names that holds a text."""
    texts = (collection.get(key) for key in ("attribution", "copyright", "license"))
    return next((text for text in texts if isinstance(text, str) and text.strip()), "")


def _tags(tags: Mapping[str, Any], keys: frozenset[str]) -> Tags:
    """The tags with keys that some feature has, sorted; others cannot change the match."""
    return tuple(sorted((k, v) for k, v in tags.items() if k in keys and v not in (None, "")))


def _fault(feature: Any, name: str, where: str) -> SymboSlamError:
    """What is wrong with a feature that could not be read."""
    if not isinstance(feature, Mapping):
        problem = f"is a JSON {_json_type(feature)}, not a feature"
        return LandmarkError(problem, source=name, where=where)
    geometry, properties = feature.get("geometry"), feature.get("properties") or {}
    if geometry is None:
        problem = "has no geometry: give it a point or leave it out"
    elif not isinstance(geometry, Mapping):
        problem = f"its geometry is a JSON {_json_type(geometry)}, not an object"
    elif "crs" in feature or "crs" in geometry:
        return GeometryError(
            f"{name}: {where}: names a coordinate system of its own; bring all features into "
            "one system and name it once, at the top of the file"
        )
    elif geometry.get("type") != "Point":
        problem = (
            f"its geometry is a {_name(geometry)}; landmarks are points: "
            "convert it first, for instance to its centroid"
        )
    elif not isinstance(properties, Mapping):
        problem = f"its properties are a JSON {_json_type(properties)}, not an object"
    elif properties.get("tags") and not isinstance(properties["tags"], Mapping):
        problem = f'its tags are a JSON {_json_type(properties["tags"])}, not {{"key": "value"}}'
    elif not isinstance(properties.get("class") or "", str):
        problem = f"its class is a JSON {_json_type(properties['class'])}, not text"
    elif not _is_position(geometry.get("coordinates")):
        problem = f"its coordinates are {_show(geometry.get('coordinates'))}, not [x, y]"
    else:
        problem = "its class or tags are not text"
    return LandmarkError(problem, source=name, where=where)


def _numbers(values: list[Any], what: str, name: str, place: Place) -> Floats:
    if not set(map(type, values)) <= {int, float}:
        for index, value in enumerate(values):
            if isinstance(value, bool) or not isinstance(value, int | float):
                problem = f"its {what} is {_show(value)}, not a number"
                raise LandmarkError(problem, source=name, where=place(index))
    try:
        return np.array(values, np.float64)
    except OverflowError:
        return np.array([_float(value) for value in values])


def _float(value: float) -> float:
    try:
        return float(value)
    except OverflowError:
        return float("inf")


def _kinds(kinds: Codes, codes: list[int], name: str, place: Place) -> list[Kind]:
    """The distinct kinds with all tag values as text."""
    result: list[Kind] = []
    for code, (label, tags) in enumerate(kinds):
        try:
            if not isinstance(label, str):
                raise TypeError
            result.append((label.strip(), tuple((key, _tag_text(value)) for key, value in tags)))
        except (TypeError, ValueError) as error:
            problem = "its class or tags are not text"
            raise LandmarkError(problem, source=name, where=place(codes.index(code))) from error
    return result


def _tag_text(value: object) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    if value is None or isinstance(value, str | int | float):
        return "" if value is None else str(value)
    raise TypeError


def _texts(values: list[Any], what: str, name: str, place: Place) -> list[str | None] | None:
    """A column of optional texts; numbers are written out, None if all are missing."""
    if not any(value is not None for value in values):
        return None
    for index, value in enumerate(values):
        if value is None or type(value) is str:
            continue
        try:
            if type(value) is not int and not (type(value) is float and math.isfinite(value)):
                raise TypeError
            values[index] = str(value)
        except (TypeError, ValueError) as error:
            problem = f"its {what} is {_show(value)}, not text"
            raise LandmarkError(problem, source=name, where=place(index)) from error
    return values


def _name(value: Mapping[str, Any]) -> str:
    kind = value.get("type")
    named = isinstance(kind, str) and kind.isprintable()
    return str(kind)[:60] if named else "JSON object without a type"


def _is_position(value: object) -> bool:
    return isinstance(value, list | tuple) and len(value) >= 2


def _show(value: object) -> str:
    try:
        return json.dumps(value, default=str)[:60]
    except ValueError:
        return "a number of thousands of digits"


def _json_type(value: object) -> str:
    names = {type(None): "null", bool: "boolean", str: "text", list: "array", dict: "object"}
    return names.get(type(value), "number")
