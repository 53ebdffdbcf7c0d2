"""The 41 rules by their codes: each has a module of its own in ``rules``."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import cache
from importlib import import_module
from typing import Protocol, cast

from symboslam.errors import InputError
from symboslam.reasoning.pitfalls.model import Finding, Pitfall, Settings
from symboslam.reasoning.pitfalls.ontology import Ontology

CODES = tuple(f"P{number:02}" for number in range(1, 42))
"""The codes of the catalogue, which are also the names of the modules in ``rules``."""


class Rule(Protocol):
    """A module of ``rules``.

    ``check`` is our rule. A module whose rule differs from that of OOPS! also has
    ``check_as_oops``, with the same signature. Either raises ``NotCheckedError`` where the pitfall
    cannot be looked for.
    """

    PITFALL: Pitfall

    def check(self, ontology: Ontology, settings: Settings) -> Iterator[Finding]:
        """All findings in an ontology."""


@cache
def rule(code: str) -> Rule:
    """The rule of a pitfall."""
    return cast(Rule, import_module(f"symboslam.reasoning.pitfalls.rules.{code.lower()}"))


def choose(select: Iterable[str], ignore: Iterable[str]) -> Sequence[str]:
    """The codes that are selected (all if none is) and not ignored.

    Args:
        select: codes such as ``P04``, ``p4`` or ``4``; several may stand in one, after commas.
        ignore: likewise.

    Raises:
        InputError: no such code.
    """
    wanted, unwanted = _codes(select), _codes(ignore)
    return [code for code in CODES if (not wanted or code in wanted) and code not in unwanted]


def _codes(texts: Iterable[str]) -> set[str]:
    found = set()
    for text in (part.strip() for whole in texts for part in whole.split(",")):
        digits = text.upper().removeprefix("P")
        code = f"P{int(digits):02}" if digits.isascii() and digits.isdigit() else ""
        if code not in CODES:
            raise InputError(f"there is no pitfall {text!r}: codes are P01 to P41")
        found.add(code)
    return found
