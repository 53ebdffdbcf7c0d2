"""What a reasoner owes the rest, so that another can take HermiT's place."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from symboslam.reasoning.axioms import Triple


@dataclass(frozen=True)
class Hierarchy:
    """What follows for the named classes of a consistent ontology.

    Attributes:
        parents: class -> its direct superclasses; only one class of each group of equals is
            listed, and ``owl:Thing`` never is.
        equals: class -> all named classes equivalent to it, itself included; only classes that
            have equals are listed.
        unsatisfiable: classes that can have no members.
    """

    parents: Mapping[str, frozenset[str]]
    equals: Mapping[str, frozenset[str]]
    unsatisfiable: frozenset[str]

    def above(self, name: str) -> frozenset[str]:
        """All classes at or above a class, equal ones included."""
        found: set[str] = set()
        waiting = [name]
        while waiting:
            here = waiting.pop()
            if here not in found:
                found.add(here)
                waiting += [*self.parents.get(here, ()), *self.equals.get(here, ())]
        return frozenset(found)


@dataclass(frozen=True)
class Realization:
    """What follows for the named individuals of a consistent ontology, and for its classes.

    Attributes:
        hierarchy: the classes.
        types: individual -> its most special classes; ``owl:Thing`` is never listed.
        values: (individual, object property, individual), stated or inferred; what follows by a
            property's being below another is left to ``properties``.
        properties: (object property, one above it); the direct ones only.
        inverses: (object property, one that is above its inverse); the direct ones only.
    """

    hierarchy: Hierarchy
    types: Mapping[str, frozenset[str]]
    values: frozenset[tuple[str, str, str]]
    properties: frozenset[tuple[str, str]]
    inverses: frozenset[tuple[str, str]]


class Reasoner(ABC):
    """Decides what follows from logical axioms, which it gets as triples.

    Implementations keep no state between calls, so threads may share one.
    """

    @abstractmethod
    def classify(self, triples: Iterable[Triple]) -> Hierarchy | None:
        """The inferred hierarchy of named classes, or None if the ontology is inconsistent.

        Raises:
            OntologyError: the axioms are outside OWL 2 DL.
            ReasonerError: the reasoner could not be run.
        """

    @abstractmethod
    def realize(self, triples: Iterable[Triple]) -> Realization | None:
        """What follows for individuals as well, or None if the ontology is inconsistent.

        Raises:
            OntologyError: the axioms are outside OWL 2 DL.
            ReasonerError: the reasoner could not be run.
        """

    def all_clashes(
        self, ontologies: Sequence[Iterable[Triple]], unsatisfiable: str | None = None
    ) -> list[bool]:
        """Which ontologies clash: an answer for each; :meth:`clashes` is asked as often as needed.

        Raises:
            OntologyError: the axioms are outside OWL 2 DL.
            ReasonerError: the reasoner could not be run.
        """
        answers: list[bool] = []
        while len(answers) < len(ontologies):
            answers += self.clashes(ontologies[len(answers) :], unsatisfiable)
        return answers

    @abstractmethod
    def clashes(
        self, candidates: Iterable[Iterable[Triple]], unsatisfiable: str | None = None
    ) -> list[bool]:
        """Which ontologies clash, in their order; the answers may end with the first that does.

        Args:
            candidates: several ontologies.
            unsatisfiable: the class that can have no members where an ontology clashes; None asks
                for inconsistent ontologies instead.

        Raises:
            OntologyError: the axioms are outside OWL 2 DL.
            ReasonerError: the reasoner could not be run.
        """
