"""Reports: golden files, and the page in a real browser."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import pytest

from symboslam.engine.evaluation import Evaluation, evaluate, evaluate_pairs, write_report
from symboslam.engine.evaluation.page import html_report
from symboslam.engine.evaluation.reports import json_report, markdown_report
from symboslam.errors import OutputError
from tests.engine.writers.page.browser.conftest import Browser, browser, started

GOLDEN = Path(__file__).parents[2] / "resources" / "evaluation"
__all__ = ["browser", "started"]  # fixtures


@pytest.fixture
def evaluated(town: Any) -> Evaluation:
    return evaluate(*town, cells=4)


@pytest.mark.parametrize(("name", "render"), [("town.json", json_report),
                                              ("town.md", markdown_report)])  # fmt: skip
def test_golden(evaluated: Evaluation, name: str, render: Any) -> None:
    assert render(evaluated) == (GOLDEN / name).read_text(encoding="utf-8")


def test_files(evaluated: Evaluation, tmp_path: Path) -> None:
    for name in ("report.json", "report.md", "report.html"):
        write_report(evaluated, tmp_path / name)
    assert json.loads((tmp_path / "report.json").read_text()) == evaluated.as_dict()
    assert (tmp_path / "report.html").read_text() == html_report(evaluated)
    with pytest.raises(OutputError, match=r"\.pdf"):
        evaluated.write(tmp_path / "report.pdf")


def test_a_failed_write_keeps_the_old_file(
    evaluated: Evaluation, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "report.json"
    path.write_text("old")

    def refuse(handle: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.fsync", refuse)
    with pytest.raises(OutputError, match="No space left"):
        write_report(evaluated, path)
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


def test_page_needs_nothing_else(evaluated: Evaluation) -> None:
    page = html_report(evaluated)
    assert not re.findall(r"""(?:src|href)=["'](?!data:)|url\((?!#)|@import|https?://""", page)
    assert " style=" not in page  # the policy would drop it


def test_words_of_files_are_never_markup(square: Any, collection: Any) -> None:
    bad = '<img src=x onerror="alert(1)">'
    about = {"environments": {bad: {"label": bad}}}
    truth = collection(square(0, 0, 10, 10, bad), bbox=[0, 0, 10, 10])
    found = collection(square(0, 0, 10, 10, bad), symboslam=about)
    got = evaluate_pairs([(truth, found)], cells=2)
    assert bad not in html_report(got)
    assert "<img" not in re.sub(r"\\<", "", markdown_report(got))


def test_maps_of_the_page(evaluated: Evaluation) -> None:
    """Rows from the north; runs of equal cells are one rectangle; three cells are wrong."""
    page = html_report(evaluated)
    # Row by row from the south: a Residential, b Commercial, g NonUrban, a dot for none.
    assert 'data-truth="....ggggaabbaabb"' in page
    assert 'data-label="ggggggggaab.aaa."' in page
    assert 'class="wrong" fill="url(#wrong)" d="M2 0h2v1h-2zM3 1h1v1h-1z"' in page
    assert '<path data-code="b" fill="#e04b4b" d="M2 0h2v1h-2zM2 1h2v1h-2z"/>' in page
    assert '<path data-code="b" fill="#e04b4b" d="M2 1h1v1h-1z"/>' in page


@pytest.mark.browser
def test_the_page_is_read_with_the_keyboard(
    browser: Browser, evaluated: Evaluation, tmp_path: Path
) -> None:
    write_report(evaluated, tmp_path / "report.html")
    browser.open(tmp_path / "report.html")
    browser.run("document.querySelector('.maps').focus()")

    def told(key: str) -> str:
        browser.key(key)
        return browser.text("output")

    row = "Row {} from the south, column {} from the west: {}"
    assert told("ArrowRight") == row.format(4, 1, "right: Residential.")
    assert told("ArrowRight") == row.format(4, 2, "right: Residential.")
    wrong = "wrong: the truth is Commercial, the map says {}."
    assert told("n") == row.format(4, 3, wrong.format("Residential"))
    assert told("n") == row.format(4, 4, wrong.format("unknown"))
    assert told("n") == row.format(3, 4, wrong.format("unknown"))
    assert told("p") == row.format(4, 4, wrong.format("unknown"))
    assert told("Home") == row.format(4, 1, "right: Residential.")
    for _ in range(5):
        browser.key("ArrowDown")
    assert browser.text("output") == row.format(1, 1, "no truth; the map says Non-urban.")


@pytest.mark.browser
def test_the_page_shows_one_environment_and_hides_marks(
    browser: Browser, evaluated: Evaluation, tmp_path: Path
) -> None:
    write_report(evaluated, tmp_path / "report.html")
    browser.open(tmp_path / "report.html")
    # Three environments on either map; all but Commercial are dimmed.
    browser.run("document.querySelector('button[data-code=b]').click()")
    assert browser.run("document.querySelectorAll('.maps .dim').length") == 4
    browser.run("document.querySelector('button[data-code=b]').click()")
    assert browser.run("document.querySelectorAll('.maps .dim').length") == 0
    shown = "getComputedStyle(document.querySelector('.maps .wrong')).display"
    assert browser.run(shown) != "none"
    browser.run("document.getElementById('marks').click()")
    assert browser.run(shown) == "none"


@pytest.mark.browser
def test_the_pointer_reads_the_cell_below_it(
    browser: Browser, evaluated: Evaluation, tmp_path: Path
) -> None:
    write_report(evaluated, tmp_path / "report.html")
    browser.open(tmp_path / "report.html", height=1600)
    left, top, width, height = browser.run(
        "(() => { const b = document.querySelectorAll('.frame')[1].getBoundingClientRect();"
        " return [b.left, b.top, b.width, b.height]; })()"
    )
    browser.mouse("mouseMoved", left + width * 0.9, top + height * 0.3)
    browser.settle()
    assert browser.text("output").startswith("Row 3 from the south, column 4 from the west: wrong")
