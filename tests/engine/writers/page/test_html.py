"""The page as a document: complete in itself, safe against hostile input, true to the map."""

from __future__ import annotations

import io
import json
import re
from base64 import b64encode
from collections import Counter
from collections.abc import Callable
from dataclasses import replace
from hashlib import sha256
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.frame import Frame
from symboslam.engine.landmarks import ReadReport
from symboslam.engine.writers import write_map
from symboslam.engine.writers.html import render_html, write
from symboslam.engine.writers.options import WriteOptions
from symboslam.engine.writers.page import payload as payload_module
from symboslam.engine.writers.page.outlines import Quantiser
from symboslam.engine.writers.page.payload import colour, payload
from symboslam.engine.writers.page.words import local_name, plural, running

MakeMap = Callable[..., EnvironmentMap]
NASTY = "</script><script>document.documentElement.dataset.pwned = 1</script><img src=x onerror=x>"


class Outline(HTMLParser):
    """Start tags with their attributes, and the content of script and style elements."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.raw: list[tuple[str, dict[str, str | None], str]] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))

    def handle_data(self, data: str) -> None:
        if self.tags and self.cdata_elem:
            self.raw.append((*self.tags[-1], data))


def data_of(page: str) -> dict[str, Any]:
    """The embedded data, as a browser would read them."""
    found = [text for tag, attrs, text in Outline(page).raw if attrs.get("id") == "map-data"]
    assert len(found) == 1
    return dict(json.loads(found[0]))


def hostile(make: MakeMap) -> EnvironmentMap:
    """A map in which every text that comes from outside tries to break out."""
    made = make(
        np.array([[10.0, 10.0], [80.0, 80.0]]),
        ["House", "Shop"],
        bbox=(0.0, 0.0, 100.0, 100.0),
        side=2,
        ids=[NASTY, "\"'><svg onload=x>"],
        segment_ids=[f"{i}{NASTY}" for i in range(4)],
        config={"title": NASTY, "note": NASTY},
        report=ReadReport(
            NASTY, 2, Counter({NASTY: 3}), 0, 0, (NASTY, "\ud800 half a pair"), NASTY
        ),
    )
    knowledge = made.knowledge
    first, *others = made.environments
    bad = replace(first, label=NASTY, definition=NASTY, colour="url(https://evil.example/x.png)")
    return replace(
        made,
        environments=(bad, *others),
        knowledge=replace(
            knowledge,
            features=tuple(replace(f, label=NASTY, definition=NASTY) for f in knowledge.features),
            indications=tuple(
                replace(i, reason=NASTY, source=NASTY, path=(NASTY,)) for i in knowledge.indications
            ),
            source=NASTY,
        ),
    )


@pytest.fixture
def nasty(make: MakeMap) -> EnvironmentMap:
    made = make(np.array([[10.0, 10.0]]), ["House"], bbox=(0.0, 0.0, 100.0, 100.0))
    broken = hostile(make)
    for name in ("parts", "counts"):  # what `replace` does not carry over
        object.__setattr__(broken, name, np.zeros((4, *getattr(made, name).shape[1:])))
    return broken


# ---- complete in itself -------------------------------------------------------------------


def test_nothing_is_fetched(make_town: MakeMap) -> None:
    page = render_html(make_town(n=50, side=4))
    outline = Outline(page)
    for tag, attributes in outline.tags:
        for name in ("src", "href", "srcset", "poster", "action", "data"):
            assert (attributes.get(name) or "#").startswith(("#", "data:")), (tag, attributes)
    assert {tag for tag, _ in outline.tags}.isdisjoint({"iframe", "object", "embed", "base"})
    code = "".join(text for tag, attrs, text in outline.raw if attrs.get("id") != "map-data")
    assert len(code) > 10_000
    for word in ("http:", "https:", "url(", "@import", "fetch(", "XMLHttpRequest", "WebSocket"):
        assert word not in code, word
    for word in ("innerHTML", "outerHTML", "insertAdjacent", "document.write", "eval("):
        assert word not in code, f"{word} could turn words of the input into markup"


def test_policy_allows_exactly_our_script_and_style(make_town: MakeMap) -> None:
    outline = Outline(render_html(make_town(n=50, side=4)))
    policies = [a["content"] for t, a in outline.tags if t == "meta" and "http-equiv" in a]
    assert len(policies) == 1
    rules = dict(part.strip().split(" ", 1) for part in str(policies[0]).split(";"))
    assert rules["default-src"] == "'none'"
    assert rules["img-src"] == "data:"
    for kind in ("script", "style"):
        contents = [t for tag, a, t in outline.raw if tag == kind and "type" not in a]
        assert len(contents) == 1
        digest = b64encode(sha256(contents[0].encode()).digest()).decode()
        assert rules[f"{kind}-src"] == f"'sha256-{digest}'"
    assert not any(name.startswith("on") or name == "style" for _, a in outline.tags for name in a)


def test_equal_maps_give_equal_pages(make_town: MakeMap) -> None:
    assert render_html(make_town(n=80, side=5)) == render_html(make_town(n=80, side=5))


def test_size_of_a_town(make_town: MakeMap) -> None:
    page = render_html(make_town(n=3700, side=24), reasons=16)
    assert len(page.encode()) < 1_500_000


def test_placeholders_are_all_filled(flat: EnvironmentMap) -> None:
    assert "@@" not in render_html(flat)


# ---- hostile input ------------------------------------------------------------------------


def test_words_of_the_input_are_never_markup(nasty: EnvironmentMap) -> None:
    page = render_html(nasty)
    assert page.count("<script") == 2
    assert page.count("</script") == 2
    assert not re.search(r"<(img|svg)[^>]*(onerror|onload)", page)
    data = data_of(page)
    assert data["title"] == NASTY
    assert data["envs"][0]["label"] == NASTY
    assert data["landmarks"]["id"][0] == NASTY
    assert data["report"]["unknown"] == [[NASTY, 3]]
    page.encode("utf-8")  # half a surrogate pair does not stop the writer


def test_a_colour_is_a_colour(nasty: EnvironmentMap) -> None:
    assert data_of(render_html(nasty))["envs"][0]["colour"] == "#888888"


@settings(deadline=None)
@given(st.text())
def test_colour_is_always_safe(text: str) -> None:
    assert re.fullmatch(r"#[0-9a-f]{6}", colour(text))


def test_colour_keeps_good_ones() -> None:
    assert colour("#AbCd01") == "#abcd01"
    assert colour("#abc") == "#888888"
    assert colour("#abcd01\n") == "#888888"


# ---- true to the map ----------------------------------------------------------------------


def test_segments_keep_their_place(flat: EnvironmentMap) -> None:
    data = payload(flat, 5)
    unit, (ox, oy) = data["unit"], data["origin"]
    boxes = np.array(data["segments"]["box"]).reshape(-1, 4) * unit + [ox, oy, 0, 0]
    assert unit == 0.001
    np.testing.assert_allclose(boxes[1], [5, 0, 3, 4])
    assert list(data["segments"]["rings"]) == ["3"]  # the one that is no rectangle
    (ring,) = data["segments"]["rings"]["3"]
    corners = np.cumsum(np.array(ring).reshape(-1, 2), axis=0) * unit + [ox, oy]
    assert shapely.Polygon(corners).equals(flat.geometry[3])
    assert data["segments"]["id"] == ["kitchen", "bath", "bed", "living"]


def test_holes_are_kept(make: MakeMap) -> None:
    ring = shapely.box(0, 0, 90, 90) - shapely.box(30, 30, 60, 60)
    geometry = np.array([ring, shapely.box(30, 30, 60, 60)])
    made = make(
        np.array([[10.0, 10.0], [45.0, 45.0]]),
        ["House", "Shop"],
        bbox=(0.0, 0.0, 90.0, 90.0),
        geometry=geometry,
    )
    data = payload(made, 5)
    assert [len(r) for r in data["segments"]["rings"]["0"]] == [8, 8]
    assert data["landmarks"]["segment"] == [0, 1]


@settings(deadline=None)
@given(
    st.floats(-1e6, 1e6),
    st.floats(-1e6, 1e6),
    st.floats(0.5, 1e6),
    st.lists(st.floats(0, 1), min_size=2, max_size=12),
)
def test_quantiser_is_within_half_a_unit(
    west: float, south: float, size: float, shares: list[float]
) -> None:
    quantiser = Quantiser.for_bounds((west, south, west + size, south + size))
    xy = np.array(shares[: len(shares) // 2 * 2]).reshape(-1, 2) * size + [west, south]
    back = quantiser.points(xy) * quantiser.unit + np.array(quantiser.origin)
    assert np.abs(back - xy).max() <= quantiser.unit * 0.5 + 1e-6
    assert quantiser.unit <= 0.1
    assert size / quantiser.unit >= 10_000 or quantiser.unit == pytest.approx(1e-4)


def test_a_landmark_on_a_border_belongs_to_the_segment_in_the_north_east(make: MakeMap) -> None:
    xy = np.array([[50.0, 50.0], [50.0, 20.0], [100.0, 100.0], [0.0, 0.0], [120.0, 5.0]])
    made = make(xy, ["House"] * 5, bbox=(0.0, 0.0, 100.0, 100.0), side=2)
    assert payload(made, 5)["landmarks"]["segment"] == [3, 1, 3, 0, -1]


def test_regions_join_neighbours_of_one_kind(make: MakeMap) -> None:
    xy = np.array([[20.0, 20.0], [20.0, 80.0], [80.0, 20.0], [80.0, 80.0]])
    made = make(xy, ["House", "House", "Shop", "Shop"], bbox=(0.0, 0.0, 100.0, 100.0), side=2)
    found = payload(made, 5)["regions"]
    assert sorted(len(r) for r in found["rings"]) == [8, 8]  # two rectangles, not four squares
    labels = [made.environments[name[0]].name for name in found["names"]]
    assert sorted(labels) == ["Commercial", "Residential"]


def test_reasons_add_up_and_answer_every_why_not(make_town: MakeMap) -> None:
    made = make_town(n=400, side=6)
    data = payload(made, 3)
    names = [f["name"] for f in data["features"]]
    for i, told in enumerate(data["segments"]["reasons"]):
        if made.label[i] < 0:
            assert told == []
            continue
        full = {r.feature: r for r in made.reasons([i])[0]}
        for k, environment in enumerate(made.environments):
            shares = {
                names[row[0]]: share / 10_000
                for row in told
                for e, share in zip(row[2::2], row[3::2], strict=True)
                if e == k
            }
            parts = {n: r.contribution.get(environment.name, 0.0) for n, r in full.items()}
            for name, share in shares.items():
                assert share == pytest.approx(parts[name], abs=5.1e-5)
            strongest = sorted(parts.values(), reverse=True)[:3]
            missing = max((v for n, v in parts.items() if n not in shares), default=0.0)
            assert missing <= max(strongest[-1], 5e-4) + 1e-9
            probability = data["segments"]["p"][i * len(made.environments) + k] / 10_000
            assert probability == pytest.approx(sum(parts.values()), abs=5.1e-5)


def test_reasons_can_be_left_out(make_town: MakeMap) -> None:
    assert payload(make_town(n=50, side=4), 0)["segments"]["reasons"] is None


def test_unsurveyed_segments_are_marked(make: MakeMap) -> None:
    made = make(
        np.array([[20.0, 20.0]]),
        ["House"],
        bbox=(0.0, 0.0, 100.0, 100.0),
        side=2,
        ground=0.0,
        surveyed=shapely.box(0, 0, 50, 100),
    )
    unknown = replace(made, label=np.array([0, -1, -1, -1], np.int16))
    object.__setattr__(unknown, "parts", made.reasons([0]) and np.zeros((4, 11, 7)))
    object.__setattr__(unknown, "counts", np.zeros((4, 11), np.int64))
    data = payload(unknown, 5)
    assert data["segments"]["unsurveyed"] == [1, 3]
    assert len(data["surveyed"]) == 1


@pytest.mark.parametrize(
    ("longitude", "latitude", "size", "error"),
    [(9.52, 47.14, 3e3, 1e-9), (149.1, -35.2, 1e5, 1e-7), (180.0, 65.0, 2e4, 1e-8)],
)
def test_degrees_without_a_projection(
    make: MakeMap, longitude: float, latitude: float, size: float, error: float
) -> None:
    frame = Frame.around(longitude, latitude)
    half = size / 2
    made = make(
        np.zeros((0, 2)),
        [],
        bbox=(-half, -half, half, half),
        side=1,
        frame=frame,
        segment_ids=["a"],
    )
    inverse = payload(made, 5)["inverse"]
    x, y = np.random.default_rng(1).uniform(-half, half, (2, 200))
    u, v = (
        (x - inverse["middle"][0]) / inverse["half"],
        (y - inverse["middle"][1]) / inverse["half"],
    )
    terms = np.column_stack([u**i * v**j for i in range(6) for j in range(6 - i)])
    lon, lat = frame.from_metres(x, y)
    turn = (terms @ inverse["lon"] - lon + 180) % 360 - 180
    assert np.abs(turn).max() < error
    assert np.abs(terms @ inverse["lat"] - lat).max() < error


def test_metres_have_no_degrees(flat: EnvironmentMap) -> None:
    data = payload(flat, 5)
    assert data["inverse"] is None
    assert data["geographic"] is False


def test_facts_and_report(make: MakeMap) -> None:
    line, notes = "© OpenStreetMap contributors, ODbL 1.0", ("Two lines were empty.",)
    made = make(
        np.array([[1.0, 1.0]]),
        ["House"],
        bbox=(0.0, 0.0, 10.0, 10.0),
        side=1,
        report=ReadReport("maps/old_town.geojson", 1, Counter({"shop=moon": 2}), 4, 1, notes, line),
    )
    data = payload(made, 5)
    assert data["title"] == "Old town"
    assert data["attribution"] == line
    assert data["report"]["notes"] == ["Two lines were empty."]
    assert data["facts"]["Source"] == "old_town.geojson"
    assert data["facts"]["Ontology hash"] == "5eed" * 16
    assert data["report"]["unknown"] == [("shop=moon", 2)]
    assert (data["report"]["outside"], data["report"]["duplicates"]) == (4, 1)


@pytest.mark.parametrize(
    ("source", "title"),
    [
        ("vaduz/landmarks.geojson", "Vaduz"),
        ("landmarks.geojson", "Landmarks"),
        ("./data.csv", "Data"),
        ("C:\\maps\\inner_city.osm.pbf", "Inner city"),
        ("<stdin>", "Environment map"),
        ("-", "Environment map"),
        ("", "Environment map"),
    ],
)
def test_title_comes_from_the_source(make: MakeMap, source: str, title: str) -> None:
    made = make(np.zeros((0, 2)), [], bbox=(0.0, 0.0, 9.0, 9.0), side=1, report=ReadReport(source))
    assert payload(made, 5)["title"] == title


def test_too_many_landmarks_are_left_out_with_their_number(
    make_town: MakeMap, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(payload_module, "DOTS", 49)
    data = payload(make_town(n=50, side=4), 5)
    assert data["landmarks"] is None
    assert data["count"] == 50


def test_an_empty_map_is_a_page(make: MakeMap) -> None:
    made = make(np.zeros((0, 2)), [], bbox=(5.0, 5.0, 5.0, 5.0), geometry=np.zeros(0, object))
    data = data_of(render_html(made))
    assert data["segments"]["id"] == []
    west, south, east, north = data["bounds"]
    assert east > west
    assert north > south


# ---- writing ------------------------------------------------------------------------------


def test_write_through_the_registry(flat: EnvironmentMap, tmp_path: Path) -> None:
    write_map(flat, tmp_path / "flat.html")
    assert (tmp_path / "flat.html").read_text("utf-8") == render_html(flat)


def test_write_without_reasons_and_with_progress(flat: EnvironmentMap) -> None:
    stream, told = io.BytesIO(), []
    options = WriteOptions(reasons=0, progress=lambda stage, share: told.append(share))
    write(flat, stream, options)
    assert data_of(stream.getvalue().decode())["segments"]["reasons"] is None
    assert told[0] == 0
    assert told[-1] == 1


# ---- words --------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("label", "many"),
    [
        ("House", "houses"),
        ("Bus stop", "bus stops"),
        ("Person", "people"),
        ("Sheep", "sheep"),
        ("C17", "C17s"),
        ("Factory", "factories"),
        ("Bench", "benches"),
        ("Soccer goals", "soccer goals"),
        ("Bus", "buses"),
        ("Boy", "boys"),
        ("Piece of artwork", "pieces of artwork"),
        ("Place of worship", "places of worship"),
        ("Parking in the street", "parking in the street"),
        ("Power pole or pylon", "power poles or pylons"),
        ("Cliff, cave or sinkhole", "cliffs, caves or sinkholes"),
        ("Book or music shop", "book or music shops"),
    ],
)
def test_plural(label: str, many: str) -> None:
    assert plural(label) == many


def test_running_text() -> None:
    assert [running(t) for t in ("House", "ATM", "C17", "")] == ["house", "ATM", "C17", ""]


def test_local_name() -> None:
    assert local_name("https://w3id.org/symboslam#source-osm-wiki") == "source-osm-wiki"
    assert local_name("https://wiki.example/Key:shop/") == "Key:shop"
    assert local_name("a survey: 2021") == "a survey: 2021"
