"""All the minimal sets of axioms that make an ontology clash, one after the other.

Reiter's hitting set tree: each minimal set must lose an axiom for the clash to go away, so every
further one is found in the ontology without some axiom of each that is known (A. Kalyanpur,
B. Parsia, M. Horridge, E. Sirin: Finding all justifications of OWL DL entailments, ISWC 2007).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from time import monotonic

from symboslam.reasoning._base import Reasoner
from symboslam.reasoning.axioms import SYMMETRIC, Axiom, Triple
from symboslam.reasoning.clash import explain
from symboslam.reasoning.locality import module


def minimal_sets(
    reasoner: Reasoner,
    declared: Iterable[Triple],
    axioms: Sequence[Axiom],
    unsatisfiable: str | None,
    limit: int,
    seconds: float,
    fixed: Sequence[Axiom] = (),
) -> tuple[list[list[Axiom]], bool]:
    """Minimal sets of axioms that clash, and whether these are all of them.

    Args:
        reasoner: decides what clashes.
        declared: declarations of the ontology.
        axioms: its axioms; empty sets are returned if they do not clash.
        unsatisfiable: the class that can have no members; None for an inconsistent ontology.
        limit: how many sets to look for.
        seconds: time limit; a set that is still too large by then is left out.
        fixed: axioms that are always there; sets are minimal beside them and do not list them.
    """
    end = monotonic() + seconds
    whole = module([*_each_once(axioms), *fixed], [unsatisfiable] if unsatisfiable else [])
    axioms = [axiom for axiom in whole if axiom not in fixed]
    names = {name for axiom in (*whole, *fixed) for name in axiom.signature}
    declared = [triple for triple in declared if triple[0] in names]

    def without(path: Iterable[Axiom]) -> list[Axiom]:
        return [axiom for axiom in axioms if axiom not in path]

    def triples_without(path: Iterable[Axiom]) -> list[Triple]:
        return [*declared, *(t for axiom in (*fixed, *without(path)) for t in axiom.triples)]

    found: list[list[Axiom]] = []
    harmless: set[frozenset[Axiom]] = set()  # without these the clash is gone
    level: set[frozenset[Axiom]] = {frozenset()}
    while level:
        if len(found) >= limit or monotonic() > end:
            return found, False
        level = {path for path in level if not any(gone <= path for gone in harmless)}
        order = sorted(level, key=lambda path: sorted(axiom.text for axiom in path))
        answers = reasoner.all_clashes([triples_without(p) for p in order], unsatisfiable)
        harmless |= {path for path, clashes in zip(order, answers, strict=True) if not clashes}
        deeper: set[frozenset[Axiom]] = set()
        for path, clashes in zip(order, answers, strict=True):
            if not clashes:
                continue
            known = next((one for one in found if path.isdisjoint(one)), None)
            if known is None:
                if len(found) >= limit or monotonic() > end:
                    return found, False
                left = end - monotonic()
                known = explain(reasoner, declared, without(path), unsatisfiable, left, fixed)
                if monotonic() > end:
                    return found, False  # it may have axioms too many
                found.append(known)
            deeper |= {path | {axiom} for axiom in known}
        level = deeper
    return found, True


def _each_once(axioms: Sequence[Axiom]) -> list[Axiom]:
    """Axioms without those that say what another one does, with its two sides changed over."""
    kept: dict[object, Axiom] = {}
    for axiom in axioms:
        sides = frozenset((axiom.subject, axiom.object))
        kept.setdefault((axiom.predicate, sides) if axiom.predicate in SYMMETRIC else axiom, axiom)
    return list(kept.values())
