"""Files that appear whole or not at all: written beside the target, then moved over it."""

from __future__ import annotations

import contextlib
import errno
import os
import secrets
import stat
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO

from symboslam.errors import OutputError


@contextlib.contextmanager
def atomic_file(target: str | Path) -> Iterator[BinaryIO]:
    """A binary file that takes the target's place only when the block ends without an error.

    The new content goes to a temporary file in the same folder, is flushed to the disk and moved
    over the target in one step. On any error the temporary file is removed and what was there
    before stays as it was (design 10). A link is followed; a device or pipe, such as
    ``/dev/stdout``, has no old content to keep and is written directly.

    Args:
        target: the file to write.

    Yields:
        The open temporary file.

    Raises:
        OutputError: no such folder, no permission, no room, or any other refusal by the system.
    """
    try:
        with _opened(Path(target)) as stream:
            yield stream
    except OSError as error:
        raise _refusal(target, error) from error


def check_writable(target: str | Path) -> None:
    """Refuse a target that could not be written now; nothing is changed on the disk.

    Raises:
        OutputError: no such folder, or no permission.
    """
    try:
        mode = _kind_of(Path(target))
        if mode is not None and not stat.S_ISREG(mode):
            return
        folder = Path(os.path.realpath(target)).parent
        if not folder.is_dir():
            raise FileNotFoundError(errno.ENOENT, f"there is no folder {folder}")
        if not os.access(folder, os.W_OK | os.X_OK):
            raise PermissionError(errno.EACCES, f"no permission to write in {folder}")
    except OSError as error:
        raise _refusal(target, error) from error


def _refusal(target: str | Path, error: OSError) -> OutputError:
    return OutputError(f"{target} cannot be written: {error.strerror or error}")


def _kind_of(target: Path) -> int | None:
    """Mode of what is there now, or None; refuses folders and write-protected files."""
    mode = target.stat().st_mode if target.exists() else None
    if mode is not None and stat.S_ISDIR(mode):
        raise IsADirectoryError(errno.EISDIR, "it is a folder")
    if mode is not None and not os.access(target, os.W_OK):
        raise PermissionError(errno.EACCES, "it is write-protected")
    return mode


@contextlib.contextmanager
def _opened(target: Path) -> Iterator[BinaryIO]:
    mode = _kind_of(target)
    if mode is not None and not stat.S_ISREG(mode):
        with target.open("wb") as device:
            yield device
        return
    path = Path(os.path.realpath(target))
    temporary = path.with_name(f".symboslam-{secrets.token_hex(8)}.tmp")
    flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0)
    handle = os.open(temporary, flags, 0o666)
    try:
        with open(handle, "wb") as stream:
            yield stream
            stream.flush()
            os.fsync(stream.fileno())
        if mode is not None:
            temporary.chmod(stat.S_IMODE(mode))
        os.replace(temporary, path)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise
