"""Why an ontology clashes: a small set of axioms that contradict each other, in words.

Black-box contraction: take the module of axioms that can have a say, then leave out halves,
quarters, ... single axioms as long as the clash stays. What is left is minimal: without any one of
its axioms there is no clash (or the time was over, then it is merely small).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from time import monotonic

from symboslam.errors import InconsistentOntologyError
from symboslam.reasoning._base import Hierarchy, Reasoner
from symboslam.reasoning.axioms import Axiom, Triple
from symboslam.reasoning.locality import module
from symboslam.reasoning.vocabulary import local_name

_SECONDS = 40.0
_NAMED = 8  # classes that the message names


def refuse(
    reasoner: Reasoner,
    declared: Iterable[Triple],
    axioms: Sequence[Axiom],
    hierarchy: Hierarchy | None,
    seconds: float = _SECONDS,
) -> InconsistentOntologyError:
    """The error for an ontology that contradicts itself.

    Args:
        reasoner: decides what clashes.
        declared: declarations of the ontology.
        axioms: its axioms.
        hierarchy: what follows from it; None if it is inconsistent.
        seconds: time to look for the axioms; after it, more than the fewest may be named.
    """
    bad = None if hierarchy is None else _root(hierarchy.unsatisfiable, axioms)
    clashing = sorted(explain(reasoner, declared, axioms, bad, seconds), key=lambda a: a.text)
    names = sorted(map(local_name, hierarchy.unsatisfiable)) if hierarchy else []
    if bad is None:
        message = "the ontology is inconsistent; these axioms clash:"
    else:
        listed = ", ".join(names[:_NAMED]) + (", ..." if len(names) > _NAMED else "")
        count = f"{len(names)} classes" if len(names) > 1 else "1 class"
        message = f"{count} can have no members ({listed}); "
        message += f"for {local_name(bad)} these axioms clash:"
    classes = tuple(sorted(hierarchy.unsatisfiable)) if hierarchy else ()
    return InconsistentOntologyError(
        message, classes=classes, axioms=tuple(axiom.text for axiom in clashing)
    )


def explain(
    reasoner: Reasoner,
    declared: Iterable[Triple],
    axioms: Sequence[Axiom],
    unsatisfiable: str | None,
    seconds: float = _SECONDS,
) -> list[Axiom]:
    """A small set of axioms that clash.

    Args:
        reasoner: decides what clashes.
        declared: declarations of the ontology.
        axioms: axioms that clash somewhere.
        unsatisfiable: the class that can have no members; None for an inconsistent ontology.
        seconds: time limit; at least the module is returned.
    """
    end = monotonic() + seconds
    declared = list(declared)

    def first_clash(candidates: Sequence[Sequence[Axiom]]) -> int | None:
        ontologies = [[*declared, *(t for a in c for t in a.triples)] for c in candidates]
        return reasoner.first_clash(ontologies, unsatisfiable)

    left = module(axioms, [unsatisfiable] if unsatisfiable else [])
    if first_clash([left]) is None:
        left = list(axioms)
    size = (len(left) + 1) // 2
    while size:
        start = 0
        while start < len(left) and monotonic() < end:
            starts = range(start, len(left), size)
            candidates = [left[:i] + left[i + size :] for i in starts]
            hit = first_clash(candidates)
            if hit is None:
                break
            start, left = starts[hit], candidates[hit]
        size = size // 2
    return left


def _root(unsatisfiable: Iterable[str], axioms: Sequence[Axiom]) -> str:
    """The unsatisfiable class to explain: the one with the smallest module.

    A class that is unsatisfiable because of another one has that one's axioms in its module too.
    """
    return min(sorted(unsatisfiable)[:50], key=lambda name: len(module(axioms, [name])))
