"""The page in a browser: pointer, fingers and keys, legend, layers and search."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from symboslam.engine.environment_map import EnvironmentMap

if TYPE_CHECKING:
    from tests.engine.writers.page.browser.conftest import Browser

MakeMap = Callable[..., EnvironmentMap]
Save = Callable[..., Path]
pytestmark = pytest.mark.browser


def test_legend_hides_an_environment(
    browser: Browser, save: Save, quarters: EnvironmentMap
) -> None:
    browser.open(save(quarters))
    at = browser.place(20, 40)
    before = browser.pixel(*at)
    browser.run(
        "[...document.querySelectorAll('#legend label')]"
        ".find((l) => l.textContent.includes('Residential')).click()"
    )
    browser.settle()
    after = browser.pixel(*at)
    assert before != after
    assert max(after) - min(after) < 15  # hardly a colour


def test_colour_modes(browser: Browser, save: Save, quarters: EnvironmentMap) -> None:
    browser.open(save(quarters))
    home, shops = browser.place(20, 40), browser.place(70, 10)
    browser.choose("#mode", "1")  # probability of Commercial
    pale, full = browser.pixel(*home), browser.pixel(*shops)
    assert sum(pale) > sum(full) + 60
    assert "Probability of Commercial" in browser.text("#ramp-text")
    browser.choose("#mode", "margin")
    assert "Lead" in browser.text("#ramp-text")
    assert browser.pixel(*shops) != full


def test_layers(browser: Browser, save: Save, quarters: EnvironmentMap) -> None:
    browser.open(save(quarters))
    dot = browser.place(80, 20)
    seen = browser.pixel(*dot)
    browser.run("document.getElementById('layer-landmarks').click()")
    browser.settle()
    ground = browser.pixel(*dot)
    assert ground != seen
    browser.run("document.getElementById('layer-segments').click()")
    browser.settle()
    assert browser.pixel(*dot) not in {ground, seen}


def test_search_finds_classes_segments_and_landmarks(
    browser: Browser, save: Save, quarters: EnvironmentMap
) -> None:
    browser.open(save(quarters))
    browser.search("sho")
    assert "Shop\n2 landmarks" in browser.text("#found")
    browser.key("Enter")
    assert browser.text("#highlight-text") == "2 shops"
    browser.key("Escape")
    assert browser.run("document.getElementById('highlight').hidden") is True
    browser.search("3-1-1")
    browser.key("Enter")
    assert browser.run("document.documentElement.dataset.segment") == "3-1-1"
    browser.search("n5")
    browser.key("Enter")
    assert browser.text("#panel h2") == "School"
    browser.search("zebra")
    assert "Nothing has that name" in browser.text("#found")


def test_wheel_drag_and_buttons_move_the_map(
    browser: Browser, save: Save, quarters: EnvironmentMap
) -> None:
    browser.open(save(quarters))
    assert browser.text("#scale-text") == "10 m"
    x, y = browser.place(50, 50)
    browser.mouse("mouseWheel", x, y, deltaX=0, deltaY=-900)
    browser.settle()
    assert browser.text("#scale-text") == "2 m"
    browser.run("document.getElementById('zoom-fit').click()")
    browser.settle()
    assert browser.text("#scale-text") == "10 m"
    start, end = browser.place(20, 40), browser.place(70, 40)
    yellow = browser.pixel(*start)
    browser.mouse("mousePressed", *start, button="left", clickCount=1)
    browser.mouse("mouseMoved", *end, button="left", buttons=1)
    browser.mouse("mouseReleased", *end, button="left", clickCount=1)
    browser.settle()
    assert browser.pixel(*end) == yellow  # the ground went along
    assert browser.run("document.getElementById('panel').hidden") is True  # a drag is no click


def test_pinch(browser: Browser, save: Save, quarters: EnvironmentMap) -> None:
    browser.open(save(quarters), width=390, height=844)
    before = float(browser.text("#scale-text").split()[0])

    def touch(kind: str, *points: tuple[float, float]) -> None:
        browser.call(
            "Input.dispatchTouchEvent",
            type=kind,
            touchPoints=[{"x": x, "y": y, "id": i} for i, (x, y) in enumerate(points)],
        )

    touch("touchStart", (180, 500), (210, 500))
    for spread in range(20, 160, 20):
        touch("touchMove", (180 - spread, 500), (210 + spread, 500))
    touch("touchEnd")
    browser.settle()
    assert float(browser.text("#scale-text").split()[0]) < before / 3


def test_keys_alone_are_enough(browser: Browser, save: Save, quarters: EnvironmentMap) -> None:
    browser.open(save(quarters))
    browser.run("document.getElementById('map').focus()")
    for _ in range(4):
        browser.key("ArrowLeft")
        browser.key("ArrowDown")
    browser.key("Enter")
    assert "Segment 3-0-0" in browser.text("#panel .about")
    assert "Residential" in browser.text("#status")
    browser.key("+", "+")
    browser.key("+", "+")
    assert browser.text("#scale-text") == "5 m"
    reached = set()
    for _ in range(60):
        browser.call("Input.dispatchKeyEvent", type="keyDown", key="Tab", windowsVirtualKeyCode=9)
        reached.add(browser.run("document.activeElement.id || document.activeElement.className"))
    assert {"search", "mode", "dots", "map", "zoom-in", "panel-close", "bar"} <= reached


def test_controls_have_names(browser: Browser, save: Save, quarters: EnvironmentMap) -> None:
    browser.open(save(quarters), "#segment=3-0-0")
    nodes = browser.call("Accessibility.getFullAXTree")["nodes"]
    kinds = {"button", "checkbox", "combobox", "textbox", "searchbox", "application"}
    found = [n for n in nodes if n.get("role", {}).get("value") in kinds and not n["ignored"]]
    assert len(found) > 20
    nameless = [n for n in found if not n.get("name", {}).get("value")]
    assert nameless == []
