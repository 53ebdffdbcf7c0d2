"""``symboslam validate``: what it prints, and its exit codes."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("pyshacl", reason="pySHACL comes with symboslam[shapes]")

EXAMPLES = Path(__file__).parents[2] / "ontology" / "shapes" / "examples"


def test_a_map_that_was_just_written_conforms(run: Any, points: Any, tmp_path: Path) -> None:
    source = points([({"class": "House"}, [149.1, -35.3])], bbox=[149.09, -35.31, 149.11, -35.29])
    assert run("classify", source, "--out", tmp_path / "map.ttl", "--cells", "3").code == 0
    result = run("validate", tmp_path / "map.ttl")
    assert (result.code, result.out) == (0, "The map conforms to the shapes.\n")


def test_a_violation_names_node_path_and_value(run: Any) -> None:
    result = run("validate", EXAMPLES / "invalid_confidence_above_1.ttl")
    assert result.code == 1
    assert result.out.startswith("1 violation:\n")
    assert "https://example.org/detection: https://w3id.org/symboslam#confidence: " in result.out
    assert result.out.endswith("Found: 1.2\n")


def test_other_shapes(run: Any, tmp_path: Path) -> None:
    shapes = tmp_path / "mine.ttl"
    shapes.write_text(
        "@prefix sh: <http://www.w3.org/ns/shacl#> . @prefix sl: <https://w3id.org/symboslam#> .\n"
        "sl:Sure a sh:NodeShape ; sh:targetClass sl:Detection ; sh:property [\n"
        "  sh:path sl:confidence ; sh:minInclusive 0.95 ; sh:message 'Not sure enough.' ] ."
    )
    result = run("validate", EXAMPLES / "valid_landmark.ttl", "--shapes", shapes)
    assert result.code == 1
    assert "Not sure enough. Found: 0.9" in result.out


@pytest.mark.parametrize(
    ("name", "text", "problem"),
    [
        ("map.ttl", "<a> <b>", "does not parse"),
        ("map.ttl", None, "cannot be read"),
        ("map.geojson", "{}", "files that end in .ttl, .nt, .nq"),
    ],
)
def test_a_map_that_cannot_be_read(
    run: Any, tmp_path: Path, name: str, text: str | None, problem: str
) -> None:
    path = tmp_path / name
    if text is not None:
        path.write_text(text)
    result = run("validate", path)
    assert (result.code, result.out) == (2, "")
    assert str(path) in result.err
    assert problem in result.err


def test_shapes_that_are_none(run: Any) -> None:
    result = run("validate", EXAMPLES / "valid_landmark.ttl", "--shapes", EXAMPLES / "missing.ttl")
    assert result.code == 2
    assert "missing.ttl cannot be read" in result.err
    result = run(
        "validate", EXAMPLES / "valid_landmark.ttl", "--shapes", EXAMPLES / "valid_landmark.ttl"
    )
    assert result.code == 2
    assert "holds no SHACL shapes" in result.err
