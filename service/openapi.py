"""What the OpenAPI description says beyond what the framework knows: problems, headers, tokens.

A handler states its bodies and what it gives; which problems it can give follows from what it
takes, and is added here.
"""

from __future__ import annotations

from typing import Any

from fastapi import FastAPI

from symboslam.service.vocabulary import PROBLEM_JSON

_PROBLEM = {"$ref": "#/components/schemas/Problem"}
_SCHEMA: dict[str, Any] = {
    "title": "Problem",
    "description": "What went wrong, and what to do about it (RFC 9457).",
    "type": "object",
    "required": ["type", "title", "status", "detail"],
    "properties": {
        "type": {"type": "string", "format": "uri", "description": "IRI of the kind of problem."},
        "title": {"type": "string"},
        "status": {"type": "integer", "minimum": 400, "maximum": 599},
        "detail": {"type": "string", "description": "What is wrong, where, and what to do."},
        "request_id": {"type": "string", "description": "Under which the log says more."},
        "line": {"type": "integer", "minimum": 1},
        "column": {"type": "integer", "minimum": 1},
        "parameter": {"type": "string"},
        "limit": {"type": "integer"},
    },
    "examples": [
        {
            "type": "https://w3id.org/symboslam/problems#no-such-map",
            "title": "No such map",
            "status": 404,
            "detail": "there is no map 'twon'",
            "request_id": "0d7c6c6b0a6f4a0d8f1f0f6a1f2b3c4d",
        }
    ],
}
_TEXTS = {
    "X-Request-ID": "The id of the request, also in the log.",
    "RateLimit": "What is left: draft-ietf-httpapi-ratelimit-headers.",
    "RateLimit-Policy": "The rate limit that counts.",
    "Retry-After": "Seconds to wait before the next try.",
    "WWW-Authenticate": "What kind of token is needed.",
    "ETag": "Changes with the store.",
    "Location": "Address of what was made.",
}
_DETAILS = {
    400: "Malformed: a parameter, the body or what is in it; says where.",
    401: "No token where one is needed, or a wrong one.",
    403: "The token lacks the scope, or the service does not do this.",
    404: "It is not there.",
    406: "None of the formats that are accepted can be given.",
    408: "The body did not arrive in time.",
    409: "Something else was taken under this name before, or keeps it.",
    413: "The body is too large.",
    415: "The media type, character encoding or compression is not understood.",
    422: "Well-formed, and yet not possible; says what is wrong and where.",
    429: "Too often, or too much at a time.",
    500: "A defect of the service.",
    503: "Too busy, about to stop, or the store is out of reach.",
    504: "It took too long and was stopped.",
}
_ALWAYS = (429, 500, 503)
_AUTHORISED = (401, 403)
_WITH_BODY = (400, 408, 413, 415, 422)
_METHODS = ("get", "put", "post", "patch", "delete")


def install(app: FastAPI, *, public_read: bool) -> None:
    """Let an app describe itself in full.

    Args:
        app: with all its routes.
        public_read: what needs ``query`` needs no token.
    """
    plain = app.openapi

    def openapi() -> dict[str, Any]:
        if app.openapi_schema is None:
            _complete(plain(), public_read)
        return plain()

    app.openapi = openapi  # type: ignore[method-assign]


def also(*statuses: int) -> dict[int | str, dict[str, Any]]:
    """``responses`` of a route that can give further problems, beyond those that always can be."""
    return {status: problem(status) for status in statuses}


def problem(status: int) -> dict[str, Any]:
    """The response of a problem."""
    return {"description": _DETAILS[status], "content": {PROBLEM_JSON: {"schema": _PROBLEM}}}


def made(description: str, status: int = 201) -> dict[int | str, dict[str, Any]]:
    """``responses`` of a route that makes something, whose address the response says."""
    return {status: {"description": description, "headers": header("Location")}}


def header(*names: str) -> dict[str, Any]:
    """The member ``headers`` of a response with some headers."""
    return {name: {"$ref": f"#/components/headers/{name}"} for name in names}


def _complete(document: dict[str, Any], public_read: bool) -> None:
    components = document["components"]
    for name in ("HTTPValidationError", "ValidationError"):
        components["schemas"].pop(name, None)
    components["schemas"]["Problem"] = _SCHEMA
    components["headers"] = {
        name: {"description": text, "schema": {"type": "string"}} for name, text in _TEXTS.items()
    }
    for path, item in document["paths"].items():
        for method in set(item) & set(_METHODS):
            operation = item[method]
            if public_read and operation.get("security") == [{"token": ["query"]}]:
                operation["security"].insert(0, {})
            for parameter in operation.get("parameters", []):
                _without_null(parameter)
            _responses(operation, has_name="{" in path, versioned=path.startswith("/v1/"))
    _link(document["paths"])


def _without_null(parameter: dict[str, Any]) -> None:
    """Leave a parameter out, or give it; JSON's null cannot be sent in an address or header."""
    schema = parameter["schema"]
    if {"type": "null"} in (kinds := schema.get("anyOf", [])):
        (kind,) = (each for each in kinds if each != {"type": "null"})
        parameter["schema"] = {**{k: v for k, v in schema.items() if k != "anyOf"}, **kind}


def _link(paths: dict[str, Any]) -> None:
    """Say that what is made can be used at once: the id of a new map in its addresses."""
    for made, name in (("/v1/maps", "map_id"), ("/v1/tokens", "identifier")):
        links = {
            item[method]["operationId"]: {
                "operationId": item[method]["operationId"],
                "parameters": {f"path.{name}": "$response.body#/id"},
            }
            for path, item in paths.items()
            if path.startswith(f"{made}/{{{name}}}") and "{segment}" not in path
            for method in _METHODS
            if method in item
        }
        paths[made]["post"]["responses"]["201"]["links"] = links


def _responses(operation: dict[str, Any], *, has_name: bool, versioned: bool) -> None:
    responses = operation["responses"]
    if PROBLEM_JSON not in responses.get("422", {}).get("content", {PROBLEM_JSON: None}):
        del responses["422"]  # the framework's own form
    statuses = set(_ALWAYS)
    if operation.get("security"):
        statuses |= set(_AUTHORISED)
    if has_name:
        statuses.add(404)
    if versioned:  # no parameter but those that are declared, and each once
        statuses |= {400, 422}
    if operation.get("parameters"):
        statuses.add(422)
    if "requestBody" in operation:
        statuses |= set(_WITH_BODY)
    for status in statuses:
        responses.setdefault(str(status), problem(status))
    for status, response in responses.items():
        found = header("X-Request-ID")
        if operation.get("security"):
            found |= header("RateLimit", "RateLimit-Policy")
        if status in ("429", "503"):
            found |= header("Retry-After")
        if status == "401":
            found |= header("WWW-Authenticate")
        response["headers"] = {**found, **response.get("headers", {})}
    operation["responses"] = {key: responses[key] for key in sorted(responses)}
