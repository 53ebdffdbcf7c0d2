"""P31: equivalent classes that WordNet tells apart."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from itertools import combinations

from rdflib import OWL, URIRef

from symboslam.reasoning.axioms import Triple
from symboslam.reasoning.pitfalls.equivalence import Equivalences
from symboslam.reasoning.pitfalls.model import Finding, Pitfall, Settings, Severity
from symboslam.reasoning.pitfalls.names import (
    english,
    oops_groups,
    oops_tag,
    oops_tokens,
    oops_words,
    phrase,
)
from symboslam.reasoning.pitfalls.ontology import Ontology
from symboslam.reasoning.pitfalls.wordnet import WordNet, wordnet
from symboslam.reasoning.vocabulary import local_name

PITFALL = Pitfall(
    code="P31",
    title="Defining wrong equivalent classes",
    severity=Severity.CRITICAL,
    affects=("class",),
    categories=("N2",),
    description="Two classes are declared equivalent although their names say, by WordNet, that "
    "one is a kind or a part of the other. All members of one become members of the other.",
    remedy="Use rdfs:subClassOf for the more special class, or a property such as part of for "
    "the part.",
    oops_group="wrongEquivalentClass",
)

_MANY = 30
_STOP_WORDS = frozenset(
    "a an and are as at be by for from has in is it its of on or that the to was with".split()
)


def check(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """Equivalent classes of which WordNet says that one is a kind or a part of the other.

    Their names are compared as a whole, and, where they share words at the start or the end, by
    what is left. Names that share a sense are fine. Equivalence counts over several steps, too;
    where more than ``_MANY`` classes are equivalent, only as far as it is stated directly.
    """
    dictionary = wordnet(settings.wordnet)
    known = Equivalences(ontology, OWL.equivalentClass)
    pairs = {*_pairs(ontology)}
    for group in known.groups():
        if len(group) <= _MANY:
            pairs.update(combinations(group, 2))
    names: dict[URIRef, str] = {}
    for pair in sorted(pairs):
        if any(map(ontology.deprecated, pair)):
            continue
        for cls in pair:
            if cls not in names:
                names[cls] = phrase(english(ontology, cls))
        one, two = (names[cls] for cls in pair)
        for left, right in dict.fromkeys(((one, two), _rest(one, two))):
            relation = _relation(dictionary, left, right)
            if relation:
                axioms = _stated(ontology, pair) or known.between(*pair)
                yield Finding(pair, f"declared equivalent, but {relation}", axioms)
                break


def _stated(ontology: Ontology, pair: tuple[URIRef, URIRef]) -> tuple[Triple, ...]:
    one, two = pair
    both = ((one, OWL.equivalentClass, two), (two, OWL.equivalentClass, one))
    return tuple(t for t in both if t in ontology.graph)


def _pairs(ontology: Ontology) -> list[tuple[URIRef, URIRef]]:
    """Each two named classes that are stated to be equivalent, once."""
    pairs = {
        (min(s, o), max(s, o))
        for s, objects in ontology.statements(OWL.equivalentClass).items()
        for o in objects
        if isinstance(s, URIRef) and isinstance(o, URIRef) and s != o
    }
    return sorted(pairs)


def _rest(one: str, two: str) -> tuple[str, str]:
    """Two names without the words that both start or end with."""
    left, right = one.split(), two.split()
    while len(left) > 1 and len(right) > 1 and left[0] == right[0]:
        left, right = left[1:], right[1:]
    while len(left) > 1 and len(right) > 1 and left[-1] == right[-1]:
        left, right = left[:-1], right[:-1]
    return " ".join(left), " ".join(right)


def _relation(dictionary: WordNet, one: str, two: str) -> str:
    # A letter or a number is what tells variants apart (Class A, Class B), no word.
    if one == two or min(len(one), len(two)) < 3:
        return ""
    words = {"kind": "is a kind of", "part": "is a part of"}
    for a, b in ((one, two), (two, one)):
        found = dictionary.relation(a, b)
        if found:
            return f'"{a}" {words[found]} "{b}" by WordNet'
    return ""


def check_as_oops(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """As OOPS! does: any word of one name that has a word of the other above it is enough.

    So a single letter counts as a word: ClassA and ClassB are reported, because WordNet has a sense
    of "B" from which three steps, each by way of any sense of a word, lead to "class". OOPS! never
    finds parts, as it asks for pointers of words where WordNet has those of synsets. Its list of
    stop words is not ours.
    """
    dictionary = wordnet(settings.wordnet)
    classes = {*ontology.classes}
    tags = {cls: oops_tag(ontology, cls) for cls in ontology.classes}
    partners: dict[URIRef, set[URIRef]] = defaultdict(set)
    for one, two in _pairs(ontology):
        if one in classes and two in classes:
            # A list of groups that goes by tags leaves the second direction out.
            for a, b in ((one, two), (two, one)):
                if not _same(dictionary, tags[a], tags[b]) and _differ(
                    dictionary, tags[a], tags[b]
                ):
                    partners[a].add(b)
    for group in oops_groups(tags, lambda cls: partners[cls]):
        names = " and ".join(local_name(cls) for cls in group)
        triples = [
            (cls, OWL.equivalentClass, other)
            for cls in group
            for other in {*ontology.objects(cls, OWL.equivalentClass)}.intersection(group)
        ]
        yield Finding(
            group,
            f"{names} are declared equivalent, but WordNet tells them apart",
            tuple(sorted(triples)),
        )


def _same(dictionary: WordNet, one: str, two: str) -> bool:
    """Whether OOPS! takes two names for the same or for synonyms."""

    def plain(name: str) -> str:
        return "".join(c for c in name.lower() if c.isascii() and c.isalnum())

    def spaced(name: str) -> str:
        return " ".join(oops_tokens(name))

    if plain(one) == plain(two):
        return True
    forms = ((plain(one), plain(two)), (one, two), (spaced(one), spaced(two)))
    if any(_synonyms(dictionary, a, b) for a, b in forms):
        return True
    return _all_words(dictionary, one, two) and _all_words(dictionary, two, one)


def _synonyms(dictionary: WordNet, one: str, two: str) -> bool:
    return one.lower() != two.lower() and two.lower() in dictionary.synonyms(one)


def _all_words(dictionary: WordNet, one: str, two: str) -> bool:
    words, others = _compounds(one), _compounds(two)
    met = {
        word
        for word in words
        if any(word.lower() == o.lower() or _synonyms(dictionary, word, o) for o in others)
    }
    return sum(word.lower() not in _STOP_WORDS for word in oops_words(one)) <= len(met)


def _differ(dictionary: WordNet, one: str, two: str) -> bool:
    """Whether OOPS! finds a word of one name above a word of the other."""
    words, others = _compounds(one), _compounds(two)
    return any(
        b.lower() in dictionary.hypernym_words(a)
        for left, right in ((words, others), (others, words))
        for a in left
        for b in right
    )


def _compounds(name: str) -> list[str]:
    """The words of a name and all runs of them."""
    words = oops_words(name)
    ends = range(len(words) + 1)
    return [" ".join(words[i:j]) for i in ends for j in ends if i < j]
