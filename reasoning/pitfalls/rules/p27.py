"""P27: equivalent properties whose domains or ranges differ."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterator, Sequence

from rdflib import OWL, URIRef
from rdflib.term import Node

from symboslam.reasoning.pitfalls.equivalence import Equivalences
from symboslam.reasoning.pitfalls.groups import (
    listed,
    meaning,
    oops_equal_all,
    oops_same,
)
from symboslam.reasoning.pitfalls.model import Finding, Pitfall, Settings, Severity
from symboslam.reasoning.pitfalls.ontology import Ontology, is_builtin
from symboslam.reasoning.vocabulary import local_name

PITFALL = Pitfall(
    code="P27",
    title="Defining wrong equivalent properties",
    severity=Severity.CRITICAL,
    affects=("object property", "datatype property"),
    categories=("N2",),
    description="Two properties are stated to be equivalent although their domains or ranges "
    "differ. As equivalents, each of them gets the domain and range of the other as well.",
    remedy="Remove the equivalence, say rdfs:subPropertyOf if one is a special case of the other, "
    "or give both the same domain and range.",
    oops_group="wrongEquivalentProperty",
)


def check(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """Properties that are stated to be equivalent, with unlike domains or ranges.

    Equivalence counts over several steps, too. Among all that are equivalent to each other, each
    whose domain or range is not the usual one is a finding, together with one that has the usual
    one. A domain or range that is not stated is unlike none.
    """
    known = Equivalences(ontology, OWL.equivalentProperty)
    for group in known.groups():
        for usual, others in _unlike(ontology, group).items():
            ways = known.ways(usual)
            for other, differ in others.items():
                pair = min(usual, other), max(usual, other)
                texts = []
                for end in differ:
                    first, second = (listed(ontology, _ENDS[end](ontology, p)) for p in pair)
                    texts.append(f"their {end} differ ({first} but {second})")
                names = " and ".join(map(local_name, pair))
                message = f"{names} are stated to be equivalent, but {' and '.join(texts)}"
                yield Finding(pair, message, known.axioms(ways, other))


_ENDS = {"domains": Ontology.domains, "ranges": Ontology.ranges}


def _unlike(ontology: Ontology, group: Sequence[URIRef]) -> dict[URIRef, dict[URIRef, list[str]]]:
    """A usual property -> the unusual ones -> the ends in which they differ from it."""
    said = {
        word: {p: meaning(ontology, ends(ontology, p)) for p in group if ends(ontology, p)}
        for word, ends in _ENDS.items()
    }
    # Of what is equally common the first in the order of names counts as usual.
    usual = {word: Counter(by.values()).most_common(1)[0][0] for word, by in said.items() if by}

    def order(prop: URIRef) -> tuple[int, URIRef]:
        return -sum(said[word].get(prop) == usual[word] for word in usual), prop

    found: dict[URIRef, dict[URIRef, list[str]]] = defaultdict(lambda: defaultdict(list))
    for word, number in usual.items():
        model = min((p for p in said[word] if said[word][p] == number), key=order)
        for prop in said[word]:
            if said[word][prop] != number:
                found[model][prop].append(word)
    return found


def _pairs(ontology: Ontology) -> set[tuple[URIRef, URIRef]]:
    """Pairs of named properties that are directly stated to be equivalent."""
    pairs: set[tuple[URIRef, URIRef]] = set()
    for one, others in ontology.statements(OWL.equivalentProperty).items():
        for other in others:
            if not isinstance(one, URIRef) or not isinstance(other, URIRef) or one == other:
                continue
            if not is_builtin(one) and not is_builtin(other):
                pairs.add((min(one, other), max(one, other)))
    return pairs


def check_as_oops(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """As OOPS!: by its own comparison, and of two properties of one kind only.

    Where datatype properties have unlike ranges, it asks once more whether the domains are the
    same, and if so it takes the ranges for the same.
    """
    kinds = {*ontology.object_properties}, {*ontology.datatype_properties}
    for pair in sorted(_pairs(ontology)):
        for kind, is_data in zip(kinds, (False, True), strict=True):
            if not kind.issuperset(pair):
                continue
            domains = [ontology.domains(prop) for prop in pair]
            ranges = [ontology.ranges(prop) for prop in pair]
            again = domains if is_data else ranges
            if _differ(ontology, domains, domains) or _differ(ontology, ranges, again):
                names = " and ".join(map(local_name, pair))
                yield Finding(pair, f"{names} are equivalent, with unlike domains or ranges")
                break


def _differ(
    ontology: Ontology, ends: Sequence[Sequence[Node]], again: Sequence[Sequence[Node]]
) -> bool:
    return (
        all(ends)
        and not oops_equal_all(ontology, ends[0], ends[1])
        and not oops_same(ontology, again[0], again[1])
    )
