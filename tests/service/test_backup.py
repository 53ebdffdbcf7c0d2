"""Backups of a running service and of a folder, what restores them, and what checks them."""

import gzip
import io
import json
import sqlite3
import tarfile
import threading
from collections.abc import Callable
from pathlib import Path
from shutil import copytree
from typing import Any

import httpx
import pytest
from typer.testing import CliRunner

from symboslam.cli.main import app
from symboslam.errors import InputError, OutputError, StoreError
from symboslam.service.backup import back_up, restore, verify
from symboslam.service.checking import differing
from tests.service.conftest import ADMIN, TOKEN, MakeService, Service, running
from tests.service.kept import graphs_of, half_written, same

SIDE = 900.0


def quiet(stage: str, share: float) -> None:
    """Tell nobody."""


def make_map(client: httpx.Client, **options: Any) -> str:
    wanted = {
        "name": "a map", "bbox": [0, 0, SIDE, SIDE], "crs": "m", "segmentation": {"cells": 6},
        **options,
    }  # fmt: skip
    return str(client.post("/v1/maps", json=wanted, headers=ADMIN).raise_for_status().json()["id"])


def observe(client: httpx.Client, which: str, number: int) -> httpx.Response:
    """Send a batch of five landmarks of its own."""
    lines = [
        {"class": kind, "coordinates": [10 + 40 * (number % 20) + 6 * i, 20 + 40 * (number // 20)]}
        for i, kind in enumerate(("House", "Factory", "Tree", "BusStop", "House"))
    ]
    return client.post(
        f"/v1/maps/{which}/observations", content="\n".join(map(json.dumps, lines)),
        headers={**ADMIN, "Content-Type": "application/x-ndjson", "Idempotency-Key": f"b{number}"},
    )  # fmt: skip


def send(client: httpx.Client, which: str, number: int) -> None:
    """The same, which has to be taken."""
    observe(client, which, number).raise_for_status()


def fill(service: Service) -> str:
    """A map with landmarks and an override, and a statement of a user's own; the map's id."""
    which = make_map(service.client)
    for number in range(4):
        send(service.client, which, number)
    segment = service.client.get(f"/v1/maps/{which}/segments").json()["features"][0]
    name = segment["properties"]["segment_id"]
    service.client.put(
        f"/v1/maps/{which}/segments/{name}/override", headers=ADMIN,
        json={"environment": "Industrial", "reason": "It smells."},
    ).raise_for_status()  # fmt: skip
    service.update("INSERT DATA { GRAPH <urn:own> { <urn:a> <urn:b> 7 } }").raise_for_status()
    return which


def symboslam(*arguments: object, **environment: str) -> tuple[int, str]:
    """Exit code and output of the command."""
    result = CliRunner().invoke(app, [str(a) for a in arguments], env=environment)
    if isinstance(result.exception, InputError | OutputError | StoreError):
        return 2, str(result.exception)
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result.exit_code, result.output


def open_again(data: Path, see: Callable[[Service], object]) -> None:
    with running(data=data, admin_token=TOKEN, bundled_ontology=False, workers=1) as service:
        see(service)


def test_there_and_back(tmp_path: Path) -> None:
    said: dict[str, dict[str, set[str]]] = {}

    def first(service: Service) -> None:
        which = fill(service)
        said[which] = graphs_of(service.client, which)

    open_again(tmp_path / "data", first)
    code, text = symboslam("store", "backup", tmp_path / "data", "--to", tmp_path / "b.tar.gz")
    assert code == 0, text
    assert not list((tmp_path / "data" / "backup").iterdir())
    code, text = symboslam("store", "restore", tmp_path / "b.tar.gz", "--data", tmp_path / "new")
    assert code == 0, text

    def second(service: Service) -> None:
        (which,) = said
        assert service.values("SELECT ?o { <urn:a> <urn:b> ?o }") == [["7"]]
        assert len(service.client.get(f"/v1/maps/{which}/overrides").json()) == 1
        assert service.client.get(f"/v1/maps/{which}").json()["batches"] == 4
        send(service.client, which, 0)  # was there, and is not taken again
        assert same(graphs_of(service.client, which), said[which])

    open_again(tmp_path / "new", second)
    assert symboslam("store", "check", tmp_path / "new", "--shapes")[0] == 0


def test_of_a_server_that_takes_batches(make_service: MakeService, tmp_path: Path) -> None:
    """Whatever moment it catches, nothing that was acknowledged before is missing."""
    service = make_service(rate="none")
    maps = [make_map(service.client) for _ in range(2)]
    acknowledged, stop = [0], threading.Event()

    def feed() -> None:
        with httpx.Client(base_url=service.url, timeout=60) as client:
            while not stop.is_set() and acknowledged[0] < 400:
                for which in maps:
                    send(client, which, acknowledged[0])
                acknowledged[0] += 1

    feeding = threading.Thread(target=feed)
    feeding.start()
    try:
        before = []
        for n in range(3):
            while acknowledged[0] < 3 * n + 2:
                assert feeding.is_alive()
            before.append(acknowledged[0])
            code, text = symboslam(
                "store", "backup", "--url", service.url, "--to", tmp_path / f"{n}.gz",
                SYMBOSLAM_TOKEN=TOKEN,
            )  # fmt: skip
            assert code == 0, text
    finally:
        stop.set()
        feeding.join()
    assert not list((tmp_path / "data" / "backup").iterdir())
    for n, least in enumerate(before):
        restore(tmp_path / f"{n}.gz", tmp_path / f"new{n}", quiet)

        def see(service: Service, least: int = least) -> None:
            for which in maps:
                found = service.client.get(f"/v1/maps/{which}").json()["batches"]
                assert least <= found <= acknowledged[0] + 1
                send(service.client, which, 0)  # known; when it is answered, all is stated
                assert half_written(service.client, which) == []
                graph = f"https://w3id.org/symboslam/map/{which}/landmarks"
                kind = "<https://w3id.org/symboslam#Landmark>"
                query = f"SELECT (COUNT(?o) AS ?n) {{ GRAPH <{graph}> {{ ?o a {kind} }} }}"
                assert service.values(query) == [[f"{5 * found}"]]

        open_again(tmp_path / f"new{n}", see)


def test_an_ontology_of_ones_own_comes_along(make_service: MakeService, tmp_path: Path) -> None:
    service = make_service()
    rooms = (Path(__file__).parents[2] / "examples" / "indoor-rooms" / "rooms.ttl").read_bytes()
    service.client.put(
        "/graphs?graph=urn:rooms", content=rooms, headers={**ADMIN, "Content-Type": "text/turtle"}
    ).raise_for_status()
    which = make_map(service.client, ontology="urn:rooms")
    (kept,) = (tmp_path / "data" / "ontologies").iterdir()
    with (
        (tmp_path / "b").open("wb") as file,
        service.client.stream("POST", "/v1/backup", headers=ADMIN) as response,
    ):
        assert response.headers["content-type"] == "application/gzip"
        file.writelines(response.iter_bytes())
    restore(tmp_path / "b", tmp_path / "new", quiet)
    assert (tmp_path / "new" / "ontologies" / kept.name).read_bytes() == kept.read_bytes()

    def see(other: Service) -> None:
        other.client.get(f"/v1/maps/{which}").raise_for_status()

    open_again(tmp_path / "new", see)
    (tmp_path / "new" / "ontologies" / kept.name).write_bytes(b"")
    code, text = symboslam("store", "check", tmp_path / "new")
    assert code == 1
    assert f"{kept.name} is damaged" in text


def test_who_may(make_service: MakeService, tmp_path: Path) -> None:
    service = make_service()
    assert service.client.post("/v1/backup").status_code == 401
    code, text = symboslam("store", "backup", tmp_path / "data", "--to", tmp_path / "b")
    assert code == 2
    assert "--url" in text
    assert not (tmp_path / "b").exists()
    code, text = symboslam("store", "check", tmp_path / "data")
    assert code == 2
    assert "another process" in text


@pytest.fixture(scope="module")
def filled(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a service that was filled; to be copied."""
    folder = tmp_path_factory.mktemp("filled") / "data"
    open_again(folder, fill)
    return folder


def test_a_backup_overwrites_nothing(make_service: MakeService, tmp_path: Path) -> None:
    service = make_service(data=tmp_path / "running")
    open_again(tmp_path / "data", lambda _: None)
    sources: list[list[object]] = [[tmp_path / "data"], ["--url", service.url]]
    for number, what in enumerate(sources):
        folder = tmp_path / f"new{number}" / "deep"
        command = ["store", "backup", *what, "--to"]
        code, text = symboslam(*command, f"{folder}/", SYMBOSLAM_TOKEN=TOKEN)
        assert code == 0, text
        (file,) = folder.iterdir()
        assert file.name.startswith("symboslam-")
        verify(file, quiet)
        before = file.read_bytes()
        code, text = symboslam(*command, file, SYMBOSLAM_TOKEN=TOKEN)
        assert code == 2
        assert f"{file} is there already" in text
        code, text = symboslam(*command, f"{file}/", SYMBOSLAM_TOKEN=TOKEN)
        assert (code, "cannot be made: File exists" in text) == (2, True), text
        assert [each.name for each in folder.iterdir()] == [file.name]
        assert file.read_bytes() == before


def test_a_file_that_came_while_a_backup_was_made(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    open_again(tmp_path / "data", lambda _: None)
    file = tmp_path / "b.tar.gz"

    def came(*arguments: Any) -> Any:
        file.write_text("another's")
        return verify(*arguments)

    monkeypatch.setattr("symboslam.service.backup.verify", came)
    code, text = symboslam("store", "backup", tmp_path / "data", "--to", file)
    assert (code, "is there already" in text) == (2, True), text
    assert file.read_text() == "another's"
    assert sorted(each.name for each in tmp_path.iterdir()) == ["b.tar.gz", "data"]


@pytest.fixture
def data(filled: Path, tmp_path: Path) -> Path:
    """A folder of the test's own with a map and more."""
    return copytree(filled, tmp_path / "data")


@pytest.fixture
def archive(data: Path, tmp_path: Path) -> Path:
    """A backup of a service with a map."""
    file = tmp_path / "b.tar.gz"
    with file.open("wb") as target:
        back_up(data, target, quiet)
    return file


def repacked(file: Path, change: Callable[[str, bytes], tuple[str, bytes] | None]) -> None:
    """Write an archive anew, with other names or content."""
    members = []
    with tarfile.open(file) as tar:
        for member in tar:
            content = tar.extractfile(member)
            assert content is not None
            members.append(change(member.name, content.read()))
    with tarfile.open(file, "w:gz") as tar:
        for found in members:
            if found is not None:
                info = tarfile.TarInfo(found[0])
                info.size = len(found[1])
                tar.addfile(info, io.BytesIO(found[1]))


def cut(file: Path) -> None:
    file.write_bytes(file.read_bytes()[: file.stat().st_size // 2])


def flip(file: Path) -> None:
    def change(name: str, data: bytes) -> tuple[str, bytes]:
        return name, data[:-1] + bytes([data[-1] ^ 1]) if name == "service.sqlite3" else data

    repacked(file, change)


def omit(file: Path) -> None:
    repacked(file, lambda name, data: None if name == "service.sqlite3" else (name, data))


def climb(file: Path) -> None:
    def change(name: str, data: bytes) -> tuple[str, bytes]:
        if name == "manifest.json":
            return name, data.replace(b'"service.sqlite3"', b'"../service.sqlite3"')
        return (f"../{name}" if name == "service.sqlite3" else name), data

    repacked(file, change)


def smuggle(file: Path) -> None:
    def change(name: str, data: bytes) -> tuple[str, bytes]:
        return name if name == "manifest.json" else f"{name}.more", data

    repacked(file, change)


def newer(file: Path) -> None:
    def change(name: str, data: bytes) -> tuple[str, bytes]:
        return name, data.replace(b'"format": 1', b'"format": 2')

    repacked(file, change)


@pytest.mark.parametrize(
    ("damage", "problem"),
    [
        (cut, "no complete backup|damaged"),
        (flip, "checksum of service.sqlite3"),
        (omit, "service.sqlite3 is missing"),
        (climb, r"names '\.\./service"),
        (smuggle, "not as it was written"),
        (newer, "take a newer one"),
        (lambda file: file.write_bytes(b"no archive"), "no complete backup"),
        (lambda file: file.write_bytes(gzip.compress(b"")), "no complete backup|no backup"),
    ],
)
def test_a_damaged_backup_makes_nothing(
    archive: Path, tmp_path: Path, damage: Callable[[Path], None], problem: str
) -> None:
    damage(archive)
    before = sorted(tmp_path.iterdir())
    with pytest.raises(InputError, match=problem):
        restore(archive, tmp_path / "new", quiet)
    with pytest.raises(InputError, match=problem):
        verify(archive, quiet)
    assert sorted(tmp_path.iterdir()) == before


def test_nothing_is_written_over(archive: Path, tmp_path: Path) -> None:
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "mine").write_text("precious")
    with pytest.raises(InputError, match="not empty"):
        restore(archive, tmp_path / "full", quiet)
    assert [path.name for path in (tmp_path / "full").iterdir()] == ["mine"]
    (tmp_path / "empty").mkdir()
    restore(archive, tmp_path / "empty", quiet)
    assert (tmp_path / "empty" / "service.sqlite3").is_file()
    with pytest.raises(InputError, match="no data folder"), (tmp_path / "x").open("wb") as file:
        back_up(tmp_path / "full", file, quiet)


def tamper(data: Path, text: str) -> None:
    """Change the store behind the service's back."""
    import pyoxigraph

    store = pyoxigraph.Store(data / "store")
    store.update("PREFIX sl: <https://w3id.org/symboslam#> " + text)
    store.flush()
    del store


ANY = "?g { ?s ?p ?o }"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (f"DELETE WHERE {{ GRAPH {ANY.replace('?p ?o', 'sl:landmarkCount ?o')} }}", "in segments"),
        (
            "DELETE { GRAPH ?g { ?s sl:probability ?o } } INSERT { GRAPH ?g { ?s sl:probability"
            " 0.123 } } WHERE { GRAPH ?g { ?s sl:probability ?o } }", "in segments",
        ),
        (
            f"DELETE WHERE {{ GRAPH {ANY.replace('?p ?o', 'a sl:Landmark')} }}",
            "statements are missing and 0 too many",
        ),
        ("DROP ALL", "the graph landmarks is missing, the graph segments is missing"),
    ],
)  # fmt: skip
def test_what_the_store_should_not_say(data: Path, text: str, said: str) -> None:
    code, found = symboslam("store", "check", data)
    assert code == 0, found
    tamper(data, text)
    code, found = symboslam("store", "check", data)
    assert code == 1
    assert said in found
    assert "--repair" in found
    code, found = symboslam("store", "check", data, "--repair", "--shapes")
    assert code == 0, found
    assert "repaired: map" in found
    code, found = symboslam("store", "check", data)
    assert code == 0, found


def test_the_last_digit_does_not_count() -> None:
    import pyoxigraph

    def one(value: str) -> set[pyoxigraph.Triple]:
        decimal = pyoxigraph.NamedNode("http://www.w3.org/2001/XMLSchema#decimal")
        node = pyoxigraph.NamedNode("urn:a")
        return {pyoxigraph.Triple(node, node, pyoxigraph.Literal(value, datatype=decimal))}

    assert differing(one("0.5"), one("0.500001")) == (0, 0)
    assert differing(one("0.5"), one("0.5001")) == (1, 1)
    assert differing(one("0.5"), set()) == (1, 0)


def test_a_folder_that_is_none(tmp_path: Path) -> None:
    code, text = symboslam("store", "check", tmp_path)
    assert code == 2
    assert "no data folder" in text
    assert not list(tmp_path.iterdir())


def test_records_that_belong_to_no_map(data: Path) -> None:
    with sqlite3.connect(data / "service.sqlite3") as database:
        database.execute("INSERT INTO name VALUES ('nowhere', 'a', 'b', 'c')")
    database.close()
    code, text = symboslam("store", "check", data)
    assert code == 1
    assert "1 rows belong to no map" in text
