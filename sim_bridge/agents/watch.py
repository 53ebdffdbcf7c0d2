"""Watch: what is odd about the robots of a map: gaps, silence, two under one name."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import combinations
from typing import Any

Run = Mapping[str, Any]
"""What a service knows of a run; see ``GET /v1/maps/{id}/robots``."""


class Watch:
    """Tells everything once when it begins, and once when it ends.

    Args:
        patience: seconds that an increment may be late.
        silent: seconds that a robot may say nothing.
    """

    def __init__(self, patience: float, silent: float) -> None:
        self._patience, self._silent = patience, silent
        self._since: dict[tuple[str, str, int, int], float] = {}
        self._late: set[tuple[str, str, int, int]] = set()
        self._quiet: set[tuple[str, str]] = set()
        self._finished: set[tuple[str, str]] = set()
        self._twins: set[tuple[str, str, str]] = set()

    def look(self, runs: Sequence[Run], now: float) -> list[str]:
        """What is new.

        Args:
            runs: what the service knows.
            now: seconds of a clock that does not jump.
        """
        said = self._gaps(runs, now)
        for run in runs:
            name, who = (run["robot"], run["run"]), _who(run)
            if run["finished"]:
                if name not in self._finished:
                    said.append(f"{who} has finished, with {run['increments']} increments")
                self._finished.add(name)
            elif run["silent"] > self._silent:
                if name not in self._quiet:
                    said.append(f"{who} has said nothing for {run['silent']:.0f} seconds")
                self._quiet.add(name)
            elif name in self._quiet:
                self._quiet.remove(name)
                said.append(f"{who} is heard again")
        for one, two in combinations(runs, 2):
            twins = one["robot"], one["run"], two["run"]
            if one["robot"] == two["robot"] and twins not in self._twins and _overlap(one, two):
                self._twins.add(twins)
                said.append(
                    f"two robots at a time are called {one['robot']}: runs {one['run']} and"
                    f" {two['run']}; they are kept apart, but give each a name of its own"
                )
        return said

    def ended(self, runs: Sequence[Run], robots: int) -> bool:
        """Whether nothing more is to be expected from so many robots or more."""
        over = all(run["finished"] or run["silent"] > self._silent for run in runs)
        return over and len({run["robot"] for run in runs}) >= robots

    def _gaps(self, runs: Sequence[Run], now: float) -> list[str]:
        gaps = {(r["robot"], r["run"], a, b): r for r in runs for a, b in r["missing"]}
        said = []
        for gap, run in gaps.items():
            since = self._since.setdefault(gap, now)
            if now - since >= self._patience and gap not in self._late:
                self._late.add(gap)
                said.append(f"{_who(run)}: {_numbers(gap)} missing, for {now - since:.0f} seconds")
        for gap in self._since.keys() - gaps.keys():
            del self._since[gap]
            if gap in self._late:
                self._late.remove(gap)
                said.append(f"robot {gap[0]} (run {gap[1]}): some of what was missing has come")
        return said


def _who(run: Run) -> str:
    return f"robot {run['robot']} (run {run['run']})"


def _numbers(gap: tuple[str, str, int, int]) -> str:
    _, _, first, last = gap
    return f"increment {first} is" if first == last else f"increments {first} to {last} are"


def _overlap(one: Run, two: Run) -> bool:
    return bool(one["began"] < two["heard"] and two["began"] < one["heard"])
