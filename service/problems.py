"""What goes wrong, told as RFC 9457 ``application/problem+json``; never a stack trace."""

from __future__ import annotations

from collections.abc import Mapping
from http import HTTPStatus
from typing import Any

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import JSONResponse
from starlette.exceptions import HTTPException
from starlette.requests import ClientDisconnect
from starlette.routing import Match

from symboslam.errors import StoreError
from symboslam.service.logs import REQUEST_ID
from symboslam.service.vocabulary import PROBLEM_JSON, PROBLEMS

_METHODS = ("GET", "HEAD", "POST", "PUT", "PATCH", "DELETE")


class Problem(Exception):
    """A request that gets no answer.

    Args:
        status: HTTP status.
        name: short name of the kind of problem, the end of its type IRI.
        detail: what is wrong and what to do about it.
        headers: further headers of the response.
        members: further members, such as ``line`` and ``column``.
    """

    def __init__(
        self,
        status: int,
        name: str,
        detail: str,
        *,
        headers: Mapping[str, str] | None = None,
        **members: Any,
    ) -> None:
        super().__init__(detail)
        self.status, self.name, self.detail = status, name, detail
        self.headers, self.members = dict(headers or {}), members

    def response(self) -> JSONResponse:
        """The problem as a response."""
        members = {"request_id": REQUEST_ID.get(), **self.members}
        content = {
            "type": PROBLEMS + self.name,
            "title": self.name.replace("-", " ").capitalize(),
            "status": self.status,
            "detail": self.detail,
            **{name: value for name, value in members.items() if value is not None},
        }
        return JSONResponse(content, self.status, self.headers, PROBLEM_JSON)


def store_unavailable(error: Exception) -> Problem:
    """A store or database that cannot be read or written."""
    return Problem(503, "store-unavailable", str(error), headers={"Retry-After": "10"})


def install(app: FastAPI) -> None:
    """Let the app answer every error with a problem."""

    async def on_problem(_: Request, error: Exception) -> JSONResponse:
        assert isinstance(error, Problem)
        return error.response()

    async def on_http(request: Request, error: Exception) -> JSONResponse:
        assert isinstance(error, HTTPException)
        if isinstance(error.__cause__, Problem):  # raised while the framework read the body
            return error.__cause__.response()
        headers = dict(error.headers or {})
        detail = str(error.detail)
        if error.status_code == HTTPStatus.METHOD_NOT_ALLOWED:
            headers["Allow"] = ", ".join(_methods(app, request))
            detail = f"{request.method} is not possible here, only {headers['Allow']}"
        elif error.status_code == HTTPStatus.NOT_FOUND:
            detail = f"there is nothing at {request.url.path}"
        name = HTTPStatus(error.status_code).phrase.lower().replace(" ", "-")
        return Problem(error.status_code, name, detail, headers=headers).response()

    async def on_validation(_: Request, error: Exception) -> JSONResponse:
        assert isinstance(error, RequestValidationError)
        first = error.errors()[0]
        where = ".".join(str(part) for part in first["loc"])
        return Problem(422, "invalid-parameter", f"{where}: {first['msg']}").response()

    async def on_store(_: Request, error: Exception) -> JSONResponse:
        return store_unavailable(error).response()

    async def on_disconnect(_: Request, error: Exception) -> JSONResponse:
        return Problem(499, "client-closed-request", "the client is gone").response()

    async def on_defect(_: Request, error: Exception) -> JSONResponse:
        detail = "the service has a defect; its log says more"
        return Problem(500, "internal-error", detail).response()

    app.add_exception_handler(Problem, on_problem)
    app.add_exception_handler(HTTPException, on_http)
    app.add_exception_handler(RequestValidationError, on_validation)
    app.add_exception_handler(StoreError, on_store)
    app.add_exception_handler(ClientDisconnect, on_disconnect)
    app.add_exception_handler(Exception, on_defect)


def _methods(app: FastAPI, request: Request) -> list[str]:
    """The methods that some route takes at the path of a request."""
    return [
        method
        for method in _METHODS
        if any(
            route.matches({**request.scope, "method": method})[0] == Match.FULL
            for route in app.routes
        )
    ]
