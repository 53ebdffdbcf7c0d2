"""The page in a browser: it explains segments and landmarks in sentences and sums."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest

from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.frame import Frame

if TYPE_CHECKING:
    from tests.engine.writers.page.browser.conftest import Browser

MakeMap = Callable[..., EnvironmentMap]
Save = Callable[..., Path]
pytestmark = pytest.mark.browser


def test_click_explains_a_segment(browser: Browser, save: Save, quarters: EnvironmentMap) -> None:
    browser.open(save(quarters))
    assert browser.run("document.getElementById('panel').hidden") is True
    browser.click(*browser.place(40, 40))
    assert browser.text("#panel h2") == "Residential"
    assert "Segment 3-0-0" in browser.text("#panel .about")
    why = browser.text("#why")
    assert "Why Residential?" in why
    first = quarters.reasons([0])[0][0]
    share = first.contribution["Residential"]
    assert f"3 houses add {share:.2f}: A house is where people live." in why
    assert f"Together {quarters.probability[0, 0]:.2f}" in why
    assert "Why not" in browser.text("#why-not")
    assert browser.run("location.hash") == "#segment=3-0-0"
    browser.key("Escape")
    assert browser.run("document.getElementById('panel').hidden") is True
    assert browser.run("location.hash") == ""


def test_why_not_any_other(browser: Browser, save: Save, quarters: EnvironmentMap) -> None:
    browser.open(save(quarters), "#segment=3-0-0")
    browser.run("document.querySelector('.bar[title=\"Why not Commercial?\"]').click()")
    text = browser.text("#why-not")
    assert text.startswith("Why not Commercial?")
    assert "shops around add" in text
    browser.run("document.querySelector('.bar[title=\"Why not Industrial?\"]').click()")
    assert "Nothing here speaks for Industrial." in browser.text("#why-not")


def test_contributions_against_are_shown_as_such(
    browser: Browser, save: Save, quarters: EnvironmentMap
) -> None:
    parts = np.array(quarters.parts)  # type: ignore[attr-defined]
    features = [f.name for f in quarters.knowledge.features]
    parts[0, features.index("Shop"), 0] -= 0.1
    parts[0, features.index("House"), 0] += 0.1
    object.__setattr__(quarters, "parts", parts)
    browser.open(save(quarters), "#segment=3-0-0")
    against = browser.text("#why .against")
    assert "2 shops around take away 0.10: Their close neighbours point elsewhere." in against


def test_what_is_not_told_is_summed_up(browser: Browser, save: Save, make_town: MakeMap) -> None:
    made = make_town(n=300, side=3)
    i = int(np.argmax([len(r) for r in made.reasons(range(9))]))
    browser.open(save(made, reasons=1), f"#segment={made.segment_id[i]}")
    assert "Everything else adds" in browser.text("#panel")
    browser.open(save(made, reasons=0), f"#segment={made.segment_id[i]}")
    assert "without reasons" in browser.text("#panel")


def test_deep_link_to_an_odd_id(browser: Browser, save: Save, make: MakeMap) -> None:
    made = make(
        np.array([[10.0, 10.0]]),
        ["House"],
        bbox=(0.0, 0.0, 100.0, 100.0),
        side=2,
        segment_ids=["a b/c", "50%", "ü", "d"],
    )
    for name, fragment in (("a b/c", "a%20b%2Fc"), ("50%", "50%"), ("ü", "%C3%BC")):
        browser.open(save(made), f"#segment={fragment}")
        assert browser.run("document.documentElement.dataset.segment") == name
    browser.open(save(made), "#segment=nowhere")
    assert browser.run("document.getElementById('panel').hidden") is True


def test_single_landmark_is_said(browser: Browser, save: Save, quarters: EnvironmentMap) -> None:
    browser.open(save(quarters), "#segment=3-1-0")
    assert "One landmark, a school, stands in this segment" in browser.text("#panel .note")


def test_click_explains_a_landmark(browser: Browser, save: Save, quarters: EnvironmentMap) -> None:
    browser.open(save(quarters))
    browser.click(*browser.place(80, 20))
    assert browser.text("#panel h2") == "Shop"
    assert "n3" in browser.text("#panel .facts")
    confidence = round(100 * float(quarters.landmarks.confidence[3]))
    assert f"{confidence}%" in browser.text("#panel .facts")
    indicates = browser.text("#panel .indications")
    assert "Commercial 0.90: Shops stand where people trade." in indicates
    assert "plan" in indicates
    browser.run("document.querySelector('#panel .actions button').click()")
    assert "Segment 3-0-1" in browser.text("#panel .about")


def test_hover_tells_the_essentials(browser: Browser, save: Save, quarters: EnvironmentMap) -> None:
    browser.open(save(quarters))
    browser.mouse("mouseMoved", *browser.place(40, 45))
    browser.settle()
    p = round(100 * quarters.probability[0, 0])
    assert f"Residential {p}%" in browser.text("#tip")
    assert "3 landmarks" in browser.text("#tip")
    assert browser.text("#readout").startswith("x ")
    browser.mouse("mouseMoved", *browser.place(80, 20))
    browser.settle()
    assert "Shop" in browser.text("#tip")
    assert "confidence" in browser.text("#tip")


def test_readout_in_degrees(browser: Browser, save: Save, make: MakeMap) -> None:
    frame = Frame.around(149.1, -35.2)
    box = (-1500.0, -1500.0, 1500.0, 1500.0)
    browser.open(save(make(np.zeros((1, 2)), ["House"], bbox=box, side=3, frame=frame)))
    x, y = browser.place(1500 + 1000, 1500 + 500, 3000)
    browser.mouse("mouseMoved", round(x), round(y))
    browser.settle()
    found = re.match(r"([\d.]+)° S, ([\d.]+)° E", browser.text("#readout"))
    assert found
    lon, lat = frame.from_metres(1000.0, 500.0)
    assert float(found[1]) == pytest.approx(-float(lat), abs=5e-5)  # a pixel is 4 m
    assert float(found[2]) == pytest.approx(float(lon), abs=5e-5)
    assert browser.run("document.getElementById('north-text').textContent") == "N"
