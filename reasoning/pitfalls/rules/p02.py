"""P02: synonyms as classes of their own, stated to be equivalent."""

from __future__ import annotations

from collections.abc import Iterator

from rdflib import OWL, RDFS, URIRef

from symboslam.reasoning.pitfalls.model import Finding, Pitfall, Settings, Severity
from symboslam.reasoning.pitfalls.ontology import Ontology, is_builtin
from symboslam.reasoning.vocabulary import local_name

PITFALL = Pitfall(
    code="P02",
    title="Creating synonyms as classes",
    severity=Severity.MINOR,
    affects=("class",),
    categories=("N1", "N7", "S6"),
    description="Two classes of one namespace are stated to be equivalent: one concept has got "
    "two classes because it has two names.",
    remedy="Keep one of the classes and give it the other name as a further label.",
)


def check(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """Pairs of named classes of one namespace that are stated to be equivalent.

    A pair is one finding, whichever way round and however often it is stated. No finding is a pair
    with a deprecated class, whose equivalence says what to use in its place, and a pair of
    datatypes.
    """
    pairs: dict[tuple[URIRef, URIRef], list[tuple[URIRef, URIRef]]] = {}
    for one, other in _stated(ontology):
        pairs.setdefault((min(one, other), max(one, other)), []).append((one, other))
    for pair, stated in sorted(pairs.items()):
        if any(ontology.deprecated(term) or _is_datatype(ontology, term) for term in pair):
            continue
        first, second = map(local_name, pair)
        yield Finding(
            pair,
            f"{first} and {second} are two classes for one concept",
            tuple((s, OWL.equivalentClass, o) for s, o in sorted(stated)),
            mend=f"Keep one of {first} and {second}, with the other name as a further label.",
        )


def check_as_oops(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """The same by statement: each is a finding about its subject alone, deprecated or not."""
    for one, other in sorted(_stated(ontology)):
        if one in ontology.kinds:
            message = f"{local_name(one)} and {local_name(other)} are two classes for one concept"
            yield Finding((one,), message, ((one, OWL.equivalentClass, other),))


def _stated(ontology: Ontology) -> Iterator[tuple[URIRef, URIRef]]:
    """The stated equivalences between classes of one namespace whose names differ."""
    for one, others in ontology.statements(OWL.equivalentClass).items():
        for other in others:
            if not isinstance(one, URIRef) or not isinstance(other, URIRef) or is_builtin(one):
                continue
            first, second = local_name(one), local_name(other)
            same_namespace = _namespace(one) == _namespace(other)
            if same_namespace and first.lower() != second.lower():
                yield one, other


def _namespace(iri: str) -> str:
    return iri.rstrip("/").removesuffix(local_name(iri))


def _is_datatype(ontology: Ontology, term: URIRef) -> bool:
    return RDFS.Datatype in ontology.kinds.get(term, frozenset())
