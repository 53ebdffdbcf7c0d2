"""``symboslam query``: ask a service in SPARQL."""

from __future__ import annotations

import json
import sys
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from symboslam.cli.client import URL, Client, Reply, TimeoutOption, TokenOption
from symboslam.cli.common import show, table
from symboslam.errors import InputError

if TYPE_CHECKING:
    from rich.table import Table

EXAMPLES = """
[bold]Examples[/]

symboslam query --example maps

symboslam query 'SELECT * { ?s ?p ?o } LIMIT 5' --format json

symboslam query --file mine.rq --url https://maps.example/town > answer.csv
"""


class Form(StrEnum):
    """What an answer can be written as."""

    table = "table"
    csv = "csv"
    tsv = "tsv"
    json = "json"
    xml = "xml"
    turtle = "turtle"
    ntriples = "ntriples"
    jsonld = "jsonld"
    rdfxml = "rdfxml"


_JSON, _TURTLE = "application/sparql-results+json", "text/turtle"
# What to ask for: a query that gives the other kind of answer still gets one.
_ACCEPT = {
    Form.table: f"{_JSON}, {_TURTLE};q=0.9",
    Form.csv: f"text/csv, {_TURTLE};q=0.9",
    Form.tsv: f"text/tab-separated-values, {_TURTLE};q=0.9",
    Form.json: f"{_JSON}, application/ld+json;q=0.9",
    Form.xml: "application/sparql-results+xml, application/rdf+xml;q=0.9",
    Form.turtle: f"{_TURTLE}, {_JSON};q=0.9",
    Form.ntriples: f"application/n-triples, {_JSON};q=0.9",
    Form.jsonld: f"application/ld+json, {_JSON};q=0.9",
    Form.rdfxml: "application/rdf+xml, application/sparql-results+xml;q=0.9",
}


def query(
    text: Annotated[
        str | None, typer.Argument(metavar="[QUERY]", help="The query; - reads standard input.")
    ] = None,
    file: Annotated[
        Path | None, typer.Option("--file", "-f", metavar="FILE", help="A file with the query.")
    ] = None,
    example: Annotated[
        str | None, typer.Option(metavar="NAME", help="One of the example queries.")
    ] = None,
    list_: Annotated[bool, typer.Option("--list", help="List the example queries.")] = False,
    url: Annotated[
        str, typer.Option(metavar="URL", help="Address of the service.", envvar="SYMBOSLAM_URL")
    ] = URL,
    form: Annotated[
        Form | None,
        typer.Option("--format", help="Of the answer.", show_default="table, or csv in a pipe"),
    ] = None,
    token: TokenOption = None,
    timeout: TimeoutOption = 60.0,
) -> None:
    """Ask a service in SPARQL.

    Exit code 0: answered; 2: the query is wrong or refused; 3: the service cannot be reached or
    has failed.
    """
    if list_:
        _list()
        return
    asked = _query(text, file, example)
    chosen = form or (Form.table if sys.stdout.isatty() else Form.csv)
    headers = {
        "Content-Type": "application/sparql-query; charset=utf-8", "Accept": _ACCEPT[chosen],
    }  # fmt: skip
    reply = Client(url, token, timeout).post("/sparql", asked.encode(), headers)
    if chosen is Form.table and reply.headers.get_content_type() == _JSON:
        _show(json.loads(reply.body))
    else:
        _write(reply)


def _query(text: str | None, file: Path | None, example: str | None) -> str:
    """The text of the query, wherever it comes from."""
    from symboslam.service.examples import get_example

    if [text, file, example].count(None) != 2:
        raise InputError("give one of: a query, --file, --example (--list lists those)")
    if example is not None:
        return get_example(example).query
    try:
        if file is not None:
            return file.read_text("utf-8")
        return sys.stdin.read() if text == "-" else str(text)
    except UnicodeDecodeError as error:
        raise InputError(f"{file or 'the standard input'} is not UTF-8 text") from error
    except OSError as error:
        raise InputError(f"{file} cannot be read: {error.strerror or error}") from error


def _list() -> None:
    from symboslam.service.examples import examples

    found = table("name", "question", "asked by")
    for each in examples():
        found.add_row(each.name, each.title, ", ".join(each.audience))
    show(found)


def _show(answer: dict[str, Any]) -> None:
    if "boolean" in answer:
        show("yes" if answer["boolean"] else "no")
        return
    solutions = answer["results"]["bindings"]
    show(_table(answer["head"]["vars"], solutions))
    show(f"{len(solutions)} answer{'' if len(solutions) == 1 else 's'}", error=True)


def _table(names: list[str], solutions: list[dict[str, Any]]) -> Table:
    from rich.text import Text

    found = table()
    for name in names:
        terms = [s[name] for s in solutions if name in s]
        numbers = terms and all(_is_number(term) for term in terms)
        found.add_column(name, justify="right" if numbers else "left", overflow="fold")
    for solution in solutions:
        found.add_row(*(Text(_words(solution[n])) if n in solution else "" for n in names))
    return found


def _is_number(term: dict[str, str]) -> bool:
    kind = term.get("datatype", "").rpartition("#")[2]
    return kind in ("integer", "decimal", "double", "float")


def _words(term: dict[str, Any]) -> str:
    """A term for people: IRIs short, and nothing that steers a terminal."""
    from symboslam.service.vocabulary import QUERY_PREFIXES

    value = str(term["value"])
    if term["type"] == "uri":
        for prefix, namespace in QUERY_PREFIXES.items():
            rest = value.removeprefix(namespace)
            if rest != value and rest.replace("-", "").replace("_", "").isalnum():
                return f"{prefix}:{rest}"
    return "".join(c if c.isprintable() or c == "\n" else "\ufffd" for c in value)


def _write(reply: Reply) -> None:
    sys.stdout.buffer.write(reply.body)
    if reply.body and not reply.body.endswith(b"\n"):
        sys.stdout.buffer.write(b"\n")
    sys.stdout.buffer.flush()
