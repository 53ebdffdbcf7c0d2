"""Imports go one way (design 2), and start-up stays light."""

import ast
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]

# Folder -> the folders that it may import from, besides itself and symboslam.errors.
ALLOWED = {
    "ontology": set(),
    "competency_questions": set(),
    "reasoning": {"ontology", "competency_questions"},
    "engine": {"ontology", "reasoning"},
    "service": {"ontology", "competency_questions", "reasoning", "engine"},
    "sim_bridge": {"ontology", "reasoning", "engine"},
    "cli": {
        "ontology", "competency_questions", "reasoning", "engine", "service", "sim_bridge",
    },
}  # fmt: skip
TOP_LEVEL = {*ALLOWED, "errors"}
CODE = ("src", "engine", "reasoning", "ontology", "service", "sim_bridge", "competency_questions")

# Too slow to load before they are needed.
HEAVY = {
    "fastapi", "httpx", "matplotlib", "networkx", "osmium", "owlready2", "pandas", "pydantic",
    "prometheus_client", "pyoxigraph", "pyproj", "pyshacl", "rdflib", "scipy", "shapely",
    "starlette", "uvicorn",
}  # fmt: skip


def sources(*folders: str) -> list[Path]:
    """Python files below the folders, without those that are reached through a link."""
    found = []
    for folder in folders:
        for here, below, names in os.walk(ROOT / folder, followlinks=False):
            below[:] = [b for b in below if not (Path(here) / b).is_symlink()]
            found += [Path(here) / n for n in names if n.endswith(".py")]
    return sorted(found)


def imported(path: Path) -> Iterator[tuple[int, str]]:
    """Line and dotted name of everything that a file imports; a relative import as dots."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"), str(path))):
        if isinstance(node, ast.Import):
            yield from ((node.lineno, alias.name) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = "." * node.level + (node.module or "")
            yield from ((node.lineno, f"{base}.{alias.name}") for alias in node.names)


def trespasses(folder: str, names: Iterator[tuple[int, str]]) -> list[str]:
    """Imports of ``names`` that a module of ``folder`` must not make."""
    found = []
    for line, name in names:
        parts = name.split(".")
        if parts[0] != "symboslam":
            continue
        allowed = ALLOWED[folder] | {folder, "errors", "__version__"}
        if len(parts) < 2 or parts[1] not in allowed:
            found.append(f"line {line}: {name}")
    return found


@pytest.mark.parametrize("folder", ALLOWED)
def test_imports_go_one_way(folder: str) -> None:
    files = sources("src/symboslam/cli" if folder == "cli" else folder)
    if folder in ("reasoning", "engine", "sim_bridge", "cli"):
        assert files
    wrong = {str(p.relative_to(ROOT)): trespasses(folder, imported(p)) for p in files}
    assert not {path: lines for path, lines in wrong.items() if lines}


def test_only_absolute_imports_of_symboslam() -> None:
    """``import engine`` from the root would load a second copy of the engine."""
    files = sources(*CODE, "tests", "bench", "scripts")
    assert len(files) > 20
    wrong = [
        f"{path.relative_to(ROOT)} line {line}: {name}"
        for path in files
        for line, name in imported(path)
        if name.startswith(".") or name.split(".")[0] in TOP_LEVEL
    ]
    assert not wrong


def test_the_checks_see_what_is_wrong(tmp_path: Path) -> None:
    bad = tmp_path / "bad.py"
    bad.write_text(
        "import symboslam.cli.main\n"
        "from symboslam import engine, errors\n"
        "def f():\n"
        "    from symboslam.service import app\n"
        "from . import grid\n"
        "from engine.grid import Grid\n"
    )
    assert trespasses("reasoning", imported(bad)) == [
        "line 1: symboslam.cli.main",
        "line 2: symboslam.engine",
        "line 4: symboslam.service.app",
    ]
    names = [name for _, name in imported(bad)]
    assert "..grid" in names
    assert "engine.grid.Grid" in names


@pytest.mark.parametrize(
    "code",
    [
        "import symboslam",
        "import symboslam.cli",
        "import symboslam.reasoning.knowledge, symboslam.engine.landmarks",
        "import symboslam.cli\nsys.argv = ['symboslam', '--help']\n"
        "try: symboslam.cli.main()\nexcept SystemExit as stop: assert not stop.code, stop.code",
    ],
    ids=["package", "cli", "engine", "help"],
)
def test_start_up_loads_nothing_heavy(code: str) -> None:
    """Seen in a fresh interpreter: ``symboslam --help`` has to be there at once."""
    ask = f"import sys\n{code}\nprint('\\n' + ' '.join(sys.modules))"
    done = subprocess.run(
        [sys.executable, "-c", ask], capture_output=True, text=True, cwd=ROOT, check=False
    )
    assert done.returncode == 0, done.stderr
    loaded = {name.split(".")[0] for name in done.stdout.splitlines()[-1].split()}
    assert "symboslam" in loaded
    assert not loaded & HEAVY
