"""The committed reports are those of the present ontology, and hold no pitfall without a reason."""

from __future__ import annotations

import filecmp
import importlib.util
import os
import sys
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from types import ModuleType

import pytest

pytestmark = pytest.mark.proof

ROOT = Path(__file__).parents[1]
COMMITTED = ROOT / "pitfall_reports"
SCRIPT = ROOT / "scripts" / "pitfall_reports.py"
UPSTREAM = ROOT.parent / "shared" / "upstream"
WORDNET = Path("/usr/share/wordnet/index.noun")


@pytest.fixture(scope="module")
def script() -> Iterator[ModuleType]:
    """The script, which scans once for all tests."""
    spec = importlib.util.spec_from_file_location("pitfall_reports", SCRIPT)
    assert spec
    assert spec.loader
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    module.scan_all = cache(module.scan_all)  # type: ignore[attr-defined]
    here = Path.cwd()
    yield module
    os.chdir(here)  # it scans from folders of its own


@pytest.fixture(scope="module")
def made(script: ModuleType, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """All reports, made anew."""
    if not WORDNET.is_file():
        if os.environ.get("CI"):
            pytest.fail("CI must have WordNet, or three pitfalls are not looked for: make system")
        pytest.skip("the committed reports are made with WordNet: make system installs it")
    out = tmp_path_factory.mktemp("reports")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sys, "argv", [str(SCRIPT), "--out", str(out)])
        assert script.main() == 0
    return out


def test_the_committed_reports_are_fresh(made: Path) -> None:
    names = {p.relative_to(made) for p in made.rglob("*") if p.is_file()}
    assert len(names) > 150
    kept = {p.relative_to(COMMITTED) for p in COMMITTED.rglob("*") if p.is_file()}
    assert kept == names, "run `make pitfalls`"
    _, differing, odd = filecmp.cmpfiles(
        made, COMMITTED, sorted(str(name) for name in names), shallow=False
    )
    assert (differing, odd) == ([], []), "run `make pitfalls`"


@pytest.mark.skipif(not UPSTREAM.is_dir(), reason="needs ../shared/upstream")
def test_the_page_about_upstream_is_fresh(script: ModuleType, made: Path) -> None:
    """Made anew beside the reports: the page must not have changed but for its date."""
    page = script.upstream_page(UPSTREAM, script.scan_all()[script.WHOLE])
    assert script.undated(page) == script.undated(script.PAGE.read_text(encoding="utf-8"))
    assert page.count("\n| P") == 41
