"""Stop: a signal ends an agent where it waits, elsewhere it is kept; a second ends it at once."""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator

import pytest

from symboslam.cli.agent_stop import INTERRUPTED, Stop, leaving


@pytest.fixture(autouse=True)
def _handlers() -> Iterator[None]:
    before = [(n, signal.getsignal(n)) for n in (signal.SIGINT, signal.SIGTERM)]
    yield
    for number, handler in before:
        signal.signal(number, handler)


@pytest.fixture
def left(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """Codes by which the process would have ended."""
    found: list[int] = []
    monkeypatch.setattr(os, "_exit", found.append)
    return found


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_amid_work_waits_for_where_it_may_end(number: int, left: list[int]) -> None:
    stop = Stop()
    stop.check()
    os.kill(os.getpid(), number)
    assert stop.wanted
    with pytest.raises(KeyboardInterrupt):
        stop.check()
    with pytest.raises(KeyboardInterrupt), stop.possible():
        raise AssertionError("it had to end before")
    assert left == []


def test_a_signal_where_it_may_end_ends_it(left: list[int]) -> None:
    stop = Stop()
    with pytest.raises(KeyboardInterrupt), stop.possible():
        os.kill(os.getpid(), signal.SIGTERM)
    assert left == []


def test_a_second_signal_ends_it_at_once(left: list[int]) -> None:
    Stop()
    os.kill(os.getpid(), signal.SIGTERM)
    assert left == []
    os.kill(os.getpid(), signal.SIGTERM)
    assert left == [INTERRUPTED]


def test_all_is_put_in_order_before_it_leaves(left: list[int]) -> None:
    order: list[str] = []
    with leaving():
        try:
            raise KeyboardInterrupt
        finally:
            order.append(f"in order, {left}")
    assert order == ["in order, []"]
    assert left == [INTERRUPTED]
