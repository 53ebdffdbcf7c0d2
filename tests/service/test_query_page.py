"""The query page: its files and policy, and what it does in a browser, with and without YASGUI."""

from __future__ import annotations

import csv
import json
import re
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from symboslam.service.page import routes
from symboslam.service.vocabulary import QUERY_PREFIXES
from tests.engine.writers.page.browser.conftest import CHROMIUM, Browser
from tests.service.conftest import ADMIN, TOKEN, Service

PAGE = Path(routes.__file__).parent
BUILT = PAGE / "built"
needs_yasgui = pytest.mark.skipif(
    not (BUILT / "yasgui.min.js").is_file(), reason="needs YASGUI: run `make query-page` (npm)"
)
DATA = """
PREFIX sl: <https://w3id.org/symboslam#>
INSERT DATA {
  GRAPH <https://w3id.org/symboslam/map/port/provenance> {
    <https://w3id.org/symboslam/map/port/map> a sl:EnvironmentMap
  }
  GRAPH <https://e.org/g> { <https://e.org/a> <https://e.org/name> "Ann, <b>bold</b>" }
}"""
NAMES = "SELECT ?name WHERE { GRAPH ?g { ?x <https://e.org/name> ?name } }"


@pytest.fixture(scope="module")
def started(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Browser]:
    """A browser that reaches this machine only."""
    if not CHROMIUM:
        pytest.skip("needs Chromium (see `make system`)")
    browser = Browser(tmp_path_factory.mktemp("chromium"), offline=False)
    yield browser
    browser.close()


@pytest.fixture
def browser(started: Browser, service: Service) -> Iterator[Browser]:
    """The browser, and data; whatever a test did, it asked only us and nothing complained."""
    service.update(DATA).raise_for_status()
    yield started
    asked = [url for url in started.requests() if not url.startswith(("data:", "blob:"))]
    assert [url for url in asked if not url.startswith(service.url + "/")] == []
    assert started.complaints() == []


@pytest.fixture
def plain(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """A package into which YASGUI was not built."""
    monkeypatch.setattr(routes, "_YASGUI", ("missing.css", "missing.js"))
    routes._page.cache_clear()
    yield
    routes._page.cache_clear()


def test_the_front_page_leads_there(service: Service) -> None:
    assert '<a href="query">' in service.client.get("/").text
    assert service.client.head("/query").status_code == 200


def test_every_file_that_the_page_names_is_served(service: Service) -> None:
    page = service.client.get("/query")
    assert page.headers["content-type"] == "text/html; charset=utf-8"
    names = re.findall(r'(?:src|href)="(query/[^"]+)"', page.text)
    assert {"query/query.js", "query/query.css", "query/plain.js", "query/editor.js"} <= set(names)
    for name in names:
        file = service.client.get(f"/{name}")
        assert file.status_code == 200, name
        kind = "text/css" if name.endswith("css") else "text/javascript"
        assert file.headers["content-type"].startswith(kind)
        again = service.client.get(f"/{name}", headers={"If-None-Match": file.headers["etag"]})
        assert again.status_code == 304


def test_nothing_is_inline_and_nothing_from_elsewhere(service: Service) -> None:
    page = service.client.get("/query")
    policy = page.headers["content-security-policy"]
    assert "default-src 'none'; script-src 'self';" in policy
    assert "connect-src 'self'" in policy
    scripts = re.findall(r"<script([^>]*)>", page.text)
    assert [s for s in scripts if "src=" not in s] == [' type="application/json" id="prefixes"']
    assert not re.findall(r"""(?:src|href|action)=["'](?:[a-z]+:)?//""", page.text)
    assert not re.findall(r"\son[a-z]+=", page.text)
    assert not re.findall(r'(?:src|href|action)="/', page.text), "breaks behind a prefix"


def test_the_page_knows_the_prefixes(service: Service) -> None:
    page = service.client.get("/query").text
    found = re.search(r'id="prefixes">(.*?)</script>', page)
    assert found
    assert json.loads(found[1]) == QUERY_PREFIXES


@pytest.mark.parametrize("name", ["routes.py", "package.json", "..%2fapp.py", "nothing.js"])
def test_other_files_are_not_served(service: Service, name: str) -> None:
    response = service.client.get(f"/query/{name}")
    assert response.status_code == 404
    assert response.headers["content-type"].startswith("application/problem+json")


@needs_yasgui
def test_the_built_version_is_the_one_that_is_pinned() -> None:
    pinned = json.loads((PAGE / "package.json").read_text())["dependencies"]["@zazuko/yasgui"]
    digest = (PAGE / "yasgui.sha512").read_text().strip()
    assert (BUILT / "version").read_text() == f"@zazuko/yasgui@{pinned} {digest}\n"
    assert json.loads((BUILT / "yasgui.package.json").read_text())["license"] == "MIT"


@needs_yasgui
@pytest.mark.browser
def test_asks_and_shows_a_table(browser: Browser, service: Service) -> None:
    browser.open(f"{service.url}/query", f"?query={NAMES}")
    assert browser.run("document.querySelector('.CodeMirror').CodeMirror.getValue()") == NAMES
    browser.run("document.querySelector('.yasqe_queryButton').click()")
    browser.wait("document.querySelector('.yasr_results table tbody tr') !== null")
    assert "Ann, <b>bold</b>" in browser.text(".yasr_results table tbody")
    assert browser.run("localStorage.length") == 0


def saved(browser: Browser, folder: Path, button: str) -> str:
    """What a button saves as a file."""
    browser.call(
        "Browser.setDownloadBehavior", at_page=False, behavior="allow", downloadPath=str(folder)
    )
    browser.run(f"document.querySelector('{button}').click()")
    end = time.monotonic() + 20
    while not (found := list(folder.glob("results*.csv"))):
        assert time.monotonic() < end, "nothing was saved"
        browser.settle()
    return found[0].read_text()


@needs_yasgui
@pytest.mark.browser
def test_saves_csv(browser: Browser, service: Service, tmp_path: Path) -> None:
    browser.open(f"{service.url}/query", f"?query={NAMES}")
    browser.run("document.querySelector('.yasqe_queryButton').click()")
    browser.wait("document.querySelector('.yasr_results table tbody tr') !== null")
    text = saved(browser, tmp_path, ".yasr_downloadIcon")
    assert list(csv.reader(text.splitlines())) == [["name"], ["Ann, <b>bold</b>"]]


@pytest.mark.browser
def test_saves_csv_without_yasgui(
    browser: Browser, service: Service, plain: None, tmp_path: Path
) -> None:
    browser.open(f"{service.url}/query", f"?query={NAMES}")
    browser.run("document.querySelector('#plain button').click()")
    browser.wait("document.querySelector('#save').hidden === false")
    text = saved(browser, tmp_path, "#save")
    assert list(csv.reader(text.splitlines())) == [["name"], ["Ann, <b>bold</b>"]]


@needs_yasgui
@pytest.mark.browser
def test_an_example_is_asked_of_the_chosen_map(browser: Browser, service: Service) -> None:
    browser.open(f"{service.url}/query")
    assert browser.run("[...document.querySelectorAll('#map option')].map((o) => o.text)") == [
        "as in the query", "port",
    ]  # fmt: skip
    browser.choose("#map", "https://w3id.org/symboslam/map/port/")
    browser.choose("#example", "near")
    assert "Landmarks around a point" in browser.text("#about")
    query = browser.run("document.querySelector('.CodeMirror').CodeMirror.getValue()")
    assert "PREFIX map:     <https://w3id.org/symboslam/map/port/>" in query
    assert "For: operator" not in query


@needs_yasgui
@pytest.mark.browser
def test_says_what_is_wrong(browser: Browser, service: Service) -> None:
    browser.open(f"{service.url}/query", "?query=SELECT %3Fx WHERE { %3Fx %3Fy }")
    browser.run("document.querySelector('.yasqe_queryButton').click()")
    browser.wait("document.querySelector('.yasr_results .problem') !== null")
    assert browser.text(".yasr_results .problem").startswith("line 1")
    assert [c for c in browser.complaints() if "400" in c]
    browser.events.clear()  # the browser tells of every 400


@needs_yasgui
@pytest.mark.browser
def test_the_token_is_sent_and_kept_for_the_session_only(
    browser: Browser, service: Service
) -> None:
    browser.open(f"{service.url}/query", f"?query={NAMES}")
    browser.run(
        "(() => { const t = document.getElementById('token'); t.value = '" + TOKEN + "';"
        " t.dispatchEvent(new Event('change')); })()"
    )
    browser.run("document.querySelector('.yasqe_queryButton').click()")
    browser.wait("document.querySelector('.yasr_results table tbody tr') !== null")
    sent = [
        e["params"]["request"]["headers"].get("Authorization")
        for e in browser.events
        if e.get("method") == "Network.requestWillBeSent"
        and e["params"]["request"]["url"].endswith("/sparql")
    ]
    assert sent[-1] == ADMIN["Authorization"]
    assert browser.run("sessionStorage.getItem('symboslam-token')") == TOKEN
    assert browser.run("localStorage.length") == 0
    assert TOKEN not in browser.run("location.href")
    browser.run("sessionStorage.clear()")


@pytest.mark.browser
def test_works_without_yasgui(browser: Browser, service: Service, plain: None) -> None:
    browser.open(f"{service.url}/query", f"?query={NAMES}")
    assert browser.run("document.getElementById('text').value") == NAMES
    browser.run("document.querySelector('#plain button').click()")
    browser.wait("document.querySelector('#results table tbody tr') !== null")
    assert browser.text("#results table tbody") == "Ann, <b>bold</b>"
    assert browser.run("document.querySelector('#save').hidden") is False
    browser.run("document.getElementById('text').value = 'SELECT'")
    browser.run("document.querySelector('#plain button').click()")
    browser.wait("document.getElementById('problem').hidden === false")
    assert browser.text("#problem").startswith("line 1")
    browser.events.clear()  # the browser tells of every 400


@pytest.mark.browser
@pytest.mark.parametrize("width", [360, 1280])
def test_fits_the_window(browser: Browser, service: Service, width: int) -> None:
    browser.open(f"{service.url}/query", "?example=why", width=width)
    assert browser.run("document.documentElement.scrollWidth") <= width
