"""The package holds what it should, and the repository nothing that it should not."""

import os
import re
import subprocess
import sys
import tarfile
import tomllib
import zipfile
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).parents[1]
SRC = ROOT / "src" / "symboslam"
LIMIT = 5 * 1024 * 1024
LEFT_OUT = {"__pycache__", ".mypy_cache", ".ruff_cache", ".pytest_cache"}

# What the program needs at run time besides its modules.
NEEDED = (
    r"symboslam/ontology/core\.ttl",
    r"symboslam/ontology/environments\.ttl",
    r"symboslam/ontology/shapes/.+\.ttl",
    r"symboslam/reasoning/bundled/knowledge\.json",
    r"symboslam/engine/evaluation/page\.css",
    r"symboslam/engine/evaluation/page\.js",
    r"symboslam/engine/writers/page/.+\.html",
    r"symboslam/py\.typed",
)


@pytest.fixture(scope="module")
def hatch() -> dict[str, Any]:
    """The build settings of pyproject.toml."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())
    targets: dict[str, Any] = project["tool"]["hatch"]["build"]["targets"]
    return targets


def mapped(hatch: dict[str, Any]) -> dict[str, str]:
    """Top-level folder -> its place in the package."""
    sources: dict[str, str] = hatch["wheel"]["sources"]
    return {here: there for here, there in sources.items() if here != "src/symboslam"}


def files_below(folder: Path) -> list[Path]:
    """Files below a folder, without caches and without what links lead to."""
    found = []
    for here, below, names in os.walk(folder, followlinks=False):
        below[:] = [b for b in below if b not in LEFT_OUT and not (Path(here) / b).is_symlink()]
        found += [Path(here) / n for n in names if not n.endswith(".pyc")]
    return found


def repository() -> list[Path]:
    """Files that git tracks or would add; all but the environment where there is no git."""
    listing = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        cwd=ROOT, capture_output=True, text=True, check=False,
    )  # fmt: skip
    if listing.returncode == 0 and listing.stdout:
        names = [name for name in listing.stdout.split("\0") if name]
        return [ROOT / name for name in names if (ROOT / name).is_file()]
    return [p for p in files_below(ROOT) if p.relative_to(ROOT).parts[0] not in (".venv", ".git")]


def test_links_are_relative_and_lead_to_the_folders() -> None:
    links = [path for path in SRC.iterdir() if path.is_symlink()]
    assert links
    for link in links:
        assert os.readlink(link) == f"../../{link.name}"
        assert link.is_dir()


def test_each_mapped_folder_has_its_link(hatch: dict[str, Any]) -> None:
    folders = mapped(hatch)
    assert {"engine", "ontology", "reasoning"} <= set(folders)
    for here, there in folders.items():
        assert there == f"symboslam/{here}"
        assert (SRC / here).is_symlink()
        assert (ROOT / here / "__init__.py").is_file()
        assert here in hatch["wheel"]["only-include"]


def test_each_link_with_code_is_mapped(hatch: dict[str, Any]) -> None:
    """A folder that only says what will live in it is not packaged yet."""
    for link in (path for path in SRC.iterdir() if path.is_symlink()):
        names = {path.name for path in files_below(ROOT / link.name)}
        assert names, f"{link.name} is empty"
        assert link.name in mapped(hatch) or names == {"README.md"}


def test_what_lies_in_src_is_included(hatch: dict[str, Any]) -> None:
    own = {
        f"src/symboslam/{path.name}"
        for path in SRC.iterdir()
        if not path.is_symlink() and path.name not in LEFT_OUT
    }
    for target in ("wheel", "sdist"):
        listed = {n for n in hatch[target]["only-include"] if n.startswith("src/")}
        assert listed == own
    assert set(hatch["wheel"]["only-include"]) <= set(hatch["sdist"]["only-include"])


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> tuple[set[str], set[str]]:
    """File names in the sdist, and in the wheel that is built from it."""
    pytest.importorskip("build", reason="needs the dev extra")
    pytest.importorskip("hatchling", reason="needs the dev extra")
    out = tmp_path_factory.mktemp("dist")
    done = subprocess.run(
        [sys.executable, "-m", "build", "--no-isolation", "--outdir", str(out), str(ROOT)],
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stdout + done.stderr
    (sdist,) = out.glob("*.tar.gz")
    (wheel,) = out.glob("*.whl")
    with tarfile.open(sdist) as archive:
        inside = {m.name.partition("/")[2] for m in archive.getmembers() if m.isfile()}
    with zipfile.ZipFile(wheel) as packed:
        return inside, set(packed.namelist())


def test_wheel_holds_every_module_and_data_file(
    built: tuple[set[str], set[str]], hatch: dict[str, Any]
) -> None:
    _, wheel = built
    ignored = subprocess.run(
        ["git", "ls-files", "--others", "--ignored", "--exclude-standard"],
        cwd=ROOT, capture_output=True, text=True, check=False,
    ).stdout.split("\n")  # fmt: skip
    built_for_the_page = "service/page/built/"  # an artifact: packaged where it was made
    expected = {
        f"{there}/{path.relative_to(ROOT / here).as_posix()}"
        for here, there in mapped(hatch).items()
        for path in files_below(ROOT / here)
        if path.relative_to(ROOT).as_posix() not in ignored
        or path.relative_to(ROOT).as_posix().startswith(built_for_the_page)
    }
    expected |= {f"symboslam/{p.relative_to(SRC).as_posix()}" for p in files_below(SRC)}
    assert len(expected) > 20
    packaged = {name for name in wheel if not name.partition("/")[0].endswith(".dist-info")}
    assert packaged == expected


@pytest.mark.parametrize("pattern", NEEDED)
def test_wheel_holds_what_the_program_needs(built: tuple[set[str], set[str]], pattern: str) -> None:
    assert [name for name in built[1] if re.fullmatch(pattern, name)]


def test_licence_goes_with_both(built: tuple[set[str], set[str]]) -> None:
    sdist, wheel = built
    assert "LICENSE" in sdist
    assert [name for name in wheel if name.endswith(".dist-info/licenses/LICENSE")]


def test_no_large_files() -> None:
    files = repository()
    assert len(files) > 20
    large = {str(f.relative_to(ROOT)): f.stat().st_size for f in files if not f.is_symlink()}
    assert not {name: size for name, size in large.items() if size > LIMIT}


def test_constraints_pin_names_and_versions_only() -> None:
    lines = (ROOT / "constraints.txt").read_text().splitlines()
    pins = [line for line in lines if line and not line.startswith("#")]
    assert len(pins) > 20
    for pin in pins:
        assert re.fullmatch(r"[A-Za-z0-9_.-]+==[0-9][A-Za-z0-9.!+]*", pin), pin


def test_constraints_cover_the_dependencies() -> None:
    """Every requirement of the package and its extras is pinned, and the pin satisfies it."""
    packaging = pytest.importorskip("packaging.requirements")
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    extras = project["optional-dependencies"].values()
    wanted = [*project["dependencies"], *(line for extra in extras for line in extra)]
    pins = dict(
        line.split("==")
        for line in (ROOT / "constraints.txt").read_text().splitlines()
        if "==" in line
    )
    for line in wanted:
        need = packaging.Requirement(line)
        if need.name != "symboslam":
            assert need.specifier.contains(pins[need.name]), line


def test_no_download_addresses() -> None:
    """Pins carry no addresses, so any mirror can serve them."""
    pattern = re.compile(r"index-url|find-links|registry\s*=|\"resolved\":\s*\"http|://[^/\s]*pypi")
    checked = [
        p for p in repository() if p.suffix in {".txt", ".toml", ".cfg", ".json", ".yaml", ".lock"}
    ]
    assert ROOT / "constraints.txt" in checked
    assert not [p.name for p in checked if pattern.search(p.read_text(encoding="utf-8"))]
