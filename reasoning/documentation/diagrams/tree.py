"""Trees from left to right; many leaves of one parent stand in several columns."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import inf

from symboslam.reasoning.documentation.diagrams.drawing import ROW, Box, Canvas

_GAP = 40.0  # between the levels of a tree
_APART = 14.0  # between trees
_LEAVES = 9  # more leaves than this under one parent stand in a block
_BLOCK_ROWS, _BLOCK_COLUMNS = 10, 4
_WIDEST = 1450.0  # of a forest
_MOST, _DEEPEST = 500, 40  # boxes and levels of a forest; what is deeper is counted, not drawn


@dataclass(frozen=True)
class Forest:
    """Boxes and which of them hang below which.

    Attributes:
        boxes: key -> what stands in its box.
        below: key -> keys right below, in drawing order; a key hangs below one other at most.
    """

    boxes: Mapping[str, Box]
    below: Mapping[str, Sequence[str]]

    @property
    def roots(self) -> list[str]:
        """Keys that hang below none."""
        lower = {key for keys in self.below.values() for key in keys}
        return [key for key in self.boxes if key not in lower]


def draw_forest(forest: Forest) -> Canvas:
    """All trees of a forest, in as many columns as make it about as wide as high."""
    forest = _cut(forest)
    lone = [key for key in forest.roots if not forest.below.get(key)]
    trees = [_Tree(forest, root) for root in forest.roots if forest.below.get(root)]
    blocks = [tree.canvas for tree in trees]
    if lone:
        blocks.append(draw_grid([forest.boxes[key] for key in lone]))
    return columns(blocks)


def _cut(forest: Forest) -> Forest:
    """A forest without its deepest levels if it has too many boxes."""
    levels: list[list[str]] = [forest.roots]
    while below := [k for key in levels[-1] for k in forest.below.get(key, ())]:
        levels.append(below)
    shown, count = len(levels), sum(map(len, levels))
    while shown > 1 and (count > _MOST or shown > _DEEPEST):
        shown -= 1
        count -= len(levels[shown])
    if shown == len(levels):
        return forest
    kept = {key for level in levels[:shown] for key in level}
    boxes = {key: box for key, box in forest.boxes.items() if key in kept}
    for key in levels[shown - 1]:
        if (more := _size(forest, key) - 1) > 0:
            box = boxes[key]
            boxes[key] = replace(box, style="inner", note=f"+ {more} below")
    below_kept = {k: tuple(b for b in v if b in kept) for k, v in forest.below.items() if k in kept}
    return Forest(boxes, below_kept)


def _size(forest: Forest, key: str) -> int:
    count, waiting = 0, [key]
    while waiting:
        count += 1
        waiting.extend(forest.below.get(waiting.pop(), ()))
    return count


class _Tree:
    """One tree, drawn."""

    def __init__(self, forest: Forest, root: str) -> None:
        self.forest, self.canvas = forest, Canvas()
        self.widths: list[float] = []
        self._measure(root, 0)
        self._y = 0.0
        self._put(root, 0)

    def _split(self, key: str) -> tuple[list[str], list[str]]:
        """What hangs below a key: keys with rows of their own, and the leaves of a block."""
        below = list(self.forest.below.get(key, ()))
        leaves = [k for k in below if not self.forest.below.get(k)]
        if len(leaves) <= _LEAVES:
            return below, []
        return [k for k in below if self.forest.below.get(k)], leaves

    def _measure(self, key: str, depth: int) -> None:
        if depth == len(self.widths):
            self.widths.append(0.0)
        self.widths[depth] = max(self.widths[depth], self.forest.boxes[key].width)
        for below in self._split(key)[0]:
            self._measure(below, depth + 1)

    def _x(self, depth: int) -> float:
        return sum(self.widths[:depth]) + _GAP * depth

    def _put(self, key: str, depth: int) -> float:
        """Draw a key and what is below it; the height of its middle."""
        box, x = self.forest.boxes[key], self._x(depth)
        own, leaves = self._split(key)
        middles = [self._put(below, depth + 1) for below in own]
        if leaves:
            middles.append(self._block(leaves, self._x(depth + 1)))
        if middles:
            middle = (middles[0] + middles[-1]) / 2
        else:
            middle = self._y + (ROW - 4) / 2
            self._y += ROW
        self.canvas.box(box, x, middle - (ROW - 4) / 2)
        for to in middles:
            self.canvas.curve(x + box.width, middle, self._x(depth + 1), to)
        return middle

    def _block(self, leaves: list[str], x: float) -> float:
        canvas = draw_grid([self.forest.boxes[key] for key in leaves])
        self.canvas.group(x, self._y, canvas.width + 12, canvas.height + 12)
        self.canvas.place(canvas, x + 6, self._y + 6)
        middle = self._y + canvas.height / 2 + 6
        self._y += canvas.height + 12 + 8
        return middle


def draw_grid(boxes: Sequence[Box]) -> Canvas:
    """Boxes in columns, one below the other."""
    canvas, x = Canvas(), 0.0
    count = min(_BLOCK_COLUMNS, -(-len(boxes) // _BLOCK_ROWS))
    rows = -(-len(boxes) // count) if count else 1
    for start in range(0, len(boxes), rows):
        column = boxes[start : start + rows]
        wide = max(box.width for box in column)
        for i, box in enumerate(column):
            canvas.box(box, x, i * ROW, wide)
        x += wide + 8
    return canvas


def columns(blocks: Sequence[Canvas], apart: float = _APART) -> Canvas:
    """Drawings in reading order, column by column, about as wide as high."""
    best, least = Canvas(), inf
    for count in range(1, 6):
        whole = Canvas()
        goal = sum(block.height + apart for block in blocks) / count
        x = y = wide = 0.0
        for block in blocks:
            if y and y + block.height / 2 > goal:
                x, y, wide = x + wide + 36, 0.0, 0.0
            whole.place(block, x, y)
            y += block.height + apart
            wide = max(wide, block.width)
        cost = max(whole.width / 1.6, whole.height)
        if cost < least and (whole.width <= _WIDEST or count == 1):
            best, least = whole, cost
    return best
