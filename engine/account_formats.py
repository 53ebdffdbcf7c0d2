"""Accounts as JSON, after ``account.schema.json``."""

from __future__ import annotations

import json
from dataclasses import asdict
from importlib.resources import files
from typing import Any

from symboslam.engine.account import Account
from symboslam.engine.wording import text_of

SCHEMA = "account.schema.json"


def record_of(account: Account, length: str = "paragraph") -> dict[str, Any]:
    """An account as plain values, with its words in the length asked for."""
    told = account.explanation
    record: dict[str, Any] = {
        "segment_id": told.segment_id,
        "environment": told.environment,
        "probabilities": dict(told.probabilities),
        "runner_up": account.runner_up,
        "chain": None
        if told.chain is None
        else {
            "groups": dict(told.chain.groups),
            "zones": {name: dict(zones) for name, zones in told.chain.zones.items()},
            "untold": list(told.chain.untold),
        },
        "reasons": [asdict(reason) for reason in told.reasons],
        "why": account.why and asdict(account.why),
        "against": account.against and asdict(account.against),
        "difference": account.why.probability - account.against.probability
        if account.why and account.against
        else None,
        "differences": [asdict(each) for each in account.differences],
        **asdict(account.parts),
        "counterfactuals": None
        if account.counterfactuals is None
        else [asdict(each) for each in account.counterfactuals],
        "indications": [asdict(each) for each in account.indications],
        "text": text_of(account, length),
    }
    return record


def as_json(account: Account, length: str = "paragraph") -> str:
    """For programs; ``schema`` says what is in it."""
    return json.dumps(record_of(account, length), indent=1, ensure_ascii=False)


def schema() -> dict[str, Any]:
    """The JSON schema of ``as_json``."""
    text = (files("symboslam.engine") / SCHEMA).read_text(encoding="utf-8")
    found: dict[str, Any] = json.loads(text)
    return found
