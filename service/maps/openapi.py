"""What the OpenAPI description says of bodies under ``/v1/maps`` and ``/v1/jobs``."""

from __future__ import annotations

from itertools import chain
from typing import Any

from symboslam.service.openapi import also
from symboslam.service.vocabulary import ANY_FILE, FILES, GEOJSON, NDJSON, OCTETS, TURTLE

TEXT = r"^[^\u0000-\u001f\u007f\ufffe\uffff]*$"
"""Pattern of a text in one line without control characters."""
_NAME = {"type": "string", "maxLength": 256, "pattern": TEXT}
_CLASS = {**_NAME, "minLength": 1, "description": "A feature: `House`; unknown ones are counted."}
_TAGS = {
    "type": "object",
    "additionalProperties": {"type": "string"},
    "minProperties": 1,
    "description": "OpenStreetMap tags, in the place of a class.",
}
_OF_AN_OBSERVATION: dict[str, Any] = {
    "class": _CLASS,
    "tags": _TAGS,
    "confidence": {"type": "number", "exclusiveMinimum": 0, "maximum": 1, "default": 1},
    "time": {
        "type": "string", "format": "date-time",
        "description": "When it was seen: ISO 8601, without a zone UTC; by default now.",
    },
    "agent": {**_NAME, "description": "Who saw it."},
}  # fmt: skip
_COORDINATES = {
    "type": "array",
    "items": {"type": "number"},
    "minItems": 2,
    "maxItems": 3,
    "prefixItems": [
        {"type": "number", "minimum": -180, "maximum": 180},
        {"type": "number", "minimum": -90, "maximum": 90},
    ],
    "description": "Longitude, latitude; x, y in metres in a map of local metres.",
}
_ID = {
    **_NAME, "minLength": 1,
    "description": "What the agent calls the landmark; the same again of the same agent is the same"
    " landmark. Without an agent it is of no account.",
}  # fmt: skip
_CLASS_OR_TAGS = [{"required": ["class"]}, {"required": ["tags"]}]
_LINE = {
    "type": "object",
    "required": ["coordinates"],
    "properties": {"id": _ID, "coordinates": _COORDINATES, **_OF_AN_OBSERVATION},
    "anyOf": _CLASS_OR_TAGS,
    "additionalProperties": False,
    "description": "A line of NDJSON; a GeoJSON Feature is as good.",
}
_FEATURE = {
    "type": "object",
    "required": ["type", "geometry", "properties"],
    "properties": {
        "type": {"const": "Feature"},
        "id": _ID,
        "geometry": {
            "type": "object",
            "required": ["type", "coordinates"],
            "properties": {"type": {"const": "Point"}, "coordinates": _COORDINATES},
            "additionalProperties": False,
        },
        "properties": {
            "type": "object", "properties": _OF_AN_OBSERVATION, "anyOf": _CLASS_OR_TAGS,
        },
    },
}  # fmt: skip
_COLLECTION = {
    "type": "object",
    "required": ["type", "features"],
    "properties": {
        "type": {"const": "FeatureCollection"},
        "features": {"type": "array", "items": _FEATURE},
        "crs_units": {"const": "m", "description": "In maps of local metres."},
    },
    "additionalProperties": False,
}
_HOUSE = {"class": "House", "confidence": 0.9, "time": "2026-03-02T10:00:00Z", "agent": "robot-1"}
_PLACE = [149.13, -35.28]
_POINT = {"type": "Point", "coordinates": _PLACE}
_EXAMPLE = {
    "type": "FeatureCollection",
    "features": [{"type": "Feature", "id": "h1", "geometry": _POINT, "properties": _HOUSE}],
}
_LINES = (
    '{"id": "h1", "coordinates": [149.13, -35.28], "class": "House", "confidence": 0.9}\n'
    '{"coordinates": [149.131, -35.281], "tags": {"highway": "bus_stop"}}\n'
)
OBSERVATIONS: dict[str, Any] = {
    "responses": also(400, 409),
    "openapi_extra": {
        "requestBody": {
            "required": True,
            "content": {
                GEOJSON: {
                    "schema": _COLLECTION,
                    "examples": {"house": {"value": _EXAMPLE}},
                },
                NDJSON: {
                    "schema": {
                        "type": "string",
                        "description": f"An observation in each line, as x-line-schema says:"
                        f"\n\n```\n{_LINES}```",
                    },
                    "x-line-schema": _LINE,
                },
            },
        }
    },
}
"""For the route that takes observations."""
FILE: dict[str, Any] = {
    "openapi_extra": {
        "requestBody": {
            "required": True,
            "content": {
                OCTETS: {"schema": {"type": "string", "format": "binary", "minLength": 1}},
                **{kind: {"schema": {}} for kind in (*ANY_FILE[1:], *chain(*FILES.values()))},
            },
        }
    },
}
"""For the route that takes a whole file."""
_POLYGONS = {
    "type": "object",
    "required": ["type", "features"],
    "properties": {"type": {"const": "FeatureCollection"}, "features": {"type": "array"}},
}
COLLECTION: dict[str, Any] = {
    "responses": {200: {"content": {GEOJSON: {"schema": _POLYGONS}}}},
}
"""For routes that give GeoJSON."""
EXPORT: dict[str, Any] = {
    "responses": {
        200: {
            "description": "The file.",
            "headers": {"Content-Disposition": {"schema": {"type": "string"}}},
            "content": {
                GEOJSON: {"schema": _POLYGONS},
                TURTLE: {"schema": {"type": "string"}},
                "application/n-quads": {"schema": {"type": "string"}},
                "text/html": {"schema": {"type": "string"}},
                "image/png": {"schema": {"type": "string", "format": "binary"}},
            },
        }
    },
}
"""For the route that gives a map as a file."""
