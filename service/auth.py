"""Who asks, and what they may do: bearer tokens (RFC 6750) with scopes.

A handler takes one of `CanQuery`, `CanIngest`, `CanUpdate` and `AdminOnly`; each counts the request
against the rate limit of its scope as well.
"""

from __future__ import annotations

import asyncio
import contextlib
import hmac
from collections.abc import Awaitable, Callable
from dataclasses import dataclass
from hashlib import sha256
from typing import Annotated, Any

from fastapi import Depends, Request, Security
from fastapi.security import HTTPBearer

from symboslam.errors import StoreError
from symboslam.service.limits import Limits, client_of
from symboslam.service.problems import Problem
from symboslam.service.settings import Settings
from symboslam.service.tokens import SCOPES, Token, Tokens

_READING = ("GET", "HEAD")
_SCHEME = "token"
_REALM = 'Bearer realm="SymboSLAM"'


@dataclass(frozen=True)
class Identity:
    """Whoever sent a request.

    Attributes:
        name: the name of the token, or ``anonymous``.
        scopes: what they may do; ``admin`` brings all others with it.
        id: the id of the token; None: they sent none.
    """

    name: str
    scopes: frozenset[str]
    id: str | None


class Authenticator:
    """Tells who bears a token.

    Args:
        settings: the administrator's token, and whether everybody may read.
        tokens: all other tokens.
    """

    def __init__(self, settings: Settings, tokens: Tokens) -> None:
        secret = settings.admin_token
        self._admin = None if secret is None else _digest(secret.get_secret_value())
        self._tokens = tokens
        self._notes: set[asyncio.Task[None]] = set()
        everybody = frozenset({"query"} if settings.public_read else ())
        self._anonymous = Identity("anonymous", everybody, None)

    def identify(self, header: str) -> Identity | None:
        """Who sends a header ``Authorization``; None: their token is wrong or expired."""
        scheme, _, sent = header.partition(" ")
        sent = sent.strip()
        if scheme.lower() != "bearer" or not sent:
            return self._anonymous
        if self._admin is not None and hmac.compare_digest(self._admin, _digest(sent)):
            return Identity("SYMBOSLAM_ADMIN_TOKEN", frozenset(SCOPES), "environment")
        token = self._tokens.find(sent)
        if token is None:
            return None
        if self._tokens.is_due(token):
            note = asyncio.create_task(self._note_use(token))
            self._notes.add(note)
            note.add_done_callback(self._notes.discard)
        every = frozenset(SCOPES) if "admin" in token.scopes else token.scopes
        return Identity(token.name, every, token.id)

    async def _note_use(self, token: Token) -> None:
        with contextlib.suppress(StoreError):  # somebody else writes; the next request tries again
            await asyncio.to_thread(self._tokens.note_use, token)


def authorize(request: Request, needed: str) -> Identity:
    """Let a request pass that may do something; who sent it.

    Args:
        request: it.
        needed: the scope that it needs.

    Raises:
        Problem: 429 where the client asks too often, 403 where the service is read-only or the
            token lacks the scope, 401 where there is none or a wrong one.
    """
    identity: Identity | None = request.state.identity
    limits: Limits = request.app.state.limits
    limits.count(request, client_of(request.scope, identity.id if identity else None), needed)
    settings: Settings = request.app.state.settings
    if settings.read_only and needed != "query" and request.method not in _READING:
        raise Problem(403, "read-only", "this service is read-only: it was started as such")
    if identity is None:
        detail = "the token is wrong, expired or revoked"
        challenge = f'{_REALM}, error="invalid_token", error_description="{detail}"'
        raise Problem(401, "token-invalid", detail, headers={"WWW-Authenticate": challenge})
    if needed in identity.scopes:
        return identity
    if identity.id is None:
        detail = f"this needs a token with the scope {needed}: send Authorization: Bearer TOKEN"
        challenge = f'{_REALM}, scope="{needed}"'
        raise Problem(401, "token-missing", detail, headers={"WWW-Authenticate": challenge})
    detail = f"the token {identity.id} ({identity.name}) lacks the scope {needed}"
    challenge = f'{_REALM}, error="insufficient_scope", scope="{needed}"'
    raise Problem(403, "insufficient-scope", detail, headers={"WWW-Authenticate": challenge})


_bearer = HTTPBearer(
    scheme_name=_SCHEME, auto_error=False, description="A token of `symboslam token add`."
)


def declare(*scopes: str) -> Any:
    """A dependency that says in the OpenAPI description what a route needs, and does nothing."""
    return Security(_bearer, scopes=list(scopes))


def _require(needed: str) -> Callable[..., Awaitable[Identity]]:
    declaration = declare(needed)

    async def identity(request: Request, _: Any = declaration) -> Identity:
        return authorize(request, needed)

    return identity


CanQuery = Annotated[Identity, Depends(_require("query"))]
CanIngest = Annotated[Identity, Depends(_require("ingest"))]
CanUpdate = Annotated[Identity, Depends(_require("update"))]
AdminOnly = Annotated[Identity, Depends(_require("admin"))]


def _digest(text: str) -> bytes:
    # Header values are Latin-1 to the framework and bytes to whoever sent them.
    return sha256(text.encode("latin-1", "replace")).digest()
