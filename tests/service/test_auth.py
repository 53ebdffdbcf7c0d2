"""Tokens: who may do what, and that a token works only while it should."""

import os
import pty
import sqlite3
import subprocess
import sys
import time
from contextlib import closing
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

import httpx
import pytest
from pydantic import ValidationError

from symboslam.errors import InputError
from symboslam.service.database import NAME
from symboslam.service.settings import Settings
from symboslam.service.tokens import SCOPES, Tokens
from tests.service.conftest import ADMIN, TOKEN, MakeService, Service
from tests.service.test_durability import serve
from tests.service.test_protocol import problem

ASK = "/sparql?query=ASK+%7B%7D"
UPDATE = {"Content-Type": "application/sparql-update"}


def bearer(token: str) -> dict[str, str]:
    return {"Authorization": f"Bearer {token}"}


def make(service: Service, *scopes: str, **members: Any) -> dict[str, Any]:
    """A new token, as the service tells it."""
    wanted = {"name": "a test", "scopes": scopes, **members}
    response = service.client.post("/v1/tokens", json=wanted, headers=ADMIN)
    assert response.status_code == 201, response.text
    found: dict[str, Any] = response.json()
    return found


def can_query(service: Service, headers: dict[str, str]) -> httpx.Response:
    return service.client.get(ASK, headers=headers)


def can_update(service: Service, headers: dict[str, str]) -> httpx.Response:
    return service.client.post("/sparql", content="CLEAR ALL", headers={**headers, **UPDATE})


def can_put(service: Service, headers: dict[str, str]) -> httpx.Response:
    turtle = {"Content-Type": "text/turtle", **headers}
    return service.client.put("/graphs?default", content="", headers=turtle)


def can_read_graph(service: Service, headers: dict[str, str]) -> httpx.Response:
    return service.client.get("/graphs?default", headers=headers)


def can_post_query(service: Service, headers: dict[str, str]) -> httpx.Response:
    return service.client.post("/sparql", data={"query": "ASK {}"}, headers=headers)


def can_list_tokens(service: Service, headers: dict[str, str]) -> httpx.Response:
    return service.client.get("/v1/tokens", headers=headers)


DOES = [
    (can_query, "query"),
    (can_post_query, "query"),
    (can_read_graph, "query"),
    (can_update, "update"),
    (can_put, "update"),
    (can_list_tokens, "admin"),
]


def test_each_scope_opens_what_it_should(make_service: MakeService) -> None:
    service = make_service(public_read=False)
    for scope in SCOPES:
        headers = bearer(make(service, scope)["token"])
        for does, needed in DOES:
            response = does(service, headers)
            if scope in (needed, "admin"):
                assert response.is_success, (scope, does, response.text)
            else:
                problem(response, 403, "insufficient-scope")
                challenge = response.headers["www-authenticate"]
                assert 'error="insufficient_scope"' in challenge
                assert f'scope="{needed}"' in challenge


def test_reading_needs_a_token_where_it_is_not_public(make_service: MakeService) -> None:
    service = make_service(public_read=False)
    for does, needed in DOES:
        response = does(service, {})
        problem(response, 401, "token-missing")
        challenge = response.headers["www-authenticate"]
        assert challenge.startswith("Bearer ")
        assert f'scope="{needed}"' in challenge
        assert "error" not in challenge  # RFC 6750, 3.1: none where no token was sent
    assert service.client.get("/healthz").status_code == 200


def test_a_wrong_token_is_refused_even_where_none_is_needed(service: Service) -> None:
    assert can_query(service, {}).status_code == 200
    good = make(service, "query")["token"]
    for wrong in ("x", good[:-1], good + "x", good.swapcase(), f"{good} {good}", "symboslam_", "_"):
        response = can_query(service, bearer(wrong))
        problem(response, 401, "token-invalid")
        assert 'error="invalid_token"' in response.headers["www-authenticate"]
    assert can_query(service, bearer(good)).status_code == 200
    assert service.client.get("/healthz", headers=bearer("x")).status_code == 200


def test_a_token_is_told_once(make_service: MakeService, tmp_path: Path) -> None:
    service = make_service()
    wanted = {"name": "r2d2", "scopes": ["ingest", "query"]}
    response = service.client.post("/v1/tokens", json=wanted, headers=ADMIN)
    assert response.headers["cache-control"] == "no-store"
    made = response.json()
    listed = can_list_tokens(service, ADMIN).json()
    assert listed == [{k: v for k, v in made.items() if k != "token"}]
    assert (made["name"], made["scopes"]) == ("r2d2", ["query", "ingest"])
    secret = made["token"].split("_", 2)[2]
    assert len(secret) >= 43  # 32 bytes in base64
    files = list((tmp_path / "data").glob(NAME + "*"))
    assert files
    assert not any(secret.encode() in file.read_bytes() for file in files)


def test_a_revoked_token_is_of_no_use(service: Service) -> None:
    made = make(service, "update")
    headers = bearer(made["token"])
    assert can_update(service, headers).status_code == 204
    url = f"/v1/tokens/{made['id']}"
    problem(service.client.delete(url, headers=headers), 403, "insufficient-scope")
    assert service.client.delete(url, headers=ADMIN).status_code == 204
    problem(can_update(service, headers), 401, "token-invalid")
    problem(service.client.delete(url, headers=ADMIN), 404, "no-such-token")


def test_an_expired_token_is_of_no_use(make_service: MakeService, tmp_path: Path) -> None:
    service = make_service()
    soon = (datetime.now(UTC) + timedelta(hours=1)).isoformat()
    made = make(service, "update", expires=soon)
    assert can_update(service, bearer(made["token"])).status_code == 204
    past = (datetime.now(UTC) - timedelta(seconds=1)).isoformat()
    with closing(sqlite3.connect(tmp_path / "data" / NAME)) as database:
        database.execute("UPDATE tokens SET expires = ?", (past,))
        database.commit()
    problem(can_update(service, bearer(made["token"])), 401, "token-invalid")


def test_use_is_noted(make_service: MakeService) -> None:
    service = make_service()
    made = make(service, "query")
    assert made["last_used"] is None
    before = datetime.now(UTC).replace(microsecond=0)
    assert can_query(service, bearer(made["token"])).status_code == 200
    while (used := can_list_tokens(service, ADMIN).json()[0]["last_used"]) is None:
        time.sleep(0.01)
    assert datetime.fromisoformat(used) >= before


@pytest.mark.parametrize(
    "members",
    [
        {"scopes": []}, {"scopes": ["root"]}, {"name": ""}, {"name": "a\nb"}, {"name": "x" * 101},
        {"expires": "2001-01-01T00:00:00Z"}, {"expires": "2999-01-01T00:00:00"}, {"id": "mine"},
    ],
)  # fmt: skip
def test_what_a_token_cannot_be(service: Service, members: dict[str, Any]) -> None:
    wanted = {"name": "n", "scopes": ["query"], **members}
    problem(service.client.post("/v1/tokens", json=wanted, headers=ADMIN), 422, "invalid-parameter")
    response = service.client.post("/v1/tokens", json=wanted)
    problem(response, 401, "token-missing")


def test_nobody_writes_where_the_service_is_read_only(make_service: MakeService) -> None:
    service = make_service(read_only=True)
    for does in (can_update, can_put):
        problem(does(service, ADMIN), 403, "read-only")
    wanted = {"name": "n", "scopes": ["query"]}
    response = service.client.post("/v1/tokens", json=wanted, headers=ADMIN)
    problem(response, 403, "read-only")
    assert can_list_tokens(service, ADMIN).json() == []
    assert can_query(service, ADMIN).status_code == 200


def test_the_administrators_token_is_not_easy_to_guess() -> None:
    for easy in ("secret", "x" * 15):
        with pytest.raises(ValidationError, match="easy to guess"):
            Settings.model_validate({"admin_token": easy})
    assert Settings.model_validate({"admin_token": ""}).admin_token is None


def test_openapi_says_what_needs_a_token(service: Service, make_service: MakeService) -> None:
    document = service.client.get("/openapi.json").json()
    assert document["components"]["securitySchemes"]["token"]["scheme"] == "bearer"
    for path, method, scope in (
        ("/sparql", "get", "query"), ("/sparql", "post", "query"), ("/graphs", "get", "query"),
        ("/graphs", "put", "update"), ("/graphs", "delete", "update"),
        ("/v1/tokens", "get", "admin"), ("/metrics", "get", "admin"),
    ):  # fmt: skip
        # Metrics need none from the machine itself.
        free: list[dict[str, list[str]]] = [{}] if scope == "query" or path == "/metrics" else []
        found = sorted(document["paths"][path][method]["security"], key=len)
        assert found == [*free, {"token": [scope]}]
    assert "security" not in document["paths"]["/healthz"]["get"]
    closed = make_service(public_read=False).client.get("/openapi.json").json()
    assert closed["paths"]["/sparql"]["get"]["security"] == [{"token": ["query"]}]


def test_tokens_are_kept(tmp_path: Path) -> None:
    with closing(Tokens(tmp_path)) as tokens:
        assert not tokens.has_admin()
        _, admin = tokens.add("a", ["admin"])
        reader, text = tokens.add("b", ["query"])
        assert tokens.has_admin()
        with pytest.raises(InputError, match="no scope 'root'"):
            tokens.add("c", ["root"])
    with closing(Tokens(tmp_path)) as tokens:
        assert [token.name for token in tokens.all()] == ["a", "b"]
        assert tokens.find(text) == reader
        assert admin.split("_")[1] != text.split("_")[1]
        assert tokens.find(f"symboslam_{reader.id}_{admin.split('_', 2)[2]}") is None


def command(*arguments: str) -> "subprocess.CompletedProcess[str]":
    return subprocess.run(
        [sys.executable, "-m", "symboslam", "token", *arguments],
        capture_output=True, text=True, check=False, timeout=60,
    )  # fmt: skip


def test_the_command_works_while_the_server_runs(tmp_path: Path) -> None:
    data = ("--data", str(tmp_path))
    with serve(tmp_path) as (_, client):
        made = command("add", "robots", "--scope", "update", "--expires", "30d", *data)
        assert made.returncode == 0, made.stderr
        token = made.stdout.strip()
        headers = {**bearer(token), **UPDATE}
        assert client.post("/sparql", content="CLEAR ALL", headers=headers).status_code == 204
        listed = command("list", *data).stdout
        identifier = token.split("_")[1]
        assert identifier in listed
        assert "robots" in listed
        assert token not in listed
        assert command("revoke", identifier, *data).returncode == 0
        assert client.post("/sparql", content="CLEAR ALL", headers=headers).status_code == 401
    assert "no tokens" in command("list", *data).stdout


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (("add", "x", "--scope", "root"), "no scope 'root'"),
        (("add", "x", "--scope", "query", "--expires", "soon"), "--expires 'soon'"),
        (("add", "x", "--scope", "query", "--expires", "2001-01-01"), "is past"),
        (("revoke", "0"), "no token '0'"),
    ],
)
def test_the_command_says_what_is_wrong(
    tmp_path: Path, arguments: tuple[str, ...], says: str
) -> None:
    done = command(*arguments, "--data", str(tmp_path))
    assert done.returncode == 2
    assert says in done.stderr


def first_lines(tmp_path: Path, terminal: bool) -> str:
    """What ``symboslam serve`` without any token prints."""
    environment = {k: v for k, v in os.environ.items() if not k.startswith("SYMBOSLAM_")}
    environment |= {"SYMBOSLAM_BUNDLED_ONTOLOGY": "false", "SYMBOSLAM_WORKERS": "1"}
    ours, theirs = pty.openpty() if terminal else os.pipe()
    arguments = [sys.executable, "-m", "symboslam", "serve", "--data", str(tmp_path), "--port", "0"]
    process = subprocess.Popen(
        arguments, stdout=theirs, stderr=subprocess.PIPE, env=environment, text=True
    )
    os.close(theirs)
    with process, open(ours, encoding="utf-8") as output:
        seen = ""
        while "Ctrl-C" not in seen:
            line = output.readline()
            assert line, seen
            seen += line
        process.terminate()
        _, logged = process.communicate(timeout=60)
    assert "symboslam_" not in logged
    return seen


def test_the_first_token_is_shown_once_and_on_a_terminal_only(tmp_path: Path) -> None:
    assert "nobody may write yet" in first_lines(tmp_path, terminal=False)
    seen = first_lines(tmp_path, terminal=True)
    (token,) = [word for word in seen.split() if word.startswith("symboslam_")]
    with closing(Tokens(tmp_path)) as tokens:
        found = tokens.find(token)
        assert found is not None
        assert found.scopes == {"admin"}
        assert f"id {found.id}" in seen
    assert "symboslam_" not in first_lines(tmp_path, terminal=True)


def test_the_token_of_the_environment_may_do_everything(service: Service) -> None:
    assert TOKEN in ADMIN["Authorization"]
    for does, _ in DOES:
        assert does(service, ADMIN).is_success


def test_tokens_that_cannot_be_read(make_service: MakeService, tmp_path: Path) -> None:
    service = make_service()
    token = make(service, "query")["token"]
    with closing(sqlite3.connect(tmp_path / "data" / NAME)) as database:
        database.execute("DROP TABLE tokens")
    problem(can_query(service, bearer(token)), 503, "store-unavailable")
    assert can_query(service, {}).status_code == 200
