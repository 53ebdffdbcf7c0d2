"""Which files make an ontology; imports are found without the network, or reported."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from rdflib import OWL, RDF, URIRef

from symboslam.errors import InputError, OntologySyntaxError
from symboslam.reasoning import sources
from symboslam.reasoning.vocabulary import DOCUMENTS, SL

OWL_PREFIX = "@prefix owl: <http://www.w3.org/2002/07/owl#> .\n"


def ontology(path: Path, iri: str, *imports: str, extra: str = "") -> Path:
    """Write an ontology that says little but what it imports."""
    listed = " , ".join(f"<{target}>" for target in imports)
    text = f"<{iri}> a owl:Ontology{' ; owl:imports ' + listed if listed else ''} .\n"
    path.write_text(OWL_PREFIX + text + extra)
    return path


def documents(read: sources.Sources) -> set[str]:
    """IRIs of the ontologies that were merged."""
    return {str(s) for s in read.graph.subjects(RDF.type, OWL.Ontology)}


def test_bundled() -> None:
    read = sources.read_bundled()
    assert {DOCUMENTS + name for name in ("core", "environments", "places")} <= documents(read)
    assert read.files.keys() == sources.bundled_files().keys()
    assert "core.ttl" in read.files
    assert not read.missing
    assert sources.combined_digest(read.files) == sources.bundled_hash()


def test_core_is_always_there(tmp_path: Path) -> None:
    for imports in ((), (DOCUMENTS + "core",)):
        read = sources.read_files([ontology(tmp_path / "a.ttl", "urn:a", *imports)])
        assert documents(read) == {"urn:a", DOCUMENTS + "core", DOCUMENTS + "external"}
        assert (URIRef(SL + "indicates"), RDF.type, OWL.ObjectProperty) in read.graph
        assert (URIRef(SL + "Residential"), None, None) not in read.graph
        assert read.files.keys() == {"a.ttl"}
        assert not read.missing


def test_bundled_module_brings_its_imports(tmp_path: Path) -> None:
    path = ontology(tmp_path / "a.ttl", "urn:a", DOCUMENTS + "places")
    read = sources.read_files([path])
    expected = {DOCUMENTS + name for name in ("core", "external", "environments", "places")}
    assert documents(read) == {"urn:a", *expected}


def test_files_beside_are_found(tmp_path: Path) -> None:
    main = ontology(
        tmp_path / "main.ttl", "urn:main", "https://example.org/by-name",
        "https://example.org/with-end.ttl", "https://example.org/by#iri/", "urn:main",
    )  # fmt: skip
    ontology(tmp_path / "by-name.owl", "urn:by-name", "https://example.org/deeper")
    ontology(tmp_path / "with-end.ttl", "urn:with-end")
    ontology(tmp_path / "other.ttl", "https://example.org/by#iri/")
    ontology(tmp_path / "deeper.ttl", "urn:deeper", "urn:main", "urn:v2")  # a circle
    ontology(tmp_path / "newer.ttl", "urn:newer", extra="<urn:newer> owl:versionIRI <urn:v2> .")
    ontology(tmp_path / "unrelated.ttl", "urn:unrelated")
    (tmp_path / "broken.ttl").write_text("<https://example.org/by#iri/> a")
    read = sources.read_files([main])
    assert documents(read) == {
        "urn:main", "urn:by-name", "urn:with-end", "https://example.org/by#iri/", "urn:deeper",
        "urn:newer", DOCUMENTS + "core", DOCUMENTS + "external",
    }  # fmt: skip
    assert read.files.keys() == {
        "main.ttl", "by-name.owl", "with-end.ttl", "other.ttl", "deeper.ttl", "newer.ttl",
    }  # fmt: skip
    assert not read.missing


def test_missing_imports_are_reported(tmp_path: Path) -> None:
    path = ontology(
        tmp_path / "a.ttl", "urn:a", "http://example.org/web.owl", DOCUMENTS + "../../secret",
        "file:///etc/passwd", DOCUMENTS + "no-such-module",
    )  # fmt: skip
    read = sources.read_files([path])
    assert read.missing == (
        "file:///etc/passwd",
        "http://example.org/web.owl",
        DOCUMENTS + "../../secret",
        DOCUMENTS + "no-such-module",
    )


def test_several_files_are_read_once(tmp_path: Path) -> None:
    b = ontology(tmp_path / "b.ttl", "urn:b", extra="[] a owl:AllDisjointClasses .")
    a = ontology(tmp_path / "a.ttl", "urn:a", "https://example.org/b")
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    c = ontology(elsewhere / "c.ttl", "urn:c", "urn:a")  # not beside it, but given
    read = sources.read_files([a, b, a, c])
    assert not read.missing
    assert len(list(read.graph.subjects(RDF.type, OWL.AllDisjointClasses))) == 1
    assert read.files.keys() == {"a.ttl", "b.ttl", "elsewhere/c.ttl"}


def test_errors_name_the_imported_file(tmp_path: Path) -> None:
    a = ontology(tmp_path / "a.ttl", "urn:a", "https://example.org/b")
    (tmp_path / "b.ttl").write_text("\nrubbish")
    with pytest.raises(OntologySyntaxError, match=r"b\.ttl: line 2"):
        sources.read_files([a])


def test_unreadable(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="No such file"):
        sources.read_files([tmp_path / "none.ttl"])


def test_unchanged(tmp_path: Path) -> None:
    (tmp_path / "sub").mkdir()
    a = ontology(tmp_path / "a.ttl", "urn:a")
    b = ontology(tmp_path / "sub" / "b.ttl", "urn:b")
    digests = sources.read_files([a, b]).files
    assert digests.keys() == {"a.ttl", "sub/b.ttl"}
    assert sources.unchanged(digests, [a, b])
    b.write_text("")
    assert not sources.unchanged(digests, [a, b])
    b.unlink()
    assert not sources.unchanged(digests, [a, b])


def test_digest_depends_on_names_and_contents(resource: Callable[[str], Path]) -> None:
    data = resource("town.ttl").read_bytes()
    assert sources.digest(data) == sources.digest(data.replace(b"\n", b"\r\n"))
    assert sources.digest(data) != sources.digest(data + b" ")
    one = sources.combined_digest({"a": "1", "b": "2"})
    assert one == sources.combined_digest({"b": "2", "a": "1"})
    assert one != sources.combined_digest({"a": "2", "b": "1"})
    assert one != sources.combined_digest({"a": "1", "c": "2"})
