"""P27: equivalent properties whose domains or ranges differ."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from rdflib import OWL, URIRef
from rdflib.term import Node

from symboslam.reasoning.pitfalls.groups import listed, oops_equal_all, oops_same, same_all
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
    """Pairs of properties that are stated to be equivalent, with unlike domains or ranges.

    A domain or range that is not stated is unlike none. A pair is one finding.
    """
    for (one, other), stated in sorted(_pairs(ontology).items()):
        differ = []
        for word, ends in (("domains", ontology.domains), ("ranges", ontology.ranges)):
            first, second = ends(one), ends(other)
            if first and second and not same_all(ontology, first, second):
                texts = " but ".join(listed(ontology, nodes) for nodes in (first, second))
                differ.append(f"their {word} differ ({texts})")
        if differ:
            names = f"{local_name(one)} and {local_name(other)}"
            yield Finding(
                (one, other),
                f"{names} are stated to be equivalent, but {' and '.join(differ)}",
                tuple((s, OWL.equivalentProperty, o) for s, o in sorted(stated)),
            )


def _pairs(ontology: Ontology) -> dict[tuple[URIRef, URIRef], list[tuple[URIRef, URIRef]]]:
    """Pairs of named properties, in the order of their names, with the statements about them."""
    pairs: dict[tuple[URIRef, URIRef], list[tuple[URIRef, URIRef]]] = {}
    for one, others in ontology.statements(OWL.equivalentProperty).items():
        for other in others:
            if not isinstance(one, URIRef) or not isinstance(other, URIRef) or one == other:
                continue
            if not is_builtin(one) and not is_builtin(other):
                pairs.setdefault((min(one, other), max(one, other)), []).append((one, other))
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
