"""``symboslam store``: back up what a service keeps, restore it, and check it."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import datetime
from pathlib import Path
from secrets import token_hex
from typing import Annotated

import typer

from symboslam.cli.client import TimeoutOption, TokenOption
from symboslam.cli.common import progress_bar, show
from symboslam.errors import InputError, MissingExtraError, OutputError

app = typer.Typer(no_args_is_help=True, help="What a service keeps: back up, restore, check.")

BACKUP_EXAMPLES = """
[bold]Examples[/]

symboslam store backup /srv/maps --to /srv/backups

symboslam store backup --url http://127.0.0.1:8080 --to maps.tar.gz
"""
CHECK_EXAMPLES = """
[bold]Examples[/]

symboslam store check /srv/maps

symboslam store check /srv/maps --shapes --repair
"""


@app.command("backup", epilog=BACKUP_EXAMPLES)
def backup(
    to: Annotated[
        str,
        typer.Option(
            "--to",
            metavar="FILE",
            help="Where to write it: a file that is not there, or a folder; with / at its end it "
            "is made if needed.",
        ),
    ],
    data: Annotated[
        Path | None,
        typer.Argument(metavar="[DIR]", help="Folder that no server has open.", show_default=False),
    ] = None,
    url: Annotated[
        str | None,
        typer.Option(metavar="URL", help="A server that runs, in the place of the folder."),
    ] = None,
    token: TokenOption = None,
    timeout: TimeoutOption = 300.0,
) -> None:
    """Write all that a service keeps to one compressed file.

    Of a server that runs by --url, with an administrator's token; it goes on meanwhile. Of a
    folder otherwise. Hashes of tokens are in the file. Exit code 0: written and read again; 2: a
    server has the folder open, something is wrong with it, or the file is there already; 3: the
    service cannot be reached.
    """
    from symboslam.cli.client import Client
    from symboslam.service.backup import back_up, verify

    if (data is None) == (url is None):
        raise InputError("give the folder of the store, or --url for a server that runs")
    _needs_store()
    target = _target(to)
    with progress_bar() as progress, _beside(target) as new:
        with new.open("xb") as file:
            if url is not None:
                Client(url, token, timeout).save(
                    "/v1/backup", file, lambda n: progress(f"receiving, {n / 1e6:.0f} MB", 0.5)
                )
            elif data is not None:
                back_up(data, file, progress)
            file.flush()
            os.fsync(file.fileno())
        manifest = verify(new, progress)
    show(f"{len(manifest['files'])} files of {manifest['created']} are in {target}")


@app.command("restore")
def restore(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="As store backup has written it.")],
    data: Annotated[
        Path, typer.Option("--data", metavar="DIR", help="Folder to make; empty or not there.")
    ],
) -> None:
    """Make a data folder of a backup.

    All checksums are compared before the folder comes into being. A service that starts on it
    states all maps anew, in the background. Exit code 0: restored; 2: the file is damaged, or the
    folder is not empty; nothing was changed.
    """
    from symboslam.service import backup

    _needs_store()
    with progress_bar() as progress:
        manifest = backup.restore(file, data, progress)
    show(f"{data} is as it was on {manifest['created']}")


@app.command("check", epilog=CHECK_EXAMPLES)
def check(
    data: Annotated[Path, typer.Argument(metavar="DIR", help="Folder that no server has open.")],
    shapes: Annotated[
        bool, typer.Option("--shapes", help="Check each map against our SHACL shapes as well.")
    ] = False,
    repair: Annotated[
        bool, typer.Option("--repair", help="State maps anew from the records where that helps.")
    ] = False,
) -> None:
    """Check what a service keeps: can all of it be read, and does the store say what it should?

    Each map is worked out anew from its records and compared with the store. Exit code 0: all is
    well, or is now; 1: something is wrong, and this says how to mend it; 2: the folder cannot be
    opened.
    """
    import asyncio

    from symboslam.service.checking import check_folder

    _needs_store()
    with progress_bar() as progress:
        report = asyncio.run(check_folder(data, progress, shapes=shapes, repair=repair))
    show(str(report))
    if not report.is_well:
        raise typer.Exit(1)


def _target(to: str) -> Path:
    """The file to write; in a folder it is named after the time.

    Raises:
        OutputError: the folder cannot be made.
        InputError: the file is there already.
    """
    target = Path(to)
    if to.endswith(("/", os.sep)):
        try:
            target.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            problem = error.strerror or error
            raise OutputError(f"the folder {to} cannot be made: {problem}") from error
    if target.is_dir():
        target /= f"symboslam-{datetime.now():%Y%m%d-%H%M%S}.tar.gz"
    _refuse_what_is_there(target)
    return target


def _refuse_what_is_there(target: Path) -> None:
    if os.path.lexists(target):
        raise InputError(f"{target} is there already, and is left as it is: name another file")


@contextmanager
def _beside(target: Path) -> Iterator[Path]:
    """A file that gets another's name when it was read again without an error."""
    new = target.with_name(f".{target.name}.{token_hex(6)}")
    try:
        yield new
        _refuse_what_is_there(target)  # it may have come meanwhile
        new.replace(target)
    except OSError as error:
        raise OutputError(f"{target} cannot be written: {error.strerror or error}") from error
    finally:
        new.unlink(missing_ok=True)


def _needs_store() -> None:
    try:
        import pydantic_settings  # noqa: F401
        import pyoxigraph  # noqa: F401
    except ImportError as error:
        raise MissingExtraError(error.name or "pyoxigraph", "service") from error
