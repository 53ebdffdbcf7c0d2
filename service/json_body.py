"""Bodies in JSON: read strictly, and what is wrong with one told with its line and column."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Coroutine
from typing import Any

from fastapi import Request, Response
from fastapi.routing import APIRoute

from symboslam.errors import InputError
from symboslam.service.problems import Problem
from symboslam.service.requests import media_type
from symboslam.service.vocabulary import JSON

_NUMBER = re.compile(r"-?\d{4301,}")
_BRACKET = re.compile(r'"(?:[^"\\]|\\.)*"?|[\[{]|[\]}]', re.DOTALL)


class JSONError(InputError):
    """A text that is no JSON.

    Args:
        problem: what is wrong.
        line: where, counted from 1.
        column: where, in characters, counted from 1.
    """

    def __init__(self, problem: str, line: int, column: int) -> None:
        super().__init__(f"line {line} column {column}: {problem}")
        self.problem, self.line, self.column = problem, line, column


class RepeatedMemberError(InputError):
    """An object of JSON that has a member twice: which of the two is meant?"""


def parse(body: bytes) -> Any:
    """The JSON of a body.

    Raises:
        JSONError: it is none, or not UTF-8.
        RepeatedMemberError: an object in it has a member twice.

    >>> parse(b'{"a": [1, 2.5]}')
    {'a': [1, 2.5]}
    """
    try:
        text = body.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        before = body[: error.start].decode()
        raise _error("it is not UTF-8 text", before, len(before)) from error
    return parse_text(text)


def parse_text(text: str) -> Any:
    """The JSON of a text; see `parse`."""
    try:
        return json.loads(text, object_pairs_hook=unique)
    except json.JSONDecodeError as error:
        raise JSONError(error.msg, error.lineno, error.colno) from error
    except RecursionError as error:
        depth, place = _deepest(text)
        raise _error(f"it is nested too deeply, {depth} levels", text, place) from error
    except ValueError as error:  # the only other one: Python reads whole numbers up to a length
        found = _NUMBER.search(text)
        problem = "a number has thousands of digits"
        raise _error(problem, text, found.start() if found else 0) from error


def unique(members: list[tuple[str, Any]]) -> dict[str, Any]:
    """An object of JSON whose members have names of their own.

    Raises:
        RepeatedMemberError: two have the same.
    """
    found = dict(members)
    if len(found) != len(members):
        names = [name for name, _ in members]
        twice = next(name for name in names if names.count(name) > 1)
        raise RepeatedMemberError(f"it has the member {twice[:40]!r} twice")
    return found


class JSONRoute(APIRoute):
    """A route whose body, if it takes one, has to be JSON by its media type and its content."""

    def get_route_handler(self) -> Callable[[Request], Coroutine[Any, Any, Response]]:
        """The handler, which gets a request that reads JSON strictly."""
        handle = super().get_route_handler()
        if self.body_field is None:
            return handle

        async def strictly(request: Request) -> Response:
            kind, _ = media_type(request.headers.get("content-type"))
            if kind != JSON:
                raise unsupported(kind, (JSON,))
            return await handle(_Request(request.scope, request.receive))

        return strictly


class _Request(Request):
    async def json(self) -> Any:
        try:
            return parse(await self.body())
        except JSONError as error:
            raise Problem(
                400, "invalid-json", f"body: {error}", line=error.line, column=error.column
            ) from error
        except RepeatedMemberError as error:
            raise Problem(422, "repeated-member", f"body: {error}; give it once") from error


def unsupported(kind: str, known: tuple[str, ...]) -> Problem:
    """What a body of another media type gets."""
    sent = f"not as {kind[:80]}" if kind else "and say so in Content-Type"
    detail = f"send the body as {' or '.join(known)}, {sent}"
    return Problem(415, "unsupported-media-type", detail, headers={"Accept": ", ".join(known)})


def _error(problem: str, text: str, place: int) -> JSONError:
    """An error at a place in a text."""
    return JSONError(problem, text.count("\n", 0, place) + 1, place - text.rfind("\n", 0, place))


def _deepest(text: str) -> tuple[int, int]:
    """How many brackets are open at most, and where the last of them opens."""
    depth = most = place = 0
    for found in _BRACKET.finditer(text):
        if found[0] in "[{":
            depth += 1
            if depth > most:
                most, place = depth, found.start()
        elif found[0] in "]}":
            depth -= 1
    return most, place
