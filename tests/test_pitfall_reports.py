"""The committed reports are those of the present ontology, and hold no pitfall without a reason."""

from __future__ import annotations

import filecmp
import importlib.util
import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
COMMITTED = ROOT / "pitfall_reports"
SCRIPT = ROOT / "scripts" / "pitfall_reports.py"
UPSTREAM = ROOT.parent / "shared" / "upstream"
WORDNET = Path("/usr/share/wordnet/index.noun")


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """All reports, made anew."""
    if not WORDNET.is_file():
        if os.environ.get("CI"):
            pytest.fail("CI must have WordNet, or three pitfalls are not looked for: make system")
        pytest.skip("the committed reports are made with WordNet: make system installs it")
    out = tmp_path_factory.mktemp("reports")
    command = [sys.executable, str(SCRIPT), "--out", str(out)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
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
def test_the_page_about_upstream_is_fresh(tmp_path: Path, made: Path) -> None:
    """Made anew beside the reports: the page must not have changed but for its date."""
    spec = importlib.util.spec_from_file_location("pitfall_reports", SCRIPT)
    assert spec
    assert spec.loader
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    here = Path.cwd()
    try:
        page = module.upstream_page(UPSTREAM, module.scan_all()[module.WHOLE])
    finally:
        os.chdir(here)
    assert module.undated(page) == module.undated(module.PAGE.read_text(encoding="utf-8"))
    assert page.count("\n| P") == 41
