"""The service's own records (tokens, maps, batches): one SQLite file beside the store."""

from __future__ import annotations

import sqlite3
from contextlib import closing
from pathlib import Path
from typing import IO

from symboslam.errors import StoreError

NAME = "service.sqlite3"
_LOCK = "service.lock"
_MEND = ". Restore a backup: symboslam store restore"


def check_database(data: Path) -> None:
    """Refuse a database that is damaged, before anything is written to it.

    Raises:
        StoreError: it is, or it is empty where it should not be.
    """
    file = data / NAME
    if not file.exists():
        return
    if file.stat().st_size == 0:  # SQLite would begin anew, and remove its log
        raise StoreError(f"{file} is empty{_MEND}. If this folder is new, remove the file")
    try:
        address = f"{file.absolute().as_uri()}?mode=ro"
        with closing(sqlite3.connect(address, timeout=10, uri=True)) as found:
            rows = found.execute("PRAGMA quick_check(1)").fetchall()
    except sqlite3.OperationalError as error:
        raise StoreError(f"{file} cannot be opened: {error}") from error
    except sqlite3.DatabaseError as error:
        rows = [(str(error),)]
    if rows != [("ok",)]:
        raise StoreError(f"{file} is damaged, and was left as it is: {rows[0][0]}{_MEND}")


def make_folder(data: Path) -> None:
    """Make a data folder if it is not there.

    Raises:
        StoreError: it cannot be made; says why.
    """
    try:
        data.mkdir(parents=True, exist_ok=True)
    except FileExistsError as error:
        raise StoreError(f"{data} is no folder; take another --data") from error
    except OSError as error:
        there = next((folder for folder in data.absolute().parents if folder.exists()), Path("/"))
        # Linux says of a folder that takes none, such as /proc, that it is not there itself.
        lost = isinstance(error, FileNotFoundError)
        problem = "it takes no new folders" if lost else error.strerror or error
        raise StoreError(
            f"the folder {data} cannot be made in {there}: {problem}; take another --data"
        ) from error


def lock_folder(data: Path) -> IO[bytes]:
    """Keep other servers out of a data folder until the file is closed or the process ends.

    Raises:
        StoreError: there is another one, or the folder cannot be made.
    """
    import fcntl

    make_folder(data)
    try:
        file = (data / _LOCK).open("ab")
    except OSError as error:
        raise StoreError(f"{data / _LOCK} cannot be opened: {error}") from error
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as error:
        file.close()
        problem = "another process serves this folder; stop it, or take another --data"
        raise StoreError(f"{data}: {problem}") from error
    return file


def open_database(data: Path) -> sqlite3.Connection:
    """The database in a data folder; each module makes the tables that it needs.

    What is committed survives the death of the process: writes go to a log that the operating
    system holds (``WAL``). The connection may be used by any thread, one at a time; transactions
    are begun and ended by the caller.

    Raises:
        StoreError: the folder or file cannot be made or opened.
    """
    make_folder(data)
    try:
        found = sqlite3.connect(
            data / NAME, timeout=10, isolation_level=None, check_same_thread=False
        )
        found.execute("PRAGMA journal_mode = WAL")
        found.execute("PRAGMA synchronous = NORMAL")
        found.execute("PRAGMA foreign_keys = ON")
    except (OSError, sqlite3.Error) as error:
        raise StoreError(f"{data / NAME} cannot be opened: {error}") from error
    return found
