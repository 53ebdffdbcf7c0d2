"""All minimal sets are found: against every subset, with a reasoner whose answers are made up."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import combinations

from hypothesis import given, settings
from hypothesis import strategies as st
from rdflib import Graph

from symboslam.reasoning._base import Hierarchy, Realization, Reasoner
from symboslam.reasoning.axioms import Axiom, Triple, split
from symboslam.reasoning.hitting_set import minimal_sets

SIZE = 8


class Clashing(Reasoner):
    """An ontology clashes if it has all axioms of one of some sets.

    As HermiT does, it ends with the first inconsistent ontology.
    """

    def __init__(self, family: Iterable[frozenset[int]]) -> None:
        self.family = list(family)
        self.asked = 0

    def classify(self, triples: Iterable[Triple]) -> Hierarchy | None:
        raise NotImplementedError

    def realize(self, triples: Iterable[Triple]) -> Realization | None:
        raise NotImplementedError

    def clashes(
        self, candidates: Iterable[Iterable[Triple]], unsatisfiable: str | None = None
    ) -> list[bool]:
        answers: list[bool] = []
        for triples in candidates:
            self.asked += 1
            there = {int(str(s).rpartition("#")[2]) for s, _, _ in triples}
            answers.append(any(one <= there for one in self.family))
            if answers[-1]:
                break
        return answers


def axioms(count: int) -> list[Axiom]:
    text = "".join(f"<urn:x#{i}> a <urn:x#-1> .\n" for i in range(count))
    return split(Graph().parse(data=text, format="turtle"))[1]


def numbers(one: Iterable[Axiom]) -> frozenset[int]:
    return frozenset(int(str(axiom.subject).rpartition("#")[2]) for axiom in one)


def smallest(family: Iterable[frozenset[int]]) -> set[frozenset[int]]:
    family = set(family)
    return {one for one in family if not any(other < one for other in family)}


subsets = st.frozensets(st.integers(0, SIZE - 1), min_size=1, max_size=4)


@settings(max_examples=150, deadline=None)
@given(st.frozensets(subsets, max_size=5))
def test_all_minimal_sets(family: frozenset[frozenset[int]]) -> None:
    found, complete = minimal_sets(Clashing(family), [], axioms(SIZE), None, 100, 1e9)
    assert complete
    assert len(found) == len({numbers(one) for one in found}), "one is found twice"
    assert {numbers(one) for one in found} == smallest(family)


@settings(max_examples=50, deadline=None)
@given(st.frozensets(subsets, min_size=1, max_size=5), st.integers(1, 3))
def test_limit(family: frozenset[frozenset[int]], limit: int) -> None:
    found, complete = minimal_sets(Clashing(family), [], axioms(SIZE), None, limit, 1e9)
    expected = smallest(family)
    assert {numbers(one) for one in found} <= expected
    assert len(found) == min(limit, len(expected))
    if len(expected) > limit:
        assert not complete


def test_nothing_clashes() -> None:
    reasoner = Clashing([])
    assert minimal_sets(reasoner, [], axioms(3), None, 5, 1e9) == ([], True)
    assert reasoner.asked == 1


def test_every_pair() -> None:
    pairs = [frozenset(pair) for pair in combinations(range(4), 2)]
    found, complete = minimal_sets(Clashing(pairs), [], axioms(4), None, 10, 1e9)
    assert complete
    assert {numbers(one) for one in found} == set(pairs)


def test_no_time_at_all() -> None:
    found, complete = minimal_sets(Clashing([frozenset({1})]), [], axioms(3), None, 5, -1.0)
    assert (found, complete) == ([], False)
