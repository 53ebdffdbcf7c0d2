"""P22: names that follow different conventions."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterator, Sequence

from rdflib import RDFS, URIRef

from symboslam.reasoning.pitfalls.model import Finding, Pitfall, Settings, Severity
from symboslam.reasoning.pitfalls.names import (
    is_code,
    oops_name,
    oops_tokens,
    tokens,
)
from symboslam.reasoning.pitfalls.ontology import Ontology
from symboslam.reasoning.vocabulary import local_name

PITFALL = Pitfall(
    code="P22",
    title="Using different naming conventions in the ontology",
    severity=Severity.MINOR,
    affects=("ontology",),
    categories=("N6",),
    description="Names of one kind of term are written in different ways: some start with a "
    "capital and some do not, or some join their words with a hyphen or an underscore.",
    remedy="Choose one way of writing for classes and one for properties, and keep to it. Keep "
    "an old name that is in use as a deprecated term.",
)

_STARTS = {"upper": "start{} with a capital", "lower": "start{} with a small letter"}
_JOINED = {
    "": "join{} words without a mark",
    "_": "join{} words by _",
    "-": "join{} words by -",
}


def check(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """The names that are written otherwise than most of their kind and namespace.

    A convention is how a name starts, and what joins its words if it has several. Numbers,
    names in capitals, which can be acronyms, and deprecated terms follow none. Each name is a
    finding of its own, in words that no other name has a part in, so that it stays the same,
    accepted or known, when terms come and go; unless the majority turns.
    """
    kinds = (
        ("classes", ontology.classes, "upper"),
        ("object properties", ontology.object_properties, "lower"),
        ("datatype properties", ontology.datatype_properties, "lower"),
    )
    for kind, terms, usual in kinds:
        spaces: dict[str, list[URIRef]] = defaultdict(list)
        for term in terms:
            name = local_name(term)
            if name and not is_code(name) and not ontology.deprecated(term):
                spaces[term.removesuffix(name)].append(term)
        for _, here in sorted(spaces.items()):
            yield from _mixed(here, kind, usual)


def _mixed(terms: Sequence[URIRef], kind: str, usual: str) -> Iterator[Finding]:
    wrong: dict[URIRef, list[tuple[str, str]]] = defaultdict(list)
    for style, preferred, words in ((_start, usual, _STARTS), (_join, "", _JOINED)):
        styles = {term: found for term in terms if (found := style(local_name(term))) is not None}
        sizes = Counter(styles.values())
        # Of what is equally common the usual one is the convention.
        convention = min(sizes, key=lambda s: (-sizes[s], s != preferred, s), default="")
        for term, found in styles.items():
            if found != convention:
                wrong[term].append((words[found].format("s"), words[convention].format("")))
    for term, deviations in sorted(wrong.items()):
        this, others = (" and ".join(texts) for texts in zip(*deviations, strict=True))
        yield Finding(
            (term,),
            f"{local_name(term)} {this}, where other {kind} {others}",
            mend="Write the name as most of its kind are written",
        )


def _start(name: str) -> str | None:
    """Whether a name starts with a capital or a small letter; None if it is neither."""
    first = name.lstrip("_-")[:1]
    if first.islower():
        return "lower"
    return "upper" if first.isupper() and not name.isupper() else None


def _join(name: str) -> str | None:
    """What joins the words of a name; None if it is one word or mixes both."""
    found = [mark for mark in "_-" if mark in name.strip("_-")]
    if found:
        return found[0] if len(found) == 1 else None
    return "" if len(tokens(name)) > 1 and not name.isupper() else None


def check_as_oops(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """As OOPS! does: one pair at most for each kind, across namespaces.

    It goes through a kind until it has met two ways of writing and reports the last of each; which
    words are joined it remembers from one kind to the next. An untyped sub-property counts as a
    class, because OOPS! by mistake makes it one when it looks for P12. OOPS! goes by the order in
    memory, this by IRI.
    """
    untyped = [
        s
        for s, objects in ontology.statements(RDFS.subPropertyOf).items()
        if isinstance(s, URIRef)
        and s not in ontology.kinds
        and {*objects} & {*ontology.object_properties, *ontology.datatype_properties}
    ]
    joined: dict[bool, URIRef] = {}
    for terms in (
        sorted({*ontology.classes, *untyped}),
        ontology.object_properties,
        ontology.datatype_properties,
    ):
        starts: dict[bool, URIRef] = {}
        for term in terms:
            name = oops_name(term)
            if not name:
                continue
            if len(oops_tokens(name)) > 1:
                joined["_" in name or "-" in name] = term
                if len(joined) > 1:
                    message = "words are joined with - or _ in one name and not in the other"
                    yield Finding((joined[True], joined[False]), message)
                    break
            if name[0].islower() or name[0].isupper():
                starts[name[0].isupper()] = term
            if len(starts) > 1:
                message = "one name starts with a small letter, the other with a capital"
                yield Finding((starts[False], starts[True]), message)
                break
