"""Justifications agree with ROBOT's, which come from other code and another search."""

from __future__ import annotations

import os
import re
import subprocess
from pathlib import Path

import pytest
from rdflib import OWL

from symboslam.reasoning import sources
from symboslam.reasoning.why import why

ROOT = Path(__file__).parents[2]
ROBOT = ROOT / "scripts" / "robot"
PIZZA = ROOT.parent / "shared" / "data" / "oops-cases" / "input" / "pizza.owl"
PIZZA_IRI = "https://raw.githubusercontent.com/owlcs/pizza-ontology/refs/heads/master/pizza.owl#"
SL_IRI = "https://w3id.org/symboslam#"
ROBOTS_LIMIT, OUR_LIMIT = 30, 2

PIZZAS = [
    "IceCream is unsatisfiable",
    "CheeseyVegetableTopping is unsatisfiable",
    "American SubClassOf CheeseyPizza",
    "CajunSpiceTopping SubClassOf SpicyTopping",
    "CheeseTopping SubClassOf VegetarianTopping",
    "Country SubClassOf DomainConcept",
    "FruitTopping SubClassOf VegetarianTopping",
    "MeatyPizza SubClassOf NonVegetarianPizza",
    "RealItalianPizza SubClassOf ThinAndCrispyPizza",
    "Napoletana SubClassOf RealItalianPizza",
    "SpicyTopping SubClassOf PizzaTopping",
    "HotGreenPepperTopping SubClassOf SpicyTopping",
]
OURS = [
    "House SubClassOf Feature",
    "House indicates Residential",
    "SoccerGoals indicates CommunityFacility",
    "SoccerGoals indicates ParksAndRecreation",
    "SoccerGoals indicates SportsGround",
    "Silo indicates Industrial",
    "Cat indicates Residential",
    "Airplane indicates CommunityFacility",
    "RZ1 SubClassOf Place",
    "Train indicates TransportAndServices",
    "Warehouse SubClassOf StaticFeature",
    "Airport SubClassOf Place",
]


def robot(*arguments: str | Path) -> None:
    done = subprocess.run([ROBOT, *arguments], capture_output=True, text=True, check=False)
    if done.returncode == 3:
        # CI has Java and Maven: a proof that is not made there is no proof.
        (pytest.fail if os.environ.get("CI") else pytest.skip)(done.stderr.strip())
    assert done.returncode == 0, done.stdout + done.stderr


def robots_sets(question: str, ontology: Path, prefix: str, folder: Path) -> set[frozenset[str]]:
    """The justifications of ``robot explain``, each axiom as the names in it."""
    out = folder / "explanation.md"
    common = (
        "--input",
        ontology,
        "--reasoner",
        "HermiT",
        "--max",
        str(ROBOTS_LIMIT),
        "--explanation",
        out,
    )
    if question.endswith("is unsatisfiable"):
        robot("explain", *common, "-M", "unsatisfiability", "--unsatisfiable", "all")
        name = question.split()[0]
        wanted = rf"## \[[^]]*\]\({re.escape(prefix + name)}\) SubClassOf \[Nothing\]"
    else:
        sub, verb, sup = question.split()
        says = f"p:{sub} SubClassOf p:indicates some p:{sup}" if verb == "indicates" else (
            f"p:{sub} SubClassOf p:{sup}"
        )  # fmt: skip
        robot("--prefix", f"p: {prefix}", "explain", *common, "--axiom", says)
        wanted = "## "
    parts = re.split(r"^(?=## \[)", out.read_text().partition("# Axiom Impact")[0], flags=re.M)
    return {
        frozenset(
            " ".join(sorted(set(re.findall(r"\]\(([^)]+)\)", line))))
            for line in part.splitlines()
            if line.lstrip().startswith("- ")
        )
        for part in parts
        if re.match(wanted, part)
    }


def agree(question: str, ontology: Path, expected: set[frozenset[str]]) -> None:
    assert 0 < len(expected) < ROBOTS_LIMIT, "choose a question with fewer justifications"
    found = why(question, ontology, limit=OUR_LIMIT)
    ours = {
        frozenset(" ".join(sorted(stated.axiom.signature)) for stated in axioms)
        for axioms in found.sets
    }
    assert ours <= expected
    assert len(ours) == len(found.sets)
    assert ours == expected if found.complete else len(ours) == OUR_LIMIT


@pytest.fixture(scope="module")
def merged(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The part of our ontology that decides what features indicate, in one file."""
    path = tmp_path_factory.mktemp("robot") / "merged.ttl"
    graph = sources.read_bundled().graph
    graph.remove((None, OWL.imports, None))
    graph.serialize(path, format="turtle")
    return path


@pytest.mark.robot
@pytest.mark.slow
@pytest.mark.skipif(not PIZZA.is_file(), reason="needs ../shared/data/oops-cases")
@pytest.mark.parametrize("question", PIZZAS)
def test_pizza(hermit: None, question: str, tmp_path: Path) -> None:
    agree(question, PIZZA, robots_sets(question, PIZZA, PIZZA_IRI, tmp_path))


@pytest.mark.robot
@pytest.mark.slow
@pytest.mark.parametrize("question", OURS)
def test_ours(hermit: None, question: str, tmp_path: Path, merged: Path) -> None:
    agree(question, merged, robots_sets(question, merged, SL_IRI, tmp_path))


def test_there_are_enough() -> None:
    assert len(set(PIZZAS) | set(OURS)) >= 20
