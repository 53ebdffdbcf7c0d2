"""Tokens over HTTP at ``/v1/tokens``, for administrators."""

from __future__ import annotations

import asyncio
from datetime import datetime
from typing import Annotated, Literal, cast

from fastapi import APIRouter, Depends, Request, Response
from pydantic import AwareDatetime, BaseModel, ConfigDict, Field

from symboslam.errors import InputError
from symboslam.service.auth import AdminOnly
from symboslam.service.json_body import JSONRoute
from symboslam.service.problems import Problem
from symboslam.service.tokens import LONGEST_NAME, SCOPES, Token, Tokens

router = APIRouter(prefix="/v1/tokens", tags=["Tokens"], route_class=JSONRoute)
Scope = Literal["query", "ingest", "update", "admin"]


class TokenRequest(BaseModel):
    """A token to make."""

    model_config = ConfigDict(extra="forbid")

    name: str = Field(min_length=1, max_length=LONGEST_NAME, description="Whose, or what for.")
    scopes: list[Scope] = Field(
        min_length=1, max_length=len(SCOPES), description="`admin` brings all others with it."
    )
    expires: AwareDatetime | None = Field(None, description="With time zone; by default never.")


class TokenInfo(BaseModel):
    """What is known of a token."""

    model_config = ConfigDict(from_attributes=True)

    id: str
    name: str
    scopes: list[str]
    created: datetime
    expires: datetime | None
    last_used: datetime | None = Field(description="Up to ten minutes too early.")


class NewToken(TokenInfo):
    """A token that was made."""

    token: str = Field(description="Shown this once only.")


async def _tokens(request: Request) -> Tokens:
    return cast(Tokens, request.app.state.tokens)


CurrentTokens = Annotated[Tokens, Depends(_tokens)]


@router.post("", status_code=201, summary="Make a token")
async def add_token(
    wanted: TokenRequest, tokens: CurrentTokens, response: Response, _: AdminOnly
) -> NewToken:
    """Make a token. It is in this response only."""
    try:
        token, text = await asyncio.to_thread(
            tokens.add, wanted.name, wanted.scopes, wanted.expires
        )
    except InputError as error:
        raise Problem(422, "invalid-parameter", str(error)) from error
    response.headers["Cache-Control"] = "no-store"
    return NewToken(token=text, **_info(token).model_dump())


@router.get("", summary="All tokens")
async def list_tokens(tokens: CurrentTokens, _: AdminOnly) -> list[TokenInfo]:
    """All tokens without their secrets, the oldest first."""
    return [_info(token) for token in tokens.all()]


@router.delete("/{identifier}", status_code=204, summary="Revoke a token")
async def delete_token(identifier: str, tokens: CurrentTokens, _: AdminOnly) -> None:
    """Make a token useless from now on."""
    if not await asyncio.to_thread(tokens.remove, identifier):
        raise Problem(404, "no-such-token", f"there is no token {identifier[:80]!r}")


def _info(token: Token) -> TokenInfo:
    return TokenInfo(
        id=token.id, name=token.name, scopes=[s for s in SCOPES if s in token.scopes],
        created=token.created, expires=token.expires, last_used=token.last_used,
    )  # fmt: skip
