"""The committed reports are those of the present ontology, and hold no pitfall without a reason."""

from __future__ import annotations

import filecmp
import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
COMMITTED = ROOT / "pitfall_reports"
WORDNET = Path("/usr/share/wordnet/index.noun")


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """All reports, made anew."""
    if not WORDNET.is_file():
        if os.environ.get("CI"):
            pytest.fail("CI must have WordNet, or three pitfalls are not looked for: make system")
        pytest.skip("the committed reports are made with WordNet: make system installs it")
    out = tmp_path_factory.mktemp("reports")
    command = [sys.executable, str(ROOT / "scripts" / "pitfall_reports.py"), "--out", str(out)]
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
