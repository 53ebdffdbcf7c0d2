"""Branch segmentation: each invariant on random maps and on maps that are hard to cut.

Hard are: all on one line, many at one place, lattices (everything is a tie), one class, one or two
landmarks, none.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import HealthCheck, given
from hypothesis import settings as examples
from hypothesis import strategies as st
from numpy.typing import NDArray

from symboslam.engine.boundaries import Parting, crossings, settle
from symboslam.engine.classify import classify
from symboslam.engine.counterfactual import without
from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.evidence import pair_evidence
from symboslam.engine.fragments import FragmentEvidence, Fragments
from symboslam.engine.growth import TOLERANCE, Fragment, Members, crowding, densest, grow
from symboslam.engine.nearest import FIRST, Nearest
from symboslam.engine.readers import read_landmarks
from symboslam.engine.sample import sample_area
from symboslam.engine.territories import territories
from symboslam.engine.triangulation import delaunay_edges, pair_lines
from symboslam.errors import InputError
from symboslam.reasoning.knowledge import Knowledge

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Points = list[tuple[float, float, int]]
WEIGHTS = np.array(
    [[0.9, 0, 0], [0, 0.8, 0], [0.3, 0, 0.3], [0, 0.5, 0.6], [0.2, 0.4, 0.5], [0, 0, 0]]
)
"""What six made-up classes say for three environments; the last says nothing."""
NAMES = ("House", "Shop", "Tree")

_class = st.integers(0, len(WEIGHTS) - 1)
_metres = st.floats(0, 240, allow_nan=False).map(lambda v: round(v, 3))
_tick = st.integers(0, 5).map(lambda v: 40.0 * v)
_spread = st.tuples(_metres, _metres, _class)
_lattice = st.tuples(_tick, _tick, _class)
_level = st.tuples(_metres, st.just(120.0), _class)
_slope = st.tuples(st.integers(0, 60).map(float), _class).map(lambda v: (v[0], 3 * v[0], v[1]))
_one_class = st.tuples(_metres, _metres, st.just(0))
_heap = st.tuples(st.just(7.0), st.just(7.0), _class)
HARD = st.one_of(
    *(st.lists(row, min_size=1, max_size=40)
      for row in (_spread, _lattice, _level, _slope, _one_class, _heap)),
    st.lists(st.one_of(_spread, _lattice, _heap), min_size=1, max_size=60),
)  # fmt: skip
RING = np.array(
    [(x, side) for x in range(-1105, 1106) for side in {math.isqrt(1105**2 - x * x) * s
     for s in (1, -1)} if x * x + side * side == 1105**2], float
)  # fmt: skip
"""108 places that are exactly as far from the origin."""
MICRON = 1e-6
"""Grid in metres on which polygons are compared: without one, GEOS errs where they touch."""
HERE = examples(max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture])


def arrays(points: Points) -> tuple[Floats, Floats]:
    """(n, 2) positions and (n, 3) weights."""
    columns = np.array(points, float).reshape(-1, 3)
    return columns[:, :2], WEIGHTS[columns[:, 2].astype(int)]


def winning(xy: Floats, weight: Floats, members: list[int]) -> float:
    """Largest P, from scratch, by the evidence that the grid uses."""
    place = xy[members]
    diagonal = math.hypot(*np.ptp(place, axis=0)) or 1.0
    p, _, _ = pair_evidence(place, weight[members], diagonal)
    return float(p.max() / p.sum()) if p.sum() > 0 else 0.0


def plain(xy: Floats, weight: Floats, start: tuple[float, float], momentum: int) -> list[list[int]]:
    """The definition word by word, everything anew at every step."""
    left, fragments = list(range(len(xy))), []
    points: list[list[float]] = xy.tolist()

    def nearest(x: float, y: float) -> list[int]:
        return sorted(left, key=lambda i: ((points[i][0] - x) ** 2 + (points[i][1] - y) ** 2, i))

    def centre(members: list[int]) -> tuple[float, float]:
        x, y = (sum(points[i][axis] for i in members) / len(members) for axis in (0, 1))
        return x, y

    while left:
        members = nearest(*start)[:3]
        left = [i for i in left if i not in members]
        while left:
            new = nearest(*centre(members))[0]
            if winning(xy, weight, [*members, new]) < winning(xy, weight, members) - TOLERANCE:
                break
            members.append(new)
            left.remove(new)
        fragments.append(members)
        if left:
            x, y = points[nearest(*centre(members))[: momentum + 1][-1]]
            start = x, y
    return fragments


@HERE
@given(HARD, st.integers(0, 3))
def test_growth_is_the_definition(points: Points, momentum: int) -> None:
    xy, weight = arrays(points)
    start = densest(xy)
    found = grow(xy, weight, 0.5, start, momentum)
    assert found == plain(xy, weight, start, momentum)
    assert sorted(i for members in found for i in members) == list(range(len(xy)))
    assert grow(xy, weight, 0.5, start, momentum) == found


@HERE
@given(HARD, st.floats(0.05, 0.95))
def test_the_winning_p_never_falls_and_is_what_a_recomputation_gives(
    points: Points, a: float
) -> None:
    xy, weight = arrays(points)
    for members in grow(xy, weight, a, densest(xy)):
        fragment, before = Fragment(3, a), 0.0
        for number, landmark in enumerate(members):
            said = [(e, float(w)) for e, w in enumerate(weight[landmark]) if w > 0]
            x, y = xy[landmark].tolist()
            if number < 3:
                fragment.add(landmark, (x, y), said)
            else:
                assert fragment.grow(landmark, (x, y), said)
                assert fragment.winning >= before - TOLERANCE
            before = fragment.winning
            place = xy[members[: number + 1]]
            diagonal = math.hypot(*np.ptp(place, axis=0)) or 1.0
            p, _, _ = pair_evidence(place, weight[members[: number + 1]], diagonal, a)
            expected = p.max() / p.sum() if p.sum() > 0 else 0.0
            assert fragment.winning == pytest.approx(expected, abs=1e-9)


def test_few_and_many_members_are_measured_alike() -> None:
    """Members are gone through one by one up to 48, and by numpy from there on."""
    rng = np.random.default_rng(1)
    xy, weight = rng.uniform(0, 100, (130, 2)), WEIGHTS[rng.integers(0, 5, 130)]
    members = Members(3)
    for number in range(130):
        x, y = xy[number].tolist()
        got = members.far(x, y, [(0, 1.0), (1, 1.0), (2, 1.0)])
        d, w = np.hypot(*(xy[:number] - xy[number]).T), weight[:number]
        expected = [((d @ (w > 0))[e], (d @ w)[e]) for e in range(3)]
        assert np.allclose(got, expected, rtol=1e-12)
        members.add(x, y, [(e, float(v)) for e, v in enumerate(weight[number]) if v > 0])


def test_growth_by_hand() -> None:
    """Along a street: houses at 0, 1, 2, 3, then shops at 10, 11, 12.

    Three houses begin and the fourth joins, for P stays 1; of the shops the first changes nothing
    (one makes no pair) and the second would: the fragment closes with five. The other two shops,
    nearest to its centre in order, are left.
    """
    houses: Points = [(x, 0, 0) for x in (0, 1, 2, 3)]
    xy, weight = arrays([*houses, *((x, 0, 1) for x in (10, 11, 12))])
    assert grow(xy, weight, 0.5, (0, 0)) == [[0, 1, 2, 3, 4], [5, 6]]
    # From the middle, the shop at 10 is as near as nothing else: 3, 2, 1 begin.
    assert grow(xy, weight, 0.5, (3, 0))[0] == [3, 2, 1, 0, 4]
    # One landmark passed over: the next fragment begins at 12, which takes 11 along.
    assert grow(xy, weight, 0.5, (0, 0), momentum=1) == [[0, 1, 2, 3, 4], [6, 5]]


def test_a_large_fragment_of_one_class_costs_no_distances() -> None:
    """All of 20,000 houses are one fragment; with every distance this would take minutes."""
    xy = np.random.default_rng(3).uniform(0, 1000, (20_000, 2))
    weight = np.tile(WEIGHTS[0], (len(xy), 1))
    (fragment,) = grow(xy, weight, 0.5, densest(xy))
    assert sorted(fragment) == list(range(len(xy)))
    regions = Fragments.of(np.zeros(len(xy), np.int64), xy)
    assert FragmentEvidence(xy, weight, 0.5).probability(regions).tolist() == [[1, 0, 0]]


def test_the_densest_spot_is_where_the_fifth_neighbour_is_nearest() -> None:
    """Of six in a row 3 m apart the two in the middle have their fifth neighbour at 9 m."""
    crowd: Points = [(100.0 + 3 * i, 100.0, 0) for i in range(6)]
    xy, _ = arrays([(10, 10, 0), (60, 10, 0), (60, 90, 0), *crowd])
    assert crowding(xy)[3:].tolist() == [15, 12, 9, 9, 12, 15]
    assert densest(xy) == (106, 100)
    assert densest(xy[:1]) == (10, 10)


@HERE
@given(HARD, st.randoms(use_true_random=False))
def test_nearest_is_what_sorting_gives(points: Points, random: Any) -> None:
    xy, _ = arrays(points)
    near, left = Nearest(xy), list(range(len(xy)))
    while left:
        x, y = random.uniform(-50, 300), random.choice([7.0, 120.0, random.uniform(0, 240)])
        count = random.choice([1, 1, 3, 50])
        order = sorted(left, key=lambda i: ((xy[i, 0] - x) ** 2 + (xy[i, 1] - y) ** 2, i))
        assert near.find(x, y, count) == order[:count]
        near.take(order[0])
        left.remove(order[0])
    assert near.find(0, 0) == []


@pytest.mark.parametrize("where", ["one place", "two places", "a ring"])
def test_nearest_of_more_than_a_list_at_one_distance(where: str) -> None:
    """No list of neighbours of a fixed length proves which is first of so many that are as near."""
    number = 20 * FIRST
    xy = {
        "one place": np.full((number, 2), 50.0),
        "two places": np.column_stack([np.arange(number) % 2 * 10.0, np.zeros(number)]),
        "a ring": RING[np.arange(number) % len(RING)],
    }[where]
    near, left = Nearest(xy), list(range(number))
    while left:
        order = sorted(left, key=lambda i: (xy[i, 0] ** 2 + xy[i, 1] ** 2, i))
        assert near.find(0, 0, 3) == order[:3]
        assert near.find(0, 0) == order[:1]
        gone = order[min(len(left) % 3, len(left) - 1)]
        near.take(gone)
        left.remove(gone)


@HERE
@given(HARD)
def test_pair_lines_are_the_shortest_that_join_each_fragment(points: Points) -> None:
    from scipy.sparse.csgraph import minimum_spanning_tree
    from scipy.spatial.distance import cdist

    columns = np.unique(np.array(points, float)[:, :2], axis=0)
    fragment = np.arange(len(columns)) * 7 % 3
    lines = pair_lines(columns, fragment)
    for number in range(3):
        members = np.flatnonzero(fragment == number)
        own = lines[np.isin(lines[:, 0], members)]
        assert len(own) == max(len(members) - 1, 0)
        assert np.isin(own, members).all()
        length = np.hypot(*(columns[own[:, 0]] - columns[own[:, 1]]).T).sum()
        shortest = minimum_spanning_tree(cdist(columns[members], columns[members])).sum()
        assert length == pytest.approx(shortest)


@pytest.mark.parametrize("n", [1, 2, 3, 30, 60])
@pytest.mark.parametrize("flat", [True, False])
def test_a_triangulation_leaves_nobody_out(n: int, flat: bool) -> None:
    x = np.random.default_rng(n).permutation(n) * 2.0
    xy = np.column_stack([x, 3 * x if flat else x**2])
    edges = delaunay_edges(xy)
    assert len(edges) == n - 1 if flat else len(edges) >= n - 1
    assert set(edges.ravel()) == (set(range(n)) if n > 1 else set())


@HERE
@given(HARD, st.integers(2, 5), st.floats(1, 400))
def test_after_the_trades_no_pair_lines_cross(points: Points, parts: int, reach: float) -> None:
    xy = np.unique(np.array(points, float)[:, :2], axis=0)
    fragment = np.random.default_rng(len(xy)).integers(0, parts, len(xy))
    found = settle(xy, fragment, reach)
    assert len(found) == len(xy)
    assert (settle(xy, fragment, reach) == found).all()
    lines = pair_lines(xy, found)
    short = lines[np.hypot(*(xy[lines[:, 0]] - xy[lines[:, 1]]).T) <= reach]
    for i, (a, b) in enumerate(short.tolist()):  # all with all, without a tree
        for c, d in short[:i].tolist():
            if found[a] != found[c]:
                one, two = shapely.linestrings([xy[[a, b]], xy[[c, d]]])
                assert not shapely.intersects(one, two)


@HERE
@given(HARD, st.integers(1, 4))
def test_lines_taken_over_are_those_made_anew(points: Points, moves: int) -> None:
    xy = np.unique(np.array(points, float)[:, :2], axis=0)
    rng = np.random.default_rng(len(xy))
    fragment = rng.integers(0, 4, len(xy))
    after = fragment.copy()
    after[rng.integers(0, len(xy), moves)] = rng.integers(0, 4)
    kept = Parting.of(xy, after, 200.0, Parting.of(xy, fragment, 200.0))
    anew = Parting.of(xy, after, 200.0)

    def length(parting: Parting) -> Any:  # where lines are equally long there are several trees
        return [
            np.hypot(*(xy[own[:, 0]] - xy[own[:, 1]]).T).sum()
            for number in range(4)
            if len(own := parting.lines[parting.fragment[parting.lines[:, 0]] == number])
        ]

    assert length(kept) == pytest.approx(length(anew))


def test_a_crossing_pair_is_parted_by_the_landmarks_around_it() -> None:
    """Two rows of houses, 0 to the west and 1 to the east; one of each has strayed over.

    The boundary lies half-way, at x = 5, so the strayed ones change over and nothing falls apart.
    """
    west = [(0.0, float(y)) for y in range(8)]
    east = [(10.0, float(y) + 0.1) for y in range(8)]
    strayed = [(9.0, 3.4), (1.0, 3.6)]
    xy = np.array([*west, *east, *strayed])
    fragment = np.array([0] * 8 + [1] * 8 + [0, 1])
    assert len(crossings(xy, fragment, pair_lines(xy, fragment), 100.0))
    assert settle(xy, fragment, 100.0).tolist() == [0] * 8 + [1] * 8 + [1, 0]


def test_what_no_boundary_resolves_falls_apart() -> None:
    """Two pairs whose lines cross, and nothing around them: the first line is taken out."""
    xy = np.array([[0.0, 0], [2, 2], [0, 2], [2, 0]])
    found = settle(xy, np.array([0, 0, 1, 1]), 10.0)
    assert len(set(found.tolist())) == 3
    assert found[2] == found[3]


@HERE
@given(HARD, st.floats(1, 100))
def test_territories_never_overlap_and_hold_their_own(points: Points, reach: float) -> None:
    xy = np.unique(np.array(points, float)[:, :2], axis=0)
    fragment = np.unique(np.arange(len(xy)) * 7 % 4, return_inverse=True)[1]
    box = (-5.0, -5.0, 245.0, 245.0)
    ground = territories(xy, fragment, reach, box, None)
    assert shapely.is_valid(ground).all()
    common = shapely.area(shapely.intersection(ground[:, None], ground, grid_size=MICRON))
    assert common[~np.eye(len(ground), dtype=bool)].max(initial=0) < 1e-3 * reach
    assert (shapely.distance(ground[fragment], shapely.points(xy)) < 1e-4 * reach).all()
    assert shapely.covers(shapely.box(*box).buffer(1e-6), ground).all()
    near = shapely.buffer(shapely.multipoints(xy), reach * 1.0001, quad_segs=64)
    assert shapely.covers(near, ground).all()  # farther away is nobody's ground
    middle = np.random.default_rng(0).uniform(0, 240, (50, 2))
    distance = np.hypot(*(middle[:, None] - xy[None]).transpose(2, 0, 1))
    ranked = np.sort(distance, axis=1)
    for point, row, order in zip(middle, distance, ranked, strict=True):
        clear = len(order) == 1 or order[1] - order[0] > 1e-3
        if order[0] < 0.9 * reach and clear:  # the disc is drawn with straight sides
            assert shapely.intersects_xy(ground[fragment[row.argmin()]], *point)


def made(landmarks_at: Callable[..., Any], points: Points) -> Any:
    """A map of the small world's features."""
    return landmarks_at([(NAMES[c % 3], x, y) for x, y, c in points])


def check(found: EnvironmentMap) -> None:
    """What holds for every branch map."""
    marks = found.landmarks
    assert found.landmark_count.sum() == len(marks)
    members = [m for part in found.regions.members for m in part.tolist()]  # type: ignore[attr-defined]
    assert sorted(members) == list(range(len(marks)))
    assert len(set(found.segment_id.tolist())) == len(found)
    sums = found.probability.sum(1)
    assert np.allclose(sums[found.label >= 0], 1)
    assert not sums[found.label < 0].any()
    west, south, east, north = marks.bbox
    whole = (east - west) * (north - south)
    assert shapely.area(found.geometry).sum() == pytest.approx(whole, rel=1e-5)
    assert shapely.is_valid(found.geometry).all()
    assert not shapely.is_empty(found.geometry).any()
    assert shapely.area(shapely.union_all(found.geometry)) == pytest.approx(whole, rel=1e-5)
    one, two = shapely.STRtree(found.geometry).query(found.geometry, predicate="intersects")
    one, two = found.geometry[one[one < two]], found.geometry[two[one < two]]
    common = shapely.area(shapely.intersection(one, two, grid_size=MICRON))
    assert common.max(initial=0) < 1e-3 * found.config["reach"]  # rounding


def own_ground(found: EnvironmentMap) -> tuple[Floats, NDArray[np.int64]]:
    """Distinct positions of the landmarks that are in a fragment, and the segment of each."""
    segment = np.zeros(len(found.landmarks), np.int64)
    for i, part in enumerate(found.regions.members):  # type: ignore[attr-defined]
        segment[part] = i
    held = found.segment_id[segment] != "b-0"
    xy, first = np.unique(found.landmarks.xy[held], axis=0, return_index=True)
    return xy, segment[held][first]


def check_neighbours(found: EnvironmentMap, most: int = 1000) -> None:
    """Each landmark is on its own ground; no lines cross; like neighbours are one, if they can."""
    xy, segment = own_ground(found)
    if len(xy) < 2:
        return
    reach = found.config["reach"]
    apart = shapely.distance(found.geometry[segment], shapely.points(xy))
    assert apart.max() < 1e-4 * reach
    now = Parting.of(xy, segment, reach)
    assert not len(now.crossings)
    edges = delaunay_edges(xy)
    near = np.hypot(*(xy[edges[:, 0]] - xy[edges[:, 1]]).T) <= reach
    pairs = np.unique(np.sort(segment[edges[near]], 1), axis=0)
    alike = (found.label[pairs[:, 0]] == found.label[pairs[:, 1]]) & (pairs[:, 0] != pairs[:, 1])
    for one, two in pairs[alike][:most].tolist():
        if found.label[one] >= 0:
            together = np.where(segment == two, one, segment)
            assert len(Parting.of(xy, together, reach, now).crossings)


@HERE
@given(points=HARD)
def test_branch_maps(
    landmarks_at: Callable[..., Any], knowledge: Knowledge, points: Points
) -> None:
    marks = made(landmarks_at, points)
    found = classify(marks, knowledge, segmentation="branch")
    check(found)
    check_neighbours(found)
    again = classify(marks, knowledge, segmentation="branch")
    assert (again.label == found.label).all()
    assert (shapely.to_wkb(again.geometry) == shapely.to_wkb(found.geometry)).all()
    for i, parts in enumerate(found.contributions(range(len(found)))):
        if found.label[i] >= 0:
            p = parts.total / parts.total.sum()
            assert p == pytest.approx(found.probability[i], abs=1e-12)


def test_like_neighbours_that_come_about_by_trades_merge(bundled: Knowledge) -> None:
    """In a town trades and merges make neighbours of one type that were none before."""
    found = classify(
        read_landmarks(sample_area(seed=7), bundled), bundled, segmentation="branch", relevance=0.2
    )
    check(found)
    check_neighbours(found)


@pytest.mark.slow
@pytest.mark.timeout(1200)
@pytest.mark.parametrize("kinds", [1, 200])
def test_a_map_of_a_hundred_thousand(bundled: Knowledge, area: Any, kinds: int) -> None:
    rng = np.random.default_rng(kinds)
    xy = np.round(rng.uniform(0, 25_000, (100_000, 2)), 1)
    xy[:500] = xy[0]
    some = [f.name for f in bundled.features if f.static][:kinds]
    rows = [(some[k % len(some)], x, y, 1.0) for k, (x, y) in enumerate(xy.tolist())]
    found = classify(area(rows, (0, 0, 25_000, 25_000)), bundled, segmentation="branch")
    check(found)
    check_neighbours(found, 40)


def test_no_landmarks_is_a_map_that_is_all_unknown(
    landmarks_at: Callable[..., Any], knowledge: Knowledge
) -> None:
    found = classify(landmarks_at([]), knowledge, segmentation="branch")
    assert found.segment_id.tolist() == ["b-0"]
    assert found.shares() == {"Home": 0, "Work": 0, "Open": 0, None: 1}


def test_one_and_two_landmarks(landmarks_at: Callable[..., Any], knowledge: Knowledge) -> None:
    """One says what it says; a house and a shop make no pair, so nothing is known of them."""
    one = classify(landmarks_at([("House", 5, 5)]), knowledge, segmentation="branch")
    assert one.segment_id.tolist() == ["b-0", "b-1"]
    assert [one.name_of(0), one.name_of(1)] == [None, "Home"]
    assert one.probability[1].tolist() == [1, 0, 0]
    two = classify(
        landmarks_at([("House", 5, 5), ("Shop", 9, 5)]), knowledge, segmentation="branch"
    )
    assert two.landmark_count.tolist() == [0, 2]
    assert two.name_of(1) is None
    both = landmarks_at([("House", 5, 5), ("House", 9, 5)])
    assert classify(both, knowledge, segmentation="branch").name_of(1) == "Home"


def test_counterfactual_of_a_fragment_by_hand() -> None:
    """Two houses 6 m apart and a shop pair 8 m apart in a box of 6 m x 8 m: the diagonal is 10.

    C(Home) = 0.9 (1 - 0.6) and C(Work) = 0.8 (1 - 0.8); both have 2 of 12 ordered pairs. Without
    the first shop nothing but the houses' pair is left, with 2 of 6; its distance still counts
    over 10 m.
    """
    xy = np.array([[0.0, 0], [6, 0], [0, 0], [0, 8]])
    weight = WEIGHTS[[0, 0, 1, 1]]
    evidence, regions = FragmentEvidence(xy, weight, 0.5), Fragments.of(np.zeros(4, int), xy)
    assert regions.diagonal.tolist() == [10]
    home, work, _ = evidence.of(regions)[0]
    assert home == pytest.approx(0.5 * 0.9 * 0.4 + 0.5 * 2 / 12)
    assert work == pytest.approx(0.5 * 0.8 * 0.2 + 0.5 * 2 / 12)
    left = evidence.without(regions, [2])[0]
    assert left == pytest.approx([0.5 * 0.9 * 0.4 + 0.5 * 2 / 6, 0, 0])
    assert evidence.without(regions, [0, 1, 2])[0] == pytest.approx(WEIGHTS[1])  # one alone


@HERE
@given(points=HARD, gone=st.lists(st.integers(0, 59), max_size=3))
def test_counterfactual_of_a_map(
    landmarks_at: Callable[..., Any], knowledge: Knowledge, points: Points, gone: list[int]
) -> None:
    """Without some landmarks P is that of the smaller fragment over the old diagonal."""
    found = classify(made(landmarks_at, points), knowledge, segmentation="branch", a=0.3)
    gone = sorted({g for g in gone if g < len(points)})
    regions = found.regions
    assert isinstance(regions, Fragments)
    evidence = found.evidence
    assert isinstance(evidence, FragmentEvidence)
    for i, name in enumerate(found.segment_id.tolist()):
        rest = [m for m in regions.members[i].tolist() if m not in gone]
        marks = found.landmarks.take(np.array(rest, int))
        weight = evidence._weight[rest]
        if len(rest) == 1:
            p = weight[0]
        else:
            p, _, _ = pair_evidence(marks.xy, weight, regions.diagonal[i] or 1.0, 0.3)
        p = p / p.sum() if p.sum() > 0 else p
        assert list(without(found, name, gone).values()) == pytest.approx(p.tolist(), abs=1e-9)


def test_ground_that_was_not_surveyed_is_unknown(
    landmarks_at: Callable[..., Any], knowledge: Knowledge
) -> None:
    west = shapely.box(0, 0, 50, 240)
    rows = [("House", 10 * i, 20) for i in range(10)] + [("Shop", 200 + i, 200) for i in range(4)]
    marks = replace(landmarks_at(rows), surveyed=west)
    found = classify(marks, knowledge, segmentation="branch", reach=30.0)
    assert found.segment_id.tolist()[0] == "b-0"
    assert found.label.tolist() == [-1, 0]
    # The first shop joined the houses, for one makes no pair; the others have no ground.
    assert found.landmark_count.tolist() == [3, 11]
    assert shapely.covers(west.buffer(1e-6), found.geometry[1])
    assert shapely.area(found.geometry[1]) > 1000


def test_the_configuration_repeats_the_map(
    landmarks_at: Callable[..., Any], knowledge: Knowledge
) -> None:
    rng = np.random.default_rng(4)
    marks = landmarks_at(
        [(NAMES[c], x, y) for (x, y), c in zip(
            rng.uniform(0, 240, (80, 2)), rng.integers(0, 3, 80), strict=True)]
    )  # fmt: skip
    found = classify(marks, knowledge, segmentation="branch", seed_position=(200, 30), momentum=2)
    assert found.config["momentum"] == 2
    assert found.config["seed_position"] == (200, 30)
    assert found.config["reach"] > 0
    again = classify(marks, knowledge, **found.config)
    assert (again.segment_id == found.segment_id).all()
    assert (again.probability == found.probability).all()
    other = classify(marks, knowledge, segmentation="branch")
    assert other.landmark_count.tolist() != found.landmark_count.tolist()


@pytest.mark.parametrize(
    "changes",
    [{"momentum": -1}, {"momentum": 1.5}, {"reach": 0}, {"reach": math.inf}, {"relevance": 2},
     {"seed_position": (1,)}, {"seed_position": (math.nan, 1)}, {"seed_position": "1,2"}],
)  # fmt: skip
def test_settings_out_of_range(
    landmarks_at: Callable[..., Any], knowledge: Knowledge, changes: dict[str, Any]
) -> None:
    with pytest.raises(InputError, match=next(iter(changes))):
        classify(landmarks_at([("House", 1, 1)]), knowledge, segmentation="branch", **changes)
