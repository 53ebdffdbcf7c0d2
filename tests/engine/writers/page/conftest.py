"""Made-up maps for the page's tests: plausible evidence over any landmarks and any cutting."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
import pytest
import shapely
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from symboslam.engine._base import Evidence
from symboslam.engine.chain import Shares
from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.explanation import Reason
from symboslam.engine.frame import Frame
from symboslam.engine.grid import Cells
from symboslam.engine.landmarks import LandmarkMap, ReadReport
from symboslam.reasoning.knowledge import Environment, Feature, Indication, Knowledge

SL = "https://example.org/town#"
ENVIRONMENTS = {
    "Residential": ("#e8c468", "Land on which people live, in houses or flats"),
    "Commercial": ("#c4566b", "Land on which people trade, eat out or work in offices"),
    "Industrial": ("#8a6fae", "Land on which goods are made, stored or repaired"),
    "CommunityFacility": ("#4f86c6", "Land for schools, health, worship and administration"),
    "ParksAndRecreation": ("#5fa55a", "Land for play, sport and rest"),
    "TransportAndServices": ("#7d848c", "Land for roads, rail, power and water"),
    "NonUrban": ("#b9c98f", "Farm land, woods and open country"),
}
FEATURES: Mapping[str, Mapping[str, tuple[float, int, str]]] = {
    "House": {"Residential": (0.95, 0, "A house is where people live")},
    "Building": {
        "Residential": (0.35, 0, "Most buildings of which nothing more is known are homes"),
        "Commercial": (0.1, 0, "Some buildings of which nothing more is known are offices"),
    },
    "Shop": {"Commercial": (0.9, 0, "Shops stand where people trade")},
    "Restaurant": {"Commercial": (0.8, 0, "People eat out where they shop and work")},
    "Warehouse": {"Industrial": (0.95, 0, "Warehouses store what industry makes")},
    "School": {"CommunityFacility": (0.95, 0, "A school is a community facility")},
    "Bench": {
        "ParksAndRecreation": (0.5, 1, "People rest in parks"),
        "Commercial": (0.1, 0, "Some shopping streets have benches"),
    },
    "Tree": {
        "ParksAndRecreation": (0.3, 0, "Parks are planted with trees"),
        "NonUrban": (0.3, 0, "Woods and hedges stand in open country"),
        "Residential": (0.15, 0, "Gardens and streets have trees"),
    },
    "BusStop": {"TransportAndServices": (0.5, 0, "A bus stop belongs to a transport network")},
    "PowerTower": {
        "NonUrban": (0.6, 0, "Power lines cross open country"),
        "TransportAndServices": (0.4, 0, "A power tower is part of a supply network"),
    },
    "OpenGround": {"NonUrban": (1.0, 0, "Ground that was looked at and bears no landmark is open")},
}


def words(name: str) -> str:
    """``BusStop`` -> ``Bus stop``."""
    text = "".join(" " + c.lower() if c.isupper() else c for c in name).strip()
    return text[0].upper() + text[1:]


def knowledge_of(
    environments: Mapping[str, tuple[str, str]],
    features: Mapping[str, Mapping[str, tuple[float, int, str]]],
) -> Knowledge:
    """Knowledge in which each feature says what is written above."""
    return Knowledge(
        environments=tuple(
            Environment(SL + name, name, words(name), definition, colour)
            for name, (colour, definition) in environments.items()
        ),
        features=tuple(Feature(SL + name, name, words(name)) for name in features),
        indications=tuple(
            Indication(f, e, strength, steps, (f, "Park", e) if steps else (f, e), why, SL + "plan")
            for f, row in features.items()
            for e, (strength, steps, why) in row.items()
        ),
        proximities={},
        schemes={"all": tuple(environments)},
        absence=("OpenGround",) if "OpenGround" in features else (),
        source="made up",
        source_hash="5eed" * 16,
    )


class FieldMap(EnvironmentMap):
    """A map whose reasons come from the table ``parts``: (s, F, K) shares of P."""

    parts: NDArray[np.float64]
    counts: NDArray[np.int64]

    def told(self, segments: Sequence[int]) -> list[tuple[tuple[Reason, ...], Shares]]:
        return [(self._reasons(i), {}) for i in segments]

    def _reasons(self, i: int) -> tuple[Reason, ...]:
        found = [
            Reason(
                feature.name,
                feature.label,
                int(self.counts[i, f]),
                {e.name: float(v) for e, v in zip(self.environments, part, strict=True) if v},
            )
            for f, (feature, part) in enumerate(
                zip(self.knowledge.features, self.parts[i], strict=True)
            )
            if part.any()
        ]
        winner = self.environments[self.label[i]].name
        return tuple(sorted(found, key=lambda r: -abs(r.contribution.get(winner, 0.0))))


class NoEvidence(Evidence[Cells]):
    """Evidence that nobody asks."""

    def of(self, cells: Cells) -> Any:
        raise AssertionError

    def without(self, cells: Cells, landmarks: Sequence[int]) -> Any:
        raise AssertionError

    def contributions(self, cells: Cells) -> Any:
        raise AssertionError


MakeMap = Callable[..., EnvironmentMap]


def make_map(
    xy: NDArray[np.float64],
    names: Sequence[str],
    *,
    bbox: tuple[float, float, float, float],
    geometry: NDArray[Any] | None = None,
    side: int = 12,
    frame: Frame | None = None,
    knowledge: Knowledge | None = None,
    ground: float = 0.6,
    ids: Sequence[str] | None = None,
    segment_ids: Sequence[str] | None = None,
    config: Mapping[str, Any] | None = None,
    report: ReadReport | None = None,
    **columns: Any,
) -> FieldMap:
    """A map with evidence from a kernel as wide as a segment, which is not what the engine does.

    Args:
        xy: (n, 2) metres.
        names: feature of each landmark.
        bbox: the area in metres.
        geometry: the segments; ``side`` x ``side`` rectangles unless given.
        side: see above.
        frame: metres unless given.
        knowledge: the town's unless given.
        ground: evidence of open ground against that of one landmark; 0 = none.
        ids: of the landmarks.
        segment_ids: of the segments.
        config: settings of the map.
        report: of the reader.
        columns: more columns of the LandmarkMap.
    """
    knowledge = knowledge or knowledge_of(ENVIRONMENTS, FEATURES)
    west, south, east, north = bbox
    if geometry is None:
        xs, ys = np.linspace(west, east, side + 1), np.linspace(south, north, side + 1)
        column, row = (i.ravel() for i in np.meshgrid(np.arange(side), np.arange(side)))
        geometry = shapely.box(xs[column], ys[row], xs[column + 1], ys[row + 1])
        segment_ids = segment_ids or [f"3-{r}-{c}" for r, c in zip(row, column, strict=True)]
    s, n = len(geometry), len(xy)
    position = {f.name: i for i, f in enumerate(knowledge.features)}
    feature = np.array([position[name] for name in names], np.int32)
    weight = np.zeros((len(position), len(knowledge.environments)))
    place = {e.name: k for k, e in enumerate(knowledge.environments)}
    for said in knowledge.indications:
        weight[position[said.feature], place[said.environment]] = said.proximity
    middle = shapely.get_coordinates(shapely.centroid(geometry))
    width = np.sqrt(shapely.area(geometry).sum() / max(s, 1)) * 0.8 or 1.0
    crowd = np.zeros((s, len(position)))
    counts = np.zeros((s, len(position)), np.int64)
    for i, near in enumerate(cKDTree(xy).query_ball_point(middle, 3 * width) if n else []):
        distance = np.linalg.norm(xy[near] - middle[i], axis=1) / width
        np.add.at(crowd[i], feature[near], np.exp(-(distance**2) / 2))
        np.add.at(counts[i], feature[near], 1)
    if knowledge.absence and n:
        crowd[:, position[knowledge.absence[0]]] = ground
    parts = crowd[:, :, None] * weight
    total = parts.sum((1, 2), keepdims=True)
    parts = np.divide(parts, total, out=np.zeros_like(parts), where=total > 0.02)
    probability = parts.sum(1)
    tree = shapely.STRtree(geometry)
    inside = np.bincount(tree.query(shapely.points(xy), predicate="within")[1], minlength=s)
    made = FieldMap(
        environments=knowledge.environments,
        geometry=geometry,
        label=np.where(probability.any(1), probability.argmax(1), -1).astype(np.int16),
        probability=probability,
        segment_id=np.array(segment_ids or [f"s{i}" for i in range(s)], dtype=np.str_),
        landmark_count=inside.astype(np.int64),
        depth=np.zeros(s, np.int16),
        landmarks=LandmarkMap(
            feature=feature,
            x=xy[:, 0],
            y=xy[:, 1],
            confidence=np.round(0.6 + 0.4 * np.cos(np.arange(n)) ** 2, 2),
            static=np.ones(n, bool),
            id=np.array(ids if ids is not None else [f"n{i}" for i in range(n)], dtype=np.str_),
            frame=frame or Frame.metric(),
            bbox=bbox,
            report=report or ReadReport("town.geojson", n, Counter({"shop=moon": 2}), 1, 0, ()),
            **columns,
        ),
        knowledge=knowledge,
        config={"profile": "default", "scheme": "all", "segmentation": "grid", **(config or {})},
        evidence=NoEvidence(),
        regions=Cells(*np.zeros((3, s), np.int64)),
    )
    object.__setattr__(made, "parts", parts)
    object.__setattr__(made, "counts", counts)
    return made


def town_map(
    n: int = 3700, side: int = 24, size: float = 3000.0, seed: int = 1, **settings: Any
) -> FieldMap:
    """A town: clusters of landmarks of one kind each."""
    rng = np.random.default_rng(seed)
    kinds = [name for name in FEATURES if name != "OpenGround"]
    clusters = rng.uniform(0, size, (60, 2))
    kind = rng.choice(len(kinds), 60, p=np.array([30, 25, 8, 5, 6, 4, 5, 12, 3, 2]) / 100)
    cluster = rng.integers(0, 60, n)
    xy = np.clip(clusters[cluster] + rng.normal(0, size / 22, (n, 2)), 0.0, size)
    names = [kinds[k] for k in np.where(rng.random(n) < 0.75, kind[cluster], rng.integers(0, 10))]
    return make_map(xy, names, bbox=(0.0, 0.0, size, size), side=side, **settings)


def flat_map() -> FieldMap:
    """Rooms of a flat, 12 m x 9 m, with an ontology of its own; one room is no rectangle."""
    knowledge = knowledge_of(
        {
            "Kitchen": ("#d98a4a", "A room for cooking"),
            "Bathroom": ("#4a9fb8", "A room for washing"),
            "Bedroom": ("#8a78b8", "A room for sleeping"),
            "LivingRoom": ("#7fa65a", "A room for being together"),
        },
        {
            "Oven": {"Kitchen": (0.95, 0, "Ovens stand in kitchens")},
            "Sink": {
                "Kitchen": (0.5, 0, "Kitchens have a sink"),
                "Bathroom": (0.6, 0, "Bathrooms have a sink"),
            },
            "Bed": {"Bedroom": (0.95, 0, "Beds stand in bedrooms")},
            "Couch": {"LivingRoom": (0.9, 0, "Couches stand in living rooms")},
        },
    )
    rooms = np.array(
        [
            shapely.box(0, 0, 5, 4),
            shapely.box(5, 0, 8, 4),
            shapely.box(8, 0, 12, 9),
            shapely.Polygon([(0, 4), (8, 4), (8, 9), (3, 9), (0, 6.5)]),
        ]
    )
    xy = np.array([(1, 1), (2, 1), (6, 1), (6.5, 3), (10, 4), (11, 7), (3, 6), (5, 8)], float)
    names = ["Oven", "Sink", "Sink", "Sink", "Bed", "Bed", "Couch", "Couch"]
    return make_map(
        xy,
        names,
        bbox=(0.0, 0.0, 12.0, 9.0),
        geometry=rooms,
        knowledge=knowledge,
        segment_ids=["kitchen", "bath", "bed", "living"],
    )


@pytest.fixture
def make() -> MakeMap:
    """Any map from landmarks; see ``make_map``."""
    return make_map


@pytest.fixture
def make_town() -> MakeMap:
    """A made-up town; see ``town_map``."""
    return town_map


@pytest.fixture
def flat() -> EnvironmentMap:
    """A flat of four rooms."""
    return flat_map()
