"""Comparison: strategies over several seeds of an area, as means with what was never reached."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from symboslam.errors import InputError
from symboslam.sim_bridge.search.area import Area, Floats
from symboslam.sim_bridge.search.swarm_metrics import SearchMetrics
from symboslam.sim_bridge.search.trial import Trial, run_trial


@dataclass(frozen=True)
class Mean:
    """A mean of times, seconds.

    Attributes:
        seconds: the mean, where a trial that never got there counts with its end.
        reached: how many trials got there.
        trials: how many there were.
    """

    seconds: float
    reached: int
    trials: int

    @property
    def text(self) -> str:
        """Minutes, with a ``>`` where a trial did not get there."""
        return f"{'>' if self.reached < self.trials else ''}{self.seconds / 60:.1f}"


@dataclass(frozen=True)
class Comparison:
    """One strategy in one area over seeds.

    Attributes:
        search: name of the strategy.
        budget: seconds at which coverage and dispersion are taken.
        until: seconds at which trials ended at the latest.
        trials: one for each seed.
    """

    search: str
    budget: float
    until: float
    trials: tuple[Trial, ...]

    @property
    def metrics(self) -> tuple[SearchMetrics, ...]:
        """Of each trial."""
        return tuple(trial.metrics for trial in self.trials)

    def mean(self, of: Callable[[SearchMetrics], float]) -> float:
        """Mean of a figure over the trials."""
        return math.fsum(of(m) for m in self.metrics) / len(self.trials)

    @property
    def coverage(self) -> float:
        """Mean share that was seen at the budget."""
        return self.mean(lambda m: m.coverage_at(self.budget))

    @property
    def time_to_95(self) -> Mean:
        """Until 95 % were seen."""
        return self._time(lambda m: m.time_to(0.95))

    @property
    def time_to_all(self) -> Mean:
        """Until every feature was seen."""
        return self._time(lambda m: m.time_to_all_features)

    def _time(self, of: Callable[[SearchMetrics], float]) -> Mean:
        times = [of(m) for m in self.metrics]
        counted = [min(t, self.until) for t in times]
        return Mean(sum(counted) / len(times), sum(map(math.isfinite, times)), len(times))

    def to_json(self) -> dict[str, Any]:
        """Means, and the metrics of each trial, as JSON values."""
        return {
            "search": self.search,
            "budget": self.budget,
            "until": self.until,
            "coverage": self.coverage,
            "time_to_95_percent": vars(self.time_to_95),
            "time_to_all_features": vars(self.time_to_all),
            "dispersion": self.mean(lambda m: m.mean_dispersion(self.budget)),
            "normalised_dispersion": self.mean(lambda m: m.normalised_dispersion(self.budget)),
            "trials": [m.to_json(self.budget) for m in self.metrics],
        }


def compare(
    search: str,
    grounds: Sequence[tuple[Area, Floats]],
    budget: float,
    until: float,
    tell: Callable[[float], None] | None = None,
) -> Comparison:
    """Try a strategy on several grounds, the k-th with seed k.

    Args:
        search: its name.
        grounds: areas and the places of their features, (k, 2) metres.
        budget: seconds at which coverage is taken.
        until: seconds at which a trial ends in any case, at least the budget.
        tell: called with the share that is done.

    Raises:
        InputError: no grounds, or a time that is not positive or ends before the budget.
        UnknownNameError: no such strategy.
    """
    if not grounds or not 0 < budget <= until < math.inf:
        raise InputError(f"budget {budget} s, until {until} s: give 0 < budget <= until")
    trials = []
    for seed, (area, features) in enumerate(grounds):
        done = seed / len(grounds)
        trials.append(run_trial(area, search, features, until, seed=seed))
        if tell is not None:
            tell(done + 1 / len(grounds))
    return Comparison(search, budget, until, tuple(trials))
