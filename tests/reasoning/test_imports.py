"""Imports: strict reading refuses what lenient reading notes; catalogs are followed."""

from __future__ import annotations

import codecs
from pathlib import Path

import pytest
from rdflib import OWL, RDF, URIRef

from symboslam.errors import ImportsError, OntologySyntaxError, UnknownNameError
from symboslam.reasoning import sources
from symboslam.reasoning.imports import find_circle, find_in_catalog
from symboslam.reasoning.vocabulary import DOCUMENTS

HEAD = "@prefix owl: <http://www.w3.org/2002/07/owl#> .\n\n"


def write(path: Path, iri: str, *imports: str) -> Path:
    lines = "".join(f"<{iri}> owl:imports <{target}> .\n" for target in imports)
    path.write_text(f"{HEAD}<{iri}> a owl:Ontology .\n{lines}")
    return path


def test_missing_import(tmp_path: Path) -> None:
    path = write(tmp_path / "a.ttl", "urn:a", "urn:b")
    with pytest.raises(ImportsError) as caught:
        sources.read_closure([path])
    assert f"{path}: line 4: the import <urn:b> was not found" in str(caught.value)
    assert "--lenient-imports" in str(caught.value)
    read = sources.read_closure([path], strict=False)
    assert read.missing == ("urn:b",)
    assert [note.kind for note in read.notes] == ["missing-import"]


def test_cyclic_import(tmp_path: Path) -> None:
    a = write(tmp_path / "a.ttl", "urn:a", "urn:b")
    b = write(tmp_path / "b.ttl", "urn:b", "urn:c")
    c = write(tmp_path / "c.ttl", "urn:c", "urn:b")
    with pytest.raises(ImportsError) as caught:
        sources.read_closure([a])
    message = str(caught.value)
    assert "in a circle" in message
    assert f"{b}: line 4 imports c.ttl" in message
    assert f"{c}: line 4 imports b.ttl" in message
    assert str(a) not in message
    read = sources.read_files([a])
    assert {(URIRef(f"urn:{x}"), RDF.type, OWL.Ontology) for x in "abc"} <= set(read.graph)
    assert [note.kind for note in read.notes] == ["cyclic-import"]


def test_an_ontology_that_imports_itself(tmp_path: Path) -> None:
    a = write(tmp_path / "a.ttl", "urn:a", "urn:a")
    with pytest.raises(ImportsError, match=r"a\.ttl: line 4 imports a\.ttl"):
        sources.read_closure([a])


def test_byte_order_mark(tmp_path: Path) -> None:
    a = write(tmp_path / "a.ttl", "urn:a")
    a.write_bytes(codecs.BOM_UTF8 + a.read_bytes())
    with pytest.raises(OntologySyntaxError, match=r"a\.ttl: line 1: begins with a byte-order mark"):
        sources.read_closure([a])
    assert len(sources.read_closure([a], strict=False).graph) == 1


def test_empty_file(tmp_path: Path) -> None:
    (tmp_path / "a.ttl").write_text("# nothing\n")
    with pytest.raises(OntologySyntaxError, match=r"a\.ttl: line 1: states nothing"):
        sources.read_closure([tmp_path / "a.ttl"])
    assert not len(sources.read_closure([tmp_path / "a.ttl"], strict=False).graph)


def test_catalog(tmp_path: Path) -> None:
    (tmp_path / "deep down").mkdir()
    b = write(tmp_path / "deep down" / "any name.ttl", "urn:b")
    a = write(tmp_path / "a.ttl", "urn:a", "urn:b")
    assert find_in_catalog(a, "urn:b") is None
    (tmp_path / "catalog-v001.xml").write_text(
        '<?xml version="1.0"?><catalog xmlns="urn:oasis:names:tc:entity:xmlns:xml:catalog">'
        '<group><uri name="urn:b" uri="deep%20down/any%20name.ttl"/></group>'
        '<uri name="urn:c" uri="http://example.org/c.ttl"/><uri name="urn:d" uri="gone.ttl"/>'
        "</catalog>"
    )
    assert find_in_catalog(a, "urn:b") == b
    assert find_in_catalog(a, "urn:c") is None
    assert find_in_catalog(a, "urn:d") is None
    assert (URIRef("urn:b"), RDF.type, OWL.Ontology) in sources.read_closure([a]).graph


def test_a_fork_of_the_bundled_ontology(tmp_path: Path) -> None:
    """A changed copy is what counts: by the catalog beside it, or as one of the given files."""
    core = write(tmp_path / "my core.ttl", DOCUMENTS + "core")
    a = write(tmp_path / "a.ttl", "urn:a", DOCUMENTS + "places")
    read = sources.read_closure([a])
    assert "core.ttl" in {place.file for place in read.places.values()}
    read = sources.read_closure([a, core])
    assert "core.ttl" not in {place.file for place in read.places.values()}
    (tmp_path / "catalog-v001.xml").write_text(
        '<catalog xmlns="urn:oasis:names:tc:entity:xmlns:xml:catalog">'
        f'<uri name="{DOCUMENTS}places" uri="my%20core.ttl"/></catalog>'
    )
    read = sources.read_closure([a])
    assert {place.file for place in read.places.values()} == {str(a), str(core)}


def test_a_catalog_that_appears_makes_a_cached_result_old(tmp_path: Path) -> None:
    a = write(tmp_path / "a.ttl", "urn:a", DOCUMENTS + "places")
    digests = sources.read_files([a]).digests
    assert sources.unchanged(digests, [a])
    write(tmp_path / "b.ttl", DOCUMENTS + "places")
    assert sources.unchanged(digests, [a]), "bundled modules come before files beside"
    (tmp_path / "catalog-v001.xml").write_text(
        '<catalog xmlns="urn:oasis:names:tc:entity:xmlns:xml:catalog">'
        f'<uri name="{DOCUMENTS}places" uri="b.ttl"/></catalog>'
    )
    assert not sources.unchanged(digests, [a])


def test_broken_catalog(tmp_path: Path) -> None:
    a = write(tmp_path / "a.ttl", "urn:a", "urn:b")
    (tmp_path / "catalog-v001.xml").write_text("<catalog>\n<uri")
    with pytest.raises(OntologySyntaxError, match=r"catalog-v001\.xml: line 2: "):
        sources.read_closure([a])


def test_bundled_documents() -> None:
    read = sources.read_closure([DOCUMENTS + "places"])
    documents = {str(s) for s in read.graph.subjects(RDF.type, OWL.Ontology)}
    assert {DOCUMENTS + name for name in ("places", "environments", "core")} <= documents
    assert DOCUMENTS + "features-detector" not in documents
    with pytest.raises(UnknownNameError, match="no-such"):
        sources.read_closure([DOCUMENTS + "no-such"])


def test_version_iris_lead_to_bundled_documents(tmp_path: Path) -> None:
    a = write(tmp_path / "a.ttl", "urn:a", DOCUMENTS + "0.2.0/core")
    assert (URIRef(DOCUMENTS + "core"), RDF.type, OWL.Ontology) in sources.read_closure([a]).graph


def test_places_name_the_file_and_the_line(tmp_path: Path) -> None:
    b = write(tmp_path / "b.ttl", "urn:b")
    a = write(tmp_path / "a.ttl", "urn:a", "urn:b")
    places = sources.read_closure([a]).places
    assert places[URIRef("urn:a"), RDF.type, OWL.Ontology] == sources.Place(str(a), 3)
    assert str(places[URIRef("urn:b"), RDF.type, OWL.Ontology]) == f"{b}: line 3"


def test_the_bundled_ontology_reads_strictly() -> None:
    read = sources.read_closure([sources.CLOSURE])
    named = {str(s) for s in read.graph.subjects(RDF.type, OWL.Ontology)}
    expected = {DOCUMENTS + name.removesuffix(".ttl") for name in sources.closure_files()}
    assert len(expected) > 25
    assert named == expected, "symboslam.ttl does not import every module"


def test_find_circle() -> None:
    assert find_circle({"a": {"b": 1}, "b": {"c": 2}, "c": {}}) == []
    assert find_circle({"a": {"b": 1, "c": 2}, "b": {"d": 3}, "c": {"d": 4}, "d": {}}) == []
    found = find_circle({"a": {"b": 1}, "b": {"c": 2}, "c": {"a": 3}})
    assert sorted(found) == [("a", 3), ("b", 1), ("c", 2)]
