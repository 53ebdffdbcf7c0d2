"""What the OpenAPI description says of increments and of landmarks that are set."""

from __future__ import annotations

from typing import Any

from symboslam.engine.slam.increment import MOST_ROWS
from symboslam.service.maps.models_agents import IncrementsResult
from symboslam.service.maps.openapi import TEXT
from symboslam.service.openapi import also
from symboslam.service.vocabulary import JSON, NDJSON

_FAR = {"type": "number", "minimum": -1e12, "maximum": 1e12}
_POSITIVE = {"type": "number", "exclusiveMinimum": 0, "maximum": 1e12}
_COUNT = {"type": "integer", "minimum": 0, "maximum": 2**53 - 1}
_ROW = {"type": "integer", "minimum": 0, "maximum": MOST_ROWS - 1}
_NAME = {"type": "string", "maxLength": 256, "pattern": TEXT}
_WORD = {"type": "string", "minLength": 1, "maxLength": 256, "pattern": r"^[0-9A-Za-z._:@/-]*$"}


def _rows(what: dict[str, Any], of: str) -> dict[str, Any]:
    return {"type": "array", "items": what, "description": f"One for each {of}."}


def _three(what: dict[str, Any]) -> dict[str, Any]:
    return {"type": "array", "items": what, "minItems": 3, "maxItems": 3}


_SIGHTING, _KEY_POSE, _FIX = "sighting", "key pose", "position from outside"
_MEMBERS: dict[str, Any] = {
    "robot": {**_WORD, "description": "Its name; any text that prints."},
    "run": {**_WORD, "description": "Names one run of one robot."},
    "sequence": {
        **_COUNT,
        "description": "Number of the increment in its run, from 0; at most"
        " 1000 beyond the highest that has come.",
    },
    "start": {
        "anyOf": [_three(_FAR), {"type": "null"}],
        "description": "Where the run began: x, y in the map's metres, heading in radians from x to"
        " y; null if not known.",
    },
    "start_sigma": {**_three(_POSITIVE), "description": "Standard deviations of that."},
    "first": {**_COUNT, "description": "Number of the first key pose here."},
    "time": {**_rows(_FAR, _KEY_POSE), "description": "Seconds, increasing; one for each key pose"},
    "step": {
        **_rows(_three(_FAR), _KEY_POSE),
        "description": "From the key pose before, in its frame; zeros for the very first.",
    },
    "sigma": {**_rows(_three(_POSITIVE), _KEY_POSE), "description": "Deviations of the steps."},
    "row": {**_rows(_ROW, _SIGHTING), "description": "Number of each sighting in its run."},
    "seen": {**_rows(_FAR, _SIGHTING), "description": "Seconds, when each sighting was made."},
    "pose": {**_rows(_COUNT, _SIGHTING), "description": "Key pose that it is made from."},
    "range": {
        **_rows({"anyOf": [{**_FAR, "minimum": 0}, {"type": "null"}]}, _SIGHTING),
        "description": "Metres; null for none.",
    },
    "bearing": {
        **_rows({"anyOf": [_FAR, {"type": "null"}]}, _SIGHTING),
        "description": "Radians from the robot's heading; null for none.",
    },
    "sigma_range": _rows(_POSITIVE, _SIGHTING),
    "sigma_bearing": _rows(_POSITIVE, _SIGHTING),
    "feature": {**_rows(_NAME, _SIGHTING), "description": "Class by name; empty for a robot."},
    "confidence": _rows({"type": "number", "exclusiveMinimum": 0, "maximum": 1}, _SIGHTING),
    "key": {**_rows(_NAME, _SIGHTING), "description": "What names it beyond doubt; empty: none."},
    "track": {
        **_rows({"type": "integer", "minimum": -1, "maximum": 2**53 - 1}, _SIGHTING),
        "description": "What the robot holds for one thing; -1 for none.",
    },
    "fix_pose": _rows(_COUNT, _FIX),
    "fix": {**_rows(_three(_FAR), _FIX), "description": "x, y, standard deviation in metres."},
    "last": {"type": "boolean", "description": "Nothing more comes from this run."},
}
_INCREMENT = {
    "type": "object",
    "required": list(_MEMBERS),
    "properties": _MEMBERS,
    "additionalProperties": False,
    "description": "A piece of a robot's pose graph; columns of one kind are equally long.",
}
_EXAMPLE = {
    "robot": "robot-1", "run": "2026-03-02T10:00:00Z", "sequence": 0, "start": [10, 20, 0],
    "start_sigma": [0.1, 0.1, 0.01], "first": 0, "time": [0, 1.5],
    "step": [[0, 0, 0], [2, 0, 0.1]], "sigma": [[0.01, 0.01, 0.01], [0.1, 0.04, 0.01]],
    "row": [0], "seen": [0.5], "pose": [1], "range": [12.5], "bearing": [0.4], "sigma_range": [0.5],
    "sigma_bearing": [0.02], "feature": ["House"], "confidence": [0.9], "key": [""], "track": [-1],
    "fix_pose": [], "fix": [], "last": False,
}  # fmt: skip
_LINES = {"type": "string", "description": "An increment in each line."}
INCREMENTS: dict[str, Any] = {
    "responses": {
        **also(400, 409),
        200: {"description": "All of them had been taken before."},
        201: {"description": "Some are new.", "model": IncrementsResult},
    },
    "openapi_extra": {
        "requestBody": {
            "required": True,
            "content": {
                JSON: {"schema": _INCREMENT, "examples": {"drive": {"value": _EXAMPLE}}},
                NDJSON: {"schema": _LINES, "x-line-schema": _INCREMENT},
            },
        }
    },
}
"""For the route that takes increments."""
LINES: dict[str, Any] = {
    "responses": {
        200: {
            "description": "In each line `number`, `received` and `increment`; or nothing.",
            "content": {NDJSON: {"schema": {"type": "string"}}},
        }
    },
}
"""For the route that gives increments."""
SETTING: dict[str, Any] = {"responses": also(400, 409)}
"""For the route that sets landmarks."""
