"""What `Store` promises, of both kinds of store: embedded, and elsewhere (a real Fuseki)."""

import asyncio
import csv
import doctest
import gzip
import io
import itertools
import json
from collections.abc import Awaitable, Callable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from typing import Any, TypeVar

import pytest
from pyoxigraph import Literal, NamedNode, Quad, RdfFormat, Triple, parse, serialize

from symboslam.errors import StoreError
from symboslam.service.settings import Settings
from symboslam.service.store import patches
from symboslam.service.store._base import (
    Answer,
    BusyError,
    Document,
    DocumentError,
    Formats,
    MissingGraphError,
    NotAcceptableError,
    Query,
    QueryError,
    ResultLimitError,
    Store,
    TimeLimitError,
)
from symboslam.service.store.opening import open_store
from symboslam.service.store.seed import seed
from symboslam.service.vocabulary import INFERENCES_GRAPH, ONTOLOGY_GRAPH, SOLUTIONS, TRIPLES
from tests.service.fuseki import UNION
from tests.service.test_limits import HOSTILE

T = TypeVar("T")
BASE = "http://example.org/sparql"
JSON = "application/sparql-results+json"
ANY = Formats(JSON, JSON, "application/n-triples")
G, H = "http://example.org/g", "http://example.org/h"
DATA = (
    "INSERT DATA { <urn:d> <urn:p> 0 . GRAPH <http://example.org/g> { <urn:a> <urn:p> 1 }"
    " GRAPH <http://example.org/h> { <urn:b> <urn:p> 2 } }"
)
ALL = "SELECT ?o { { ?s ?p ?o } UNION { GRAPH ?g { ?s ?p ?o } } }"
NOBODY = "http://127.0.0.1:9/nothing"  # the port "discard", at which nobody listens
TURTLE = "text/turtle"


class Case:
    """A started store, and the event loop that it lives in."""

    def __init__(self, runner: "asyncio.Runner", store: Store) -> None:
        self.runner, self.store = runner, store

    def do(self, work: Awaitable[T]) -> T:
        async def wait() -> T:
            return await work

        return self.runner.run(wait())

    def query(self, text: str, formats: Formats = ANY, **given: Any) -> Answer:
        return self.do(self.store.query(Query(text, BASE, formats, **given)))

    def rows(self, text: str, **given: Any) -> list[list[str]]:
        """The values of a query's solutions, sorted."""
        found = json.loads(content(self.query(text, **given)))["results"]["bindings"]
        return sorted([term["value"] for term in row.values()] for row in found)

    def update(self, text: str) -> None:
        self.do(self.store.update(text, BASE))

    def put(self, graph: str | None, *texts: str) -> bool:
        documents = [Document(TURTLE, text.encode(), graph or BASE) for text in texts]
        return self.do(self.store.replace_graph(graph, documents))

    def add(self, graph: str | None, *texts: str) -> bool:
        documents = [Document(TURTLE, text.encode(), graph or BASE) for text in texts]
        return self.do(self.store.add_to_graph(graph, documents))

    def patch(self, removed: str, added: str) -> None:
        self.do(self.store.patch(removed, added))


def content(answer: Answer) -> bytes:
    """The body of an answer, whose size is as it says."""
    if isinstance(answer.body, bytes):
        data = answer.body
    else:
        with answer.body as file:
            data = file.read()
    assert len(data) == answer.size
    return gzip.decompress(data) if answer.gzipped else data


WITHOUT_GRAPH_STORE = "remote, by queries and updates only"
every_way = pytest.mark.parametrize(
    "settings", ["embedded", "remote", WITHOUT_GRAPH_STORE], indirect=True
)


@pytest.fixture(scope="module", params=["embedded", "remote"])
def settings(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory
) -> dict[str, Any]:
    """Settings of a store."""
    given: dict[str, Any] = {"data": tmp_path_factory.mktemp("store"), "workers": 2}
    if request.param != "embedded":
        url = request.getfixturevalue("fuseki_url")
        if request.param == WITHOUT_GRAPH_STORE:
            url = url.replace("/sparql", "/query")
        given |= {"store": url, "store_union_graphs": UNION}
    return given


@contextmanager
def started(settings: dict[str, Any]) -> Iterator[Case]:
    with asyncio.Runner() as runner:
        store = open_store(Settings(**settings))
        case = Case(runner, store)
        assert not store.ready
        case.do(store.start())
        assert store.ready
        try:
            yield case
        finally:
            case.do(store.stop())
            assert not store.ready


@pytest.fixture(scope="module")
def shared(settings: dict[str, Any]) -> Iterator[Case]:
    with started(settings) as case:
        yield case


@pytest.fixture
def case(shared: Case) -> Case:
    """The shared store, emptied."""
    shared.update("DROP ALL")
    return shared


@pytest.fixture
def make(settings: dict[str, Any], tmp_path: Path) -> Iterator[Callable[..., Case]]:
    """Starts a store with further settings, one at a time."""
    with ExitStack() as stack:

        def start(**given: Any) -> Case:
            limited = {**settings, "data": tmp_path / "data", **given}
            case = stack.enter_context(started(limited))
            case.update("DROP ALL")
            return case

        yield start


# Queries


@pytest.mark.parametrize("media_type", SOLUTIONS)
def test_tables(case: Case, media_type: str) -> None:
    case.update(DATA)
    text = "SELECT ?o { GRAPH ?g { ?s ?p ?o } } ORDER BY ?o"
    answer = case.query(text, Formats(media_type, media_type, None))
    assert answer.media_type == media_type
    body = content(answer).decode()
    if SOLUTIONS[media_type] == "JSON":
        assert [b["o"]["value"] for b in json.loads(body)["results"]["bindings"]] == ["1", "2"]
    elif SOLUTIONS[media_type] == "CSV":
        assert list(csv.reader(io.StringIO(body))) == [["o"], ["1"], ["2"]]
    elif SOLUTIONS[media_type] == "TSV":
        assert body.split() == ["?o", "1", "2"]
    else:
        assert "sparql-results#" in body
        assert body.count("</literal>") == 2


@pytest.mark.parametrize("media_type", [m for m in SOLUTIONS if SOLUTIONS[m] in ("JSON", "XML")])
def test_true_or_false(case: Case, media_type: str) -> None:
    answer = case.query("ASK { ?s ?p ?o }", Formats(media_type, media_type, None))
    assert answer.media_type == media_type
    body = content(answer)
    if SOLUTIONS[media_type] == "JSON":
        assert json.loads(body)["boolean"] is False
    else:
        assert b"<boolean>false</boolean>" in body


@every_way
@pytest.mark.parametrize("media_type", TRIPLES)
def test_graphs_as_results(case: Case, media_type: str) -> None:
    case.put(G, "<urn:a> <http://example.org/p> 'größer'@de .")
    predicate = NamedNode("http://example.org/p")
    expected = Triple(NamedNode("urn:a"), predicate, Literal("größer", language="de"))
    construct = "CONSTRUCT { ?s ?p ?o } { GRAPH ?g { ?s ?p ?o } }"
    answers = [
        case.query(construct, Formats(None, None, media_type)),
        case.query("DESCRIBE ?s { GRAPH ?g { ?s ?p ?o } }", Formats(JSON, JSON, media_type)),
        case.do(case.store.read_graph(G, media_type, False)),
    ]
    for answer in answers:
        assert answer.media_type == media_type
        rdf_format = getattr(RdfFormat, TRIPLES[media_type])
        assert [quad.triple for quad in parse(content(answer), rdf_format)] == [expected]


@pytest.mark.parametrize(
    ("text", "formats"),
    [
        ("SELECT * { ?s ?p ?o }", Formats(None, None, TURTLE)),
        ("ASK {}", Formats(None, None, TURTLE)),
        ("ASK {}", Formats(None, None, None)),
        ("CONSTRUCT WHERE { ?s ?p ?o }", Formats("text/csv", "text/csv", None)),
    ],
)
def test_not_acceptable(case: Case, text: str, formats: Formats) -> None:
    with pytest.raises(NotAcceptableError):
        case.query(text, formats)


def test_relative_iris(case: Case) -> None:
    case.update("INSERT DATA { <a> <urn:p> <> }")
    assert case.rows("SELECT ?s ?o { ?s ?p ?o }") == [["http://example.org/a", BASE]]
    assert case.rows("SELECT ?o { <a> ?p ?o }") == [[BASE]]
    assert case.rows("BASE <urn:x:> SELECT ?o { <http://example.org/a> ?p ?o }") == [[BASE]]


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("SELECT * {\n ?s ?p ?o ", 2),
        ("SELECT * { ?s ?p ,, }", 1),
        ("ASK {}\n\nASK {}", 3),
        ("SELECT * { ?s nowhere:p ?o }", None),
        ("", None),
    ],
)
def test_malformed_queries(case: Case, text: str, line: int | None) -> None:
    with pytest.raises(QueryError) as caught:
        case.query(text)
    said = str(caught.value)
    assert 0 < len(said) < 400
    assert "\n" not in said
    assert "BASE" not in said
    if line is not None:
        assert caught.value.line == line
        assert caught.value.column is not None


@pytest.mark.parametrize("text", ["INSERT DATA {\n <urn:a> <urn:b> }", "SELECT * {}", "DROP x"])
def test_malformed_updates(case: Case, text: str) -> None:
    with pytest.raises(QueryError) as caught:
        case.update(text)
    assert "\n" not in str(caught.value)
    assert caught.value.line == text.count("\n") + 1


@every_way
def test_results_that_are_not_small(case: Case) -> None:
    case.put(G, *(f"<urn:s{i}> <urn:p> '{'x' * 400}' ." for i in range(1000)))
    text = "SELECT ?s ?o { GRAPH ?g { ?s ?p ?o } }"
    for zipped in (False, True):
        answer = case.query(text, gzip=zipped)
        assert answer.gzipped is zipped
        assert isinstance(answer.body, bytes) is zipped  # which is small again
        assert len(json.loads(content(answer))["results"]["bindings"]) == 1000
    answer = case.do(case.store.read_graph(G, "application/n-triples", True))
    assert answer.gzipped
    assert content(answer).count(b"\n") == 1000


# Which graphs a query sees


def test_the_union_of_all_graphs(case: Case) -> None:
    case.update(DATA)
    assert case.rows("SELECT ?o { ?s ?p ?o }") == [["0"], ["1"], ["2"]]
    both = "SELECT ?o ?g { ?s ?p ?o GRAPH ?g { ?s ?p ?o } }"
    assert case.rows(both) == [["1", G], ["2", H]]


def test_a_dataset_of_the_query(case: Case) -> None:
    case.update(DATA)
    assert case.rows(f"SELECT ?o FROM <{G}> {{ ?s ?p ?o }}", has_dataset=True) == [["1"]]
    named = f"SELECT ?o FROM NAMED <{H}> {{ GRAPH ?g {{ ?s ?p ?o }} }}"
    assert case.rows(named, has_dataset=True) == [["2"]]


def test_a_dataset_of_the_request(case: Case) -> None:
    case.update(DATA)
    assert case.rows("SELECT ?o { ?s ?p ?o }", default_graphs=(G, H)) == [["1"], ["2"]]
    assert case.rows(ALL, default_graphs=(G,)) == [["1"]]
    assert case.rows(ALL, named_graphs=(H,)) == [["2"]]
    text = f"SELECT ?o FROM <{G}> {{ ?s ?p ?o }}"
    assert case.rows(text, has_dataset=True, default_graphs=(H,)) == [["2"]]


def test_without_union(make: Callable[..., Case]) -> None:
    case = make(union_default_graph=False)
    case.update(DATA)
    assert case.rows("SELECT ?o { ?s ?p ?o }") == [["0"]]
    assert case.rows(ALL) == [["0"], ["1"], ["2"]]


# Updates


def test_an_update_is_carried_out_in_full_or_not_at_all(case: Case) -> None:
    for wrong in (f"LOAD <{NOBODY}>", "INSERT DATA { <urn:a> <urn:b> }"):
        with pytest.raises(StoreError):
            case.update(f"INSERT DATA {{ <urn:a> <urn:b> 1 }} ; {wrong}")
        assert case.rows(ALL) == []


def test_the_patterns_of_an_update_see_the_default_graph(case: Case) -> None:
    case.update(DATA)
    case.update("DELETE WHERE { ?s ?p ?o }")
    assert case.rows("SELECT ?o { ?s ?p ?o }") == [["1"], ["2"]]


def test_the_version_changes_with_every_write(case: Case) -> None:
    if case.store.version is None:  # others may write
        assert "store" in Settings.model_fields
        return
    line = f"<urn:a> <urn:b> <urn:c> <{G}> ."
    seen = {case.store.version}
    for write in (
        lambda: case.update(DATA), lambda: case.patch("", line), lambda: case.put(G, ""),
        lambda: case.add(G, "<urn:a> <urn:b> 1 ."), lambda: case.do(case.store.drop_graph(G)),
    ):  # fmt: skip
        write()
        assert case.store.version not in seen
        seen.add(case.store.version)
    case.query("ASK {}")
    case.patch(line, line)
    assert case.store.version in seen


# Whole graphs


@every_way
@pytest.mark.parametrize("graph", [G, None])
def test_replace_add_and_drop(case: Case, graph: str | None) -> None:
    where = "SELECT ?o { ?s ?p ?o }"

    def held() -> list[list[str]]:
        return case.rows(where, default_graphs=(graph,)) if graph else case.rows(where)

    assert case.put(graph, "<urn:a> <urn:p> 1 .") is (graph is not None)
    assert case.put(graph, "<urn:a> <urn:p> 2 .", "<urn:a> <urn:p> 3 .") is False
    assert held() == [["2"], ["3"]]
    assert case.add(graph, "<urn:a> <urn:p> 3, 4 .") is False
    assert held() == [["2"], ["3"], ["4"]]
    case.do(case.store.drop_graph(graph))
    assert held() == []
    assert case.do(case.store.has_graph(graph)) is (graph is None)
    assert case.add(graph, "<urn:a> <urn:p> 5 .") is (graph is not None)
    assert held() == [["5"]]
    case.put(graph, "")
    assert held() == []


@every_way
def test_other_graphs_are_left_alone(case: Case) -> None:
    case.update(DATA)
    case.put(G, "<urn:a> <urn:p> 9 .")
    case.do(case.store.drop_graph(None))
    assert case.rows(ALL) == [["2"], ["2"], ["9"], ["9"]]
    case.do(case.store.drop_graph(H))
    assert case.rows(ALL) == [["9"], ["9"]]


@every_way
def test_a_graph_that_does_not_parse_leaves_the_graph(case: Case) -> None:
    case.put(G, "<urn:a> <urn:p> 1 .")
    for change in (case.put, case.add):
        with pytest.raises(DocumentError) as caught:
            change(G, "<urn:a> <urn:p> 2 .", "<urn:a> <urn:p> 3 .\n<urn:a> ,")
        assert caught.value.line == 2
        with pytest.raises(DocumentError):
            change(H, "nonsense")
    assert case.rows("SELECT ?g ?o { GRAPH ?g { ?s ?p ?o } }") == [[G, "1"]]


@every_way
def test_blank_nodes_of_documents_are_distinct(case: Case) -> None:
    case.put(G, "_:x <urn:p> 1 .", "_:x <urn:q> 1 .")
    case.add(G, "_:x <urn:r> _:x .")
    assert len(case.rows("SELECT DISTINCT ?s { GRAPH ?g { ?s ?p ?o } }")) == 3
    assert len(case.rows("SELECT ?s { GRAPH ?g { ?s ?p ?s } }")) == 1


def test_several_graphs_at_once(case: Case) -> None:
    case.update(DATA)
    good = Document(TURTLE, b"<a> <urn:p> 7 .", BASE)
    with pytest.raises(DocumentError):
        case.do(case.store.replace_graphs({G: good, H: Document(TURTLE, b"<a> <urn:p>", BASE)}))
    query = "SELECT ?o { GRAPH ?g { ?s ?p ?o } }"
    assert sorted(case.rows(query)) == [["1"], ["2"]]
    empty = Document(TURTLE, b"", BASE)
    case.do(case.store.replace_graphs({G: good, H: empty, f"{H}2": good}))
    assert sorted(case.rows(query)) == [["7"], ["7"]]


@every_way
def test_graphs_that_are_not_there(case: Case) -> None:
    assert case.do(case.store.has_graph(G)) is False
    assert case.do(case.store.has_graph(None)) is True
    with pytest.raises(MissingGraphError):
        case.do(case.store.drop_graph(G))
    with pytest.raises(MissingGraphError):
        case.do(case.store.read_graph(G, TURTLE, False))
    assert content(case.do(case.store.read_graph(None, "application/n-triples", False))) == b""


def test_names_of_graphs(case: Case) -> None:
    assert case.do(case.store.graph_names(10)) == []
    for graph in (H, G, "urn:größe"):
        case.put(graph, "<urn:a> <urn:p> 1 .")
    assert case.do(case.store.graph_names(10)) == [G, H, "urn:größe"]
    assert len(case.do(case.store.graph_names(2))) == 2


# Patches


def lines(count: int, value: str, graph: str = G) -> str:
    return "".join(f'<urn:s{i}> <urn:p> "{value} {i}" <{graph}> .\n' for i in range(count))


def test_a_patch(case: Case) -> None:
    case.patch("", lines(3, "old") + lines(1, "other", H))
    case.patch(lines(2, "old") + lines(1, "other", H), lines(1, "old") + lines(1, "new", H))
    expected = [[G, "old 0"], [G, "old 2"], [H, "new 0"]]
    assert case.rows("SELECT ?g ?o { GRAPH ?g { ?s ?p ?o } }") == expected
    for _ in range(2):  # what is there already, and what is not there
        case.patch(lines(2, "old").split("\n")[1] + "\n", lines(1, "new", H))
        assert case.rows("SELECT ?g ?o { GRAPH ?g { ?s ?p ?o } }") == expected
    case.patch("", "")
    assert case.rows("SELECT ?g ?o { GRAPH ?g { ?s ?p ?o } }") == expected


@pytest.mark.parametrize(
    "line",
    [
        "<urn:a> <urn:b> <urn:c> .", '<urn:a> <urn:b> "c" .', "nonsense", "<urn:a> <urn:b> .",
        f"<urn:a> <urn:b> }} }} ; DROP ALL <{G}> .",
    ],
)  # fmt: skip
@pytest.mark.parametrize("removed", [False, True])
def test_a_patch_with_a_line_that_is_none(case: Case, line: str, removed: bool) -> None:
    case.update(DATA)
    good = f"<urn:a> <urn:p> <urn:good> <{G}> .\n"
    with pytest.raises(QueryError):
        case.patch(line if removed else "", good + ("" if removed else line))
    assert case.rows("SELECT ?o { ?s ?p ?o }") == [["0"], ["1"], ["2"]]


TEXTS = [
    "größer 🤖 ‮", 'a "quoted" \\ text', "two\nlines\r\n\ttab", "} } ; DROP ALL #", "'''", '"""',
    "\\u0022", "\\n", "\x01\x7f", "\u2028 \x85 \x0b", "", " <urn:a> <urn:g> .", "_:b", "$1 ?x",
]  # fmt: skip


@every_way
def test_texts_of_every_kind(case: Case) -> None:
    """Whatever a robot reads somewhere stays text, by every way in and out."""
    graph, named = NamedNode(G), NamedNode("urn:größe#ü")
    terms = [Literal(text) for text in TEXTS] + [Literal("größer", language="de")]
    quads = [Quad(named, NamedNode("urn:p"), term, graph) for term in terms]
    sent = (serialize(quads, format=RdfFormat.N_QUADS) or b"").decode()
    triples = serialize([quad.triple for quad in quads], format=RdfFormat.N_TRIPLES) or b""

    def held() -> set[Triple]:
        answer = case.do(case.store.read_graph(G, "application/n-triples", False))
        return {quad.triple for quad in parse(content(answer), RdfFormat.N_TRIPLES)}

    expected = {quad.triple for quad in quads}
    case.patch("", sent)
    assert held() == expected
    assert case.rows("SELECT ?o { GRAPH ?g { ?s ?p ?o } }") == sorted(
        [term.value] for term in terms
    )
    case.patch(sent, "")
    assert case.do(case.store.graph_names(9)) in ([], [G])
    assert case.rows(ALL) == []
    case.do(case.store.replace_graph(G, [Document("application/n-triples", triples, G)]))
    assert held() == expected


def test_a_large_patch(case: Case) -> None:
    count = 5000
    case.patch("", lines(count, "old"))
    case.patch(lines(count, "old"), lines(count, "new"))
    text = "SELECT (COUNT(*) AS ?n) (MIN(?o) AS ?least) { GRAPH ?g { ?s ?p ?o } }"
    assert case.rows(text) == [[str(count), "new 0"]]


def test_readers_see_a_patch_whole(case: Case) -> None:
    """While somebody writes, readers see the state before or after, never one in between."""
    count, enough = 200, 10
    text = "SELECT (COUNT(*) AS ?n) (MIN(?v) AS ?a) (MAX(?v) AS ?b) { GRAPH ?g { ?s ?p ?v } }"

    def values(number: int) -> str:
        return "".join(f'<urn:s{i}> <urn:p> "{number:06}" <{G}> .\n' for i in range(count))

    case.patch("", values(0))

    async def both() -> tuple[int, list[tuple[str, ...]]]:
        seen: list[tuple[str, ...]] = []

        async def read() -> None:
            while len(seen) < enough:
                answer = await case.store.query(Query(text, BASE, ANY))
                (row,) = json.loads(content(answer))["results"]["bindings"]
                seen.append(tuple(term["value"] for term in row.values()))

        readers = [asyncio.create_task(read()) for _ in range(2)]
        rounds = 0
        while len(seen) < enough:
            await case.store.patch(values(rounds), values(rounds + 1))
            rounds += 1
        await asyncio.gather(*readers)
        return rounds, seen

    rounds, seen = case.do(both())
    for number, least, most in seen:
        assert (number, least) == (str(count), most)
    assert len({most for _, _, most in seen}) > 1, "they read all at the same time"
    assert case.rows(text) == [[str(count), f"{rounds:06}", f"{rounds:06}"]]


def test_writers_do_not_mind_each_other(case: Case) -> None:
    async def write() -> None:
        work = (
            case.store.update(f"INSERT DATA {{ GRAPH <{G}> {{ <urn:a> <urn:p> {i} }} }}", BASE)
            for i in range(10)
        )
        patches = (case.store.patch("", lines(1, f"patch {i}")) for i in range(10))
        await asyncio.gather(*itertools.chain(work, patches))

    case.do(write())
    assert len(case.rows("SELECT ?o { GRAPH ?g { ?s ?p ?o } }")) == 20


# Limits

SLOW = "SELECT (COUNT(*) AS ?n) { GRAPH ?g { ?a ?b ?c . ?d ?e ?f . ?h ?i ?j FILTER (?c < ?f) } }"


def test_a_slow_query_is_stopped(make: Callable[..., Case]) -> None:
    case = make(query_seconds=0.5, workers=1, quick_workers=0)
    case.patch("", lines(3000, "x"))
    with pytest.raises(TimeLimitError):
        case.query(SLOW)
    assert case.rows("SELECT (1 AS ?x) {}") == [["1"]]
    assert case.store.ready


def test_a_slow_query_that_nobody_waits_for(make: Callable[..., Case]) -> None:
    case = make(query_seconds=1000, workers=1, quick_workers=0, queue_length=0)
    case.patch("", lines(3000, "x"))

    async def leave() -> None:
        slow = asyncio.create_task(case.store.query(Query(SLOW, BASE, ANY)))
        await asyncio.sleep(0.3)
        with pytest.raises(BusyError):
            await case.store.query(Query("ASK {}", BASE, ANY))
        slow.cancel()
        with suppress(asyncio.CancelledError):
            await slow

    case.do(leave())
    for _ in range(200):  # until another worker is there
        with suppress(BusyError):
            assert case.rows("SELECT (1 AS ?x) {}") == [["1"]]
            break
        case.do(asyncio.sleep(0.05))
    else:
        pytest.fail("nobody answers any more")


def test_nobody_waits_for_ever(make: Callable[..., Case]) -> None:
    case = make(query_seconds=2, workers=1, quick_workers=0, queue_length=5, queue_seconds=0.1)
    case.patch("", lines(3000, "x"))

    async def wait() -> None:
        slow = asyncio.create_task(case.store.query(Query(SLOW, BASE, ANY)))
        await asyncio.sleep(0.3)
        with pytest.raises(BusyError):
            await case.store.query(Query("ASK {}", BASE, ANY))
        with pytest.raises(TimeLimitError):
            await slow

    case.do(wait())


def test_a_result_that_is_too_large(make: Callable[..., Case]) -> None:
    case = make(max_result_bytes=20_000)
    case.patch("", lines(1000, "x"))
    for zipped in (False, True):
        with pytest.raises(ResultLimitError):
            case.query("SELECT * { GRAPH ?g { ?s ?p ?o } }", gzip=zipped)
        with pytest.raises(ResultLimitError):
            case.do(case.store.read_graph(G, TURTLE, zipped))
    assert len(case.rows("SELECT ?s { GRAPH ?g { ?s ?p ?o } } LIMIT 10")) == 10


@pytest.mark.parametrize(
    "name", [n for n in HOSTILE if n not in ("regex", "repetition", "replacement")]
)
def test_hostile_queries(case: Case, name: str) -> None:
    with suppress(StoreError):
        content(case.query(HOSTILE[name]))
    assert case.rows("SELECT (1 AS ?x) {}") == [["1"]]


# The rest


def test_a_stopped_store_answers_nothing(settings: dict[str, Any], tmp_path: Path) -> None:
    with started({**settings, "data": tmp_path}) as case:
        case.do(case.store.stop())
        with pytest.raises(StoreError):
            case.update("CLEAR DEFAULT")
        with pytest.raises(StoreError):
            case.do(case.store.graph_names(1))


def test_the_ontology_is_put_there_once(case: Case) -> None:
    count = f"SELECT (COUNT(*) AS ?n) {{ GRAPH <{INFERENCES_GRAPH}> {{ ?s ?p ?o }} }}"
    assert [case.do(seed(case.store)) for _ in range(2)] == [True, False]
    before = case.rows(count)
    for harm in (
        f"DROP GRAPH <{ONTOLOGY_GRAPH}>",
        f"DELETE {{ GRAPH ?g {{ ?s ?p ?o }} }} INSERT {{ GRAPH ?g {{ ?s ?p 'sha256 0' }} }} WHERE"
        f" {{ VALUES ?g {{ <{INFERENCES_GRAPH}> }} GRAPH ?g {{ ?g ?p ?o BIND (?g AS ?s) }} }}",
    ):  # fmt: skip
        case.update(harm)
        assert [case.do(seed(case.store)) for _ in range(2)] == [True, False], harm
    assert case.rows(count) == before


@pytest.mark.parametrize("settings", ["embedded"], indirect=True)
def test_geosparql(case: Case) -> None:
    """Distances in metres and containment, which the embedded store has."""
    text = """
    PREFIX geo: <http://www.opengis.net/ont/geosparql#>
    PREFIX geof: <http://www.opengis.net/def/function/geosparql/>
    PREFIX uom: <http://www.opengis.net/def/uom/OGC/1.0/>
    SELECT ?within ?far {
      BIND (geof:sfWithin("POINT(1 1)"^^geo:wktLiteral,
            "POLYGON((0 0, 2 0, 2 2, 0 2, 0 0))"^^geo:wktLiteral) AS ?within)
      BIND (geof:distance("POINT(0 0)"^^geo:wktLiteral, "POINT(0 1)"^^geo:wktLiteral, uom:metre)
            > 110000 AS ?far)
    }"""
    assert case.rows(text) == [["true", "true"]]


def test_docstrings() -> None:
    from symboslam.service.store import endpoint, remote

    for module in (patches, endpoint, remote):
        done = doctest.testmod(module)
        assert done.attempted > 0
        assert done.failed == 0
