"""A full disk, and folders that are damaged: told, nothing lost, nothing written over."""

import os
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import httpx
import pytest

from tests.service.conftest import ADMIN, TOKEN, UPDATE, MakeService, Service, running
from tests.service.kept import half_written
from tests.service.test_backup import make_map, observe, open_again, send, symboslam


@pytest.fixture
def small_disk(tmp_path: Path) -> Iterator[Path]:
    """A disk of its own; skips where none can be mounted."""
    folder = tmp_path / "disk"
    folder.mkdir()
    command = ["mount", "-t", "tmpfs", "-o", "size=24m", "tmpfs", str(folder)]
    try:
        done = subprocess.run(command, check=False, capture_output=True, text=True)
    except FileNotFoundError:
        pytest.skip("there is no mount")
    if done.returncode:
        pytest.skip(f"nothing can be mounted here: {done.stderr.strip()}")
    try:
        yield folder
    finally:
        subprocess.run(["umount", "--lazy", str(folder)], check=True)


def fill_up(folder: Path) -> Path:
    """A file that takes all room that is left."""
    file = folder / "ballast"
    with file.open("wb", buffering=0) as target:
        for size in (1 << 20, 1 << 12, 1):
            try:
                while True:
                    target.write(bytes(size))
            except OSError:
                pass
    return file


def refused(response: httpx.Response) -> bool:
    """Whether a write got the answer that it must get on a full disk; else it was done."""
    if response.is_success:
        return False
    assert response.status_code == 503, response.text
    assert response.headers["content-type"] == "application/problem+json"
    assert "Retry-After" in response.headers
    return True


def insert(service: Service, number: int) -> httpx.Response:
    text = "x" * 2000
    return service.client.post(
        "/sparql", headers=UPDATE,
        content=f"INSERT DATA {{ GRAPH <urn:log> {{ <urn:a> <urn:n> {number} ; <urn:t{number}> "
        f"'{text}{number}' }} }}",
    )  # fmt: skip


def inserted(service: Service) -> set[int]:
    rows = service.values("SELECT (STR(?n) AS ?t) { GRAPH <urn:log> { <urn:a> <urn:n> ?n } }")
    return {int(row[0]) for row in rows}


def ready_again(service: Service) -> None:
    """Wait until the service says that it is ready; the test's time limit ends this."""
    while service.client.get("/readyz").status_code != 200:
        time.sleep(0.05)


def test_a_full_disk(small_disk: Path) -> None:
    data = small_disk / "data"
    settings = {"data": data, "admin_token": TOKEN, "bundled_ontology": False, "workers": 1}
    with running(**settings, rate="none") as service:
        which = make_map(service.client)
        for number in range(10):
            send(service.client, which, number)
            assert insert(service, number).is_success
        for more in range(2):
            ballast = fill_up(small_disk)
            first = 10 + 100 * more
            took, told = set(range(10 if not more else 0)), []
            for number in range(first, first + 100):
                if refused(insert(service, number)):
                    told.append(number)
                else:
                    took.add(number)
            assert told, "the disk never became full"
            assert refused(observe(service.client, which, first))
            response = service.client.get("/readyz")
            assert response.status_code == 503
            assert "No space left" in response.json()["detail"]
            assert service.client.get("/healthz").status_code == 200
            query = service.ask("ASK { GRAPH <urn:log> { ?s ?p ?o } }")
            assert query.status_code == 200 or refused(query)
            ballast.unlink()
            ready_again(service)
            assert took <= inserted(service)
            assert not set(told) & inserted(service)
            send(service.client, which, first)
            assert half_written(service.client, which) == []
        found = service.client.get(f"/v1/maps/{which}").json()
        assert (found["batches"], found["landmarks"]) == (12, 60)
    assert symboslam("store", "check", data)[0] == 0


def test_records_on_a_full_disk(small_disk: Path, tmp_path: Path) -> None:
    """The store has room; the records, elsewhere, have not."""
    data = tmp_path / "data"
    data.mkdir()
    database = small_disk / "service.sqlite3"
    (data / "service.sqlite3").symlink_to(database)
    with running(
        data=data, admin_token=TOKEN, bundled_ontology=False, workers=1, rate="none"
    ) as service:
        which = make_map(service.client)
        send(service.client, which, 0)
        ballast = fill_up(small_disk)
        number = 1
        while not refused(observe(service.client, which, number)):
            number += 1
        assert refused(service.client.post("/v1/maps", headers=ADMIN, json={
            "name": "m", "bbox": [0, 0, 1, 1], "crs": "m", "reasons": 5,
        }))  # fmt: skip
        ballast.unlink()
        send(service.client, which, number)
        assert service.client.get(f"/v1/maps/{which}").json()["batches"] == number + 1
        assert half_written(service.client, which) == []


def test_a_backup_for_which_there_is_no_room(small_disk: Path, tmp_path: Path) -> None:
    def fill(service: Service) -> None:
        send(service.client, make_map(service.client), 0)

    open_again(tmp_path / "data", fill)
    fill_up(small_disk)
    result = subprocess.run(
        [sys.executable, "-m", "symboslam", "store", "backup", tmp_path / "data", "--to",
         small_disk], check=False, text=True, capture_output=True,
    )  # fmt: skip
    assert result.returncode == 2
    assert "No space left" in result.stderr
    assert [path.name for path in small_disk.iterdir()] == ["ballast"]


def largest(folder: Path, pattern: str) -> Path:
    return max(folder.glob(pattern), key=lambda file: file.stat().st_size)


def halve(file: Path) -> None:
    os.truncate(file, file.stat().st_size // 2)


def overwrite(file: Path) -> None:
    file.write_bytes(b"something else")


DAMAGE: dict[str, Callable[[Path], None]] = {
    "half a database": lambda data: halve(data / "service.sqlite3"),
    "an empty database": lambda data: os.truncate(data / "service.sqlite3", 0),
    "no database": lambda data: overwrite(data / "service.sqlite3"),
    "half a table": lambda data: halve(largest(data / "store", "*.sst")),
    "no manifest": lambda data: largest(data / "store", "MANIFEST-*").unlink(),
    "half a manifest": lambda data: halve(largest(data / "store", "MANIFEST-*")),
    "an empty CURRENT": lambda data: os.truncate(data / "store" / "CURRENT", 0),
    "no CURRENT": lambda data: (data / "store" / "CURRENT").unlink(),
}


@pytest.fixture(scope="module")
def kept(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The data folder of a service that was stopped, with a map."""
    data = tmp_path_factory.mktemp("kept") / "data"

    def fill(service: Service) -> None:
        which = make_map(service.client)
        for number in range(5):
            send(service.client, which, number)

    open_again(data, fill)
    return data


def content(data: Path) -> dict[str, bytes]:
    """What a damaged folder holds, but for locks and logs of ours and of RocksDB."""
    return {
        str(file.relative_to(data)): file.read_bytes()
        for file in data.rglob("*")
        if file.is_file() and not file.name.startswith(("LOG", "LOCK", "service.lock", "OPTIONS"))
    }


@pytest.mark.parametrize("name", DAMAGE)
def test_a_damaged_folder_is_left_as_it_is(kept: Path, tmp_path: Path, name: str) -> None:
    data = tmp_path / "data"
    shutil.copytree(kept, data)
    DAMAGE[name](data)
    before = content(data)
    for command in (["serve", "--port", "0", "--data"], ["store", "check"]):
        done = subprocess.run(
            [sys.executable, "-m", "symboslam", *command, str(data)], check=False, text=True,
            capture_output=True, timeout=60, env={**os.environ, "SYMBOSLAM_LOG": "none"},
        )  # fmt: skip
        assert done.returncode == 2, done.stderr
        assert done.stderr.count("\n") == 1
        assert str(data) in done.stderr
        assert "damaged" in done.stderr or "empty" in done.stderr
        assert "estore a backup" in done.stderr
        after = content(data)
        assert {name: after.get(name) for name in before} == before


def test_one_server_a_folder_wherever_the_store_is(tmp_path: Path, fuseki_url: str) -> None:
    from symboslam.errors import StoreError
    from symboslam.service.database import lock_folder

    settings = {
        "data": tmp_path, "store": fuseki_url, "admin_token": TOKEN, "bundled_ontology": False,
    }  # fmt: skip
    with running(**settings):
        with pytest.raises(StoreError, match="another process serves this folder"):
            lock_folder(tmp_path)
        done = subprocess.run(
            [sys.executable, "-m", "symboslam", "serve", "--port", "0", "--data", str(tmp_path)],
            check=False, text=True, capture_output=True, timeout=60,
            env={**os.environ, "SYMBOSLAM_STORE": fuseki_url},
        )  # fmt: skip
        assert done.returncode == 2
        assert "another process serves this folder" in done.stderr
    lock_folder(tmp_path).close()


def test_a_map_whose_statements_are_gone(make_service: MakeService, kept: Path) -> None:
    """A folder whose store was moved away gets the maps' statements back."""
    data = kept.parent / "without"
    shutil.copytree(kept, data)
    shutil.rmtree(data / "store")
    service = make_service(data=data)
    (which,) = (found["id"] for found in service.client.get("/v1/maps").json())
    query = f"ASK {{ GRAPH <https://w3id.org/symboslam/map/{which}/provenance> {{ ?s ?p ?o }} }}"
    while not service.ask(query).json()["boolean"]:
        time.sleep(0.05)
    assert half_written(service.client, which) == []


def flip(file: Path) -> None:
    """Turn bits over in the first block of a table, which holds data."""
    with file.open("r+b") as stream:
        bad = bytes(byte ^ 255 for byte in stream.read(16))
        stream.seek(0)
        stream.write(bad)


@pytest.mark.parametrize("which", ["all", "the small"])
def test_blocks_that_went_bad(kept: Path, tmp_path: Path, which: str) -> None:
    """They are found when the store is opened, or when it is read."""
    data = tmp_path / "bad"
    shutil.copytree(kept, data)
    tables = list((data / "store").glob("*.sst"))
    for file in tables:
        if which == "all" or file.stat().st_size < 3000:
            flip(file)
    code, text = symboslam("store", "check", data)
    assert code in {1, 2}
    assert "damaged" in text
    assert "Corruption" in text
    assert "estore a backup" in text


def test_statements_that_went_bad(kept: Path, tmp_path: Path) -> None:
    data = tmp_path / "bad"
    shutil.copytree(kept, data)
    for file in (data / "store").glob("*.sst"):
        if file.stat().st_size > 3000:
            flip(file)
    code, text = symboslam("store", "check", data)
    assert code in {1, 2}
    assert "the store is damaged: Corruption" in text
