"""A swarm with its operators in one environment is consistent, and its inferences are right."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from rdflib import OWL, RDF, RDFS, Graph, Literal, Namespace, URIRef
from rdflib.collection import Collection
from rdflib.namespace import PROV, SKOS

from symboslam.errors import ReasonerError
from symboslam.reasoning.axioms import Triple, split
from symboslam.reasoning.hermit import Hermit, find_java
from symboslam.reasoning.parsing import parse

FOLDER = Path(__file__).resolve().parents[2] / "ontology"
SL = Namespace("https://w3id.org/symboslam#")
O4M = Namespace("http://www.semanticweb.org/swarmShepherdingOntology/Onto4MAT#")
OS = Namespace("http://github.com/Alex23013/slam-up/OntoSLAM.owl#")
CORA = Namespace("http://www.semanticweb.org/ontologies/2013/7/CORA.owl#")
EX = Namespace("https://w3id.org/symboslam/examples/swarm#")

REUSED = (  # the 34 terms of Onto4MAT that the SymboSLAM ontology of 2022 names
    "AbilitiesTraits Agent AgentType Artificial Biological Configuration Role Intent Mission Goal "
    "Task Scope IndividualActions Escaping EscapingObstacle EscapingOpponent "
    "UnalignedCollisionEscaping IndividualCovering NoEye Speed Swarm Team TeamActions Contracting "
    "Deforming Expanding Forming Merging Spiral Splitting TeamCovering TeamBarrierCovering "
    "TeamBlanketCovering TeamSweepCovering"
).split()


@pytest.fixture(scope="module", autouse=True)
def _java() -> None:
    try:
        find_java()
    except ReasonerError as error:
        pytest.skip(str(error))


@pytest.fixture(scope="module")
def onto4mat() -> Graph:
    return Graph().parse(FOLDER / "upstream" / "onto4mat.ttl")


@pytest.fixture(scope="module")
def swarm() -> Graph:
    return Graph().parse(FOLDER / "examples" / "swarm.ttl")


@pytest.fixture(scope="module")
def modules() -> dict[str, Graph]:
    """Name -> every module of the ontology."""
    return {
        path.stem: parse(str(path), path.read_bytes())
        for part in (".", "upstream", "alignments")
        for path in sorted((FOLDER / part).glob("*.ttl"))
    }


@pytest.fixture(scope="module")
def closure(modules: dict[str, Graph], swarm: Graph) -> Graph:
    """The whole ontology, and the swarm."""
    graph = sum(modules.values(), Graph()) + swarm
    assert len(graph) > 5000
    return graph


@pytest.fixture(scope="module")
def about_teams(modules: dict[str, Graph], swarm: Graph) -> Graph:
    """The modules that say something about teams, and the swarm; the rest is about features."""
    wanted = ("external", "core", "environments", "map", "team", "terms", "onto4mat", "ontoslam")
    return sum((modules[name] for name in wanted), Graph()) + swarm


def triples(graph: Graph, added: str = "") -> list[Triple]:
    """What the reasoner is given of a graph, with some Turtle added."""
    if added:
        names = {"sl": SL, "o4m": O4M, "os": OS, "cora": CORA, "ex": EX, "owl": OWL}
        head = "".join(f"@prefix {prefix}: <{iri}> .\n" for prefix, iri in names.items())
        graph = graph + Graph().parse(data=head + added)
    declarations, axioms = split(graph)
    return [*declarations, *(triple for axiom in axioms for triple in axiom.triples)]


def members(graph: Graph, kind: URIRef) -> Iterator[list[URIRef]]:
    """The members of each block of a kind, such as ``owl:AllDifferent``."""
    predicate = OWL.distinctMembers if kind == OWL.AllDifferent else OWL.members
    for block in graph.subjects(RDF.type, kind):
        listed = graph.value(block, predicate)
        assert listed is not None
        yield [URIRef(str(member)) for member in Collection(graph, listed)]


@pytest.mark.proof
def test_three_robots_and_two_operators_in_one_environment(closure: Graph, swarm: Graph) -> None:
    robots = set(swarm.subjects(RDF.type, SL.EdgeAgent))
    operators = set(swarm.subjects(RDF.type, SL.Operator))
    assert len(robots) == 3
    assert len(operators) == 2
    assert set(swarm.objects(EX.site, OS.hasAgent)) == robots | operators
    found = Hermit().classify(triples(closure))
    assert found is not None
    assert found.unsatisfiable == frozenset()
    assert str(O4M.Agent) in found.above(str(SL.EdgeAgent))
    assert str(O4M.Team) in found.above(str(O4M.Swarm))
    assert str(O4M.AgentType) not in found.above(str(O4M.Agent))
    assert str(O4M.Agent) not in found.above(str(O4M.IndividualActions))


def test_every_individual_is_different_from_every_other(swarm: Graph) -> None:
    individuals = set(swarm.subjects(RDF.type, OWL.NamedIndividual))
    (different,) = members(swarm, OWL.AllDifferent)
    assert len(different) == len(set(different)) == len(individuals) >= 30
    assert set(different) == individuals


# What upstream got wrong or a user may get wrong; each must be refused together with the swarm.
CLASHES = {
    "upstream: an environment has one agent": "os:hasAgent a owl:FunctionalProperty .",
    "upstream: and shares it with none": "os:inEnvironment a owl:InverseFunctionalProperty .",
    "a robot that is an operator": "ex:rover1 a sl:Operator .",
    "a robot that is a place": "ex:rover1 a o4m:Environment .",
    "a task that is a goal": "ex:map-the-street a o4m:Goal .",
    "an action that is an agent": "ex:seek-the-gate a o4m:Agent .",
    "a line that is a vee": "ex:line a o4m:VeeFormation .",
    "a robot with two headings": "ex:rover1 o4m:hasHeading 1.0e0 .",
    "a question that two ask": "ex:which-way sl:sentBy ex:ada .",
    "a question that answers": "ex:which-way sl:answers ex:why-residential .",
    "an override by a robot": "ex:override1 sl:madeBy ex:rover1 .",
    "an override of two segments": "ex:override1 sl:overriddenSegment ex:s2 ."
    "ex:s2 owl:differentFrom ex:segment1 .",
    "a goal for a role": "ex:every-segment-known o4m:goalForAgent ex:leader .",
}  # fmt: skip


@pytest.mark.proof
@pytest.mark.parametrize("added", CLASHES.values(), ids=CLASHES.keys())
def test_what_must_be_refused(about_teams: Graph, added: str) -> None:
    assert Hermit().clashes([triples(about_teams, added)]) == [True]


# What a reasoner must add to what the swarm states, and what it must not.
FOLLOWS = [
    ("ada", O4M.agentControlsAgent, "rover3"),  # through the base
    ("rover2", O4M.agentControlledByAgent, "ada"),
    ("site", O4M.environmentHasAnEnvironment, "fence"),  # through the grounds
    ("rover2", OS.inEnvironment, "site"),
    ("swarm", O4M.teamHasAgent, "base"),
    ("swarm", SL.hasConfiguration, "line"),
    ("ben", SL.receives, "which-way"),
    ("why-residential", SL.hasAnswer, "because-of-houses"),
    ("override1", PROV.wasAttributedTo, "ada"),
    ("segment1", SL.hasOverride, "override1"),
]
FOLLOWS_NOT = [
    ("ben", O4M.agentControlsAgent, "rover1"),
    ("rover1", O4M.agentControlsAgent, "ada"),
    ("fence", O4M.environmentHasAnEnvironment, "site"),
    ("base", OS.inEnvironment, "site"),
]


@pytest.mark.proof
def test_what_follows_and_what_does_not(about_teams: Graph) -> None:
    """For each statement: is the class of its subject alone below that of all it holds of?"""
    statements = FOLLOWS + FOLLOWS_NOT
    probes = "".join(
        f"<urn:one:{number}> owl:equivalentClass [ a owl:Class ; owl:oneOf ( ex:{one} ) ] .\n"
        f"<urn:all:{number}> owl:equivalentClass [ a owl:Restriction ; owl:onProperty <{along}> ;"
        f" owl:hasValue ex:{other} ] .\n"
        for number, (one, along, other) in enumerate(statements)
    )
    found = Hermit().classify(triples(about_teams, probes))
    assert found is not None
    follows = [f"urn:all:{n}" in found.above(f"urn:one:{n}") for n in range(len(statements))]
    assert follows == [True] * len(FOLLOWS) + [False] * len(FOLLOWS_NOT)


def test_the_reused_terms_are_there_with_words_of_their_own(onto4mat: Graph) -> None:
    assert len(REUSED) == 34
    for term in REUSED:
        assert (O4M[term], RDF.type, OWL.Class) in onto4mat, term
    kinds = (OWL.Class, OWL.ObjectProperty, OWL.DatatypeProperty)
    declared = {
        s for kind in kinds for s in onto4mat.subjects(RDF.type, kind) if isinstance(s, URIRef)
    }
    ours = {s for s in declared if s.startswith(SL)}
    assert ours == {SL.Operator, SL.EdgeAgent, SL.ControlAgent}, "what the paper adds"
    declared -= ours
    assert len(declared) == 60 + 56 + 14
    definitions = set()
    for term in declared:
        assert term.startswith(O4M), "team.ttl is the place for other terms of ours"
        for predicate in (RDFS.label, SKOS.definition, RDFS.isDefinedBy):
            assert len(list(onto4mat.objects(term, predicate))) == 1, (term, predicate)
        definitions.add(onto4mat.value(term, SKOS.definition))
    assert len(definitions) == len(declared)
    assert list(onto4mat.subject_objects(OWL.equivalentClass)) == []


def test_every_object_property_has_an_inverse(onto4mat: Graph) -> None:
    pairs = [
        (one, other)
        for one, other in onto4mat.subject_objects(OWL.inverseOf)
        if isinstance(one, URIRef) and isinstance(other, URIRef)
    ]
    assert len(pairs) == 28
    assert len({p for pair in pairs for p in pair}) == 56
    for one, other in pairs:
        assert onto4mat.value(one, RDFS.domain) == onto4mat.value(other, RDFS.range)
        assert onto4mat.value(one, RDFS.range) == onto4mat.value(other, RDFS.domain)


def test_figures_of_the_swarm_are_those_of_its_positions(swarm: Graph) -> None:
    def value(who: URIRef, what: str) -> float:
        found = swarm.value(who, O4M[what])
        assert isinstance(found, Literal)
        return float(found)

    robots = [EX.rover1, EX.rover2, EX.rover3]
    x = sorted(value(robot, "xLocation") for robot in robots)
    assert x == [-10, 0, 10]
    assert value(EX.swarm, "hasTeamCohesion") == pytest.approx(20 / 3, abs=0.05)
    assert value(EX.swarm, "hasTeamSeparation") == pytest.approx(40 / 3, abs=0.05)
    assert value(EX.swarm, "hasSeparationToNearestNeighbour") == 10
    assert (
        value(EX.rover1, "hasDistanceToGoal") == value(EX["every-segment-known"], "xLocation") - 10
    )
    members_stated = set(swarm.subjects(O4M.agentMemberOfTeam, EX.swarm))
    assert value(EX.swarm, "hasTeamMembers") == len(members_stated) == 4


def test_the_override_says_who_what_when_and_why(swarm: Graph) -> None:
    override = EX.override1
    assert swarm.value(override, SL.madeBy) == EX.ada
    assert swarm.value(override, SL.overriddenSegment) == EX.segment1
    assert swarm.value(override, SL.environmentGiven) == SL.CommunityFacility
    assert (override, PROV.generatedAtTime, None) in swarm
    assert (override, SL.overrideReason, None) in swarm
