"""The checks of ontology/checks: none finds a fault in our modules, each finds what it is for."""

from __future__ import annotations

from pathlib import Path

import pyoxigraph
import pytest

FOLDER = Path(__file__).resolve().parents[2] / "ontology"
CHECKS = sorted((FOLDER / "checks").glob("*-violation.rq"))

PREFIXES = """
@prefix : <https://example.org/> .
@prefix sl: <https://w3id.org/symboslam#> .
@prefix dcterms: <http://purl.org/dc/terms/> .
@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix prov: <http://www.w3.org/ns/prov#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
@prefix skos: <http://www.w3.org/2004/02/skos/core#> .
"""
INDICATION = """
:Hut rdfs:subClassOf [ owl:onProperty sl:indicates ; owl:someValuesFrom :Wood ] .
[] owl:annotatedSource :Hut ; owl:annotatedProperty rdfs:subClassOf ;
   owl:annotatedTarget [ owl:onProperty sl:indicates ; owl:someValuesFrom :Wood ] ;
"""
BAD = {
    "place-restriction": ":A rdfs:subClassOf sl:Place , [ owl:onProperty :near ; "
    "owl:someValuesFrom :B ] .",
    "annotation-of-nothing": INDICATION + "a owl:Axiom .",
    "class-cycle": ":A rdfs:subClassOf :B . :B rdfs:subClassOf :A .",
    "definition-copied": ':A skos:definition "A hut."@en . :B skos:definition "A hut."@en .',
    "definition-equals-label": ':A rdfs:label "Hut"@en ; skos:definition "A hut."@en .',
    "definition-missing": ':A a owl:ObjectProperty ; rdfs:label "has hut"@en .',
    "definition-multiple": ':A skos:definition "A hut."@en , "A small hut."@en .',
    "definition-unfinished": ':A skos:definition "A hut"@en .',
    "environment-without-colour": ':A rdfs:subClassOf sl:Environment ; sl:colour "red" .',
    "environment-without-scheme": ":A rdfs:subClassOf sl:Environment ; skos:inScheme :Unknown .",
    "feature-is-place": ":A rdfs:subClassOf sl:Feature , :B . :B rdfs:subClassOf sl:Environment . "
    "sl:Environment rdfs:subClassOf sl:Place .",
    "feature-neither-static-nor-dynamic": ":A rdfs:subClassOf :B . :B rdfs:subClassOf sl:Feature .",
    "header-history": ':A a owl:Ontology ; skos:changeNote "Second version."@en .',
    "header-incomplete": ':A a owl:Ontology ; dcterms:title "Huts"@en ; owl:versionInfo "1" .',
    "header-scope": ':A a owl:Ontology ; rdfs:comment "Scope: huts."@en .',
    "header-version": ':A a owl:Ontology ; owl:versionInfo "0.2.0" ; '
    "owl:versionIRI <https://example.org/0.1.0/huts> .",
    "import-unknown": ":A a owl:Ontology ; owl:imports :B .",
    "indication-stated-twice": INDICATION + "sl:strength 0.5 , 0.7 .",
    "indication-strength": INDICATION + "sl:strength 1.5 .",
    "indication-without-reason": INDICATION + "sl:strength 0.5 .",
    "indication-without-source": INDICATION + "sl:strength 0.5 .",
    "indication-without-strength": INDICATION + 'rdfs:comment "Huts stand in woods."@en .',
    "label-language": ':A a owl:Class ; rdfs:label "Hut" .',
    "label-missing": ':A a owl:NamedIndividual ; skos:definition "A hut."@en .',
    "label-multiple": ':A a owl:Class ; rdfs:label "Hut"@en , "Shed"@en .',
    "property-cycle": ":A rdfs:subPropertyOf :B . :B rdfs:subPropertyOf :A .",
    "property-with-two-domains": ":A rdfs:domain :B , :C .",
    "property-with-two-ranges": ":A rdfs:range :B , :C .",
    "reason-copied": INDICATION
    + 'sl:strength 0.5 ; rdfs:comment "Huts stand there."@en .'
    + INDICATION.replace("Hut", "Shed")
    + 'sl:strength 0.5 ; rdfs:comment "Huts stand there."@en .',
    "reason-unfinished": INDICATION + 'sl:strength 0.5 ; rdfs:comment "Huts stand there"@en .',
    "source-undescribed": INDICATION + "sl:strength 0.5 ; prov:wasDerivedFrom :A . "
    ':A a prov:Entity ; rdfs:label "Of huts"@en .',
    "term-undeclared": ":A rdfs:seeAlso sl:Hut .",
    "term-without-origin": ":A a owl:Class ; skos:definition 'A hut.'@en .",
}
"""Check -> a graph in which it must find a violation."""
STRENGTHS = {"0": True, "-0.1": True, '"0.5"': True, '"x"': True, "1.01": True, "1": False,
             "0.001": False, "1.0e0": False}  # fmt: skip


def name(check: Path) -> str:
    """The rule that a file checks, in short."""
    return check.name.removesuffix("-violation.rq")


def rows(check: Path, store: pyoxigraph.Store) -> list[tuple[str, str]]:
    """(term, problem) of each violation."""
    found = store.query(check.read_text(encoding="utf-8"), use_default_graph_as_union=True)
    assert isinstance(found, pyoxigraph.QuerySolutions)
    assert [variable.value for variable in found.variables] == ["term", "problem"]
    return [(str(row["term"]), str(row["problem"])) for row in found]


def loaded(text: str) -> pyoxigraph.Store:
    store = pyoxigraph.Store()
    store.load(PREFIXES + text, format=pyoxigraph.RdfFormat.TURTLE)
    return store


@pytest.fixture(scope="module")
def modules() -> pyoxigraph.Store:
    """All modules, shapes and examples of the ontology, each in a graph of its own."""
    store = pyoxigraph.Store()
    folders = (".", "upstream", "alignments", "shapes", "examples")
    for path in (path for folder in folders for path in (FOLDER / folder).glob("*.ttl")):
        store.load(
            path=path,
            format=pyoxigraph.RdfFormat.TURTLE,
            base_iri="https://w3id.org/symboslam/",
            to_graph=pyoxigraph.NamedNode(path.as_uri()),
        )
    return store


def test_there_are_checks_and_each_has_a_bad_graph() -> None:
    assert len(CHECKS) >= 30
    assert set(BAD) == {name(check) for check in CHECKS}


def test_the_modules_were_read(modules: pyoxigraph.Store) -> None:
    assert len(set(modules.named_graphs())) >= 40
    assert len(modules) > 15_000


@pytest.mark.parametrize("check", CHECKS, ids=name)
def test_a_check_begins_with_its_rule(check: Path) -> None:
    rule = check.read_text(encoding="utf-8").splitlines()[0]
    assert rule.startswith("# ")
    assert rule.endswith(".")
    assert len(rule.split()) > 4


@pytest.mark.parametrize("check", CHECKS, ids=name)
def test_no_module_violates_a_check(check: Path, modules: pyoxigraph.Store) -> None:
    assert rows(check, modules) == []


@pytest.mark.parametrize("check", CHECKS, ids=name)
def test_a_check_finds_what_it_is_made_for(check: Path) -> None:
    found = rows(check, loaded(BAD[name(check)]))
    assert found, "no violation is found in the bad graph"
    for term, problem in found:
        assert term.startswith(("<https://example.org/", "<https://w3id.org/symboslam#Hut")), term
        assert len(problem) > 10


@pytest.mark.parametrize(("strength", "is_bad"), STRENGTHS.items())
def test_strengths_at_the_limits(strength: str, is_bad: bool) -> None:
    check = FOLDER / "checks" / "indication-strength-violation.rq"
    assert bool(rows(check, loaded(f"{INDICATION} sl:strength {strength} ."))) is is_bad


def test_a_complete_indication_violates_nothing() -> None:
    store = loaded(
        INDICATION
        + 'sl:strength 0.5 ; rdfs:comment "Huts stand in woods."@en ; prov:wasDerivedFrom :Book .'
        ":Book a prov:Entity ; rdfs:label 'Of huts'@en ; rdfs:seeAlso <https://example.org/book> ."
    )
    about = [c for c in CHECKS if name(c).startswith(("indication", "reason", "source"))]
    assert len(about) == 8
    assert {name(check): found for check in about if (found := rows(check, store))} == {}


def test_a_feature_that_is_static_and_dynamic_is_found() -> None:
    check = FOLDER / "checks" / "feature-neither-static-nor-dynamic-violation.rq"
    store = loaded(":A rdfs:subClassOf sl:StaticFeature , sl:DynamicFeature .")
    assert [term for term, _ in rows(check, store)] == ["<https://example.org/A>"]
