"""Explanations over HTTP: an account of a segment, as many words as asked for."""

from __future__ import annotations

from typing import Any

from symboslam.engine.account import full_account
from symboslam.engine.account_formats import record_of
from symboslam.engine.environment_map import EnvironmentMap

NAMED = {"line": 3, "paragraph": 3, "full": 10_000}
"""How many classes are named for the environment of a segment."""


def explained(
    found: EnvironmentMap, segment: str, length: str, against: str | None, counterfactual: bool
) -> dict[str, Any]:
    """Why a segment is what it is, as plain values.

    Args:
        found: a map with the segment and the landmarks around it.
        segment: its id.
        length: of the words: ``line``, ``paragraph`` or ``full``.
        against: the environment to compare with; None takes the one that comes second.
        counterfactual: whether to look for changes that make it something else.
    """
    account = full_account(
        found, segment, against=against, limit=NAMED[length], counterfactual=counterfactual
    )
    return record_of(account, length)
