"""How agents end on Ctrl-C and SIGTERM: where they wait, without a traceback, by exit code 130."""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import NoReturn

INTERRUPTED = 130
"""Exit code."""
_SHOW_CURSOR = b"\x1b[?25h"


class Stop:
    """Signals that end an agent where it waits, and never in the midst of its work.

    The second one ends it at once; what is on its disk is whole at any time.

    Attributes:
        wanted: whether it is to end.
    """

    def __init__(self) -> None:
        self.wanted = self._possible = False
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, self._on_signal)

    def _on_signal(self, *_: object) -> None:
        if self.wanted:
            leave()
        self.wanted = True
        if self._possible:
            raise KeyboardInterrupt

    def check(self) -> None:
        """End here, if that is wanted.

        Raises:
            KeyboardInterrupt: it is.
        """
        if self.wanted:
            raise KeyboardInterrupt

    @contextmanager
    def possible(self) -> Iterator[None]:
        """Where it may end: no lock is held, and nothing is left half done.

        Raises:
            KeyboardInterrupt: it does.
        """
        self._possible = True
        try:
            self.check()
            yield
        finally:
            self._possible = False


@contextmanager
def leaving() -> Iterator[None]:
    """Leave the process if it is interrupted in here, once all in here is put in order."""
    try:
        yield
    except KeyboardInterrupt:
        leave()


def leave(*_: object) -> NoReturn:
    """End the process at once.

    Threads that still wait for a service would otherwise be cut down one by one while the
    interpreter goes, which sometimes ends in a traceback or a crash.
    """
    if sys.stderr.isatty():
        os.write(2, _SHOW_CURSOR)  # a progress bar may have hidden it
    os._exit(INTERRUPTED)
