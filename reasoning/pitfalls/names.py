"""Names of terms: their words, forms in which they can be compared, and terms named alike."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cache

from rdflib import Literal, URIRef
from rdflib.term import Node

from symboslam.reasoning.pitfalls.ontology import Ontology
from symboslam.reasoning.vocabulary import local_name

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


def apart(group: Iterable[URIRef], related: Callable[[URIRef, URIRef], bool]) -> list[URIRef]:
    """The terms of a group that some other of the group is not related to, in order."""
    found = sorted(group)
    return [a for a in found if any(a != b and not related(a, b) for b in found)]


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


def above(start: URIRef, steps: Mapping[URIRef, Sequence[URIRef]]) -> set[URIRef]:
    """A term and all that is above it."""
    found, waiting = {start}, [start]
    while waiting:
        for term in steps.get(waiting.pop(), ()):
            if term not in found:
                found.add(term)
                waiting.append(term)
    return found


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
    tags: Mapping[URIRef, str], partners: Mapping[URIRef, Iterable[URIRef]]
) -> list[tuple[URIRef, ...]]:
    """The groups in which OOPS! reports terms that belong together in pairs.

    There is one for each tag, with the partners of all terms of that tag; a pair counts only if
    the partner's tag has no group by then. OOPS! goes by the order in memory, this one by IRI.
    """
    groups: dict[str, set[URIRef]] = {}
    for term in sorted(partners):
        for other in sorted(partners[term]):
            if tags[other] not in groups:
                groups.setdefault(tags[term], set()).update((term, other))
    return [tuple(sorted(group)) for group in groups.values()]
