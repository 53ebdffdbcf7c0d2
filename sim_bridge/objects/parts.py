"""The vocabulary of coloured solids from which the models of objects are put together.

Everything is a loft: rings of points, one after the other, joined by triangles. Lengths are metres,
x is forward, y left, z up.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

Colour = tuple[int, int, int]
Point = tuple[float, float, float]
Flat = tuple[float, float]
Floats = NDArray[np.float32]
Ints = NDArray[np.int32]

TAU = 2 * np.pi
GAP = 0.02  # metres between a wall and what is painted on it
# Side of a wall -> (outward, along): a viewer in front of it sees `along` go from left to right.
SIDES: dict[str, tuple[Point, Point]] = {
    "+x": ((1, 0, 0), (0, 1, 0)),
    "-x": ((-1, 0, 0), (0, -1, 0)),
    "+y": ((0, 1, 0), (-1, 0, 0)),
    "-y": ((0, -1, 0), (1, 0, 0)),
}


@dataclass(frozen=True)
class Part:
    """Triangles of one colour.

    Attributes:
        vertices: (n, 3) metres.
        faces: (m, 3) indices of vertices, anticlockwise seen from outside.
        rgba: red, green, blue, opacity, each in [0, 1].
        uv: (n, 2) places in the shape's picture, from its lower left corner, in [0, 1]; None
            where the part has a plain colour.
    """

    vertices: Floats
    faces: Ints
    rgba: tuple[float, float, float, float]
    uv: Floats | None = None


@dataclass(frozen=True)
class Shape:
    """What an object looks like: its origin is on the ground in the middle, its front is +x.

    Attributes:
        name: class and variant, such as ``House/3``.
        parts: one for each colour, and one for a picture.
        picture: (height, width, 3) bytes, top row first, for the parts with ``uv``.
    """

    name: str
    parts: tuple[Part, ...]
    picture: NDArray[np.uint8] | None = field(default=None, compare=False)

    @property
    def triangles(self) -> int:
        """How many triangles there are."""
        return sum(len(part.faces) for part in self.parts)

    @property
    def bounds(self) -> Floats:
        """(2, 3) metres: the lowest and the highest corner."""
        everything = np.concatenate([part.vertices for part in self.parts])
        return np.stack([everything.min(0), everything.max(0)])


def circle(n: int, *, start: float = 0.0) -> NDArray[np.float64]:
    """(n, 2) points of the unit circle."""
    angles = start + np.arange(n) * TAU / n
    return np.stack([np.cos(angles), np.sin(angles)], 1)


class Model:
    """A shape in the making; every method adds a solid in the colour given last."""

    def __init__(self) -> None:
        self._vertices: dict[Colour, list[NDArray[np.float64]]] = {}
        self._faces: dict[Colour, list[NDArray[np.int64]]] = {}

    def add(self, vertices: object, faces: object, colour: Colour) -> None:
        """Triangles as they are: (n, 3) metres and (m, 3) indices."""
        corners = np.asarray(vertices, float).reshape(-1, 3)
        before = sum(len(v) for v in self._vertices.setdefault(colour, []))
        self._vertices[colour].append(corners)
        self._faces.setdefault(colour, []).append(np.asarray(faces, np.int64) + before)

    def loft(self, rings: object, colour: Colour, *, closed: bool = True) -> None:
        """Join rings of points, (k, n, 3), to a solid; the ends are convex and get lids."""
        points = np.asarray(rings, float)
        k, n, _ = points.shape
        i, j = np.meshgrid(np.arange(k - 1), np.arange(n), indexing="ij")
        a, b = (i * n + j).ravel(), (i * n + (j + 1) % n).ravel()
        faces = [np.stack([a, b, b + n], 1), np.stack([a, b + n, a + n], 1)]
        if closed:
            fan = np.stack([np.zeros(n - 2, int), np.arange(1, n - 1), np.arange(2, n)], 1)
            faces += [fan[:, ::-1], fan + (k - 1) * n]
        flat = points.reshape(-1, 3)
        triangles = np.concatenate(faces)
        corners = flat[triangles]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        triangles = triangles[np.linalg.norm(normals, axis=1) > 1e-9]
        corners = flat[triangles] - flat.mean(0)
        volume = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])).sum()
        self.add(flat, triangles if volume >= 0 else triangles[:, ::-1], colour)

    def box(
        self, at: Point, size: Point, colour: Colour, *, top: Flat = (1, 1), shift: float = 0
    ) -> None:
        """A box that stands with the middle of its floor at ``at``.

        ``top`` is the size of the lid by that of the floor, ``shift`` how far forward the lid is.
        """
        x, y, z = at
        length, width, height = size
        rings = []
        for up, (sx, sy), dx in ((0.0, (1.0, 1.0), 0.0), (height, top, shift)):
            a, b = length / 2 * sx, width / 2 * sy
            rings.append(
                [
                    (x + dx + p * a, y + q * b, z + up)
                    for p, q in ((1, 1), (-1, 1), (-1, -1), (1, -1))
                ]
            )
        self.loft(rings, colour)

    def rod(
        self, a: Point, b: Point, r: float, colour: Colour, *, end: float | None = None, n: int = 6
    ) -> None:
        """A round bar between two points; ``end`` is its radius at the second one."""
        self.tube([a, b], [r, r if end is None else end], colour, n=n)

    def tube(
        self, path: Sequence[Point], radii: float | Sequence[float], colour: Colour, *, n: int = 6,
        squash: float = 1.0,
    ) -> None:  # fmt: skip
        """A round bar along a path, with one radius or one for each point.

        ``squash`` is its height by its width where the path is level.
        """
        points = np.asarray(path, float)
        sizes = np.broadcast_to(np.asarray(radii, float), len(points))
        along = np.gradient(points, axis=0)
        along /= np.linalg.norm(along, axis=1, keepdims=True)
        span = points[-1] - points[0]
        level = abs(span[2]) < 0.9 * np.linalg.norm(span)
        side = np.cross(along, (0.0, 0.0, 1.0) if level else (1.0, 0.0, 0.0))
        side /= np.linalg.norm(side, axis=1, keepdims=True)
        up = np.cross(side, along) * squash
        ring = circle(n, start=np.pi / n)
        self.loft(
            [
                p + r * (ring[:, :1] * s + ring[:, 1:] * u)
                for p, r, s, u in zip(points, sizes, side, up, strict=True)
            ],
            colour,
        )

    def beam(
        self, a: Point, b: Point, size: Flat, colour: Colour, *, end: Flat | None = None
    ) -> None:
        """A bar of rectangular section between two points: width across, height."""
        start, stop = np.asarray(a, float), np.asarray(b, float)
        along = stop - start
        steep = np.hypot(along[0], along[1]) < 1e-6
        side = np.cross(along, (1.0, 0.0, 0.0) if steep else (0.0, 0.0, 1.0))
        side /= np.linalg.norm(side)
        up = np.cross(side, along)
        up /= np.linalg.norm(up)
        rings = []
        for p, (w, h) in ((start, size), (stop, end or size)):
            rings.append(
                [
                    p + i * side * w / 2 + j * up * h / 2
                    for i, j in ((1, 1), (-1, 1), (-1, -1), (1, -1))
                ]
            )
        self.loft(rings, colour)

    def lathe(self, at: Point, profile: Sequence[Flat], colour: Colour, *, n: int = 8) -> None:
        """A solid turned about an upright axis: (radius, height above ``at``) from below."""
        ring = circle(n, start=np.pi / n)
        self.loft(
            [
                np.column_stack(
                    [at[0] + r * ring[:, 0], at[1] + r * ring[:, 1], np.full(n, at[2] + z)]
                )
                for r, z in profile
            ],
            colour,
        )

    def ball(self, at: Point, radii: Point, colour: Colour, *, n: int = 8, rings: int = 4) -> None:
        """An ellipsoid with its middle at ``at``."""
        angles = np.linspace(-np.pi / 2, np.pi / 2, rings + 1)
        ring = circle(n)
        self.loft(
            [
                np.asarray(at)
                + np.column_stack([np.cos(a) * ring, np.full(n, np.sin(a))]) * np.asarray(radii)
                for a in angles
            ],
            colour,
        )

    def wheel(self, at: Point, r: float, width: float, colour: Colour, *, n: int = 10) -> None:
        """A disc on an axle along y, with a light hub on its outer side."""
        x, y, z = at
        self.rod((x, y - width / 2, z), (x, y + width / 2, z), r, colour, n=n)
        out = 1 if y >= 0 else -1
        hub = circle(6) * r * 0.5
        face = np.column_stack(
            [x + hub[:, 0], np.full(6, y + out * (width / 2 + GAP)), z + hub[:, 1]]
        )
        fan = np.array([(0, i + 1, i) if out > 0 else (0, i, i + 1) for i in range(1, 5)])
        self.add(face, fan, (190, 190, 190))

    def extrude(self, outline: Sequence[Flat], y: Flat, colour: Colour) -> None:
        """An outline in the (x, z) plane, drawn out sideways from y[0] to y[1]."""
        self._prism(outline, y, (0, 2, 1), colour)

    def plate(self, outline: Sequence[Flat], z: Flat, colour: Colour) -> None:
        """An outline in the (x, y) plane, drawn up from z[0] to z[1]."""
        self._prism(outline, z, (0, 1, 2), colour)

    def front(self, outline: Sequence[Flat], x: Flat, colour: Colour) -> None:
        """An outline in the (y, z) plane, drawn forward from x[0] to x[1]."""
        self._prism(outline, x, (1, 2, 0), colour)

    def panel(self, side: str, at: Point, size: Flat, colour: Colour) -> None:
        """A rectangle painted on a wall: its middle and (width, height)."""
        outward, along = (np.asarray(v, float) for v in SIDES[side])
        middle = np.asarray(at, float) + outward * GAP
        a, b = along * size[0] / 2, np.array((0, 0, size[1] / 2))
        corners = [middle - a - b, middle + a - b, middle + a + b, middle - a + b]
        self.add(corners, [(0, 1, 2), (0, 2, 3)], colour)

    def build(self, name: str) -> Shape:
        """The finished shape, as it was put together."""
        parts = []
        for colour, vertices in self._vertices.items():
            red, green, blue = (max(0, min(255, round(c))) / 255 for c in colour)
            corners = np.concatenate(vertices).astype(np.float32)
            faces = np.concatenate(self._faces[colour]).astype(np.int32)
            parts.append(Part(corners, faces, (red, green, blue, 1.0)))
        return Shape(name, tuple(parts))

    def _prism(
        self, outline: Sequence[Flat], depth: Flat, axes: tuple[int, int, int], colour: Colour
    ) -> None:
        """A polygon (convex or not) drawn out; ``axes``: where first, second and depth go."""
        import shapely

        flat = np.asarray(outline, float)
        if shapely.LinearRing(flat).is_ccw != (axes in ((0, 1, 2), (1, 2, 0))):
            flat = flat[::-1]
        n = len(flat)
        places = {tuple(p): i for i, p in enumerate(flat)}
        lid = np.array([
            [places[tuple(c)] for c in np.asarray(t.exterior.coords)[:3]]
            for t in shapely.constrained_delaunay_triangles(shapely.Polygon(flat)).geoms
        ])  # fmt: skip
        a, b = flat[lid[:, 1]] - flat[lid[:, 0]], flat[lid[:, 2]] - flat[lid[:, 0]]
        turn = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
        same = (turn > 0) == shapely.LinearRing(flat).is_ccw
        lid = np.where(same[:, None], lid, lid[:, ::-1])
        low, high = np.zeros((n, 3)), np.zeros((n, 3))
        for corners, z in ((low, min(depth)), (high, max(depth))):
            corners[:, axes[0]], corners[:, axes[1]], corners[:, axes[2]] = (
                flat[:, 0],
                flat[:, 1],
                z,
            )
        i = np.arange(n)
        j = (i + 1) % n
        sides = np.concatenate([np.stack([i, j, j + n], 1), np.stack([i, j + n, i + n], 1)])
        self.add(
            np.concatenate([low, high]), np.concatenate([sides, lid[:, ::-1], lid + n]), colour
        )
