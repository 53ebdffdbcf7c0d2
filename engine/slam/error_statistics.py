"""Statistics of errors: RMSE, mean, median, largest."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Statistics:
    """What a column of errors comes to; the unit is that of the errors.

    Attributes:
        rmse: root of the mean square.
        mean: arithmetic mean.
        median: middle one.
        max: largest.
    """

    rmse: float
    mean: float
    median: float
    max: float

    @classmethod
    def of(cls, errors: Floats) -> Statistics | None:
        """Statistics of (n,) errors; None for no errors."""
        if not len(errors):
            return None
        return cls(
            rmse=float(np.sqrt(np.mean(np.square(errors)))),
            mean=float(np.mean(errors)),
            median=float(np.median(errors)),
            max=float(np.max(errors)),
        )
