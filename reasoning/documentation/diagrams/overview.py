"""The overview diagram: which module imports which."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from symboslam.reasoning.documentation.diagrams.drawing import ROW, Box, Canvas

_GAP, _STEP = 70.0, ROW + 8


def draw_layers(boxes: Mapping[str, Box], edges: Mapping[str, Sequence[str]]) -> Canvas:
    """Boxes in layers from left to right; an edge leads from a box to those that need it.

    Args:
        boxes: key -> box.
        edges: key -> keys of what it needs, which stand further left; without rings.

    Returns:
        The drawing. An edge that follows from others is left out.
    """
    needs = _reduced({key: [k for k in edges.get(key, ()) if k in boxes] for key in boxes})
    layers = _layers(needs)
    chains: dict[str, list[str]] = {key: list(found) for key, found in needs.items()}
    rank = {key: depth for depth, layer in enumerate(layers) for key in layer}
    for key in boxes:  # a long edge passes through an empty place in each layer between
        for i, below in enumerate(chains[key]):
            last = below
            for depth in range(rank[below] + 1, rank[key]):
                stop = f"{below}\n{depth}"
                if stop not in rank:
                    rank[stop] = depth
                    layers[depth].append(stop)
                    chains[stop] = [last]
                last = stop
            chains[key][i] = last
    _untangle(layers, chains)
    return _draw(boxes, layers, chains)


def _reduced(needs: dict[str, list[str]]) -> dict[str, list[str]]:
    """Edges without those that a longer way makes superfluous, and without rings."""
    reach: dict[str, set[str]] = {}

    def reached(key: str, above: frozenset[str]) -> set[str]:
        if key not in reach:
            needs[key] = [k for k in needs[key] if k not in above and k != key]
            found: set[str] = set()
            for below in needs[key]:
                found |= {below} | reached(below, above | {key})
            reach[key] = found
        return reach[key]

    for key in needs:
        reached(key, frozenset([key]))
    return {
        key: [b for b in found if not any(b in reach[other] for other in found if other != b)]
        for key, found in needs.items()
    }


def _layers(needs: Mapping[str, Sequence[str]]) -> list[list[str]]:
    depth: dict[str, int] = {}

    def deep(key: str) -> int:
        if key not in depth:
            depth[key] = 1 + max((deep(k) for k in needs[key]), default=-1)
        return depth[key]

    layers: list[list[str]] = [[] for _ in range(1 + max(map(deep, needs), default=-1))]
    for key in needs:
        layers[depth[key]].append(key)
    return layers


def _untangle(layers: list[list[str]], chains: Mapping[str, Sequence[str]]) -> None:
    """Order each layer by the mean place of its neighbours, back and forth a few times."""
    above: dict[str, list[str]] = {}
    for key, found in chains.items():
        for below in found:
            above.setdefault(below, []).append(key)
    for turn in range(8):
        order = range(1, len(layers)) if turn % 2 == 0 else range(len(layers) - 2, -1, -1)
        for depth in order:
            side = layers[depth - 1] if turn % 2 == 0 else layers[depth + 1]
            near = chains if turn % 2 == 0 else above
            place = {key: (i + 0.5) / len(side) for i, key in enumerate(side)}
            old = {key: (i + 0.5) / len(layers[depth]) for i, key in enumerate(layers[depth])}

            def middle(
                key: str,
                near: Mapping[str, Sequence[str]] = near,
                place: Mapping[str, float] = place,
                old: Mapping[str, float] = old,
            ) -> float:
                found = [place[k] for k in near.get(key, ()) if k in place]
                return sum(found) / len(found) if found else old[key]

            layers[depth].sort(key=middle)


def _draw(
    boxes: Mapping[str, Box],
    layers: Sequence[Sequence[str]],
    chains: Mapping[str, Sequence[str]],
) -> Canvas:
    canvas = Canvas()
    tallest = max((len(layer) for layer in layers), default=0) * _STEP
    spots: dict[str, tuple[float, float, float]] = {}
    x = 0.0
    for layer in layers:
        wide = max((boxes[key].width for key in layer if key in boxes), default=0.0)
        y = (tallest - len(layer) * _STEP) / 2
        for key in layer:
            spots[key] = (x, y, wide)
            if key in boxes:
                canvas.box(boxes[key], x, y, wide)
            y += _STEP
        x += wide + _GAP
    for key, found in chains.items():
        to_x, to_y, wide = spots[key]
        for below in found:
            from_x, from_y, from_wide = spots[below]
            canvas.curve(from_x + from_wide, from_y + 11, to_x, to_y + 11)
        if key not in boxes:
            canvas.line(to_x, to_y + 11, to_x + wide, to_y + 11)
    return canvas
