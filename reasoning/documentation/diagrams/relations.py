"""Charts of relations: who, by what property, to whom; three columns with short lines between."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby

from symboslam.reasoning.documentation.diagrams.drawing import ROW, Box, Canvas
from symboslam.reasoning.documentation.diagrams.tree import columns

_GAP = 36.0


@dataclass(frozen=True)
class Relation:
    """A property and the classes that it joins.

    Attributes:
        via: what stands in the middle.
        left, right: keys of boxes; none for a side about which nothing is said.
    """

    via: Box
    left: tuple[str, ...]
    right: tuple[str, ...]


def draw_relations(
    boxes: Mapping[str, Box], relations: Sequence[Relation], most: int = 1000
) -> Canvas:
    """The relations, in groups with the same left side.

    A class may appear in several groups; in return no line is long and hardly any cross.

    Args:
        boxes: what stands in the boxes of both sides.
        relations: who, by what, to whom.
        most: how many are drawn at most.
    """

    def words(keys: tuple[str, ...]) -> tuple[str, ...]:
        return tuple(boxes[key].words.casefold() for key in keys)

    def order(relation: Relation) -> tuple[object, ...]:
        left = (not relation.left, words(relation.left), relation.left)
        right = (words(relation.right), relation.right)
        return (*left, *right, relation.via.words.casefold(), relation.via.href or "")

    ordered = sorted(relations, key=order)[:most]
    wide = [
        max((boxes[key].width for r in ordered for key in r.left), default=0.0),
        max((r.via.width for r in ordered), default=0.0),
    ]
    groups = [list(group) for _, group in groupby(ordered, key=lambda r: r.left)]
    return columns([_draw_group(boxes, group, wide) for group in groups])


def _draw_group(
    boxes: Mapping[str, Box], group: Sequence[Relation], wide: Sequence[float]
) -> Canvas:
    canvas = Canvas()
    left = group[0].left
    via_x = wide[0] + _GAP if wide[0] else 0.0
    right_x = via_x + wide[1] + _GAP
    height = max(len(group), len(left), sum(len(k) for k, _ in groupby(r.right for r in group)))
    start = (height - len(group)) / 2 * ROW
    rows = [start + i * ROW for i in range(len(group))]
    for i, relation in enumerate(group):
        canvas.box(relation.via, via_x, rows[i], wide[1])
    for j, key in enumerate(left):
        y = ((height - len(left)) / 2 + j) * ROW
        canvas.box(boxes[key], wide[0] - boxes[key].width, y)
        for row in rows:
            canvas.curve(wide[0], y + 11, via_x, row + 11)
    y = 0.0
    for keys, some in groupby(zip(rows, group, strict=True), key=lambda pair: pair[1].right):
        some_rows = [row for row, _ in some]
        wanted = (some_rows[0] + some_rows[-1] - (len(keys) - 1) * ROW) / 2
        y = max(y, wanted)
        for key in keys:
            canvas.box(boxes[key], right_x, y)
            canvas.head(right_x - 1, y + 11)
            for row in some_rows:
                canvas.curve(via_x + wide[1], row + 11, right_x - 8, y + 11, "dg-arrow")
            y += ROW
    return canvas
