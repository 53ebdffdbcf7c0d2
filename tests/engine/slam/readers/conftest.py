"""Short ways to write files for the readers' tests."""

from __future__ import annotations

import gzip
import os
from collections.abc import Callable
from pathlib import Path

import pytest

Write = Callable[..., Path]


@pytest.fixture
def write(tmp_path: Path) -> Write:
    """Write text or bytes to a file of the test's folder; names that end in .gz are packed."""

    def put(name: str, content: str | bytes) -> Path:
        data = content if isinstance(content, bytes) else content.encode()
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(gzip.compress(data) if name.endswith(".gz") else data)
        return path

    return put


@pytest.fixture(scope="session")
def shared() -> Path:
    """The folder of other people's data."""
    default = Path(__file__).resolve().parents[5] / "shared"
    folder = Path(os.environ.get("SYMBOSLAM_SHARED", default))
    if not folder.is_dir():
        pytest.skip(f"the shared data folder is not here: {folder}")
    return folder
