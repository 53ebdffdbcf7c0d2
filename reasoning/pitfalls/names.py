"""Names of terms: their words, forms in which they can be compared, and terms named alike."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence, Set
from functools import cache
from typing import Any

from rdflib import Literal, URIRef
from rdflib.term import Node

from symboslam.reasoning.pitfalls.model import NotCheckedError
from symboslam.reasoning.pitfalls.ontology import Ontology
from symboslam.reasoning.vocabulary import local_name

_BITS = 4096
_LARGEST = 1_000_000
_Steps = Mapping[Any, Sequence[Node]]
_CODE = re.compile(r"[A-Za-z]*[_-]?\d{3,}")


def tokens(name: str) -> list[str]:
    """The words of a name: parted by case, at digits, and at whatever is neither letter nor digit.

    >>> tokens("HTTPServer2_of-town")
    ['HTTP', 'Server', '2', 'of', 'town']
    """
    return _split(name)


@cache
def _kind(char: str) -> str:
    if char.isdigit():
        return "digit"
    if not char.isalpha():
        return ""
    return "upper" if char.isupper() else "lower"


def _split(name: str) -> list[str]:
    found: list[str] = []
    last = ""
    for at, char in enumerate(name):
        kind = _kind(char)
        ahead = _kind(name[at + 1]) if at + 1 < len(name) else ""
        if not kind:
            pass
        elif kind == last == "upper" and ahead == "lower":  # the S of HTTPServer
            found.append(char)
        elif kind == last or (last, kind) == ("upper", "lower"):
            found[-1] += char
        else:
            found.append(char)
        last = kind
    return found


def phrase(name: str) -> str:
    """The words of a name in small letters, with spaces.

    >>> phrase("BedAndBreakfast")
    'bed and breakfast'
    """
    return " ".join(tokens(name)).lower()


def squashed(name: str) -> str:
    """A name without case and without whatever is neither letter nor digit.

    >>> squashed("has-Part_of")
    'haspartof'
    """
    return "".join(char for char in name if char.isalnum()).casefold()


def normal_label(text: str) -> str:
    """A label without case; spaces, hyphens and underscores in a row are one space.

    >>> normal_label(" Four-Seasons  pizza")
    'four seasons pizza'
    """
    return " ".join(re.split(r"[\s_-]+", text.strip().casefold())).strip()


def is_code(name: str) -> bool:
    """Whether a name is a number rather than words, such as ``ENVO_00000428``."""
    return _CODE.fullmatch(name) is not None


def is_english(label: Node) -> bool:
    """Whether a literal is English or does not say its language."""
    if not isinstance(label, Literal):
        return False
    return not label.language or label.language.lower().split("-")[0] == "en"


def english(ontology: Ontology, term: URIRef) -> str:
    """A term's English label, else one without a language, else its local name."""
    labels = [x for x in ontology.names(term) if isinstance(x, Literal) and is_english(x)]
    best = min(labels, key=lambda x: (not x.language, str(x)), default=None)
    return str(best).strip() if best is not None and best.strip() else local_name(term)


def spoken(ontology: Ontology, term: URIRef) -> str:
    """A term's local name; its English label where that is a number."""
    name = local_name(term)
    return english(ontology, term) if is_code(name) else name


def apart(group: Iterable[URIRef], part: Mapping[Node, int]) -> list[URIRef]:
    """The terms of a group in order; none if all are in the same part.

    Args:
        group: terms, each of them once.
        part: what ``components`` found; a term that is not in it is a part of its own.
    """
    found = sorted(group)
    return found if len({part.get(term, term) for term in found}) > 1 else []


def components(pairs: Mapping[Node, Sequence[Node]]) -> dict[Node, int]:
    """Node -> the number of its connected part of an undirected graph."""
    part: dict[Node, int] = {}
    for number, start in enumerate(pairs):
        waiting = [start]
        while waiting:
            node = waiting.pop()
            if node not in part:
                part[node] = number
                waiting += pairs.get(node, ())
    return part


def strong(starts: Iterable[Node], steps: _Steps) -> list[list[Node]]:
    """What is reached in a directed graph, by strongly connected part (Tarjan's algorithm).

    Each part comes after all that it leads to.
    """
    number: dict[Node, int] = {}
    low: dict[Node, int] = {}
    open_: dict[Node, None] = {}  # in no part yet, in order
    found: list[list[Node]] = []
    for start in starts:
        path: list[tuple[Node, Iterator[Node]]] = []
        after: Node | None = None if start in number else start
        while after is not None or path:
            if after is not None:
                number[after] = low[after] = len(number)
                open_[after] = None
                path.append((after, iter(steps.get(after, ()))))
            node, others = path[-1]
            after = None
            for other in others:
                if other not in number:
                    after = other
                    break
                if other in open_:
                    low[node] = min(low[node], number[other])
            else:
                path.pop()
                if path:
                    low[path[-1][0]] = min(low[path[-1][0]], low[node])
                if low[node] == number[node]:
                    part = [open_.popitem()[0]]
                    while part[-1] != node:
                        part.append(open_.popitem()[0])
                    found.append(part)
    return found


class Relations:
    """What is declared between terms, to find the unrelated ones of many groups at once.

    Two terms are related if they are in the same part, one is above the other, they are or are
    below two members of a disjoint set, or they are a pair. Sets of terms are the bits of a number,
    so that it takes no look at every two terms of a group, and so many terms at a time that the
    numbers stay small.

    Args:
        part: term -> number of the part that it is in.
        steps: term -> what is directly above it.
        disjoint: sets of disjoint terms.
        pairs: term -> what it is related to, in either direction.
    """

    def __init__(
        self,
        part: Mapping[Node, int],
        steps: _Steps,
        disjoint: Iterable[Iterable[Node]] = (),
        pairs: _Steps | None = None,
    ) -> None:
        self._part, self._steps, self._pairs = part, steps, pairs or {}
        self._disjoint = [{*terms} for terms in disjoint]

    def unrelated(
        self, groups: Sequence[Sequence[URIRef]], word: Callable[[URIRef], Node | str]
    ) -> list[list[URIRef]]:
        """For each group, its terms to which some other term of another word is not related.

        Args:
            groups: terms, each once in its group.
            word: terms of the same word are not compared.
        """
        columns = [(at, term) for at, group in enumerate(groups) for term in group]
        layers = strong((term for _, term in columns), self._steps)
        self._layer = {term: n for n, terms in enumerate(layers) for term in terms}
        self._upper = [
            {self._layer[up] for term in terms for up in self._steps.get(term, ())} - {n}
            for n, terms in enumerate(layers)
        ]
        sets = ([self._layer[t] for t in terms if t in self._layer] for terms in self._disjoint)
        self._sets = [terms for terms in sets if len(terms) > 1]
        found: list[set[URIRef]] = [set() for _ in groups]
        for start in range(0, len(columns), _BITS):
            self._compare(columns[start : start + _BITS], groups, found, word)
        return [[t for t in group if t in found[at]] for at, group in enumerate(groups)]

    def _compare(
        self,
        columns: Sequence[tuple[int, URIRef]],
        groups: Sequence[Sequence[URIRef]],
        found: Sequence[set[URIRef]],
        word: Callable[[URIRef], Node | str],
    ) -> None:
        """Add to ``found`` what is not related to one of the columns."""
        bits: dict[object, int] = defaultdict(int)
        own, wanted = [0] * len(self._upper), dict[int, int]()
        for at, (group, term) in enumerate(columns):
            bit = 1 << at
            wanted[group] = wanted.get(group, 0) | bit
            own[self._layer[term]] |= bit
            for key in (("term", term), ("word", word(term)), ("part", self._part.get(term))):
                bits[key] |= bit
        bits["part", None] = 0
        below, related = self._sweep(own)
        for group, all_ in wanted.items():
            for term in groups[group]:
                if term not in found[group]:
                    n = self._layer[term]
                    known = below[n] | related[n]
                    known |= bits.get(("word", word(term)), 0)
                    known |= bits.get(("part", self._part.get(term)), 0)
                    for other in self._pairs.get(term, ()):
                        known |= bits.get(("term", other), 0)
                    if all_ & ~known:
                        found[group].add(term)

    def _sweep(self, own: Sequence[int]) -> tuple[list[int], list[int]]:
        """Layer -> the columns in it or below it, and those above it or disjoint from it."""
        below, related = list(own), [0] * len(own)
        for n in reversed(range(len(own))):
            for up in self._upper[n] if below[n] else ():
                below[up] |= below[n]
        for layers in self._sets:
            once = twice = 0
            for n in layers:
                twice |= once & below[n]
                once |= below[n]
            for n in layers if once else ():
                related[n] |= (once & ~below[n]) | twice
        for n, uppers in enumerate(self._upper):
            for up in uppers:
                related[n] |= related[up] | own[up]
        return below, related


# What OOPS! does with names


def oops_name(iri: str) -> str:
    """The local name in OOPS!: the longest end of an IRI that XML allows as a name.

    >>> oops_name("http://example.org/o#4Seasons")
    'Seasons'
    """
    end = re.search(r"[\w.\-·]*$", iri)
    start = re.search(r"[^\W\d].*$", end.group()) if end else None
    return start.group() if start else ""


def oops_tokens(name: str) -> list[str]:
    """The words of a local name in OOPS!: at ``_``, else at ``-``, else at each capital.

    Within one name only one of these counts, an acronym falls into its letters, and where
    capitals part the words all but letters is dropped.
    """
    delimiter = "-" if "-" in name and "_" not in name else "_"
    name = name.removeprefix(delimiter)
    if delimiter in name:
        parts = name.split(delimiter)
        while parts and not parts[-1]:
            parts.pop()
        return parts
    found = [""]
    for at, char in enumerate(name):
        if char.isupper() and at > 0:
            if found[-1]:
                found.append(char)
        elif char.isupper() or char.islower():
            found[-1] += char
    return found


def oops_words(text: str) -> list[str]:
    """The words of a label in OOPS!: parted by case and at all but letters, acronyms whole."""
    return [word for word in _split(text) if not word[0].isdigit()]


def oops_tag(ontology: Ontology, term: URIRef) -> str:
    """What OOPS! calls a class: its English label in camel case, else its local name."""
    labels = [
        str(x)
        for x in ontology.labels(term)
        if isinstance(x, Literal) and (x.language or "").lower().split("-")[0] == "en"
    ]
    if not labels:
        return oops_name(term)
    label = min(labels)
    if " " not in label:
        return label
    return "".join(part[:1].upper() + part[1:] for part in label.split(" "))


def oops_groups(
    tags: Mapping[URIRef, str], partners: Callable[[URIRef], Set[URIRef]]
) -> list[tuple[URIRef, ...]]:
    """The groups in which OOPS! reports terms that belong together in pairs.

    There is one for each tag, with the partners of all terms of that tag; a pair counts only if
    the partner's tag has no group by then. OOPS! goes by the order in memory, this one by IRI.

    Raises:
        NotCheckedError: the groups are too large; k terms that all belong together are in k groups.
    """
    tagged: dict[str, set[URIRef]] = defaultdict(set)
    for term, tag in tags.items():
        tagged[tag].add(term)
    groups: dict[str, set[URIRef]] = {}
    grouped: set[URIRef] = set()
    size = 0
    for term in sorted(tags):
        tag = tags[term]
        if not (fresh := partners(term) - grouped):
            continue
        if tag not in groups:
            groups[tag] = {min(fresh)}
            grouped |= tagged[tag]
            fresh -= tagged[tag]
        before = len(groups[tag])
        groups[tag].update(fresh, (term,))
        size += len(groups[tag]) - before
        if size > _LARGEST:
            raise NotCheckedError(f"OOPS! would list more than {_LARGEST:,} terms in its groups")
    return [tuple(sorted(group)) for group in groups.values()]
