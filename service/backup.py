"""Backups of a data folder: one compressed file with the store, the records and the ontologies.

What belongs together is written in this order: statements, records, ontologies. A map's statements
can always be made anew from its records, and its records from nothing else; so the records in a
backup say of every map that it is not stated yet, and a service that starts on them states all maps
anew. Ontologies are written before a map that uses them and never change, so that those that the
records name are there. All else that is in the store is as it was at one moment.
"""

from __future__ import annotations

import asyncio
import gzip
import io
import json
import os
import shutil
import sqlite3
import tarfile
import zlib
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager
from datetime import UTC, datetime
from hashlib import sha256
from pathlib import Path, PurePosixPath
from secrets import token_hex
from typing import IO, Any

from symboslam.errors import InputError, OutputError, StoreError
from symboslam.service.database import NAME, check_database, lock_folder, open_database
from symboslam.service.store._base import Store
from symboslam.service.store.folder import open_folder

Progress = Callable[[str, float], None]
STAGING = "backup"
"""Folder in the data folder for what is being backed up; the same disk, because of hard links."""
_FORMAT = 1
_MANIFEST = "manifest.json"
_PIECE = 1024 * 1024
_LEVEL = 3
"""Of compression; RocksDB's files are compressed already."""
_LONGEST_MANIFEST = 64 * 1024 * 1024
_DAMAGED = (tarfile.TarError, EOFError, zlib.error, gzip.BadGzipFile)


async def collect(data: Path, store: Store, guard: asyncio.Lock) -> Path:
    """Put what belongs into a backup of a running service into a folder, with its manifest.

    Args:
        data: the data folder.
        store: the store.
        guard: held while maps come or go.

    Raises:
        StoreError: something cannot be read or written.
    """
    folder = data / STAGING / token_hex(8)
    try:
        folder.mkdir(parents=True)
        async with guard:
            await store.copy_to(folder / "store")
            await asyncio.to_thread(_copy_records, data, folder)
        await asyncio.to_thread(_finish, data, folder)
    except BaseException as error:
        await asyncio.to_thread(shutil.rmtree, folder, True)
        if isinstance(error, OSError):
            raise StoreError(f"there is no room for a backup: {error}") from error
        raise
    return folder


def back_up(data: Path, target: IO[bytes], progress: Progress) -> None:
    """Write the backup of a data folder that no server has open.

    Raises:
        StoreError: it cannot be read, or a server has it open.
        InputError: it is no data folder.
    """
    if not (data / NAME).is_file():
        raise InputError(f"{data} is no data folder of symboslam serve: it has no {NAME}")
    folder = data / STAGING / token_hex(8)
    try:
        with _alone(data):
            check_database(data)
            folder.mkdir(parents=True)
            if (data / "store").is_dir():
                progress("copying the store", 0.0)
                _copy_store(data, folder / "store")
            _copy_records(data, folder)
            _finish(data, folder)
            archive(folder, target, progress)
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def archive(folder: Path, target: IO[bytes], progress: Progress) -> None:
    """Write a folder of `collect` as one file, the manifest first."""
    files = json.loads((folder / _MANIFEST).read_bytes())["files"]
    total, done = sum(each["size"] for each in files.values()) or 1, 0
    with (
        gzip.GzipFile("", "wb", _LEVEL, target) as packed,
        tarfile.open(fileobj=packed, mode="w|", format=tarfile.PAX_FORMAT) as tar,
    ):
        tar.add(folder / _MANIFEST, _MANIFEST)
        for name, each in files.items():
            tar.add(folder / name, name)
            done += each["size"]
            progress("packing", done / total)


def verify(file: Path, progress: Progress) -> dict[str, Any]:
    """Read a backup and compare all checksums; its manifest.

    Raises:
        InputError: it is no backup, or not as it was written.
    """
    return _unpack(file, None, progress)


def restore(file: Path, data: Path, progress: Progress) -> dict[str, Any]:
    """Make a data folder of a backup; its manifest. All of it is there at the end, or nothing.

    Raises:
        InputError: the folder is not empty; or the file is no backup or is damaged.
        OutputError: it cannot be written.
    """
    if data.exists() and not (data.is_dir() and not any(data.iterdir())):
        raise InputError(f"{data} is there and not empty; restore into another folder")
    new = data.absolute().parent / f".{data.absolute().name}.{token_hex(6)}"
    try:
        new.mkdir(parents=True)
        manifest = _unpack(file, new, progress)
        progress("looking at it", 1.0)
        check_database(new)
        if manifest["store"]:
            open_folder(new)
        _sync(new)
        new.replace(data)
        _sync(data.absolute().parent)
    except OSError as error:
        raise OutputError(f"{data} cannot be restored: {error.strerror or error}") from error
    finally:
        shutil.rmtree(new, ignore_errors=True)
    return manifest


def _copy_records(data: Path, folder: Path) -> None:
    """Copy the database as it is at this moment, whoever writes to it."""
    try:
        with (
            closing(open_database(data)) as source,
            closing(sqlite3.connect(folder / NAME, isolation_level=None)) as target,
        ):
            source.backup(target)
            target.execute("PRAGMA journal_mode = DELETE")
            if target.execute("SELECT 1 FROM sqlite_master WHERE name = 'map'").fetchone():
                target.execute("UPDATE map SET stated = -1")
    except sqlite3.Error as error:
        raise StoreError(f"the records cannot be copied: {error}") from error


def _copy_store(data: Path, folder: Path) -> None:
    store = open_folder(data)
    try:
        store.backup(str(folder))
    except (OSError, RuntimeError) as error:
        raise StoreError(f"{data}: the store cannot be copied: {error}") from error


@contextmanager
def _alone(data: Path) -> Iterator[None]:
    try:
        lock = lock_folder(data)
    except StoreError as error:
        problem = f"{error}. A server that runs makes its backup itself: --url"
        raise StoreError(problem) from error
    with lock:
        yield


def _finish(data: Path, folder: Path) -> None:
    """Add the ontologies and the manifest."""
    from symboslam import __version__

    if (data / "ontologies").is_dir():
        shutil.copytree(data / "ontologies", folder / "ontologies")
    files = {
        file.relative_to(folder).as_posix(): {"size": file.stat().st_size, "sha256": _hash(file)}
        for file in sorted(folder.rglob("*"))
        if file.is_file()
    }
    manifest = {
        "format": _FORMAT,
        "version": __version__,
        "created": datetime.now(UTC).isoformat(timespec="seconds"),
        "store": (folder / "store").is_dir(),
        "files": files,
    }
    (folder / _MANIFEST).write_text(json.dumps(manifest, indent=1))


def _hash(file: Path) -> str:
    found = sha256()
    with file.open("rb") as stream:
        while piece := stream.read(_PIECE):
            found.update(piece)
    return found.hexdigest()


def _unpack(file: Path, folder: Path | None, progress: Progress) -> dict[str, Any]:
    """Read a backup to its end, and write its files if a folder is given."""
    try:
        with file.open("rb") as raw, tarfile.open(fileobj=raw, mode="r|gz") as tar:
            manifest = _manifest(file, tar)
            missing = dict(manifest["files"])
            total, done = sum(each["size"] for each in missing.values()) or 1, 0
            while member := tar.next():  # iteration would begin with the manifest again
                wanted = missing.pop(member.name, None)
                content = tar.extractfile(member) if member.isreg() else None
                if wanted is None or content is None or member.size != wanted["size"]:
                    raise InputError(f"{file} is damaged: {member.name} is not as it was written")
                if _copy(content, folder and folder / member.name) != wanted["sha256"]:
                    raise InputError(f"{file} is damaged: the checksum of {member.name} is wrong")
                done += member.size
                progress("reading the backup", done / total)
    except _DAMAGED as error:
        raise InputError(f"{file} is no complete backup of a service: {error}") from error
    except FileNotFoundError as error:
        raise InputError(f"there is no file {file}") from error
    if missing:
        raise InputError(f"{file} is damaged: {min(missing)} is missing")
    return manifest


def _manifest(file: Path, tar: tarfile.TarFile) -> dict[str, Any]:
    """The first member of a backup.

    Raises:
        InputError: it is none, or of another kind; or it names a file outside of the folder.
    """
    first = tar.next()
    content = tar.extractfile(first) if first and first.name == _MANIFEST else None
    if first is None or content is None or first.size > _LONGEST_MANIFEST:
        raise InputError(f"{file} is no backup of a service: it has no {_MANIFEST}")
    try:
        found: dict[str, Any] = json.loads(content.read())
        if found["format"] > _FORMAT:
            raise InputError(
                f"{file} was made by version {found['version']}, of whose kind of backup this"
                " version does not know: take a newer one"
            )
        for name, each in found["files"].items():
            path = PurePosixPath(name)
            inside = not path.is_absolute() and ".." not in path.parts and name != _MANIFEST
            if not (inside and int(each["size"]) >= 0 and each["sha256"]):
                raise InputError(f"{file} is no backup of a service: it names {name!r}")
        if NAME not in found["files"] or not isinstance(found["store"], bool):
            raise InputError(f"{file} is no backup of a service: it has no {NAME}")
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise InputError(f"{file} is no backup of a service: its {_MANIFEST} is none") from error
    return found


def _copy(source: IO[bytes], target: Path | None) -> str:
    """Read to the end, and write what was read if there is a target; its checksum."""
    found = sha256()
    if target is not None:
        target.parent.mkdir(parents=True, exist_ok=True)
    with io.BytesIO() if target is None else target.open("xb") as out:
        while piece := source.read(_PIECE):
            found.update(piece)
            if target is not None:
                out.write(piece)
        if target is not None:
            out.flush()
            os.fsync(out.fileno())
    return found.hexdigest()


def _sync(folder: Path) -> None:
    """Force the names in a folder onto the disk."""
    number = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(number)
    finally:
        os.close(number)
