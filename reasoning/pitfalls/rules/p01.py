"""P01: one name for several things."""

from __future__ import annotations

from collections.abc import Iterator

from symboslam.reasoning.pitfalls.conditions import left_to_people
from symboslam.reasoning.pitfalls.model import Finding, NotCheckedError, Pitfall, Settings, Severity
from symboslam.reasoning.pitfalls.ontology import Ontology

PITFALL = Pitfall(
    code="P01",
    title="Creating polysemous elements",
    severity=Severity.CRITICAL,
    affects=("class", "object property", "datatype property"),
    categories=("N1", "N7", "S4"),
    description="One element stands for several things that its name means in different settings, "
    "such as a theatre as a building and as an art.",
    remedy="Give each of the meanings an element of its own, with a name that tells it from the "
    "others.",
    advisory=True,
)


def check(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """Nothing: what a name is meant to mean is in nobody's file."""
    raise NotCheckedError(
        "left to people: only they can tell whether an element is meant in several senses"
    )


def check_as_oops(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """OOPS! has no rule."""
    raise left_to_people()
