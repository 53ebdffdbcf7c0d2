"""``symboslam sim search``: the table, JSON, a picture, and what is refused."""

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner

from symboslam.cli.main import app
from symboslam.errors import InputError


def run(*arguments: object) -> str:
    """What the command prints."""
    words = ["sim", "search", *map(str, arguments)]
    result = CliRunner().invoke(app, words, catch_exceptions=False)
    assert result.exit_code == 0, result.output
    return result.stdout


def test_table_and_picture(tmp_path: Path) -> None:
    target = tmp_path / "paths.png"
    out = run("--area", "400x300", "--minutes", 3, "--seeds", 1, "--picture", target)
    assert "boustrophedon" in out
    assert "400x300" in out
    assert target.read_bytes().startswith(b"\x89PNG")


def test_json() -> None:
    words = ("--area", "kingston", "--strategies", "boustrophedon", "--seeds", 1, "--until", 1)
    out = run(*words, "--json")
    (told,) = json.loads(out)
    assert told["paper_coverage"] == 0.877
    assert told["strategies"][0]["coverage"] > 0.99
    assert run(*words, "--json") == out


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (("--area", "sydney"), "800x600"),
        (("--area", "0x5"), "above 0"),
        (("--area", ","), "name one"),
        (("--strategies", "frontir"), "frontier"),
        (("--strategies", ","), "name one"),
        (("--speed", "0"), "speed"),
        (("--fov", "400"), "fov"),
        (("--minutes", "-1"), "budget"),
    ],
)
def test_bad_input(words: tuple[str, ...], told: str) -> None:
    result = CliRunner().invoke(app, ["sim", "search", *words])
    assert isinstance(result.exception, InputError)
    assert told in str(result.exception)
