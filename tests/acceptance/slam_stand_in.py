"""A stand-in for the estimator: dead reckoning, with a doubt, that must not see the truth."""

from __future__ import annotations

import sys
from dataclasses import replace
from types import ModuleType
from typing import Any

import pytest

from symboslam.engine.slam.dead_reckoning import dead_reckoned
from symboslam.engine.slam.log import Mission
from symboslam.engine.slam.slam_map import SlamMap

DOUBT = "this is a stand-in"


def stand_in(monkeypatch: pytest.MonkeyPatch) -> None:
    """Put it in the place of ``symboslam.engine.slam.estimate``."""

    def estimate(mission: Mission, settings: Any = None, progress: Any = None) -> SlamMap:
        assert mission.truth is None
        assert not mission.identity
        progress("standing in", 0.5)
        found = dead_reckoned(mission, lost="left out")
        return replace(found, doubts=(DOUBT,), notes=("stood in",))

    module = ModuleType("symboslam.engine.slam.estimate")
    vars(module)["estimate"] = estimate
    monkeypatch.setitem(sys.modules, module.__name__, module)
