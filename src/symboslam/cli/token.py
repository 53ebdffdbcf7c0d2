"""``symboslam token``: who may use the service, whether it runs or not."""

from __future__ import annotations

import re
import sys
from contextlib import closing
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Annotated

import typer

from symboslam.cli.common import show, table
from symboslam.errors import InputError

app = typer.Typer(no_args_is_help=True, help="Tokens: who may use the service for what.")

ADD_EXAMPLES = """
[bold]Examples[/]

symboslam token add robots --scope ingest --data /srv/maps

symboslam token add alice --scope query --scope update --expires 90d
"""
_SPAN = re.compile(r"([1-9]\d{0,4})([dh])")

DataOption = Annotated[
    Path,
    typer.Option(metavar="DIR", envvar="SYMBOSLAM_DATA", help="Folder of the store."),
]
DEFAULT_DATA = Path("symboslam-data")


@app.command("add", epilog=ADD_EXAMPLES)
def add(
    name: Annotated[str, typer.Argument(help="Whose it is, or what for.")],
    scope: Annotated[
        list[str],
        typer.Option(help="query, ingest, update or admin, which brings all others with it."),
    ],
    expires: Annotated[
        str | None,
        typer.Option(
            metavar="WHEN", help="90d, 12h or a time such as 2027-01-31.", show_default="never"
        ),
    ] = None,
    data: DataOption = DEFAULT_DATA,
) -> None:
    """Make a token and print it, this once.

    A service that runs knows it at once. Exit code 2: a scope or a time is wrong.
    """
    from symboslam.service.tokens import Tokens

    end = None if expires is None else _time(expires)
    with closing(Tokens(data)) as tokens:
        token, text = tokens.add(name, scope, end)
    show(f"token {token.id} for {name}; it is not shown again:", error=True)
    sys.stdout.write(text + "\n")


@app.command("list")
def list_(data: DataOption = DEFAULT_DATA) -> None:
    """List all tokens, without their secrets."""
    from symboslam.service.tokens import SCOPES, Tokens

    with closing(Tokens(data)) as tokens:
        found = tokens.all()
    rows = table("id", "name", "scopes", "created", "expires", "last used")
    for token in found:
        scopes = " ".join(scope for scope in SCOPES if scope in token.scopes)
        expires = "expired" if token.is_expired else _shown(token.expires)
        rows.add_row(
            token.id, token.name, scopes, _shown(token.created), expires, _shown(token.last_used)
        )
    show(rows if found else f"there are no tokens in {data}")


@app.command("revoke")
def revoke(
    identifier: Annotated[str, typer.Argument(metavar="ID", help="As in the list.")],
    data: DataOption = DEFAULT_DATA,
) -> None:
    """Make a token useless at once."""
    from symboslam.service.tokens import Tokens

    with closing(Tokens(data)) as tokens:
        if not tokens.remove(identifier):
            raise InputError(
                f"there is no token {identifier!r} in {data}; see symboslam token list"
            )
    show(f"revoked {identifier}")


def _time(text: str) -> datetime:
    if match := _SPAN.fullmatch(text):
        return datetime.now(UTC) + timedelta(hours=int(match[1]) * (24 if match[2] == "d" else 1))
    try:
        found = datetime.fromisoformat(text)
    except ValueError:
        raise InputError(
            f"--expires {text!r}: give 90d, 12h or a time such as 2027-01-31"
        ) from None
    return found if found.tzinfo else found.astimezone()


def _shown(moment: datetime | None) -> str:
    return f"{moment.astimezone():%Y-%m-%d %H:%M}" if moment else "never"
