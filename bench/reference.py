"""The paper's equations written down plainly, loop by loop (design 5 and 6), to measure against.

Nothing here is shared with the engine: lists, loops and the formulas as they are printed.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

Point = tuple[float, float]
Row = Sequence[float]
Box = tuple[float, float, float, float]


def pair_loop(
    points: Sequence[Point], weight: Sequence[Row], diagonal: float, a: float = 0.5
) -> tuple[list[float], list[float], list[int]]:
    """P~(e), C(e) and n_e of one segment, pair by pair.

    Args:
        points: z positions in metres.
        weight: z rows of SP(e, x) * f_x, one for each environment.
        diagonal: the segment's diagonal in metres.
        a: weight of C against the share of pairs.

    Returns:
        P~, C and n, one entry for each environment; all 0 where z < 2.
    """
    z = len(points)
    environments = range(len(weight[0]) if z else 0)
    if z < 2:
        return [0.0] * len(environments), [0.0] * len(environments), [0] * len(environments)
    p, c, n = [], [], []
    for e in environments:
        members = [x for x in range(z) if weight[x][e] > 0]
        n_e = len(members) * (len(members) - 1)
        total = 0.0
        for x in members:
            for y in members:
                if x != y:
                    d = math.dist(points[x], points[y]) / diagonal
                    total += 0.5 * (weight[x][e] + weight[y][e]) * (1 - d)
        c_e = total / n_e if n_e else 0.0
        p.append(a * c_e + (1 - a) * n_e / (z * (z - 1)))
        c.append(c_e)
        n.append(n_e)
    return p, c, n


def classify(
    points: Sequence[Point],
    weight: Sequence[Row],
    box: Box,
    cells: int = 24,
    threshold: float = 0.55,
    min_landmarks: int = 3,
) -> dict[str, list[float]]:
    """P(e) of each segment of the grid with the paper's profile.

    A cell splits into quadrants while its largest P is below the threshold, unless it has too few
    landmarks or was split three times; a cell without evidence takes that of the cell it was split
    from.

    Args:
        points: n positions in metres.
        weight: n rows of SP(e, x) * f_x.
        box: (min x, min y, max x, max y) of the map.
        cells: finest cells along each side, a multiple of 8.
        threshold: largest P at which a cell is settled.
        min_landmarks: fewest landmarks of a cell that is split.

    Returns:
        ``depth-row-column`` of each segment -> P, or all 0 where nothing is known.
    """
    width, height = (box[2] - box[0]) / cells, (box[3] - box[1]) / cells
    last = cells - 1
    finest = [
        (min(int((y - box[1]) // height), last), min(int((x - box[0]) // width), last))
        for x, y in points
    ]
    found: dict[str, list[float]] = {}

    def visit(depth: int, row: int, column: int, inside: list[int], above: list[float]) -> None:
        span = 2 ** (3 - depth)
        diagonal = math.hypot(span * width, span * height)
        p, _, _ = pair_loop([points[i] for i in inside], [weight[i] for i in inside], diagonal)
        if sum(p) == 0:
            p = above
        total = sum(p)
        p = [v / total for v in p] if total else p
        certain = max(p) >= threshold
        if depth == 3 or len(inside) < max(min_landmarks, 1) or certain:
            found[f"{depth}-{row}-{column}"] = p
            return
        half = span // 2
        for r in (2 * row, 2 * row + 1):
            for c in (2 * column, 2 * column + 1):
                part = [i for i in inside if (finest[i][0] // half, finest[i][1] // half) == (r, c)]
                visit(depth + 1, r, c, part, p)

    environments = len(weight[0]) if weight else 0
    for row in range(cells // 8):
        for column in range(cells // 8):
            part = [i for i, (r, c) in enumerate(finest) if (r // 8, c // 8) == (row, column)]
            visit(0, row, column, part, [0.0] * environments)
    return found


def grow(
    points: Sequence[Point], weight: Sequence[Row], start: Point, momentum: int = 0, a: float = 0.5
) -> list[list[int]]:
    """Fragments by progressive clustering, everything anew at every step.

    Args:
        points: n positions in metres.
        weight: n rows of SP(e, x) * f_x.
        start: where the first fragment begins.
        momentum: landmarks that are passed over between one fragment and the next.
        a: weight of C against the share of pairs.

    Returns:
        The landmarks of each fragment, in the order in which they joined.
    """

    def winning(members: list[int]) -> float:
        xs, ys = zip(*(points[i] for i in members), strict=True)
        diagonal = math.hypot(max(xs) - min(xs), max(ys) - min(ys)) or 1.0
        p, _, _ = pair_loop([points[i] for i in members], [weight[i] for i in members], diagonal, a)
        return max(p) / sum(p) if sum(p) else 0.0

    def nearest(to: Point) -> list[int]:
        def key(i: int) -> tuple[float, int]:
            return (points[i][0] - to[0]) ** 2 + (points[i][1] - to[1]) ** 2, i

        return sorted(left, key=key)

    def centre(members: list[int]) -> Point:
        z = len(members)
        return sum(points[i][0] for i in members) / z, sum(points[i][1] for i in members) / z

    left, fragments = list(range(len(points))), []
    while left:
        members = nearest(start)[:3]
        left = [i for i in left if i not in members]
        while left:
            new = nearest(centre(members))[0]
            if winning([*members, new]) < winning(members) - 1e-12:
                break
            members.append(new)
            left.remove(new)
        fragments.append(members)
        if left:
            start = points[nearest(centre(members))[: momentum + 1][-1]]
    return fragments
