"""The folder of the embedded store: opened, or refused where it is seen to be damaged.

RocksDB takes a folder without ``CURRENT`` for a new one, and the rest of a manifest that was cut
short for an older state, and removes what that does not know. Both are told here before it looks.
"""

from __future__ import annotations

import contextlib
import json
from pathlib import Path
from typing import TYPE_CHECKING

from symboslam.errors import OutputError, StoreError

if TYPE_CHECKING:
    import pyoxigraph

DAMAGED = "Corruption"
"""How RocksDB begins what it says of files that are not as they were written."""
_NOTE = "store.json"
_MEND = (
    ". Restore a backup (symboslam store restore), or move the folder away: maps are stated anew"
    " from service.sqlite3, graphs of your own are lost"
)


def open_folder(data: Path) -> pyoxigraph.Store:
    """Open the store in a data folder; it is made if it is not there.

    Raises:
        StoreError: it is damaged, another process has it open, or it cannot be made.
    """
    import pyoxigraph

    folder = data / "store"
    if problem := _problem(data):
        raise StoreError(f"{folder} is damaged, and was left as it is: {problem}{_MEND}")
    try:
        folder.mkdir(parents=True, exist_ok=True)
        return pyoxigraph.Store(folder)
    except (OSError, RuntimeError) as error:
        raise StoreError(_opening(data, error)) from error


def note(data: Path) -> None:
    """Note how long the manifest is, so that a shorter one is found out."""
    from symboslam.engine.writers.atomic import atomic_file

    with contextlib.suppress(OSError, OutputError):  # it is of use, but nothing depends on it
        current = (data / "store" / "CURRENT").read_text().strip()
        size = (data / "store" / current).stat().st_size
        with atomic_file(data / _NOTE) as file:
            file.write(json.dumps({"manifest": current, "bytes": size}).encode())


def _problem(data: Path) -> str | None:
    """What is wrong with the folder; None if nothing is, as far as can be seen from outside."""
    folder = data / "store"
    if not folder.is_dir():
        return None
    current = folder / "CURRENT"
    if not current.exists():
        lost = any(folder.glob("*.sst")) or any(folder.glob("MANIFEST-*"))
        return "it has no file CURRENT" if lost else None
    try:
        found = json.loads((data / _NOTE).read_bytes())
        manifest = folder / str(found["manifest"])
        if current.read_text().strip() != manifest.name:
            return None  # somebody else had it open since
        short = int(found["bytes"]) - manifest.stat().st_size
    except (OSError, ValueError, KeyError, TypeError):
        return None
    return f"{manifest.name} lacks {short} bytes or more" if short > 0 else None


def _opening(data: Path, error: Exception) -> str:
    if isinstance(error, OSError) and "lock" in str(error).lower():
        return f"{data}: another process has this store open; stop it, or take another --data"
    if str(error).startswith(DAMAGED) or isinstance(error, FileNotFoundError):
        return f"{data / 'store'} is damaged, and was left as it is: {error}{_MEND}"
    return f"{data}: the store cannot be opened: {error}"
