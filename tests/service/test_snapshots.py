"""Snapshots are made when something was written, and kept as long as somebody reads them."""

import asyncio
import doctest
from pathlib import Path

import pytest

from symboslam.errors import StoreError
from symboslam.service.sparql import negotiation, tokens
from symboslam.service.store.snapshots import Snapshots
from tests.service.conftest import MakeService


class Folder:
    """Snapshots in a folder, and who reads which."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.held: set[str] = set()
        self.snapshots = Snapshots(folder, lambda path: Path(path).mkdir(), lambda: self.held)

    async def become(self, names: set[str]) -> None:
        """Wait until these are there and no others: removal is in the background."""
        while {path.name for path in self.folder.iterdir()} != names:
            await asyncio.sleep(0.005)


def test_one_for_each_generation_that_is_asked_for(tmp_path: Path) -> None:
    folder = Folder(tmp_path / "snapshots")

    async def ask() -> list[str]:
        at = folder.snapshots.at
        # 5 makes the first; 4 is older than that; 9 needs another, once for both.
        return [await at(5), await at(5), await at(4), *await asyncio.gather(at(9), at(9))]

    names = [Path(path).name for path in asyncio.run(ask())]
    assert names == ["1", "1", "1", "2", "2"]


def test_what_is_read_stays(tmp_path: Path) -> None:
    folder = Folder(tmp_path / "snapshots")

    async def ask() -> None:
        folder.held = {await folder.snapshots.at(1)}
        for generation in range(2, 6):
            await folder.snapshots.at(generation)
        await folder.become({"1", "4", "5"})  # held; the one before; the newest
        folder.held = set()
        await folder.snapshots.at(6)
        await folder.become({"5", "6"})
        folder.snapshots.clear()
        assert not folder.folder.exists()
        assert Path(await folder.snapshots.at(6)).is_dir()

    asyncio.run(asyncio.wait_for(ask(), timeout=10))


def test_one_that_cannot_be_made(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(StoreError, match="cannot be read"):
        asyncio.run(Folder(tmp_path / "file").snapshots.at(1))


def test_a_store_that_cannot_be_read_is_told(make_service: MakeService, tmp_path: Path) -> None:
    service = make_service()
    (tmp_path / "data" / "snapshots").touch()
    response = service.ask("ASK {}")
    assert response.status_code == 503
    assert response.headers["content-type"] == "application/problem+json"
    assert "store-unavailable" in response.text
    (tmp_path / "data" / "snapshots").unlink()
    assert service.ask("ASK {}").status_code == 200


def test_examples_in_docstrings() -> None:
    for module in (negotiation, tokens):
        result = doctest.testmod(module)
        assert result.attempted
        assert not result.failed
