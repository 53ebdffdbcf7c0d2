"""Link: a way to a service that may be down, slow or busy."""

from __future__ import annotations

import random
from collections.abc import Callable
from typing import TYPE_CHECKING, Any
from urllib.parse import urlsplit

from symboslam.errors import InputError, MissingExtraError, ServiceError

if TYPE_CHECKING:
    import httpx

Tell = Callable[[str], None]
_LATER = (408, 425, 429)
_LONGEST_WAIT = 30.0
"""Seconds between two tries, unless the service asks for more."""
_FIRST_WAIT = 0.5


class LinkDownError(ServiceError):
    """A service that is out of reach or says "later".

    Args:
        message: what is wrong.
        seconds: how long the service wants to be left alone.
    """

    def __init__(self, message: str, seconds: float = 0.0) -> None:
        super().__init__(message)
        self.seconds = seconds


class RefusedError(InputError):
    """A request that the service refuses.

    Args:
        message: what the service says.
        status: of the response.
    """

    def __init__(self, message: str, status: int) -> None:
        super().__init__(message)
        self.status = status


class Link:
    """A way to a service; any thread may use it.

    Args:
        url: address of the service.
        token: sent as ``Authorization: Bearer``; None sends nothing.
        timeout: seconds that an answer may take.

    Raises:
        InputError: the address or token cannot be one.
        MissingExtraError: httpx is not installed.
    """

    def __init__(self, url: str, token: str | None, timeout: float) -> None:
        try:
            import httpx
        except ImportError as error:
            raise MissingExtraError("httpx", "slam") from error
        parts = urlsplit(url)
        if parts.scheme not in ("http", "https") or not parts.hostname:
            raise InputError(f"{url!r} is no address of a service, such as http://127.0.0.1:8080")
        if not (token or "").isascii() or any(c.isspace() for c in token or ""):
            raise InputError("the token has characters that no token has")
        self.url = url.rstrip("/")
        headers = {"Authorization": f"Bearer {token}"} if token else {}
        self._client = httpx.Client(base_url=self.url, headers=headers, timeout=timeout)
        self._timeout, self._failure = timeout, httpx.TransportError

    def close(self) -> None:
        """Close its connections."""
        self._client.close()

    def ask(self, method: str, path: str, *, seconds: float = 0.0, **given: Any) -> httpx.Response:
        """Ask once.

        Args:
            method: of HTTP.
            path: below the service's address.
            seconds: that the service may take beyond the usual, because it was asked to wait.
            **given: body, parameters and headers, as httpx takes them.

        Raises:
            LinkDownError: it is out of reach, busy or has failed: try again later.
            RefusedError: it refuses this request.
        """
        try:
            answer = self._client.request(method, path, timeout=self._timeout + seconds, **given)
        except self._failure as error:
            reason = str(error) or type(error).__name__
            raise LinkDownError(f"{self.url} cannot be reached: {reason}") from error
        if answer.status_code in _LATER or answer.status_code >= 500:
            raise LinkDownError(f"{self.url}: {_detail(answer)}", _retry_after(answer))
        if answer.status_code >= 300:
            raise RefusedError(f"{self.url}: {_detail(answer)}", answer.status_code)
        return answer


class Patience:
    """How long to wait between tries, and what to say of it: once when it begins, once at its end.

    Args:
        tell: is told.
    """

    def __init__(self, tell: Tell) -> None:
        self._tell, self._seconds = tell, 0.0

    def failed(self, error: Exception) -> float:
        """A try has failed: seconds to wait before the next."""
        if not self._seconds:
            self._tell(f"{error}; trying again until it answers")
        self._seconds = min(max(2 * self._seconds, _FIRST_WAIT), _LONGEST_WAIT)
        # Not all robots at the same moment.
        seconds = self._seconds * random.uniform(0.5, 1.0)
        return max(seconds, getattr(error, "seconds", 0.0))

    def worked(self) -> None:
        """A try has not failed."""
        if self._seconds:
            self._tell("the service answers again")
        self._seconds = 0.0


def _detail(answer: httpx.Response) -> str:
    """What a problem says, in a line."""
    try:
        detail = str(answer.json()["detail"])
    except (ValueError, KeyError, TypeError):
        return f"the service answers with HTTP status {answer.status_code}"
    return "".join(c if c.isprintable() else " " for c in detail)


def _retry_after(answer: httpx.Response) -> float:
    """Seconds of a header Retry-After; 0 where it is none or a date."""
    text = answer.headers.get("Retry-After", "")
    return min(float(text), 120.0) if text.isdigit() else 0.0
