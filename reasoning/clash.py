"""Why an ontology clashes: a small set of axioms that contradict each other, in words.

Black-box search: take the module of axioms that can have a say, of it the smallest neighbourhood
of the question that clashes, then leave out from its front as many as the clash survives; the next
one is needed; go on behind it. What is left is minimal: without any one of its axioms there is no
clash (or the time was over, then it is merely small).
Questions are asked many at a time, since starting Java costs more than answering.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from time import monotonic

from rdflib import RDF, RDFS, BNode, URIRef
from rdflib.term import Node

from symboslam.errors import InconsistentOntologyError
from symboslam.reasoning._base import Hierarchy, Reasoner
from symboslam.reasoning.axioms import SYMMETRIC, Axiom, Triple
from symboslam.reasoning.locality import module
from symboslam.reasoning.vocabulary import OWL_NAMESPACE, local_name

_SECONDS = 40.0
_WIDTH = 64  # questions at a time
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
    fixed: Sequence[Axiom] = (),
) -> list[Axiom]:
    """A small set of axioms that clash.

    Args:
        reasoner: decides what clashes.
        declared: declarations of the ontology.
        axioms: axioms that clash somewhere.
        unsatisfiable: the class that can have no members; None for an inconsistent ontology.
        seconds: time limit; at least the module is returned.
        fixed: axioms that are always there, and not in the result.
    """
    end = monotonic() + seconds
    declared = list(declared)

    def ask(candidates: Sequence[Sequence[Axiom]]) -> list[bool]:
        always = [*declared, *(t for a in fixed for t in a.triples)]
        ontologies = [[*always, *(t for a in c for t in a.triples)] for c in candidates]
        return reasoner.clashes(ontologies, unsatisfiable)

    # The smallest neighbourhood of the question that clashes; most of a module is beside the point.
    whole = module([*axioms, *fixed], [unsatisfiable] if unsatisfiable else [])
    near = [[a for a in part if a not in fixed] for part in _neighbourhoods(whole, unsatisfiable)]
    answers = ask(near)
    # One must clash, unless the module lacks something.
    left = near[answers.index(True)] if True in answers else axioms
    # What is left out first is least missed: plain statements about classes explain best.
    left = sorted(left, key=_is_plain)
    fewer = [[a for a in left if a is not without] for without in left[: _WIDTH + 1]]
    answers = ask(fewer) if len(fewer) <= _WIDTH else []
    # What no explanation can do without, as far as the answers go.
    needed = [a for a, clashes in zip(left, answers, strict=False) if not clashes]
    rest = [a for a in left if a not in needed]
    while rest:
        # rest[low:] with what is needed clashes, rest[high:] with it does not.
        low, high = 0, len(rest) + 1
        while high - low > 1:
            if monotonic() > end:
                return [*needed, *rest[low:]]
            step = -(-(high - low) // _WIDTH)
            starts = range(high - step, low, -step)
            answers = ask([[*needed, *rest[start:]] for start in starts])
            if True in answers:
                hit = answers.index(True)
                low, high = starts[hit], starts[hit - 1] if hit else high
            else:
                high = starts[-1]
        needed += rest[low : low + 1]  # nothing if what is needed clashes by itself
        rest = rest[low + 1 :]
    return needed


def _neighbourhoods(axioms: Sequence[Axiom], start: str | None) -> list[list[Axiom]]:
    """Growing parts of some axioms, the last one being all: first what is said about ``start``.

    Each part adds what is said about the names in the one before. Without a start, the first part
    is what is said about individuals.
    """
    known: set[Node] = {URIRef(start)} if start else {a.subject for a in axioms if _is_fact(a)}
    parts: list[list[Axiom]] = []
    while True:
        part = [a for a in axioms if _is_about(a, known)]
        if parts and len(part) == len(parts[-1]):
            break
        parts.append(part)
        known.update(name for axiom in part for name in axiom.signature)
    return parts if len(parts[-1]) == len(axioms) else [*parts, list(axioms)]


def _is_about(axiom: Axiom, known: set[Node]) -> bool:
    if axiom.subject in known or isinstance(axiom.subject, BNode):
        return True
    return axiom.predicate in SYMMETRIC and axiom.object in known


def _is_fact(axiom: Axiom) -> bool:
    """Whether it says something about an individual."""
    about_all = (RDFS.subClassOf, RDFS.subPropertyOf, RDFS.domain, RDFS.range)
    if axiom.predicate == RDF.type:
        return not str(axiom.object).startswith(OWL_NAMESPACE)
    return axiom.predicate not in about_all and not str(axiom.predicate).startswith(OWL_NAMESPACE)


def _is_plain(axiom: Axiom) -> bool:
    return isinstance(axiom.object, URIRef) and axiom.predicate in (RDFS.subClassOf, RDF.type)


def _root(unsatisfiable: Iterable[str], axioms: Sequence[Axiom]) -> str:
    """The unsatisfiable class to explain: the one with the smallest module.

    A class that is unsatisfiable because of another one has that one's axioms in its module too.
    """
    return min(sorted(unsatisfiable)[:50], key=lambda name: len(module(axioms, [name])))
