"""P07: a class whose name joins two concepts."""

from __future__ import annotations

from collections.abc import Iterator

from symboslam.reasoning.pitfalls.model import Finding, Pitfall, Settings, Severity
from symboslam.reasoning.pitfalls.names import oops_name, oops_tokens, spoken, tokens
from symboslam.reasoning.pitfalls.ontology import Ontology
from symboslam.reasoning.pitfalls.wordnet import WordNet, wordnet

PITFALL = Pitfall(
    code="P07",
    title="Merging different concepts in the same class",
    severity=Severity.MINOR,
    affects=("class",),
    categories=("N1", "N7", "S4"),
    description='The name of a class joins two concepts with "and" or "or". What is said of the '
    "class may hold for one of them only.",
    remedy="Make a class of each concept, and put both below a common class, or define that as "
    "their union, where it is needed.",
)

_JOINING = ("and", "or")


def check(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """Classes with "and" or "or" between other words, unless WordNet knows these words as one."""
    dictionary = wordnet(settings.wordnet)
    for cls in ontology.classes:
        name = spoken(ontology, cls)
        words = [word.lower() for word in tokens(name)]
        joints = [at for at in range(1, len(words) - 1) if words[at] in _JOINING]
        for at in joints:
            if not ontology.deprecated(cls) and not _one_word(words, at, dictionary):
                left, right = " ".join(words[:at]), " ".join(words[at + 1 :])
                yield Finding((cls,), f'the name joins "{left}" and "{right}"')
                break


def _one_word(words: list[str], at: int, dictionary: WordNet) -> bool:
    """Whether the joint is within words that WordNet has as one, such as bed and breakfast."""
    return any(
        dictionary.known(" ".join(words[start:end]))
        for start in range(max(0, at - 3), at)
        for end in range(at + 2, min(len(words), at + 4) + 1)
    )


def check_as_oops(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """As OOPS! does: "and" and "or" anywhere in the local name, also alone or at its ends.

    Only the whole name is looked up.
    """
    dictionary = wordnet(settings.wordnet)
    for cls in ontology.classes:
        words = oops_tokens(oops_name(cls))
        if any(w.lower() in _JOINING for w in words) and not dictionary.known(" ".join(words)):
            yield Finding((cls,), f'the name joins concepts: "{" ".join(words).lower()}"')
