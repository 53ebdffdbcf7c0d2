"""The page in a browser: it draws every kind of map, fits every screen, asks for nothing."""

from __future__ import annotations

import base64
import re
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest
import shapely

from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.landmarks import ReadReport

if TYPE_CHECKING:
    from tests.engine.writers.page.browser.conftest import Browser

NASTY = "</script><script>document.documentElement.dataset.pwned = 1</script><img src=x onerror=x>"
SIDE = 296  # pixels of the legend on a wide screen
MakeMap = Callable[..., EnvironmentMap]
Save = Callable[..., Path]
pytestmark = pytest.mark.browser


def test_draws_segments_in_their_colours(
    browser: Browser, save: Save, quarters: EnvironmentMap
) -> None:
    browser.open(save(quarters))
    red, green, blue = browser.pixel(*browser.place(20, 40))  # Residential: yellow
    assert red > green > blue + 40
    red, green, blue = browser.pixel(*browser.place(70, 10))  # Commercial: red
    assert red > green + 40
    assert browser.text("h1") == "Town"
    assert "6 landmarks, 4 segments" in browser.text("#counts")
    assert "5eed5eed" in browser.text("#counts")
    legend = browser.text("#legend")
    assert re.search(r"Residential\s+50%", legend)
    assert "1 class or tag not in the ontology (2 landmarks)" in browser.text("#notices")


def test_draws_rooms_of_a_flat(browser: Browser, save: Save, flat: EnvironmentMap) -> None:
    browser.open(save(flat), "#segment=living")
    assert "Living room" in browser.text("#panel h2")
    assert browser.text("#scale-text") in {"1 m", "2 m"}
    assert "12\u00a0m × 9" in browser.text("#counts")


def test_an_empty_map_is_unknown(browser: Browser, save: Save, make: MakeMap) -> None:
    nothing = make(np.zeros((0, 2)), [], bbox=(0.0, 0.0, 3000.0, 3000.0), side=1)
    browser.open(save(nothing))
    browser.click(*browser.place(1500, 1500, 3000))
    assert "Unknown" in browser.text("#panel h2")
    assert "no landmarks" in browser.text("#panel .note")
    assert not browser.run("document.getElementById('classes-section').offsetHeight")


def test_a_map_without_segments_or_extent(browser: Browser, save: Save, make: MakeMap) -> None:
    point = (7.0, 7.0, 7.0, 7.0)
    browser.open(save(make(np.zeros((0, 2)), [], bbox=point, geometry=np.zeros(0, object))))
    assert "0 segments" in browser.text("#counts")


def test_unsurveyed_ground_is_explained(browser: Browser, save: Save, make: MakeMap) -> None:
    seen = shapely.box(0, 0, 30, 100)
    far = make(
        np.array([(5.0, 5.0)]),
        ["House"],
        bbox=(0.0, 0.0, 400.0, 100.0),
        geometry=shapely.box(np.arange(4) * 100.0, 0, np.arange(1, 5) * 100.0, 100),
        ground=0.0,
        surveyed=seen,
    )
    browser.open(save(far), "#segment=s3")
    assert "Nobody has looked here" in browser.text("#panel .note")


def test_hostile_words_stay_words(browser: Browser, save: Save, make: MakeMap) -> None:
    made = make(
        np.array([[10.0, 10.0], [80.0, 80.0]]),
        ["House", "Shop"],
        bbox=(0.0, 0.0, 100.0, 100.0),
        side=2,
        ids=[NASTY, "\"'><svg onload=x>"],
        segment_ids=[f"{i}{NASTY}" for i in range(4)],
        config={"title": NASTY},
        report=ReadReport(attribution=NASTY),
    )
    browser.open(save(made))
    assert browser.text("h1") == NASTY
    assert browser.text("#attribution") == NASTY
    browser.click(*browser.place(40, 40))
    assert NASTY in browser.text("#panel .about")
    browser.run("document.querySelectorAll('#panel details').forEach((d) => d.open = true)")
    assert NASTY in browser.text("#panel .inside")
    browser.click(*browser.place(10, 10))
    assert NASTY in browser.text("#panel .facts")
    browser.search("<svg")
    browser.search("\"'><svg")
    assert browser.run("document.documentElement.dataset.pwned") is None
    assert browser.run("document.querySelectorAll('script, img').length") == 2  # our own scripts


def test_phone(browser: Browser, save: Save, make_town: MakeMap) -> None:
    browser.open(save(make_town(n=300, side=6)), "#segment=3-2-2", width=390, height=844)
    assert browser.run("document.documentElement.scrollWidth <= innerWidth")
    box = browser.run("document.getElementById('panel').getBoundingClientRect().toJSON()")
    assert (box["left"], box["right"], box["bottom"]) == (0, 390, 844)
    assert browser.run("document.getElementById('map').clientHeight") > 600
    assert not browser.run("document.getElementById('legend').offsetHeight")
    browser.run("document.getElementById('drawer').click()")
    assert browser.run("document.getElementById('legend').offsetHeight") > 100


def test_dark(browser: Browser, save: Save, quarters: EnvironmentMap) -> None:
    browser.open(save(quarters))
    corner = (SIDE + 250, 780)
    light = browser.pixel(*corner)
    browser.emulate(dark=True)
    browser.settle()
    dark = browser.pixel(*corner)
    assert min(light) > 200
    assert max(dark) < 60


def test_print(browser: Browser, save: Save, quarters: EnvironmentMap) -> None:
    browser.open(save(quarters), "#segment=3-0-0")
    pdf = base64.b64decode(browser.call("Page.printToPDF", printBackground=True)["data"])
    assert pdf.startswith(b"%PDF")
    browser.emulate(media="print")
    assert not browser.run("document.getElementById('controls').offsetHeight")
    assert browser.run("document.getElementById('why').offsetHeight") > 20


def test_without_scripts_there_is_a_summary(
    browser: Browser, save: Save, quarters: EnvironmentMap
) -> None:
    browser.call("Emulation.setScriptExecutionDisabled", value=True)
    try:
        browser.open(save(quarters), ready="document.querySelector('.sorry') !== null")
        text = browser.text(".sorry")
    finally:
        browser.call("Emulation.setScriptExecutionDisabled", value=False)
    assert "6 landmarks in 4 segments: Residential 50%, Commercial 50%." in text


def test_flights_arrive(browser: Browser, save: Save, quarters: EnvironmentMap) -> None:
    browser.emulate(calm=False)
    browser.open(save(quarters))
    browser.run("document.getElementById('zoom-in').click()")
    browser.run("document.getElementById('zoom-in').click()")
    browser.wait("document.getElementById('scale-text').textContent === '5 m'")
    browser.run("document.getElementById('zoom-fit').click()")
    browser.wait("document.getElementById('scale-text').textContent === '10 m'")


@pytest.mark.slow
def test_a_large_map(browser: Browser, save: Save, make_town: MakeMap) -> None:
    made = make_town(n=50_000, side=142, size=12_000.0)
    browser.open(save(made), "#segment=3-70-70")
    assert "Segment 3-70-70" in browser.text("#panel .about")
    assert "20,164 segments" in browser.text("#counts")
