"""Where knowledge comes from: files, the cache, and what is refused."""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

from symboslam.errors import (
    EmptyOntologyError,
    InputError,
    OntologyError,
    OntologySyntaxError,
)
from symboslam.reasoning import loading, store
from symboslam.reasoning.knowledge import Knowledge

Resource = Callable[[str], Path]


def same(one: Knowledge, other: Knowledge) -> bool:
    """Whether two pieces of knowledge are equal in all but where they came from."""
    return store.to_json(one, {}) == store.to_json(other, {}) and all(
        np.array_equal(one.proximity(m), other.proximity(m)) for m in one.proximities
    )


@pytest.fixture
def reasoned(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Grows by one entry each time that something is reasoned."""
    calls: list[str] = []
    original = loading.reason

    def count(*args: object) -> object:
        calls.append("")
        return original(*args)  # type: ignore[arg-type]

    monkeypatch.setattr(loading, "reason", count)
    return calls


@pytest.fixture
def town_file(tmp_path: Path, resource: Resource) -> Path:
    return Path(shutil.copy(resource("town.ttl"), tmp_path / "town.ttl"))


def test_second_load_does_not_reason(town: Knowledge, town_file: Path, reasoned: list[str]) -> None:
    first = Knowledge.load(town_file)
    second = Knowledge.load(str(town_file))
    third = Knowledge.load([town_file])
    assert len(reasoned) == 1
    assert same(first, second)
    assert same(first, third)
    assert same(first, town)
    assert first.source == second.source == str(town_file)
    assert first.source_hash == second.source_hash
    assert first.labels == second.labels


def test_no_cache(hermit: None, town_file: Path, reasoned: list[str], cache_folder: Path) -> None:
    Knowledge.load(town_file, cache=False)
    Knowledge.load(town_file, cache=False)
    assert len(reasoned) == 2
    assert not list(cache_folder.iterdir())


def test_change_is_noticed(hermit: None, town_file: Path, reasoned: list[str]) -> None:
    first = Knowledge.load(town_file)
    town_file.write_text(town_file.read_text().replace("sl:strength 0.9", "sl:strength 0.8"))
    second = Knowledge.load(town_file)
    assert len(reasoned) == 2
    assert first.source_hash != second.source_hash
    assert second.indications_of("House")[0].strength == 0.8


def test_line_ends_do_not_count(hermit: None, town_file: Path, reasoned: list[str]) -> None:
    first = Knowledge.load(town_file)
    town_file.write_bytes(town_file.read_bytes().replace(b"\n", b"\r\n"))
    assert Knowledge.load(town_file).source_hash == first.source_hash
    assert len(reasoned) == 1


def test_change_of_an_import_is_noticed(
    hermit: None, tmp_path: Path, town_file: Path, reasoned: list[str]
) -> None:
    main = tmp_path / "main.ttl"
    main.write_text(
        "@prefix owl: <http://www.w3.org/2002/07/owl#> .\n"
        "<https://example.org/main> a owl:Ontology ; owl:imports <https://example.org/town> .\n"
    )
    assert len(Knowledge.load(main).features) == 5
    assert len(Knowledge.load(main).features) == 5
    assert len(reasoned) == 1
    town_file.write_text(town_file.read_text().replace('"house_1"', '"house_2"'))
    assert Knowledge.load(main).index_of("house_2") is not None
    town_file.unlink()
    with pytest.raises(EmptyOntologyError):
        Knowledge.load(main)


def test_missing_imports_are_noted(
    hermit: None, tmp_path: Path, town_file: Path, reasoned: list[str]
) -> None:
    town_file.write_text(
        town_file.read_text().replace(
            "<https://w3id.org/symboslam/core>", "<https://example.org/extra#>"
        )
    )
    for _ in range(2):
        knowledge = Knowledge.load(town_file)
        assert knowledge.notes == (
            f"the import <https://example.org/extra#> was not found beside {town_file}",
        )
    assert len(reasoned) == 1
    (tmp_path / "any.ttl").write_text(
        "<https://example.org/extra#> a <http://www.w3.org/2002/07/owl#Ontology> .\n"
        "<https://example.org/town#Tower> <https://w3id.org/symboslam#detectorLabel> 'spire' ."
    )
    knowledge = Knowledge.load(town_file)
    assert knowledge.notes == ()
    assert knowledge.index_of("spire") is not None
    assert len(reasoned) == 2


@pytest.mark.parametrize(
    "damage",
    [
        lambda data: b"",
        lambda data: data[:-100],
        lambda data: data.replace(b"Country cottage", b"Country cabbage"),
        lambda data: b"\x00\xff" * 100,
        lambda data: data.partition(b"\n")[2],
    ],
    ids=["empty", "truncated", "altered", "noise", "no digest"],
)
def test_damaged_cache(
    hermit: None,
    town_file: Path,
    cache_folder: Path,
    reasoned: list[str],
    damage: Callable[[bytes], bytes],
) -> None:
    first = Knowledge.load(town_file)
    (entry,) = cache_folder.iterdir()
    entry.write_bytes(damage(entry.read_bytes()))
    assert same(Knowledge.load(town_file), first)
    assert len(reasoned) == 2
    assert same(Knowledge.load(town_file), first)  # mended
    assert len(reasoned) == 2
    assert [path.name for path in cache_folder.iterdir()] == [entry.name]


def test_unusable_cache_folder(
    hermit: None, town_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("SYMBOSLAM_CACHE", str(tmp_path / "file" / "below"))
    assert len(Knowledge.load(town_file).features) == 5


def test_cache_folder(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.delenv("SYMBOSLAM_CACHE")
    monkeypatch.setattr("sys.platform", "linux")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert store.cache_folder() == tmp_path / "symboslam"
    monkeypatch.delenv("XDG_CACHE_HOME")
    monkeypatch.setenv("HOME", str(tmp_path))
    assert store.cache_folder() == tmp_path / ".cache" / "symboslam"


def test_other_format_version_is_refused(town: Knowledge) -> None:
    text = store.to_json(town, {"town.ttl": "0"})
    assert store.from_json(text, "x")[1] == {"town.ttl": "0"}
    with pytest.raises(ValueError, match="format"):
        store.from_json(text.replace(f'"format": {store.FORMAT}', '"format": 0'), "x")
    with pytest.raises(ValueError, match="not stored knowledge"):
        store.from_json(json.dumps({"format": store.FORMAT}), "x")


def test_stored_knowledge_is_complete(town: Knowledge) -> None:
    again, _ = store.from_json(store.to_json(town, {}), town.source)
    assert again.environments == town.environments
    assert again.features == town.features
    assert again.indications == town.indications
    assert again.schemes == town.schemes
    assert again.labels == town.labels
    for measure in ("path", "wu_palmer", "lin"):
        np.testing.assert_array_equal(again.proximity(measure), town.proximity(measure))


def test_threads(hermit: None, resource: Resource, town: Knowledge) -> None:
    """Two ontologies at once do not mix."""
    with ThreadPoolExecutor(2) as pool:
        one, two = pool.map(
            lambda name: Knowledge.load(resource(name), cache=False), ["town.ttl", "rooms.owx"]
        )
    assert same(one, town)
    assert [f.name for f in two.features] == ["Stove"]


def test_several_files(hermit: None, resource: Resource) -> None:
    knowledge = Knowledge.load([resource("town.ttl"), resource("rooms.owx")])
    assert len(knowledge.features) == 6
    # Only the town's environments are in a scheme; the kitchen needs to be asked for.
    assert [e.name for e in knowledge.environments] == ["Home", "Kitchen", "Park", "Work"]


def test_inferred_kinds(hermit: None, tmp_path: Path) -> None:
    """That a manor is a garden house, and a lawn a park, follows but is stated nowhere."""
    (tmp_path / "a.ttl").write_text("""
    @prefix : <https://example.org/x#> .
    @prefix sl: <https://w3id.org/symboslam#> .
    @prefix owl: <http://www.w3.org/2002/07/owl#> .
    @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
    :has a owl:ObjectProperty . :Garden a owl:Class .
    :Home a owl:Class ; rdfs:subClassOf sl:Environment .
    :Park a owl:Class ; rdfs:subClassOf sl:Environment ;
        owl:equivalentClass [ a owl:Class ; owl:intersectionOf ( sl:Environment
            [ a owl:Restriction ; owl:onProperty :has ; owl:someValuesFrom :Garden ] ) ] .
    :Lawn rdfs:subClassOf sl:Environment ,
        [ a owl:Restriction ; owl:onProperty :has ; owl:someValuesFrom :Garden ] .
    :House rdfs:subClassOf sl:StaticFeature ,
        [ a owl:Restriction ; owl:onProperty sl:indicates ; owl:someValuesFrom :Home ] .
    :GardenHouse owl:equivalentClass [ a owl:Class ; owl:intersectionOf ( :House
            [ a owl:Restriction ; owl:onProperty :has ; owl:someValuesFrom :Garden ] ) ] ;
        rdfs:subClassOf [ owl:onProperty sl:indicates ; owl:someValuesFrom :Lawn ] .
    :Manor rdfs:subClassOf :House ,
        [ a owl:Restriction ; owl:onProperty :has ; owl:someValuesFrom :Garden ] .
    """)
    knowledge = Knowledge.load(tmp_path / "a.ttl")
    assert [e.name for e in knowledge.environments] == ["Home", "Park"]
    home, park = knowledge.indications_of("Manor")
    assert home.path == ("Manor", "House", "Home")
    assert home.axioms == ("Manor is a kind of House", "House indicates Home (strength 1)")
    assert park.path == ("Manor", "GardenHouse", "Lawn", "Park")
    assert park.axioms == (
        "Manor is a kind of Garden house (inferred)",
        "Garden house indicates Lawn (strength 1)",
        "Lawn is a kind of Park (inferred)",
    )
    assert [i.environment for i in knowledge.indications_of("House")] == ["Home"]


def test_no_files() -> None:
    with pytest.raises(EmptyOntologyError, match="no ontology file"):
        Knowledge.load([])


def test_missing_file(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"none\.ttl: No such file"):
        Knowledge.load(tmp_path / "none.ttl")
    with pytest.raises(InputError, match="directory"):
        Knowledge.load(tmp_path)


def test_no_environments(hermit: None, resource: Resource) -> None:
    with pytest.raises(EmptyOntologyError, match="declares no environments: make"):
        Knowledge.load(resource("invalid_no_environments.ttl"))


def test_no_indications(hermit: None, resource: Resource) -> None:
    with pytest.raises(EmptyOntologyError, match="no feature of the ontology indicates"):
        Knowledge.load(resource("invalid_no_indications.ttl"))


def test_empty_file(hermit: None, tmp_path: Path) -> None:
    (tmp_path / "empty.ttl").write_text("")
    with pytest.raises(EmptyOntologyError, match="no environments"):
        Knowledge.load(tmp_path / "empty.ttl")


def test_strength_out_of_range(hermit: None, resource: Resource) -> None:
    with pytest.raises(OntologyError, match="strength of 'House indicates Home'"):
        Knowledge.load(resource("invalid_strength.ttl"))


def test_syntax_error(resource: Resource) -> None:
    with pytest.raises(OntologySyntaxError, match=r"invalid_syntax\.ttl: line 6: "):
        Knowledge.load(resource("invalid_syntax.ttl"))


def test_refused_ontology_is_not_cached(
    hermit: None, resource: Resource, cache_folder: Path
) -> None:
    with pytest.raises(EmptyOntologyError):
        Knowledge.load(resource("invalid_no_indications.ttl"))
    assert not list(cache_folder.iterdir())
