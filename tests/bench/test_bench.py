"""The bench runs on toy sizes, and its reference gives what a hand computation gives."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


def run(*arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, *arguments], cwd=ROOT, capture_output=True, text=True, check=False
    )


CASES = (
    "evidence",
    "classification",
    "growth",
    "segmentation",
    "start-up",
    "evaluation",
    "explanations",
)


@pytest.mark.parametrize("case", CASES)
def test_each_case_runs_on_toy_sizes(case: str, tmp_path: Path) -> None:
    out = tmp_path / "RESULTS.md"
    done = run("-m", "bench", "--tiny", "--only", case, "--out", str(out))
    assert done.returncode == 0, done.stderr
    text = out.read_text()
    assert "Toy sizes" in text
    assert len([line for line in text.splitlines() if re.match(r"\| [^-|]", line)]) >= 2
    if case in ("evidence", "classification"):
        differences = [float(d) for d in re.findall(r"\d(?:\.\d+)?e-\d\d|\b0e\+00", text)]
        assert differences  # the engine agrees with the plain loops
        assert max(differences) < 1e-12
    assert "different" not in text.replace("difference", "")


def test_map_building_runs_on_toy_sizes_and_into_a_page(tmp_path: Path) -> None:
    pytest.importorskip("gtsam", reason="needs symboslam[slam]")
    page = tmp_path / "page.md"
    page.write_text("before\n<!-- bench -->\nold\n<!-- end of bench -->\nafter\n")
    done = run("-m", "bench", "--tiny", "--only", "slam", "--into", str(page))
    assert done.returncode == 0, done.stderr
    text = page.read_text()
    assert text.startswith("before\n<!-- bench -->\n")
    assert text.endswith("\n<!-- end of bench -->\nafter\n")
    assert "\nold\n" not in text
    assert "### SymboSLAM, in simulated worlds" in text
    assert "target p99" in text


def test_a_page_without_marks_is_kept(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text("before\n<!-- bench -->\n")
    done = run("-m", "bench", "--tiny", "--only", "evidence", "--into", str(page))
    assert done.returncode != 0
    assert "<!-- end of bench -->" in done.stderr
    assert page.read_text() == "before\n<!-- bench -->\n"


@pytest.mark.slow
def test_knowledge_case_runs(tmp_path: Path) -> None:
    done = run("-m", "bench", "--tiny", "--only", "knowledge")
    assert done.returncode == 0, done.stderr
    assert "cold build" in done.stdout


@pytest.mark.slow
def test_reasoning_case_runs(tmp_path: Path) -> None:
    done = run("-m", "bench", "--tiny", "--only", "reasoning")
    assert done.returncode == 0, done.stderr
    assert "| HermiT over the whole import closure |" in done.stdout
    assert "| `symboslam cq run` |" in done.stdout


@pytest.mark.slow
@pytest.mark.parametrize(
    ("case", "told"),
    [
        ("queries", "| `why` | "),
        ("ready", "## `symboslam serve` until"),
        ("ingest", "| all over the map | "),
    ],
)
def test_service_cases_run(case: str, told: str) -> None:
    pytest.importorskip("fastapi", reason="needs symboslam[service]")
    done = run("-m", "bench", "--tiny", "--only", case)
    assert done.returncode == 0, done.stderr
    assert told in done.stdout
    assert "differently" not in done.stdout


def test_answers_are_compared_by_value() -> None:
    """Order, and how numbers and times are written, do not count; a missing row does."""
    code = (
        "import json\n"
        "from bench.queries import lines_of\n"
        "from bench.servers import SELECT\n"
        "def answer(*values):\n"
        "    rows = [{'x': {'type': 'literal', 'value': v}} for v in values]\n"
        "    return lines_of(json.dumps({'results': {'bindings': rows}}).encode(), SELECT)\n"
        "day = '2026-03-02T12:00:00'\n"
        "assert answer('1.50', day + 'Z') == answer(day + '+00:00', '1.5')\n"
        "assert answer('1', '1') != answer('1')\n"
        "assert answer('1') != answer('2')\n"
    )
    done = run("-c", code)
    assert done.returncode == 0, done.stderr


def test_reference_by_hand() -> None:
    """Three landmarks on a 3-4-5 triangle in a segment with a diagonal of 10.

    Environment 0 has all three with weights 1, 0.5, 0.5: d is 0.3, 0.4 and 0.5; unordered pairs
    give 0.75 * 0.7, 0.75 * 0.6 and 0.5 * 0.5, together 1.225; C = 1.225 / 3; n = 6 of 6.
    Environment 1 has the first alone: no pair, no evidence.
    """
    code = (
        "from bench.reference import pair_loop\n"
        "p, c, n = pair_loop([(0, 0), (3, 0), (0, 4)], [[1, 1], [0.5, 0], [0.5, 0]], 10.0)\n"
        "assert n == [6, 0] and c[1] == p[1] == 0, (p, c, n)\n"
        "assert abs(c[0] - 1.225 / 3) < 1e-15 and abs(p[0] - (0.5 * c[0] + 0.5)) < 1e-15, (p, c)\n"
    )
    done = run("-c", code)
    assert done.returncode == 0, done.stderr


def test_failing_command_is_not_measured() -> None:
    code = (
        "import sys\nfrom bench.measure import process\n"
        "try: process([sys.executable, '-c', 'print(41 + 1); raise SystemExit(3)'])\n"
        "except RuntimeError as error: assert 'exit code 3' in str(error) and '42' in str(error)\n"
        "else: raise AssertionError\n"
    )
    done = run("-c", code)
    assert done.returncode == 0, done.stderr
