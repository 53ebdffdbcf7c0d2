"""P21: a class for whatever fits no other class."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

from symboslam.reasoning.pitfalls.model import Finding, Pitfall, Settings, Severity
from symboslam.reasoning.pitfalls.names import oops_name, oops_tokens, spoken, tokens
from symboslam.reasoning.pitfalls.ontology import Ontology

PITFALL = Pitfall(
    code="P21",
    title="Using a miscellaneous class",
    severity=Severity.MINOR,
    affects=("class",),
    categories=("N1", "S6"),
    description="A class collects what does not belong to its sibling classes. Its members have "
    "nothing in common, and change whenever a sibling is added.",
    remedy="Leave the members in the class above, or sort them into classes that say what they "
    "are.",
)

_WORDS = ("other", "misc", "miscellanea", "miscellaneous", "miscellany")


def check(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """Classes with a word such as "other" in their name; "other than" says more and is let be."""
    for cls in ontology.classes:
        name = spoken(ontology, cls)
        words = [word.lower() for word in tokens(name)]
        for word, after in pairwise([*words, ""]):
            if word in _WORDS and after != "than" and not ontology.deprecated(cls):
                message = f'"{word}" in the name says that the class is for what is left over'
                yield Finding((cls,), message)
                break


def check_as_oops(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """As OOPS! does, which parts names in its own way and does not look at labels."""
    for cls in ontology.classes:
        found = [w for w in oops_tokens(oops_name(cls)) if w.lower() in _WORDS]
        if found:
            yield Finding((cls,), f'"{found[0]}" is in the name')
