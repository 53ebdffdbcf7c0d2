"""The OntoSLAM module: explained terms, repairs that hold, the authors' data."""

from __future__ import annotations

import gzip
import os
from collections import Counter
from pathlib import Path

import pytest
from rdflib import OWL, RDF, RDFS, SKOS, XSD, Graph, Literal, Namespace, URIRef
from rdflib.term import Node

from symboslam.errors import OntologyError, ReasonerError
from symboslam.reasoning.axioms import split
from symboslam.reasoning.hermit import Hermit, find_java

FOLDER = Path(__file__).parents[2] / "ontology"
SHARED = Path(os.environ.get("SYMBOSLAM_SHARED", Path(__file__).parents[3] / "shared"))
TURTLEBOT = SHARED / "data" / "ontoslam_abox" / "turtlebot_map_1713.ttl.gz"

PREFIXES = {
    "os": Namespace("http://github.com/Alex23013/slam-up/OntoSLAM.owl#"),
    "fr": Namespace("http://github.com/Alex23013/slam-up/FortesRey.owl#"),
    "isro": Namespace("http://github.com/Alex23013/slam-up/ISRO.owl#"),
    "cora": Namespace("http://www.semanticweb.org/ontologies/2013/7/CORA.owl#"),
    "kn": Namespace("http://knowrob.org/kb/knowrob.owl#"),
}
OS, FR, CORA = PREFIXES["os"], PREFIXES["fr"], PREFIXES["cora"]
E = Namespace("https://example.org/")
HEAD = "".join(
    f"PREFIX {p}: <{n}>\n"
    for p, n in {**PREFIXES, "e": E, "owl": OWL, "rdfs": RDFS, "xsd": XSD}.items()
)

# The 24 that the SymboSLAM ontology of 2022 names.
REUSED = """
os:AbstractThing os:Axis os:Box os:Color os:Cylinder os:Dimension os:FeatureThing os:HeightMap
os:Mobile os:OccupancyGrid os:Plane os:Pose os:Position os:Reconfigurable os:Shape os:Sphere
os:State os:TranslationMeasure os:UndefinedShape fr:CartesianPositionPoint isro:RotationMatrix
isro:TemporalThing cora:OrientationMeasure cora:OrientationValue
""".split()
CLASSES = """
os:Thing os:PhysicalThing os:PositionalThing os:Probability os:CovarianceMatrix os:MatrixElement
os:Part os:AtomicPart os:BasePart os:Sensor os:StructuralModel os:Visual os:Action os:TemporalThing
os:Joint os:Height os:Width os:Depth isro:Agent isro:TimePoint cora:Robot cora:AutonomousRobot
cora:RobotGroup cora:Environment cora:PositionPoint cora:CoordinateSystem cora:Operator
fr:CartesianCoordinateSystem kn:SpaceRegion kn:FrameOfReference
""".split()
LINKS = """
os:hasPosition os:hasTranslation os:hasOrientation os:hasPose os:hasProbability os:hasMatrixValue
os:hasShape os:hasModel os:hasPart os:hasVisual os:isMobile os:isReconfigurable os:hasState
os:inEnvironment os:hasAgent os:hasRelativePosition os:hasParent os:hasChild os:hasDimension
os:belongs_to kn:near kn:isInsideOf kn:isNextTo kn:isLeftOf kn:isRightOf kn:isInFrontOf
kn:isBehindOf kn:isAboveOf kn:isBelowOf fr:posAtTime cora:in cora:ofCS
""".split()
NUMBERS = """
os:hasNumberValue os:hasValue os:hasStamp os:has_resolution os:componentRow os:componentCol
os:componentValue fr:cartesianX fr:cartesianY fr:cartesianZ cora:componentX cora:componentY
cora:componentZ cora:componentW cora:mobileValue
""".split()


def iri(name: str) -> URIRef:
    prefix, local = name.split(":")
    return PREFIXES[prefix][local]


@pytest.fixture(scope="module")
def module() -> Graph:
    return Graph().parse(FOLDER / "upstream" / "ontoslam.ttl")


@pytest.fixture(scope="module")
def alignment() -> Graph:
    return Graph().parse(FOLDER / "alignments" / "ontoslam-data.ttl")


@pytest.fixture(scope="module")
def hermit() -> Hermit:
    try:
        find_java()
    except ReasonerError:
        pytest.skip("no Java: pip install 'symboslam[reasoner]'")
    return Hermit()


def consistent(hermit: Hermit, *graphs: Graph) -> bool:
    """Whether the axioms of some graphs can all hold."""
    merged = Graph()
    for graph in graphs:
        merged += graph
    declarations, axioms = split(merged)
    triples = [*declarations, *(t for axiom in axioms for t in axiom.triples)]
    return not hermit.clashes([triples])[0]


def facts(text: str) -> Graph:
    return Graph().parse(data=HEAD + text, format="turtle")


def declared(graph: Graph) -> set[URIRef]:
    """Classes and properties."""
    kinds = (OWL.Class, OWL.ObjectProperty, OWL.DatatypeProperty)
    found = {s for kind in kinds for s in graph.subjects(RDF.type, kind)}
    return {s for s in found if isinstance(s, URIRef)}


@pytest.mark.parametrize(
    ("names", "kind", "count"),
    [
        (REUSED, OWL.Class, 24),
        (CLASSES, OWL.Class, 30),
        (LINKS, OWL.ObjectProperty, 32),
        (NUMBERS, OWL.DatatypeProperty, 15),
    ],
)
def test_every_listed_term_is_there(
    module: Graph, names: list[str], kind: URIRef, count: int
) -> None:
    assert len(set(names)) == count
    assert [name for name in names if (iri(name), RDF.type, kind) not in module] == []


def test_every_term_is_explained(module: Graph, alignment: Graph) -> None:
    assert len(declared(module)) > 100
    assert len(declared(alignment)) == 13
    assert declared(module) & declared(alignment) == set()
    for graph in (module, alignment):
        for about in (RDFS.label, SKOS.definition):
            texts = {term: list(graph.objects(term, about)) for term in declared(graph)}
            assert [t for t, found in texts.items() if len(found) != 1] == []
            words = [found[0] for found in texts.values()]
            assert {w.language for w in words if isinstance(w, Literal)} == {"en"}
            assert [w for w, n in Counter(map(str, words)).items() if n > 1] == []
        for term in declared(graph):
            home = str(graph.value(term, RDFS.isDefinedBy))
            assert str(term).startswith(home + "#"), term
            assert str(graph.value(term, SKOS.definition)).endswith("."), term


def test_every_spelling_of_the_data_stands_below_a_term(module: Graph, alignment: Graph) -> None:
    along = (RDFS.subClassOf, RDFS.subPropertyOf)
    above = {t: {o for p in along for o in alignment.objects(t, p)} for t in declared(alignment)}
    assert above.pop(OS.hasRGBValue) == set()  # a text, which nothing in the module is
    for term, found in above.items():
        (one,) = found
        kind = alignment.value(term, RDF.type)
        assert (one, RDF.type, kind) in module, term
        assert alignment.value(term, RDFS.comment), term


TWO_ROBOTS = """
e:town a cora:Environment ; os:hasAgent e:first , e:second .
e:first a cora:Robot ; os:inEnvironment e:town .
e:second a cora:Robot ; os:inEnvironment e:town ; owl:differentFrom e:first .
"""


def test_two_robots_share_an_environment(hermit: Hermit, module: Graph) -> None:
    robots = facts(TWO_ROBOTS)
    assert consistent(hermit, module, robots)
    published = Graph().add((OS.hasAgent, RDF.type, OWL.FunctionalProperty))
    assert not consistent(hermit, module, robots, published)
    published = Graph().add((OS.inEnvironment, RDF.type, OWL.InverseFunctionalProperty))
    assert not consistent(hermit, module, robots, published)


def test_all_classes_can_have_members(hermit: Hermit, module: Graph, alignment: Graph) -> None:
    declarations, axioms = split(module + alignment)
    found = hermit.classify([*declarations, *(t for axiom in axioms for t in axiom.triples)])
    assert found is not None
    assert found.unsatisfiable == frozenset()
    assert str(FR.CartesianPositionPoint) in found.above(str(FR.cartesianPositionPoint))


@pytest.mark.parametrize("value", ["0.04", "4e-2", "1"])
def test_elements_of_matrices_can_be(hermit: Hermit, module: Graph, value: str) -> None:
    """The published file wants a value that is an owl:real and an xsd:double, which none is."""
    element = f"e:m a os:MatrixElement ; os:componentRow 0 ; os:componentValue {value} "
    assert consistent(hermit, module, facts(element + "."))
    assert not consistent(hermit, module, facts(element + ", 7 ."))
    published = facts("os:MatrixElement rdfs:subClassOf [ a owl:Restriction ;"
                      " owl:onProperty os:componentValue ; owl:someValuesFrom owl:real ] ."
                      " os:componentValue rdfs:range xsd:double .")  # fmt: skip
    assert not consistent(hermit, module, published, facts(element + "."))


def test_a_landmark_with_a_position_is_no_structural_model(hermit: Hermit, module: Graph) -> None:
    """What the published file infers would even clash here: a part takes up room, a model none."""
    landmark = facts("e:tree a os:Part ; os:hasPosition e:there .")
    assert consistent(hermit, module, landmark)
    published = Graph().add((OS.hasPosition, RDFS.domain, OS.StructuralModel))
    assert not consistent(hermit, module, landmark, published)


@pytest.mark.parametrize(
    "data",
    [
        "e:robot a cora:Robot , os:Position .",
        "e:point a cora:PositionPoint ; cora:in e:a , e:b . e:a owl:differentFrom e:b .",
        "e:robot a cora:Robot ; os:hasPose e:pose . e:pose a os:Joint .",
        "e:there os:hasTranslation e:point . e:point a fr:CartesianPositionPoint ;"
        " fr:cartesianX 1.0 , 2.0 .",
        "e:m a os:MatrixElement ; os:componentRow -1 .",
    ],
)
def test_nonsense_is_refused(hermit: Hermit, module: Graph, data: str) -> None:
    assert not consistent(hermit, module, facts(data))


@pytest.fixture(scope="module")
def turtlebot() -> Graph:
    if not TURTLEBOT.is_file():
        pytest.skip("the published data of OntoSLAM is in the shared data folder, which is absent")
    return Graph().parse(data=gzip.decompress(TURTLEBOT.read_bytes()), format="turtle")


@pytest.fixture(scope="module")
def entailed(turtlebot: Graph, module: Graph, alignment: Graph) -> Graph:
    """The data with what follows by subclasses and subproperties."""
    terms, found = module + alignment, turtlebot + Graph()

    def above(term: Node, along: URIRef) -> list[Node]:
        return [t for t in terms.transitive_objects(term, along) if isinstance(t, URIRef)]

    for s, p, o in turtlebot:
        for wider in above(o, RDFS.subClassOf) if p == RDF.type else ():
            found.add((s, p, wider))
        for wider in above(p, RDFS.subPropertyOf):
            found.add((s, wider, o))
    return found


def rows(graph: Graph, query: str) -> set[tuple[Node, ...]]:
    return {tuple(row) for row in graph.query(HEAD + query)}  # type: ignore[arg-type]


def test_every_term_of_the_data_is_known(turtlebot: Graph, module: Graph, alignment: Graph) -> None:
    used = {*turtlebot.predicates(), *turtlebot.objects(None, RDF.type)} - {RDF.type}
    assert len(used) > 50
    assert used - declared(module) - declared(alignment) == set()


def test_positions_of_map_objects(turtlebot: Graph, entailed: Graph) -> None:
    """Our terms find on the entailed data what the authors' spellings find on the plain data."""
    ask = """SELECT ?object ?x ?y WHERE {{ ?joint os:hasChild ?object . ?object os:hasPosition ?p .
        ?p os:hasTranslation ?point . ?point {0}:cartesianX ?x ; {0}:cartesianY ?y }}"""
    found = rows(entailed, ask.format("fr"))
    assert len({thing for thing, _, _ in found}) == len(found) == 3084
    assert found == rows(turtlebot, ask.format("cora"))
    assert rows(turtlebot, ask.format("fr")) == set()
    assert {thing for thing, _, _ in found} < set(entailed.subjects(RDF.type, OS.Part))
    assert len(set(entailed.subjects(RDF.type, FR.CartesianPositionPoint))) == 3085


ROBOT = "?robot a isro:Agent ; os:hasModel/os:hasPart ?base . ?base os:hasPosition ?p . "


@pytest.mark.parametrize(
    ("chosen", "pattern", "expected"),
    [
        (
            "?x ?stamp",
            "?p os:hasTranslation/fr:cartesianX ?x ; fr:posAtTime/os:hasStamp ?stamp",
            {("-1.99504742589", "57385000000")},
        ),
        ("?w", "?p os:hasOrientation/cora:componentW ?w", {("0.972735779913",)}),
        (
            "?row ?column ?value",
            "?p os:hasProbability/os:hasMatrixValue ?matrix . ?cell os:belongs_to ?matrix ;"
            " os:componentRow ?row ; os:componentCol ?column ; os:componentValue ?value",
            {("0", "0", "1e-05"), ("1", "1", "1e-05"), ("2", "2", "1e+12"), ("3", "3", "1e+12"),
             ("4", "4", "1e+12"), ("5", "5", "0.001")},
        ),
    ],
)  # fmt: skip
def test_the_robot_of_the_data(
    entailed: Graph, chosen: str, pattern: str, expected: set[tuple[str, ...]]
) -> None:
    """Values as they stand in the file."""
    found = rows(entailed, f"SELECT {chosen} WHERE {{ {ROBOT} {pattern} }}")
    assert {tuple(map(str, row)) for row in found} == expected


def test_the_data_is_consistent(
    hermit: Hermit, turtlebot: Graph, module: Graph, alignment: Graph
) -> None:
    """Once its numbers have types that have literals; owl:real and NonNegativeInteger have none."""
    as_published = facts("e:x fr:cartesianX '1.5'^^owl:real .")
    with pytest.raises(OntologyError, match="outside OWL 2 DL"):
        consistent(hermit, module, as_published)
    typed = {t for t in module + alignment if t[1] != OWL.imports}
    for s, p, o in turtlebot:
        if isinstance(o, Literal) and o.datatype not in (XSD.string, XSD.boolean):
            whole = str(o).isdecimal()
            o = Literal(str(o), datatype=XSD.nonNegativeInteger if whole else XSD.double)
        typed.add((s, p, o))
    assert hermit.clashes([typed]) == [False]
