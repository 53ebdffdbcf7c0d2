"""World: extent, ground, roads, walls, zones with their true environment, objects and starts.

Lengths are metres, x east and y north; headings are radians from east, counterclockwise.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symboslam.sim_bridge.worlds.sizes import SIZES, Size

if TYPE_CHECKING:
    from shapely.geometry import Polygon

Point = tuple[float, float]
Ring = tuple[Point, ...]


@dataclass(frozen=True)
class Extent:
    """The rectangle that a world fills, in metres."""

    min_x: float
    min_y: float
    max_x: float
    max_y: float

    @property
    def width(self) -> float:
        """Metres from west to east."""
        return self.max_x - self.min_x

    @property
    def height(self) -> float:
        """Metres from south to north."""
        return self.max_y - self.min_y

    @property
    def area_km2(self) -> float:
        """Square kilometres."""
        return self.width * self.height / 1e6

    def has(self, x: float, y: float) -> bool:
        """Whether a point lies in it or on its border."""
        return self.min_x <= x <= self.max_x and self.min_y <= y <= self.max_y


@dataclass(frozen=True)
class Ground:
    """What the ground looks like: a name for people and a colour ``#rrggbb``."""

    name: str = "grass"
    colour: str = "#8a9a6b"


@dataclass(frozen=True)
class Road:
    """A road: the line of its middle and its width in metres."""

    points: Ring
    width: float = 8.0


@dataclass(frozen=True)
class Wall:
    """A wall: a line and its height in metres."""

    points: Ring
    height: float = 1.0


@dataclass(frozen=True)
class Zone:
    """A part of the world and the type of environment that it truly is.

    Attributes:
        environment: local name of the type, such as ``Residential``.
        rings: the outline and, after it, holes; each closed (the last point is the first).
    """

    environment: str
    rings: tuple[Ring, ...]

    @property
    def polygon(self) -> Polygon:
        """The zone as a shape."""
        from shapely.geometry import Polygon

        return Polygon(self.rings[0], self.rings[1:])

    @property
    def area_m2(self) -> float:
        """Square metres."""
        return float(self.polygon.area)


@dataclass(frozen=True)
class WorldObject:
    """Something that stands in a world.

    Attributes:
        id: unique in the world.
        kind: one of the 56 detector classes; ``class`` in files.
        x: metres east, of the middle of the footprint.
        y: metres north.
        z: metres above the ground, of the foot.
        heading: radians.
        scale: times the nominal size of the class.
        model: name of a variant of the class's mesh; None leaves the choice to class and id.
        name: text on it, such as that of a sign; None for none.
    """

    id: str
    kind: str
    x: float
    y: float
    z: float = 0.0
    heading: float = 0.0
    scale: float = 1.0
    model: str | None = None
    name: str | None = None

    @property
    def size(self) -> Size:
        """Length, width and height in metres, with the scale."""
        nominal = SIZES[self.kind]
        length, width, height = (float(v) * self.scale for v in nominal[:3])
        return Size(length, width, height, nominal.moves)


@dataclass(frozen=True)
class Start:
    """Where a robot starts: metres and radians."""

    x: float
    y: float
    heading: float = 0.0


@dataclass(frozen=True)
class World:
    """A world for robots; see ``docs/worlds.md`` for the file.

    Attributes:
        name: what it is called.
        extent: its rectangle.
        objects: what stands in it.
        zones: the ground truth; what no zone covers has none.
        roads: roads, for pictures, placement and driving.
        walls: walls, obstacles without a class.
        starts: where robots start, the first robot first; may be empty.
        ground: look of the ground.
        attribution: whose data it is, one line.
    """

    name: str
    extent: Extent
    objects: tuple[WorldObject, ...] = ()
    zones: tuple[Zone, ...] = ()
    roads: tuple[Road, ...] = ()
    walls: tuple[Wall, ...] = ()
    starts: tuple[Start, ...] = ()
    ground: Ground = field(default_factory=Ground)
    attribution: str = ""

    @property
    def class_counts(self) -> dict[str, int]:
        """Class -> number of objects, the most frequent first."""
        return dict(Counter(o.kind for o in self.objects).most_common())

    @property
    def positions(self) -> NDArray[np.float64]:
        """(n, 2) x and y of the objects in metres."""
        return np.array([(o.x, o.y) for o in self.objects], float).reshape(-1, 2)

    def environments_at(self, xy: NDArray[np.float64]) -> tuple[str | None, ...]:
        """True environment of (n, 2) points in metres; None where there is no zone.

        Where zones overlap the smallest counts, as in the benchmark.
        """
        import shapely

        order = sorted(range(len(self.zones)), key=lambda i: self.zones[i].area_m2)
        found: list[str | None] = [None] * len(xy)
        if not order:
            return tuple(found)
        tree = shapely.STRtree([self.zones[i].polygon for i in order])
        which, rank = tree.query(shapely.points(xy), predicate="intersects")
        best: dict[int, int] = {}
        for point, r in zip(which.tolist(), rank.tolist(), strict=True):
            best[point] = min(r, best.get(point, r))
        for point, r in best.items():
            found[point] = self.zones[order[r]].environment
        return tuple(found)

    def zone_areas_km2(self) -> dict[str, float]:
        """Environment -> square kilometres, the largest first."""
        areas: Counter[str] = Counter()
        for zone in self.zones:
            areas[zone.environment] += zone.area_m2 / 1e6  # type: ignore[assignment]
        return {name: float(area) for name, area in areas.most_common()}


def footprints(objects: tuple[WorldObject, ...]) -> NDArray[Any]:
    """(n,) shapely rectangles on which the objects stand, turned to their headings."""
    import shapely

    if not objects:
        return np.empty(0, object)
    half = np.array([[o.size.length / 2, o.size.width / 2] for o in objects])
    corners = half[:, None, :] * np.array([[1, 1], [-1, 1], [-1, -1], [1, -1]])[None]
    heading = np.array([o.heading for o in objects])
    cos, sin = np.cos(heading)[:, None], np.sin(heading)[:, None]
    x = corners[..., 0] * cos - corners[..., 1] * sin + np.array([[o.x] for o in objects])
    y = corners[..., 0] * sin + corners[..., 1] * cos + np.array([[o.y] for o in objects])
    return np.asarray(shapely.polygons(np.stack([x, y], -1)), object)
