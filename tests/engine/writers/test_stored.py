"""Maps read back from their files explain their segments, equally from every format."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.explanation import Reason
from symboslam.engine.writers import write_map
from symboslam.engine.writers.rdf_index import read_index
from symboslam.engine.writers.stored import StoredMap, read_map
from symboslam.errors import InputError, UnknownNameError

Make = Callable[..., EnvironmentMap]
ENDINGS = ("geojson", "ttl", "nq")


def stored(environment_map: EnvironmentMap, folder: Path, ending: str, reasons: int) -> StoredMap:
    target = folder / f"map.{ending}"
    write_map(environment_map, target, reasons=reasons)
    return read_map(target)


@pytest.mark.parametrize("reasons", [0, 2, 8])
def test_all_formats_tell_the_same(town: EnvironmentMap, tmp_path: Path, reasons: int) -> None:
    first, *others = (stored(town, tmp_path, ending, reasons) for ending in ENDINGS)
    assert len(first) == 4
    for other in others:
        assert other.segments == first.segments
        assert other.environments == first.environments
        assert other.features == first.features
        assert other.indications == first.indications


@pytest.mark.parametrize("ending", ENDINGS)
def test_explanations_survive(town: EnvironmentMap, tmp_path: Path, ending: str) -> None:
    found = stored(town, tmp_path, ending, 8)
    for segment_id in town.segment_id:
        told, known = found.explain(segment_id), town.explain(segment_id)
        assert replace(told, chain=None) == replace(known, chain=None)
        assert (told.chain is None) == (known.chain is None)
        if told.chain and known.chain:
            assert told.chain.groups == pytest.approx(known.chain.groups)
            assert told.chain.zones == known.chain.zones
            assert told.chain.untold == known.chain.untold


@pytest.mark.parametrize("ending", ENDINGS)
def test_the_rest_comes_last_without_a_feature(
    town: EnvironmentMap, tmp_path: Path, ending: str
) -> None:
    house, other = stored(town, tmp_path, ending, 1).explain("0-0-0").reasons
    assert house == Reason("House", "house", 2, {"Residential": 0.6})
    rest = {"Residential": 0.1, "Commercial": 0.1, "NonUrban": 0.2}
    assert other == Reason("", "other", 2, rest)


@pytest.mark.parametrize("ending", ENDINGS)
def test_sentences_behind_reasons(town: EnvironmentMap, tmp_path: Path, ending: str) -> None:
    found = stored(town, tmp_path, ending, 8)
    assert found.find_indication("Shop", "Commercial") == town.knowledge.indications[1]
    assert found.find_indication("Shop", "NonUrban") is None
    assert found.find_indication("", "NonUrban") is None


@pytest.mark.parametrize("ending", ENDINGS)
def test_unknown_segment(town: EnvironmentMap, tmp_path: Path, ending: str) -> None:
    found = stored(town, tmp_path, ending, 0)
    with pytest.raises(UnknownNameError, match=r"no segment '0-0-2'.*close: .*0-0-0"):
        found.explain("0-0-2")


@pytest.mark.parametrize("ending", ENDINGS)
def test_empty_map(empty: EnvironmentMap, tmp_path: Path, ending: str) -> None:
    explanation = stored(empty, tmp_path, ending, 8).explain("0-0-0")
    assert explanation.environment is None
    assert explanation.probabilities == {}
    assert explanation.reasons == ()


def test_geojson_of_others_needs_only_the_contract(tmp_path: Path) -> None:
    properties = {
        "segment_id": 7,
        "environment": "Home",
        "probabilities": {"Home": 1},
        "landmark_count": 0,
    }
    collection = {
        "type": "FeatureCollection",
        "features": [{"type": "Feature", "geometry": None, "properties": properties}],
    }
    (tmp_path / "map.json").write_text(json.dumps(collection))
    assert read_map(tmp_path / "map.json").explain("7").probabilities == {"Home": 1.0}


@pytest.mark.parametrize(
    ("name", "content", "problem"),
    [
        ("map.geojson", "", "no JSON"),
        ("map.geojson", '{"type": "Fea', "no JSON"),
        ("map.geojson", "[]", "no environment map"),
        ("map.geojson", '{"features": [{"properties": null}]}', "no environment map"),
        ("map.geojson", '{"features": [{"properties": {"class": "House"}}]}', "segment_id"),
        ("map.geojson", "[" + "1" * 5000 + "]", "with a number of thousands of digits$"),
        ("map.geojson", "[" * 100_000, "nested too deeply"),
        ("map.geojson", '{"symboslam": {"features": "x"}, "features": []}', "damaged: a part"),
        ("map.geojson", '{"features": [{"properties": "x"}]}', "damaged: a part has a wrong type$"),
        ("map.ttl", "<a> <b", "does not parse"),
        ("map.ttl", '<urn:a> <urn:b> "c', "does not parse"),
        ("map.nq", "# a map\n\n<a> .", "line 3 is no statement"),
        ("map.nq", "", "holds no sl:EnvironmentMap"),
        ("map.ttl", "", "holds no sl:EnvironmentMap"),
        ("map.png", "", r"only maps in \.geojson"),
    ],
)
def test_files_that_are_no_maps(tmp_path: Path, name: str, content: str, problem: str) -> None:
    (tmp_path / name).write_text(content)
    with pytest.raises(InputError, match=problem):
        read_map(tmp_path / name)


def test_nquads_of_others(tmp_path: Path) -> None:
    """Whatever the grammar allows: comments, tabs, no spaces, escapes, no graph."""
    text = (
        '# comment\n<urn:a>\t<urn:p>"x\\"\\u00e9\\U0001F600\\n"@en-GB.\n\n'
        '_:b.1 <urn:p> "1"^^<urn:t> _:g . # more\n<urn:a><urn:q><urn:\\u00e9>.\n'
    )
    (tmp_path / "other.nq").write_text(text.replace("<urn:\\u00e9>", "<urn:é>"), encoding="utf-8")
    index = read_index(tmp_path / "other.nq")
    assert index.one("urn:a", "urn:p") == 'x"é😀\n'
    assert index.all("_:b.1", "urn:p") == ["1"]
    assert index.subjects("urn:q", "urn:é") == ["urn:a"]
    assert index.one("urn:a", "urn:r") is None


def test_nquads_that_are_no_text(tmp_path: Path) -> None:
    (tmp_path / "map.nq").write_bytes(b"\xff\xfe")
    with pytest.raises(InputError, match="not UTF-8"):
        read_map(tmp_path / "map.nq")


@pytest.mark.parametrize("ending", ENDINGS)
def test_missing_file(tmp_path: Path, ending: str) -> None:
    with pytest.raises(InputError, match="cannot be read: No such file"):
        read_map(tmp_path / f"map.{ending}")


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("sl:count 2", 'sl:count "two"'),
        ("sl:count 2", 'sl:count "INF"'),
        ("sl:environment sl:Commercial ;", ""),
    ],
)
def test_incomplete_rdf(town: EnvironmentMap, tmp_path: Path, old: str, new: str) -> None:
    write_map(town, tmp_path / "map.ttl")
    text = (tmp_path / "map.ttl").read_text()
    assert old in text
    (tmp_path / "map.ttl").write_text(text.replace(old, new))
    with pytest.raises(InputError, match="no complete environment map"):
        read_map(tmp_path / "map.ttl")


PYTHON = re.compile(r"Error|index out of range|object has no|invalid literal|not convert|sys\.")


def problem_of(path: Path) -> str:
    """What the message says, without the file's name; empty if the map is read."""
    try:
        read_map(path)
    except InputError as error:
        return str(error).replace(str(path), "")
    return ""


@pytest.mark.parametrize("ending", ENDINGS)
def test_damage_is_told_in_plain_words(town: EnvironmentMap, tmp_path: Path, ending: str) -> None:
    """Files cut anywhere are read or refused, never with words of Python's own."""
    path = tmp_path / f"map.{ending}"
    write_map(town, path)
    whole = path.read_bytes()
    refused = 0
    for size in range(0, len(whole), max(len(whole) // 40, 1)):
        path.write_bytes(whole[:size])
        problem = problem_of(path)
        refused += bool(problem)
        assert not PYTHON.search(problem)
    assert refused > 20 or ending == "nq"


@pytest.mark.parametrize("damaged", ["x", 7, None, [], {}, ["x"], {"x": "y"}])
@pytest.mark.parametrize("member", ["reasons", "probabilities", "features", "environments"])
def test_wrong_types_are_told_in_plain_words(
    town: EnvironmentMap, tmp_path: Path, member: str, damaged: object
) -> None:
    path = tmp_path / "map.geojson"
    write_map(town, path)
    document = json.loads(path.read_bytes())
    for holder in (document["symboslam"], document["features"][0]["properties"]):
        if member in holder:
            holder[member] = damaged
    path.write_text(json.dumps(document))
    assert not PYTHON.search(problem_of(path))
