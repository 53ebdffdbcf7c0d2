"""Pictures: they have the promised size, the right colours in the right places, and never fail."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely

from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.frame import Frame
from symboslam.engine.landmarks import ReadReport
from symboslam.engine.writers import write_map
from symboslam.engine.writers.png import fills, round_length, title_of
from symboslam.engine.writers.png_panel import PALEST, dot_classes

Make = Callable[..., EnvironmentMap]


def picture(environment_map: EnvironmentMap, folder: Path) -> Any:
    """(height, width, 3) the picture's colours, 0-255."""
    from matplotlib.image import imread

    target = folder / "map.png"
    write_map(environment_map, target)
    return np.round(imread(target)[..., :3] * 255).astype(int)


def has(pixels: Any, colour: str) -> int:
    wanted = [int(colour[i : i + 2], 16) for i in (1, 3, 5)]
    return int((np.abs(pixels - wanted).max(-1) <= 1).sum())


def at(pixels: Any, x: float, y: float) -> list[int]:
    """The colour at a place of the 200 m x 200 m area, which is drawn 1002 pixels wide."""
    row, column = 120 + (100 - y) / 200 * 1002, 48 + (x + 100) / 200 * 1002
    colour: list[int] = pixels[round(row), round(column)].tolist()
    return colour


def test_segments_are_where_they_should_be(make_town: Make, tmp_path: Path) -> None:
    pixels = picture(make_town(), tmp_path)
    assert at(pixels, 50, -30) == [0xB0, 0x4A, 0x5A]
    assert at(pixels, -50, 50) == [0xE4, 0xE4, 0xE4]
    assert at(pixels, 50, 50) == [0x8F, 0xB5, 0x73]
    assert at(pixels, -60, -60) == [0x10, 0x10, 0x10]  # a house


def test_size_and_colours(town: EnvironmentMap, tmp_path: Path) -> None:
    pixels = picture(town, tmp_path)
    assert pixels.shape == (1200, 1600, 3)
    left = pixels[:, :1100]  # the map without the legend
    quarter = 400_000 // 2
    assert has(left, "#8fb573") > quarter  # certain: full colour
    assert has(left, "#b04a5a") > quarter
    assert has(left, "#e4e4e4") > quarter  # unknown
    assert has(left, "#f2cf63") < 1000  # P = 0.7: paler
    for environment in town.environments:
        assert has(pixels[:, 1150:], environment.colour) > 300  # swatches


def test_colours_get_paler_with_doubt(town: EnvironmentMap) -> None:
    # P = 0.7 of three environments: certainty (0.7 - 1/3) / (2/3) = 0.55.
    opacity = PALEST + (1 - PALEST) * 0.55
    red = 0xF2 / 255 * opacity + (1 - opacity)
    assert fills(town)[0, 0] == pytest.approx(red)
    assert fills(town)[1].tolist() == pytest.approx([0xB0 / 255, 0x4A / 255, 0x5A / 255])


def test_equal_maps_give_equal_pictures(make_town: Make, tmp_path: Path) -> None:
    pictures = []
    for name in ("one.png", "two.png"):
        write_map(make_town(), tmp_path / name)
        pictures.append((tmp_path / name).read_bytes())
    assert pictures[0] == pictures[1]


@pytest.mark.parametrize("frame", [None, Frame.around(9.52, 47.14)])
def test_empty_map(make_map: Make, frame: Frame | None, tmp_path: Path) -> None:
    assert has(picture(make_map(frame), tmp_path)[:, :1100], "#e4e4e4") > 500_000


@pytest.mark.parametrize("name", ["a$b$c_{.geojson", "地図 <&>.geojson", "caf\udce9", "", "-"])
def test_any_name_can_be_a_title(make_town: Make, tmp_path: Path, name: str) -> None:
    pixels = picture(make_town(report=ReadReport(name)), tmp_path)
    assert pixels.shape == (1200, 1600, 3)
    assert (pixels[40:85, 40:400] < 100).all(-1).sum() > 500  # ink of the title
    assert at(pixels, 50, -30) == [0xB0, 0x4A, 0x5A]  # and the map below it


def test_attribution_stands_below_the_map(make_town: Make, tmp_path: Path) -> None:
    """Ink below the map: without a line, with one, with the longest (two lines, inside)."""
    pictures = [
        picture(make_town(report=ReadReport("a", attribution=line)), tmp_path)
        for line in ("", "© Contributors", "wide words " * 27)
    ]
    ink = [(p[1140:] < 200).any(-1) for p in pictures]
    rows = [np.flatnonzero(i.any(1)).max() for i in ink]
    assert rows[0] < rows[1] < rows[2] < 58
    assert not ink[2][:, -10:].any()


@pytest.mark.parametrize(
    ("source", "title"),
    [
        ("data/town.geojson", "town.geojson"),
        ("C:\\data\\town.csv", "town.csv"),
        ("dev/vaduz/landmarks.geojson.gz", "vaduz"),
        ("landmarks.geojson", "landmarks.geojson"),
        ("", "landmarks"),
        ("-", "landmarks"),
    ],
)
def test_title(make_town: Make, source: str, title: str) -> None:
    assert title_of(make_town(report=ReadReport(source))) == f"Environment types: {title}"


def test_frequent_classes_have_dots_of_their_own(make_town: Make) -> None:
    dots = dot_classes(make_town())
    assert [(d.label, d.count) for d in dots] == [("house", 2), ("shop", 2), ("tree", 1)]
    assert len({(d.colour, d.marker) for d in dots}) == 3


def test_rare_classes_are_drawn_as_one(make_map: Make) -> None:
    found = make_map(landmarks=[(i, 0.0, 0.0, 1.0) for i in range(10)])
    twelve = replace(found.knowledge, features=found.knowledge.features * 3)
    *own, rest = dot_classes(replace(found, knowledge=twelve))
    assert len(own) == 8
    assert (rest.label, rest.count, rest.features.tolist()) == ("2 other classes", 2, [8, 9])


@pytest.mark.parametrize(
    ("longest", "length"), [(999, 500), (1000, 1000), (0.37, 0.2), (2.1, 2), (0, 1), (-1, 1)]
)
def test_scale_bars_have_round_lengths(longest: float, length: float) -> None:
    assert round_length(longest) == pytest.approx(length)


def test_outlines_keep_their_holes(make_town: Make, tmp_path: Path) -> None:
    found = make_town()
    geometry = found.geometry.copy()
    geometry[3] = shapely.box(0, 0, 100, 100).difference(shapely.box(40, 40, 60, 60))
    object.__setattr__(found, "geometry", geometry)
    pixels = picture(found, tmp_path)
    assert at(pixels, 50, 50) == [255, 255, 255]
    assert at(pixels, 30, 50) == [0x8F, 0xB5, 0x73]
