"""Sender: delivers what is in a spool to a service, and gives up on nothing."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Mapping
from urllib.parse import quote

from symboslam.errors import InputError
from symboslam.sim_bridge.agents.link import Link, LinkDownError, Patience, RefusedError, Tell
from symboslam.sim_bridge.agents.spool import Letter, Spool

NDJSON = {"Content-Type": "application/x-ndjson"}
_NEVER = (400, 409, 413, 422)
"""What an increment gets that will never be taken; anything else may be mended."""
_AT_A_TIME = 100
_BYTES = 1024 * 1024
_TICK = 0.5


class Sender(threading.Thread):
    """Sends what is in a spool, whenever the service takes it, until it is stopped.

    Args:
        spool: what is to be sent.
        link: to the service.
        identifier: id of the map.
        tell: is told what is odd.

    Attributes:
        refusal: why the service refuses everything for now, such as a token that is wrong.
        refused: increments that it will never take.
        failure: what has ended it, if anything did.
    """

    def __init__(self, spool: Spool, link: Link, identifier: str, tell: Tell) -> None:
        super().__init__(daemon=True)
        self._spool, self._link, self._tell = spool, link, tell
        self._path = f"/v1/maps/{quote(identifier, safe='')}/increments"
        self._patience = Patience(tell)
        self._stopped = threading.Event()
        self.refusal: RefusedError | None = None
        self.refused = 0
        self.failure: Exception | None = None

    def run(self) -> None:
        """Send until stopped."""
        try:
            while not self._stopped.is_set():
                if letters := self._spool.next(_AT_A_TIME, _BYTES):
                    self._try(letters)
                else:
                    self._spool.wait(_TICK)
        except Exception as error:  # whoever feeds the spool has to hear of it
            self.failure = error

    def stop(self) -> None:
        """End; what was not delivered stays in the spool."""
        self._stopped.set()
        self.join(1.0)

    def empty(self, seconds: float | None, tell: Callable[[int], None] = lambda left: None) -> bool:
        """Wait until everything is delivered; whether it is.

        Args:
            seconds: how long; None: as long as it takes.
            tell: is told how many increments are left.

        Raises:
            RefusedError: the service refuses everything.
            Exception: what has ended the thread.
        """
        deadline = None if seconds is None else time.monotonic() + seconds
        while self._spool.waiting:
            self.check()
            if self.refusal is not None:
                raise self.refusal
            if deadline is not None and time.monotonic() > deadline:
                return False
            tell(self._spool.waiting)
            self._spool.wait(_TICK)
        return True

    def check(self) -> None:
        """Raise what has ended the thread, if anything did."""
        if self.failure is not None:
            raise self.failure

    def _try(self, letters: list[Letter]) -> None:
        try:
            self._send(letters)
        except LinkDownError as error:
            self._stopped.wait(self._patience.failed(error))
        except RefusedError as error:
            self.refusal = error
            self._stopped.wait(self._patience.failed(error))
        else:
            self.refusal = None
            self._patience.worked()

    def _send(self, letters: list[Letter]) -> None:
        """Send increments, and one by one where one of them is refused for good."""
        content = "".join(f"{letter.content}\n" for letter in letters).encode()
        try:
            self._link.ask("POST", self._path, content=content, headers=NDJSON)
        except RefusedError as error:
            if error.status not in _NEVER:
                raise
            if len(letters) > 1:
                for letter in letters:
                    self._send([letter])
                return
            self.refused += 1
            self._spool.refuse(letters[0], str(error))
            self._tell(f"{letters[0].name} is refused and put aside: {error}")
            return
        self._spool.delivered(letters)


def check_map(link: Link, identifier: str, tell: Tell) -> Mapping[str, object] | None:
    """What a service says of a map; None if it cannot be reached now.

    Raises:
        RefusedError: there is no such map, or it may not be read.
    """
    try:
        answer = link.ask("GET", f"/v1/maps/{quote(identifier, safe='')}")
    except LinkDownError as error:
        tell(f"{error}; what is mapped is kept until it can")
        return None
    try:
        found = answer.json()
    except ValueError as error:
        raise InputError(f"{link.url} is no SymboSLAM service: it sends no JSON") from error
    if not isinstance(found, dict):
        raise InputError(f"{link.url} is no SymboSLAM service")
    return found
