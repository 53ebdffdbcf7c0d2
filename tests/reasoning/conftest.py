"""Shared by the tests of reasoning/: no network, a cache folder of their own, the town."""

from __future__ import annotations

import socket
from collections.abc import Callable
from pathlib import Path

import pytest

from symboslam.errors import ReasonerError
from symboslam.reasoning.hermit import find_java
from symboslam.reasoning.knowledge import Knowledge

RESOURCES = Path(__file__).parents[1] / "resources" / "reasoning"


def _has_java() -> bool:
    try:
        find_java()
    except ReasonerError:
        return False
    return True


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    if _has_java():
        return
    skip = pytest.mark.skip(reason="no Java: pip install 'symboslam[reasoner]'")
    for item in items:
        if {"town", "hermit"} & set(getattr(item, "fixturenames", ())):
            item.add_marker(skip)


@pytest.fixture(autouse=True)
def no_network(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object) -> None:
        raise AssertionError("a test asked the network")

    monkeypatch.setattr(socket.socket, "connect", refuse)


@pytest.fixture(autouse=True)
def cache_folder(tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = tmp_path_factory.mktemp("cache")
    monkeypatch.setenv("SYMBOSLAM_CACHE", str(folder))
    return folder


@pytest.fixture
def hermit() -> None:
    """Asked for by tests that start Java; they are skipped where there is none."""


@pytest.fixture
def resource() -> Callable[[str], Path]:
    return lambda name: RESOURCES / name


@pytest.fixture(scope="session")
def town() -> Knowledge:
    """The town of tests/resources/reasoning/town.ttl."""
    return Knowledge.load(RESOURCES / "town.ttl", cache=False)
