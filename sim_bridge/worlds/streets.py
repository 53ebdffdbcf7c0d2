"""Streets: a bent grid of streets and the blocks between them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from symboslam.sim_bridge.worlds.world import Extent, Road

Floats = NDArray[np.float64]

_BEND = 0.16  # how far a crossing leaves its place, in shares of the spacing
_MAIN = 3  # every third street goes through wherever it lies
_MAIN_WIDTH = 1.4  # times the width of other streets


@dataclass(frozen=True)
class Streets:
    """A grid of columns x rows blocks.

    Block ``(i, j)`` has the corners ``nodes[i, j]``, ``nodes[i + 1, j]``, ``nodes[i + 1, j + 1]``
    and ``nodes[i, j + 1]``, counterclockwise; its edges 0 to 3 begin at them: south, east, north,
    west.

    Attributes:
        extent: the world's rectangle, which the blocks fill.
        nodes: (columns + 1, rows + 1, 2) metres.
        width: street width in metres.
    """

    extent: Extent
    nodes: Floats
    width: float

    @property
    def shape(self) -> tuple[int, int]:
        """Columns and rows of blocks."""
        return self.nodes.shape[0] - 1, self.nodes.shape[1] - 1

    def corners(self, i: int, j: int) -> Floats:
        """(4, 2) corners of a block, counterclockwise from its south-west."""
        n = self.nodes
        return np.array([n[i, j], n[i + 1, j], n[i + 1, j + 1], n[i, j + 1]])

    @property
    def middles(self) -> Floats:
        """(columns, rows, 2) middles of the blocks."""
        n = self.nodes
        return np.asarray((n[:-1, :-1] + n[1:, :-1] + n[:-1, 1:] + n[1:, 1:]) / 4)

    @property
    def areas(self) -> Floats:
        """(columns, rows) areas of the blocks in square metres."""
        n = self.nodes
        d1, d2 = n[1:, 1:] - n[:-1, :-1], n[:-1, 1:] - n[1:, :-1]
        return np.asarray(np.abs(d1[..., 0] * d2[..., 1] - d1[..., 1] * d2[..., 0]) / 2)


@dataclass(frozen=True)
class Network:
    """Which edges of the grid carry a street, and how wide it is.

    Attributes:
        across: (columns, rows + 1) widths of edges from node (i, j) to (i + 1, j); 0 = no street.
        along: (columns + 1, rows) widths of edges from node (i, j) to (i, j + 1).
    """

    across: Floats
    along: Floats

    def around(self, i: int, j: int) -> Floats:
        """(4,) widths of the streets on a block's edges: south, east, north, west."""
        return np.array(
            [self.across[i, j], self.along[i + 1, j], self.across[i, j + 1], self.along[i, j]]
        )


def lay_streets(extent: Extent, spacing: float, width: float, rng: np.random.Generator) -> Streets:
    """A grid of streets about ``spacing`` metres apart, bent a little, straight at the border."""
    columns = max(2, round(extent.width / spacing))
    rows = max(2, round(extent.height / spacing))
    x = extent.min_x + extent.width * np.arange(columns + 1) / columns
    y = extent.min_y + extent.height * np.arange(rows + 1) / rows
    nodes = np.stack(np.meshgrid(x, y, indexing="ij"), -1)
    step = np.array([extent.width / columns, extent.height / rows])
    bend = np.zeros_like(nodes)
    bend[1:-1, :, 0] += rng.normal(size=columns - 1)[:, None] * 0.6  # whole streets shift
    bend[:, 1:-1, 1] += rng.normal(size=rows - 1)[None, :] * 0.6
    bend[1:-1, 1:-1] += rng.normal(size=(columns - 1, rows - 1, 2)) * 0.4  # and single crossings
    bend = np.clip(bend, -1.5, 1.5) * _BEND * step
    nodes[1:-1, :, 0] += bend[1:-1, :, 0]
    nodes[:, 1:-1, 1] += bend[:, 1:-1, 1]
    nodes[1:-1, 1:-1] = np.round(nodes[1:-1, 1:-1], 2)
    nodes[1:-1, [0, -1], 0] = np.round(nodes[1:-1, [0, -1], 0], 2)
    nodes[[0, -1], 1:-1, 1] = np.round(nodes[[0, -1], 1:-1, 1], 2)
    return Streets(extent, nodes, width)


def open_streets(streets: Streets, rural: NDArray[np.bool_]) -> Network:
    """Streets on the edges between blocks; few of them between blocks of open country.

    Args:
        streets: the grid.
        rural: (columns, rows) which blocks are open country.

    Returns:
        The widths; the border of the world has no street.
    """
    columns, rows = streets.shape
    width = streets.width
    first_x, first_y = (min(n // 2, _MAIN - 1) or 1 for n in (columns, rows))
    across = np.full((columns, rows + 1), width)
    across[:, first_y::_MAIN] *= _MAIN_WIDTH
    along = np.full((columns + 1, rows), width)
    along[first_x::_MAIN, :] *= _MAIN_WIDTH
    minor_x = np.ones(rows + 1, bool)
    minor_x[first_y::_MAIN] = False
    minor_y = np.ones(columns + 1, bool)
    minor_y[first_x::_MAIN] = False
    country = rural[:, :-1] & rural[:, 1:] & minor_x[None, 1:-1]
    across[:, 1:-1][country] = 0
    country = rural[:-1] & rural[1:] & minor_y[1:-1, None]
    along[1:-1][country] = 0
    across[:, [0, -1]] = 0
    along[[0, -1]] = 0
    return Network(across, along)


def roads_of(streets: Streets, network: Network) -> tuple[Road, ...]:
    """The streets as lines, one for each unbroken run of edges of one width."""
    columns, rows = streets.shape
    roads = []
    for j in range(rows + 1):
        roads += _runs(streets.nodes[:, j], network.across[:, j])
    for i in range(columns + 1):
        roads += _runs(streets.nodes[i, :], network.along[i, :])
    return tuple(roads)


def _runs(nodes: Floats, widths: Floats) -> list[Road]:
    roads, begin = [], 0
    for k in range(len(widths) + 1):
        if k == len(widths) or (k > begin and widths[k] != widths[begin]):
            if widths[begin] > 0:
                points = tuple((float(x), float(y)) for x, y in nodes[begin : k + 1])
                roads.append(Road(points, round(float(widths[begin]), 2)))
            begin = k
    return roads
