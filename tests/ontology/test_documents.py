"""The documents of the ontology: headers, imports and catalog; a term is declared in one place."""

from __future__ import annotations

from collections import defaultdict
from pathlib import Path
from xml.etree import ElementTree

import pytest
from rdflib import OWL, RDF, RDFS, Graph, Literal, URIRef
from rdflib.namespace import DCTERMS
from rdflib.term import Node

FOLDER = Path(__file__).resolve().parents[2] / "ontology"
DOCUMENTS = "https://w3id.org/symboslam/"
SL = DOCUMENTS.rstrip("/") + "#"
FOLDERS = ("upstream", "alignments", "shapes", "examples")
# The modules that 0.1.0 had; every other one says that it is new.
FIRST_MODULES = {
    "core", "environments", "feature-groups", "features-detector", "features-osm", "map", "places",
    *(f"features-osm-{topic}" for topic in (
        "access", "buildings", "community", "country", "homes", "hospitality", "industry",
        "offices", "recreation", "shops", "streets", "transport",
    )),
}  # fmt: skip
# The namespaces whose terms the modules declare themselves.
SPACES = (
    SL,
    "http://www.semanticweb.org/swarmShepherdingOntology/Onto4MAT#",
    "http://github.com/Alex23013/slam-up/OntoSLAM.owl#",
    "http://github.com/Alex23013/slam-up/FortesRey.owl#",
    "http://github.com/Alex23013/slam-up/ISRO.owl#",
    "http://www.semanticweb.org/ontologies/2013/7/CORA.owl#",
    "http://knowrob.org/kb/knowrob.owl#",
)

Ontology = dict[str, Graph]


@pytest.fixture(scope="module")
def documents() -> Ontology:
    """Name of a document -> its graph, for this folder and those below.

    ``shapes/examples`` are pieces of maps and no ontologies.
    """
    paths = [path for folder in (".", *FOLDERS) for path in (FOLDER / folder).glob("*.ttl")]
    stems = {path.relative_to(FOLDER).with_suffix("").as_posix(): path for path in paths}
    assert {stem.partition("/")[0] for stem in stems if "/" in stem} == set(FOLDERS)
    return {stem: Graph().parse(path) for stem, path in sorted(stems.items())}


def english(graph: Graph, subject: Node, predicate: URIRef) -> str:
    """The one English text of a document; fails where there is none or more than one."""
    (text,) = graph.objects(subject, predicate)
    assert isinstance(text, Literal)
    assert text.language == "en"
    return str(text)


def test_every_document_has_a_complete_header(documents: Ontology) -> None:
    for stem, graph in documents.items():
        document = URIRef(DOCUMENTS + stem)
        assert set(graph.subjects(RDF.type, OWL.Ontology)) == {document}
        title, description, comment = (
            english(graph, document, says)
            for says in (DCTERMS.title, DCTERMS.description, RDFS.comment)
        )
        assert title != description
        assert "Scope:" in comment, stem
        assert "Design choice:" in comment, stem
        assert graph.value(document, DCTERMS.creator) == Literal("SymboSLAM contributors"), stem
        assert graph.value(document, DCTERMS.license) == URIRef(
            "https://creativecommons.org/licenses/by/4.0/"
        ), stem
        assert graph.value(document, OWL.versionInfo) == Literal("0.2.0"), stem
        assert graph.value(document, OWL.versionIRI) == URIRef(f"{DOCUMENTS}0.2.0/{stem}")
        prior = graph.value(document, OWL.priorVersion)
        if stem in FIRST_MODULES:
            assert prior == URIRef(f"{DOCUMENTS}0.1.0/{stem}")


def test_every_module_begins_with_its_scope_imports_and_design(documents: Ontology) -> None:
    for stem in documents:
        head = (FOLDER / f"{stem}.ttl").read_text(encoding="utf-8").partition("@prefix")[0]
        assert head.startswith("# "), stem
        for word in ("# Scope ", "# Design ", *(() if "shapes" in stem else ("# Imports ",))):
            assert f"\n{word}" in head, f"{stem} lacks {word}"


def imports_of(documents: Ontology) -> dict[str, set[str]]:
    """Document -> the documents that it imports, by their names."""
    return {
        stem: {str(o).removeprefix(DOCUMENTS) for o in graph.objects(None, OWL.imports)}
        for stem, graph in documents.items()
    }


def closure(imports: dict[str, set[str]], stem: str) -> set[str]:
    """A document and all that it imports, directly or not."""
    reached, waiting = set[str](), [stem]
    while waiting:
        one = waiting.pop()
        if one not in reached:
            reached.add(one)
            waiting += imports[one]
    return reached


def is_module(stem: str) -> bool:
    """Whether a document says what is true: shapes and examples do not."""
    return not stem.startswith(("shapes/", "examples/"))


def test_imports_exist_and_cover_every_term_used(documents: Ontology) -> None:
    imports = imports_of(documents)
    declared = {stem: set(graph.subjects(RDF.type, None)) for stem, graph in documents.items()}
    assert imports["external"] == set()
    assert imports["core"] == {"external"}
    for stem, graph in documents.items():
        assert imports[stem] <= set(documents), f"{stem} imports an unknown module"
        if stem.startswith("shapes/"):
            continue  # shapes name classes of maps and need none of them
        known = set[Node]().union(*(declared[one] for one in closure(imports, stem)))
        used = {t for triple in graph for t in triple if str(t).startswith(SPACES)}
        assert used <= known, f"{stem}: not imported: {sorted(map(str, used - known))[:5]}"


def test_symboslam_imports_every_module(documents: Ontology) -> None:
    imports = imports_of(documents)
    assert closure(imports, "symboslam") == {stem for stem in documents if is_module(stem)}
    assert set(documents["symboslam"].subjects()) == {URIRef(DOCUMENTS + "symboslam")}


def test_no_import_leads_back(documents: Ontology) -> None:
    imports = imports_of(documents)
    for stem, direct in imports.items():
        for one in direct:
            assert stem not in closure(imports, one), f"{stem} imports {one}, which imports it"


def test_a_term_is_declared_in_one_module(documents: Ontology) -> None:
    kinds = {OWL.Class, OWL.ObjectProperty, OWL.DatatypeProperty, OWL.AnnotationProperty}
    owners = defaultdict[Node, set[str]](set)
    for stem, graph in documents.items():
        for term, kind in graph.subject_objects(RDF.type):
            if kind in kinds and isinstance(term, URIRef) and is_module(stem):
                owners[term].add(stem)
    assert len(owners) > 900
    assert {term: where for term, where in owners.items() if len(where) > 1} == {}


@pytest.mark.parametrize("folder", [".", *FOLDERS])
def test_the_catalog_of_a_folder_names_every_document(folder: str, documents: Ontology) -> None:
    """``python scripts/catalog.py`` writes them anew."""
    catalog = ElementTree.parse(FOLDER / folder / "catalog-v001.xml").getroot()
    entries = {entry.get("name"): entry.get("uri") for entry in catalog}
    assert len(entries) == len(catalog)
    assert set(entries) == {DOCUMENTS + stem for stem in documents}
    for stem in documents:
        uri = entries[DOCUMENTS + stem]
        assert uri is not None
        assert (FOLDER / folder / uri).resolve() == FOLDER / f"{stem}.ttl"


def test_the_readme_names_every_module(documents: Ontology) -> None:
    text = (FOLDER / "README.md").read_text(encoding="utf-8")
    modules = {stem.rpartition("/")[2] for stem in documents if is_module(stem)}
    single = {stem for stem in modules if not stem.startswith("features-osm-")}
    assert len(modules - single) == 12  # "the twelve `features-osm-*.ttl`"
    assert {stem for stem in single if f"`{stem}.ttl`" not in text} == set()
