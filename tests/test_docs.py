"""The documents are true: links lead somewhere, Python blocks run, cli.md is up to date."""

import json
import re
import subprocess
import sys
from pathlib import Path

import pytest

from symboslam.engine.sample import sample_area

ROOT = Path(__file__).parents[1]
FOLDERS = (".", "bench", "competency_questions", "docs", "docs/decisions", "engine", "examples",
           "ontology", "pitfall_reports", "reasoning", "service", "sim_bridge")  # fmt: skip
PAGES = sorted(
    [page for folder in FOLDERS for page in (ROOT / folder).glob("*.md")]
    + list((ROOT / "examples").glob("*/*.md"))
)
NAMES = [str(page.relative_to(ROOT)) for page in PAGES]
BLOCK = re.compile(r"^```python\n(.*?)^```$", re.MULTILINE | re.DOTALL)
FENCED = re.compile(r"^```.*?^```$", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")


def test_there_are_pages() -> None:
    assert {"README.md", "CONTRIBUTING.md", "CHANGELOG.md"} <= set(NAMES)


@pytest.mark.parametrize("name", NAMES)
def test_links_lead_to_files(name: str) -> None:
    page = ROOT / name
    links = LINK.findall(FENCED.sub("", page.read_text(encoding="utf-8")))
    local = [link.partition("#")[0] for link in links if not re.match(r"[a-z]+:|#", link)]
    assert not [link for link in local if not (page.parent / link).exists()]


@pytest.mark.parametrize(
    "name", [n for n, page in zip(NAMES, PAGES, strict=True) if BLOCK.search(page.read_text())]
)
def test_python_blocks_run(name: str, tmp_path: Path) -> None:
    """All blocks of a page, one after the other, in a folder with a sample ``town.geojson``."""
    (tmp_path / "town.geojson").write_text(json.dumps(sample_area()))
    code = "\n".join(BLOCK.findall((ROOT / name).read_text(encoding="utf-8")))
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", code],
        cwd=tmp_path, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr


def test_cli_page_is_fresh(tmp_path: Path) -> None:
    out = tmp_path / "cli.md"
    subprocess.run([sys.executable, str(ROOT / "scripts" / "cli_docs.py"), str(out)], check=True)
    assert out.read_text() == (ROOT / "docs" / "cli.md").read_text(), "run `make docs`"
