"""What every kind of evidence offers: values for regions, and the landmarks behind each value."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Generic, Protocol, Self, TypeVar

import numpy as np
from numpy.typing import NDArray

from symboslam.engine.grid import Cells

Floats = NDArray[np.float64]


class Regions(Protocol):
    """Some parts of a map, such as the cells of a grid or fragments of landmarks."""

    def __len__(self) -> int: ...

    def take(self, index: NDArray[Any]) -> Self:
        """The regions at ``index`` (integers or a mask)."""
        ...


R = TypeVar("R", bound=Regions)


@dataclass(frozen=True)
class Contributions:
    """What a region's evidence is made of, in the units of P~; all parts together are P~(e).

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
        """(K,) the region's evidence P~."""
        return np.asarray(self.each.sum(0) + self.ground)


class Evidence(ABC, Generic[R]):
    """Evidence for K environments in regions of a map."""

    @abstractmethod
    def of(self, regions: R) -> Floats:
        """(m, K) evidence P~(e) of m regions; 0 where nothing speaks for e.

        Cells of a grid must be of one level.
        """

    @abstractmethod
    def contributions(self, regions: R) -> Iterator[Contributions]:
        """The landmarks behind the evidence of each region, in the order given."""

    @abstractmethod
    def without(self, regions: R, landmarks: Sequence[int]) -> Floats:
        """(m, K) evidence of the regions if the landmarks at these positions were not there.

        Computed anew, and so exact; what was estimated for the whole map stays as it is.
        """


class CellEvidence(Evidence[Cells]):
    """Evidence in the cells of a grid, which also says where larger cells will do."""

    @abstractmethod
    def settled(self, cells: Cells, evidence: Floats) -> NDArray[np.bool_]:
        """(m,) which cells need no splitting, given their (m, K) evidence."""


def normalised(evidence: Floats) -> Floats:
    """P(e) = P~(e) / sum of P~; rows without evidence stay 0 (design 5)."""
    total = evidence.sum(-1, keepdims=True)
    zeros = np.zeros_like(evidence)
    return np.asarray(np.divide(evidence, total, out=zeros, where=total > 0))
