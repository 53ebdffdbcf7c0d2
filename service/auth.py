"""Who may write. For now one token, the administrator's."""

from __future__ import annotations

import hmac
from typing import Annotated

from fastapi import Depends, Request

from symboslam.service.problems import Problem
from symboslam.service.settings import Settings


def require_admin(request: Request) -> None:
    """Let a request pass that bears the administrator's token.

    Raises:
        Problem: 401 where it bears none or a wrong one, 403 where nobody may write.
    """
    settings: Settings = request.app.state.settings
    if settings.admin_token is None:
        detail = "this service is read-only: it was started without SYMBOSLAM_ADMIN_TOKEN"
        raise Problem(403, "read-only", detail)
    scheme, _, sent = request.headers.get("authorization", "").partition(" ")
    expected = settings.admin_token.get_secret_value().encode()
    if scheme.lower() != "bearer" or not sent:
        detail = "writing needs a token: send the header Authorization: Bearer TOKEN"
        raise Problem(401, "token-missing", detail, headers={"WWW-Authenticate": "Bearer"})
    # Header values are Latin-1 to the framework and bytes to whoever sent them.
    if not hmac.compare_digest(sent.strip().encode("latin-1", "replace"), expected):
        challenge = 'Bearer error="invalid_token"'
        raise Problem(
            401, "token-invalid", "the token is wrong", headers={"WWW-Authenticate": challenge}
        )


AdminOnly = Annotated[None, Depends(require_admin)]
