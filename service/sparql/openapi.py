"""What the OpenAPI description says of ``/sparql`` and ``/graphs``."""

from __future__ import annotations

from typing import Any

from symboslam.service.openapi import also, header
from symboslam.service.vocabulary import (
    FORM,
    MULTIPART,
    SOLUTIONS,
    SPARQL_QUERY,
    SPARQL_UPDATE,
    TRIPLES,
    UPLOADS,
)

_TEXT = {"type": "string"}
_QUERY = {"type": "string", "format": "sparql-query"}
_UPDATE = {"type": "string", "format": "sparql-update"}
_IRIS = {"type": "array", "items": {"type": "string", "format": "iri"}}
_DATASETS = {
    "default-graph-uri": "Graphs that make the default graph of a query.",
    "named-graph-uri": "Graphs that a query may name.",
    "using-graph-uri": "As `USING` in an update.",
    "using-named-graph-uri": "As `USING NAMED` in an update.",
}


def _parameter(name: str, schema: dict[str, Any], text: str) -> dict[str, Any]:
    return {
        "name": name, "in": "query", "required": False, "description": text, "schema": schema,
    }  # fmt: skip


_NOT_MODIFIED = {"description": "As the ETag in If-None-Match has it.", "headers": header("ETag")}
_UNCHANGED = {"name": "If-None-Match", "in": "header", "required": False, "schema": _TEXT}


def _graph(required: bool) -> dict[str, Any]:
    """``?graph=IRI`` or ``?default``: one of the two, which takes an exploded object to say."""
    named = {"type": "string", "format": "iri", "description": "Its name."}
    unnamed = {"const": "", "description": "The graph without a name; takes no value."}
    return {
        "name": "target", "in": "query", "required": required, "style": "form", "explode": True,
        "description": "The graph: either `graph=IRI` or `default`.",
        "schema": {
            "type": "object",
            "properties": {"graph": named, "default": unnamed},
            "oneOf": [{"required": ["graph"]}, {"required": ["default"]}],
        },
    }  # fmt: skip


_GRAPHS: dict[str, Any] = {
    "required": True,
    "content": {name: {"schema": _TEXT} for name in UPLOADS}
    | {"application/ld+json": {"schema": {"type": ["array", "object"]}}},
}
_PARTS = {MULTIPART: {"schema": {"type": "object", "additionalProperties": {
    "type": "string", "format": "binary",
}}}}  # fmt: skip
_ANSWER = {
    "description": "The result.",
    "headers": header("ETag"),
    "content": {
        **{name: {"schema": _TEXT} for name in (*SOLUTIONS, *TRIPLES)},
        "application/sparql-results+json": {"schema": {"type": "object", "required": ["head"]}},
        "application/ld+json": {"schema": {"type": ["array", "object"]}},
        "application/json": {"schema": {"type": ["array", "object"]}},
    },
}
_PROBLEMS = also(400, 406, 413, 422, 504)

QUERY: dict[str, Any] = {
    "responses": {200: _ANSWER, 304: _NOT_MODIFIED, **_PROBLEMS},
    "openapi_extra": {
        "parameters": [
            _parameter("query", _QUERY, "The query; without it, the Service Description."),
            *[_parameter(n, _IRIS, _DATASETS[n]) for n in list(_DATASETS)[:2]],
            _UNCHANGED,
        ]
    },
}
"""For the route of a query by GET."""
QUERY_OR_UPDATE: dict[str, Any] = {
    "responses": {
        200: {**_ANSWER, "headers": {}},
        204: {"description": "The update was carried out."},
        **_PROBLEMS,
    },
    "openapi_extra": {
        "parameters": [_parameter(n, _IRIS, text) for n, text in _DATASETS.items()],
        "requestBody": {
            "required": True,
            "content": {
                SPARQL_QUERY: {"schema": _QUERY},
                SPARQL_UPDATE: {"schema": _UPDATE},
                FORM: {"schema": {
                    "type": "object",
                    "properties": {
                        "query": _QUERY, "update": _UPDATE, **{n: _IRIS for n in _DATASETS},
                    },
                    "oneOf": [{"required": ["query"]}, {"required": ["update"]}],
                }},
            },
        },
    },
}  # fmt: skip
"""For the route of a query or update by POST."""
GET_GRAPH: dict[str, Any] = {
    "responses": {
        200: {
            "description": "The graph.",
            "headers": header("ETag"),
            "content": {
                **{name: {"schema": _TEXT} for name in TRIPLES},
                "application/ld+json": {"schema": {"type": ["array", "object"]}},
                "application/json": {"schema": {"type": ["array", "object"]}},
            },
        },
        304: _NOT_MODIFIED,
        **also(400, 404, 406, 422, 504),
    },
    "openapi_extra": {"parameters": [_graph(True), _UNCHANGED]},
}
PUT_GRAPH: dict[str, Any] = {
    "responses": {
        201: {"description": "The graph is new."},
        204: {"description": "The graph was replaced."},
        **also(400, 409),
    },
    "openapi_extra": {"parameters": [_graph(True)], "requestBody": _GRAPHS},
}
POST_GRAPH: dict[str, Any] = {
    "responses": {
        201: {"description": "The graph is new.", "headers": header("Location")},
        204: {"description": "The statements were added."},
        **also(400, 409),
    },
    "openapi_extra": {
        "parameters": [_graph(False)],
        "requestBody": {**_GRAPHS, "content": {**_GRAPHS["content"], **_PARTS}},
    },
}
DELETE_GRAPH: dict[str, Any] = {
    "responses": {204: {"description": "The graph is gone."}, **also(400, 404, 409)},
    "openapi_extra": {"parameters": [_graph(True)]},
}
