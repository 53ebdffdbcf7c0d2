"""What every kind of evidence offers: values for cells, and the landmarks behind each value."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from symboslam.engine.grid import Cells

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Contributions:
    """What a cell's evidence is made of, in the units of P~; all parts together are P~(e).

    Attributes:
        landmark: (m,) positions of the landmarks that have a say.
        own: (m, K) what each adds by itself.
        pairs: (m, K) what each adds, or loses, through pairs with others.
        ground: (K,) what ground without landmarks adds.
    """

    landmark: NDArray[np.int64]
    own: Floats
    pairs: Floats
    ground: Floats

    @property
    def each(self) -> Floats:
        """(m, K) what each landmark adds in all."""
        return self.own + self.pairs

    @property
    def total(self) -> Floats:
        """(K,) the cell's evidence P~."""
        return np.asarray(self.each.sum(0) + self.ground)


class Evidence(ABC):
    """Evidence for K environments in the cells of a grid."""

    @abstractmethod
    def of(self, cells: Cells) -> Floats:
        """(m, K) evidence P~(e) of m cells of one level; 0 where nothing speaks for e."""

    @abstractmethod
    def settled(self, cells: Cells, evidence: Floats) -> NDArray[np.bool_]:
        """(m,) which cells need no splitting, given their (m, K) evidence."""

    @abstractmethod
    def contributions(self, cells: Cells) -> Iterator[Contributions]:
        """The landmarks behind the evidence of each cell, in the order given."""


def normalised(evidence: Floats) -> Floats:
    """P(e) = P~(e) / sum of P~; rows without evidence stay 0 (design 5)."""
    total = evidence.sum(-1, keepdims=True)
    zeros = np.zeros_like(evidence)
    return np.asarray(np.divide(evidence, total, out=zeros, where=total > 0))
