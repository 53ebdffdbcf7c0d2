"""Every shape lets good examples pass and finds the one thing that is wrong in each bad one."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from rdflib import DCTERMS, OWL, RDF, RDFS, SH, SKOS, XSD, Graph, URIRef
from rdflib.term import Node

pytest.importorskip("pyshacl", reason="pySHACL comes with symboslam[shapes]")
from symboslam.engine.validate import bundled_shapes, validate_map

FOLDER = Path(__file__).parents[2] / "ontology" / "shapes"
MODULES = sorted(FOLDER.glob("*.ttl"))
VALID = sorted((FOLDER / "examples").glob("valid_*.ttl"))
INVALID = sorted((FOLDER / "examples").glob("invalid_*.ttl"))
DOCUMENTS = "https://w3id.org/symboslam/shapes/"
EXAMPLE = "https://example.org/"
WKT_LITERAL = "http://www.opengis.net/ont/geosparql#wktLiteral"


def stem(path: Path) -> str:
    return path.stem


def claim(path: Path) -> tuple[str, str]:
    """(node, message) that an invalid example names in its head."""
    head = path.read_text(encoding="utf-8").partition("\n\n")[0]
    found = re.fullmatch(
        r"# Invalid: .+\n# Breaks {3}(?P<message>.+)\n# Node {5}ex:(?P<node>.+)", head
    )
    assert found, f"{path.name}: the head does not say what is broken"
    return EXAMPLE + found["node"], found["message"]


def says(message: str, text: str) -> bool:
    """Whether a text is a rule's message, its ``{?variables}`` filled in."""
    parts = re.split(r"\{\?\w+\}", message)
    return re.fullmatch(".+".join(map(re.escape, parts)), text) is not None


def rules() -> Iterator[tuple[Node, str]]:
    """(shape or SPARQL constraint, message) of every rule; an ``or`` of rules counts as one."""
    shapes = bundled_shapes()
    for rule, message in shapes.subject_objects(SH.message):
        yield rule, str(message)


def test_there_are_examples() -> None:
    assert len(MODULES) >= 7
    assert len(VALID) >= 7
    assert len(INVALID) >= 50
    others = {p.name for p in (FOLDER / "examples").iterdir()} - {
        p.name for p in (*VALID, *INVALID)
    }
    assert not others


@pytest.mark.parametrize("path", MODULES, ids=stem)
def test_every_shape_file_has_a_complete_header(path: Path) -> None:
    graph, document = Graph().parse(path), URIRef(DOCUMENTS + path.stem)
    assert set(graph.subjects(RDF.type, OWL.Ontology)) == {document}
    for predicate in (DCTERMS.title, DCTERMS.description, DCTERMS.creator, DCTERMS.license):
        assert graph.value(document, predicate), predicate
    assert "Design choice:" in str(graph.value(document, RDFS.comment))
    version = graph.value(document, OWL.versionInfo)
    assert graph.value(document, OWL.versionIRI) == URIRef(
        f"https://w3id.org/symboslam/{version}/shapes/{path.stem}"
    )
    assert graph.value(document, OWL.priorVersion) or graph.value(document, SKOS.changeNote)
    imported = {str(o) for o in graph.objects(document, OWL.imports)}
    assert imported <= {DOCUMENTS + other.stem for other in MODULES}


def test_the_whole_imports_every_part() -> None:
    graph = Graph().parse(FOLDER / "map.ttl")
    imported = {str(o).removeprefix(DOCUMENTS) for o in graph.objects(None, OWL.imports)}
    assert imported == {path.stem for path in MODULES} - {"map"}


def test_every_part_imports_what_it_refers_to() -> None:
    graphs = {path.stem: Graph().parse(path) for path in MODULES}
    for name, graph in graphs.items():
        reached = graph + Graph()
        for imported in graph.objects(None, OWL.imports):
            reached += graphs[str(imported).removeprefix(DOCUMENTS)]
        shapes = {s for s in reached.subjects(RDF.type, None) if str(s).startswith(DOCUMENTS)}
        used = {o for p in (SH.property, SH.node, SH.prefixes) for o in graph.objects(None, p)}
        assert {o for o in used if isinstance(o, URIRef)} <= shapes, name


def test_shapes_speak_of_declared_terms_only() -> None:
    ontology = Graph()
    for module in (*FOLDER.parent.glob("*.ttl"), *FOLDER.parent.glob("upstream/*.ttl")):
        ontology.parse(module)
    declared = {s for s in ontology.subjects(RDF.type, None) if isinstance(s, URIRef)}
    shapes = bundled_shapes()
    outside = (str(SH), str(RDF), str(RDFS), str(OWL), str(XSD), str(SKOS), DOCUMENTS)
    used = {o for _, p, o in shapes if str(p).startswith(str(SH))}
    used |= set(shapes.objects(None, RDF.first))
    used = {o for o in used if isinstance(o, URIRef) and not str(o).startswith(outside)}
    assert len(used) > 40
    assert {str(o) for o in used - declared} <= {WKT_LITERAL}


def test_each_rule_has_a_message_of_its_own() -> None:
    messages = [message for _, message in rules()]
    assert len(messages) > 50
    assert len(set(messages)) == len(messages)


@pytest.mark.parametrize("path", VALID, ids=stem)
def test_valid_examples_conform(path: Path) -> None:
    assert path.read_text(encoding="utf-8").startswith("# Valid: ")
    assert str(validate_map(path)) == "The map conforms to the shapes."


@pytest.mark.parametrize("path", sorted((FOLDER.parent / "examples").glob("*.ttl")), ids=stem)
def test_examples_of_the_ontology_conform(path: Path) -> None:
    assert str(validate_map(path)) == "The map conforms to the shapes."


def test_every_kind_of_agent_passes_for_one() -> None:
    """Data carry no subclass axioms, so that a shape lists the kinds; none may be missing."""
    ontology = Graph()
    for module in (*FOLDER.parent.glob("*.ttl"), *FOLDER.parent.glob("upstream/*.ttl")):
        ontology.parse(module)
    agent = URIRef("http://www.w3.org/ns/prov#Agent")
    kinds = {k for k in ontology.transitive_subjects(RDFS.subClassOf, agent) if k != agent}
    assert len(kinds) > 10
    text = (FOLDER / "examples" / "valid_collective_map.ttl").read_text(encoding="utf-8")
    for kind in (agent, *kinds):
        said = text.replace("a sl:EdgeAgent", f'a <{kind}> ; owl:versionInfo "1"')
        graph = Graph().parse(data=said, format="turtle")
        assert validate_map(graph).conforms, kind


@pytest.mark.parametrize("path", INVALID, ids=stem)
def test_invalid_examples_break_the_one_rule_that_they_name(path: Path) -> None:
    found = [(v.node, v.message) for v in validate_map(path).violations]
    assert found == [claim(path)]


def test_every_rule_is_broken_by_an_invalid_example() -> None:
    said = [claim(path)[1] for path in INVALID]
    assert [m for _, m in rules() if not any(says(m, text) for text in said)] == []


def test_every_node_shape_has_a_valid_and_an_invalid_example() -> None:
    """The class that a shape is for has members in both; one without a target serves another."""
    shapes = bundled_shapes()
    valid = [Graph().parse(path) for path in VALID]
    invalid = {path: Graph().parse(path) for path in INVALID}
    targets = {s: set(shapes.objects(s, SH.targetClass)) for s in shapes.subjects(SH.targetClass)}
    assert len(targets) >= 20
    for shape, classes in targets.items():
        for target in classes:
            assert any((None, RDF.type, target) in graph for graph in valid), (shape, target)
        own = [str(m) for m in shapes.objects(shape, SH.message)]
        own += [str(m) for m in shapes.objects(shape, SH.property / SH.message)]
        own += [str(m) for m in shapes.objects(shape, SH.sparql / SH.message)]
        assert any(
            says(message, claim(path)[1])
            and any((URIRef(claim(path)[0]), RDF.type, target) in graph for target in classes)
            for path, graph in invalid.items()
            for message in own
        ), f"no invalid example for {shape}"
    named = {s for s in shapes.subjects(RDF.type, SH.NodeShape) if isinstance(s, URIRef)}
    serving = named - set(targets)
    assert {s for s in serving if (None, SH.node, s) not in shapes} == set()


def test_every_property_that_a_shape_names_is_in_a_valid_example() -> None:
    shapes = bundled_shapes()
    graph = Graph()
    for file in VALID:
        graph.parse(file)
    for shape in set(shapes.subjects(SH.targetClass)):
        members = {
            m for t in shapes.objects(shape, SH.targetClass) for m in graph.subjects(RDF.type, t)
        }
        for path in shapes.objects(shape, SH.property / SH.path):
            if isinstance(path, URIRef):
                assert any((m, path, None) in graph for m in members), (shape, path)
