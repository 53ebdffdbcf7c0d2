"""``symboslam serve``: the web service."""

from __future__ import annotations

import errno
import socket
import sys
from contextlib import closing, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from symboslam.errors import InputError, MissingExtraError

if TYPE_CHECKING:
    from symboslam.service.settings import Settings

EXAMPLES = """
[bold]Examples[/]

symboslam serve

SYMBOSLAM_ADMIN_TOKEN=$(openssl rand -hex 32) symboslam serve --data /srv/maps --port 8000

symboslam token add robots --scope ingest --data /srv/maps

curl -G localhost:8080/sparql --data-urlencode 'query=SELECT * { ?s ?p ?o } LIMIT 3'
"""


def serve(
    data: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR", help="Folder of the store; made if needed.",
            show_default="symboslam-data, or SYMBOSLAM_DATA",
        ),
    ] = None,
    host: Annotated[str, typer.Option(help="Address to listen at.")] = "127.0.0.1",
    port: Annotated[int, typer.Option(min=0, max=65535, help="0: any that is free.")] = 8080,
    open_: Annotated[bool, typer.Option("--open", help="Open it in a browser.")] = False,
    read_only: Annotated[
        bool, typer.Option("--read-only", help="Let nobody write, whatever their token says.")
    ] = False,
) -> None:  # fmt: skip
    """Serve maps that are fed live, and SPARQL, over HTTP until Ctrl-C.

    Reading is free; writing needs a token: the one in SYMBOSLAM_ADMIN_TOKEN, or one of
    [bold]symboslam token add[/]. Where there is no administrator's token yet, one is made and
    shown, if standard output is a terminal. All settings are in docs/service.md.

    Exit code 0: stopped; 2: the address or the folder is in use, a setting is wrong, or the store
    cannot be reached.
    """
    try:
        import fastapi  # noqa: F401
        import prometheus_client  # noqa: F401
        import pydantic_settings  # noqa: F401
        import uvicorn  # noqa: F401
    except ImportError as error:
        raise MissingExtraError(error.name or "fastapi", "service") from error
    settings = _settings(data, read_only)
    listening = listen(host, port)
    with listening:
        _run(settings, listening, open_)


def _settings(data: Path | None, read_only: bool) -> Settings:
    from pydantic import ValidationError

    from symboslam.service.settings import Settings

    given: dict[str, Any] = {} if data is None else {"data": data}
    if read_only:
        given["read_only"] = True
    try:
        return Settings(**given)
    except ValidationError as error:
        first = error.errors(include_input=False, include_url=False)[0]
        name = "SYMBOSLAM_" + "_".join(str(part) for part in first["loc"]).upper()
        raise InputError(f"{name}: {first['msg']}") from error


def listen(host: str, port: int) -> socket.socket:
    """A socket at an address, not listening yet.

    Raises:
        InputError: it cannot be had.
    """
    try:
        found = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)
    except (socket.gaierror, UnicodeError) as error:
        problem = getattr(error, "strerror", None) or "it is no name of a machine"
        raise InputError(f"--host {host[:80]!r} is no address to listen at: {problem}") from error
    try:
        kind, _, protocol, _, address = found[0]
        # asyncio sends small packets at once only where the socket says that it is TCP.
        listening = socket.socket(kind, socket.SOCK_STREAM, protocol or socket.IPPROTO_TCP)
        listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            listening.bind(address)
        except OSError:
            listening.close()
            raise
    except OSError as error:
        problem = error.strerror or error
        if error.errno == errno.EADDRNOTAVAIL:
            detail = f"--host {host[:80]!r} is no address of this machine: {problem}"
            raise InputError(detail) from error
        raise InputError(
            f"cannot listen at {host}:{port}: {problem}; take another --port"
        ) from error
    return listening


def _run(settings: Settings, listening: socket.socket, open_: bool) -> None:
    import signal

    from rich.console import Console

    from symboslam.service import logs
    from symboslam.service.app import create_app
    from symboslam.service.database import check_database, make_folder
    from symboslam.service.server import Server
    from symboslam.service.store.opening import open_store

    host, port = listening.getsockname()[:2]
    shown = f"[{host}]" if ":" in host else host
    address = settings.public_url or f"http://{shown}:{port}"
    logs.install(settings.log, settings.log_level)
    make_folder(settings.data)
    check_database(settings.data)  # before anything is written
    status = Console(stderr=True).status("starting: opening the store, loading the ontology ...")

    def tell() -> None:
        status.stop()
        _tell(settings, address, open_)

    app = create_app(settings, open_store(settings))
    server = Server(app, settings, tell)
    # uvicorn hands the signal that stopped it on to these; a stop that was asked for is no failure.
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: None)
    with status, suppress(SystemExit):  # uvicorn exits if it does not start
        server.run([listening])
    if not server.started:
        raise getattr(app.state, "failure", None) or RuntimeError("the service did not start")
    print("stopped")


def _tell(settings: Settings, address: str, open_: bool) -> None:
    import webbrowser

    print(f"SymboSLAM serves {settings.store or settings.data}")
    print(f"  query page  {address}/query")
    print(f"  SPARQL      {address}/sparql")
    print(f"  graphs      {address}/graphs")
    print(f"  maps        {address}/v1/maps")
    if settings.read_only:
        print("  read-only")
    elif settings.admin_token is None:
        _tell_about_tokens(settings.data)
    print("Stop with Ctrl-C.", flush=True)
    if open_:
        webbrowser.open(address + "/")


def _tell_about_tokens(data: Path) -> None:
    """Make the first administrator's token where a person sees it, and no log."""
    from symboslam.service.tokens import Tokens

    with closing(Tokens(data)) as tokens:
        if tokens.has_admin():
            return
        if sys.stdout.isatty():
            token, text = tokens.add("first administrator", ["admin"])
            print(f"  the administrator's token, shown this once (id {token.id}):\n  {text}")
        else:
            print("  nobody may write yet: symboslam token add NAME --scope admin")
