"""The page in a real browser without a network: it draws, explains, and asks for nothing."""

from __future__ import annotations

import base64
import contextlib
import io
import json
import os
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely

from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.frame import Frame
from symboslam.engine.writers.html import render_html

NAMES = ("chromium", "chromium-browser", "google-chrome", "chrome")
CHROMIUM = next((found for found in map(shutil.which, NAMES) if found), None)
OFFLINE = ["unshare", "-n"]
LAUNCH = """
import fcntl, os, sys
inbox, outbox = (fcntl.fcntl(int(n), fcntl.F_DUPFD, 10) for n in sys.argv[1:3])
os.dup2(inbox, 3)  # the browser reads commands here
os.dup2(outbox, 4)  # and answers here
os.execv(sys.argv[3], sys.argv[3:])
"""
SIDE = 296  # pixels of the legend on a wide screen
NASTY = "</script><script>document.documentElement.dataset.pwned = 1</script><img src=x onerror=x>"

pytestmark = [
    pytest.mark.browser,
    pytest.mark.skipif(not CHROMIUM, reason="needs Chromium, and there is none on the path"),
]
MakeMap = Callable[..., EnvironmentMap]


class Browser:
    """Headless Chromium, driven over a pipe by its DevTools protocol: no port, no driver needed.

    Args:
        profile: a folder that the browser may fill.
    """

    def __init__(self, profile: Path) -> None:
        assert CHROMIUM
        inbox, self._outbox = os.pipe()
        self._inbox, outbox = os.pipe()
        no_network = OFFLINE if _can_unshare() else []
        command = [
            *no_network,
            sys.executable,
            "-c",
            LAUNCH,
            str(inbox),
            str(outbox),
            CHROMIUM,
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--disable-dev-shm-usage",
            "--no-first-run",
            "--disable-background-networking",
            "--disable-component-update",
            "--disable-sync",
            "--hide-scrollbars",
            "--proxy-server=127.0.0.1:9",
            f"--user-data-dir={profile}",
            "--remote-debugging-pipe",
            "about:blank",
        ]
        self._process = subprocess.Popen(
            command, pass_fds=(inbox, outbox), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        )
        os.close(inbox)
        os.close(outbox)
        self._buffer = b""
        self._number = 0
        self._page = ""
        self.events: list[dict[str, Any]] = []
        pages = self.call("Target.getTargets", at_page=False)["targetInfos"]
        target = next(t["targetId"] for t in pages if t["type"] == "page")
        self._session = self.call(
            "Target.attachToTarget", at_page=False, targetId=target, flatten=True
        )["sessionId"]
        for domain in ("Page", "Runtime", "Network", "Log"):
            self.call(f"{domain}.enable")

    def call(self, method: str, *, at_page: bool = True, **parameters: Any) -> dict[str, Any]:
        """Send a command and wait for its result; events on the way are kept."""
        self._number += 1
        message: dict[str, Any] = {"id": self._number, "method": method, "params": parameters}
        if at_page:
            message["sessionId"] = self._session
        os.write(self._outbox, json.dumps(message).encode() + b"\0")
        while True:
            answer = self._read()
            if answer.get("id") == self._number:
                assert "error" not in answer, answer["error"]
                return dict(answer["result"])
            self.events.append(answer)

    def _read(self) -> dict[str, Any]:
        while b"\0" not in self._buffer:
            chunk = os.read(self._inbox, 1 << 20)
            assert chunk, "the browser has gone"
            self._buffer += chunk
        line, _, self._buffer = self._buffer.partition(b"\0")
        return dict(json.loads(line))

    def emulate(self, *, dark: bool = False, calm: bool = True, media: str = "") -> None:
        """A reader who prefers dark or light, no motion (so that nothing has to be awaited)."""
        wishes = {
            "prefers-color-scheme": "dark" if dark else "light",
            "prefers-reduced-motion": "reduce" if calm else "no-preference",
        }
        features = [{"name": name, "value": value} for name, value in wishes.items()]
        self.call("Emulation.setEmulatedMedia", media=media, features=features)

    def open(
        self,
        page: Path,
        fragment: str = "",
        width: int = 1200,
        height: int = 800,
        ready: str = "document.documentElement?.dataset.ready === 'true'",
    ) -> None:
        """Load a page in a window of this size and wait until it says that it is ready."""
        self.call("Page.navigate", url="about:blank")
        self._page = page.as_uri()
        self.call(
            "Emulation.setDeviceMetricsOverride",
            width=width,
            height=height,
            deviceScaleFactor=1,
            mobile=width < 600,
        )
        self.events.clear()
        self.call("Page.navigate", url=self._page + fragment)
        self.wait(ready)
        self.settle()

    def run(self, script: str) -> Any:
        """The value of an expression in the page."""
        answer = self.call(
            "Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True
        )
        assert "exceptionDetails" not in answer, answer["exceptionDetails"]
        return answer["result"].get("value")

    def wait(self, condition: str) -> None:
        """Wait until an expression is true."""
        end = time.monotonic() + 20
        while not self.run(condition):
            assert time.monotonic() < end, f"never true: {condition}; {self.complaints()}"
            time.sleep(0.02)

    def settle(self) -> None:
        """Let the next drawing end."""
        frame = "requestAnimationFrame"
        self.run(f"new Promise((done) => {frame}(() => {frame}(done)))")

    def mouse(self, kind: str, x: float, y: float, **more: Any) -> None:
        """A mouse event at a place of the window."""
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, **more)

    def click(self, x: float, y: float) -> None:
        """Move there, press and lift the left button."""
        self.mouse("mouseMoved", x, y)
        for kind in ("mousePressed", "mouseReleased"):
            self.mouse(kind, x, y, button="left", clickCount=1)
        self.settle()

    def key(self, key: str, text: str = "") -> None:
        """Press and lift a key."""
        code = {"Enter": 13, "Escape": 27, "Tab": 9}.get(key, 0)
        for kind in ("keyDown", "keyUp"):
            more = {"text": text} if text and kind == "keyDown" else {}
            self.call(
                "Input.dispatchKeyEvent", type=kind, key=key, windowsVirtualKeyCode=code, **more
            )
        self.settle()

    def text(self, selector: str) -> str:
        """The visible text of an element."""
        return str(self.run(f"document.querySelector({json.dumps(selector)}).innerText"))

    def picture(self, x: float, y: float) -> bytes:
        """A PNG of one pixel of the window."""
        clip = {"x": int(x), "y": int(y), "width": 1, "height": 1, "scale": 1}
        return base64.b64decode(self.call("Page.captureScreenshot", clip=clip)["data"])

    def requests(self) -> list[str]:
        """Addresses that were asked for, but for the page itself."""
        asked = [
            e["params"]["request"]["url"]
            for e in self.events
            if e.get("method") == "Network.requestWillBeSent"
        ]
        return [url for url in asked if not url.startswith((self._page, "data:"))]

    def complaints(self) -> list[str]:
        """Exceptions, errors and policy violations that the browser reported."""
        kinds = {"Runtime.exceptionThrown", "Log.entryAdded", "Runtime.consoleAPICalled"}
        return [json.dumps(e["params"]) for e in self.events if e.get("method") in kinds]

    def close(self) -> None:
        """End the browser."""
        with contextlib.suppress(AssertionError, OSError):
            self.call("Browser.close", at_page=False)
        self._process.wait(20)
        os.close(self._inbox)
        os.close(self._outbox)


def _can_unshare() -> bool:
    """Whether we may start a process in a network of its own, which leads nowhere."""
    if not shutil.which("unshare"):
        return False
    return subprocess.run([*OFFLINE, "true"], capture_output=True).returncode == 0


@pytest.fixture(scope="module")
def started(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Browser]:
    """One browser for all tests of this file."""
    browser = Browser(tmp_path_factory.mktemp("chromium"))
    yield browser
    browser.close()


@pytest.fixture
def browser(started: Browser) -> Iterator[Browser]:
    """The browser; whatever the test did, the page asked for nothing and complained of nothing."""
    started.emulate()
    yield started
    assert started.requests() == []
    assert started.complaints() == []


Save = Callable[..., Path]


@pytest.fixture
def save(tmp_path: Path) -> Save:
    """Write the page of a map to a file."""

    def write(environment_map: EnvironmentMap, **options: Any) -> Path:
        path = tmp_path / "map.html"
        path.write_text(render_html(environment_map, **options), "utf-8")
        return path

    return write


@pytest.fixture
def quarters(make: MakeMap) -> EnvironmentMap:
    """100 m x 100 m in four: houses in the south-west, shops south-east, one school, nothing."""
    xy = [(10.0, 10.0), (15.0, 20.0), (30.0, 12.0), (80.0, 20.0), (90.0, 30.0), (10.0, 90.0)]
    return make(
        np.array(xy), ["House"] * 3 + ["Shop"] * 2 + ["School"], bbox=(0.0, 0.0, 100.0, 100.0), side=2
    )


def place(browser: Browser, x: float, y: float, extent: float = 100.0) -> tuple[float, float]:
    """Where a place of the whole square map is in the window."""
    left, top, width, height = browser.run(
        "(() => { const b = document.getElementById('map').getBoundingClientRect();"
        " return [b.left, b.top, b.width, b.height]; })()"
    )
    k = min(width - 56, height - 56) / extent
    return left + width / 2 + (x - extent / 2) * k, top + height / 2 - (y - extent / 2) * k


def pixel(browser: Browser, x: float, y: float) -> tuple[int, int, int]:
    """Colour at a place of the window, 0 to 255."""
    from matplotlib.image import imread

    red, green, blue = imread(io.BytesIO(browser.picture(x, y)))[0, 0, :3] * 255
    return round(red), round(green), round(blue)


def choose(browser: Browser, selector: str, value: str) -> None:
    """Take an option of a select."""
    browser.run(
        f"(() => {{ const s = document.querySelector('{selector}'); s.value = '{value}';"
        " s.dispatchEvent(new Event('change')); })()"
    )
    browser.settle()


def write(browser: Browser, text: str) -> None:
    """Type into the search box."""
    browser.run("document.getElementById('search').focus()")
    browser.call("Input.insertText", text=text)
    browser.settle()


# ---- it draws -----------------------------------------------------------------------------


def test_draws_segments_in_their_colours(
    browser: Browser, save: Save, quarters: EnvironmentMap
) -> None:
    browser.open(save(quarters))
    red, green, blue = pixel(browser, *place(browser, 20, 40))  # Residential: yellow
    assert red > green > blue + 40
    red, green, blue = pixel(browser, *place(browser, 70, 10))  # Commercial: red
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
    browser.click(*place(browser, 1500, 1500, 3000))
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
        config={"title": NASTY, "attribution": NASTY},
    )
    browser.open(save(made))
    assert browser.text("h1") == NASTY
    assert browser.text("#attribution") == NASTY
    browser.click(*place(browser, 40, 40))
    assert NASTY in browser.text("#panel .about")
    browser.run("document.querySelectorAll('#panel details').forEach((d) => d.open = true)")
    assert NASTY in browser.text("#panel .inside")
    browser.click(*place(browser, 10, 10))
    assert NASTY in browser.text("#panel .facts")
    write(browser, "<svg")
    write(browser, "\"'><svg")
    assert browser.run("document.documentElement.dataset.pwned") is None
    assert browser.run("document.querySelectorAll('script, img').length") == 2  # our own scripts


# ---- it explains --------------------------------------------------------------------------


def test_click_explains_a_segment(
    browser: Browser, save: Save, quarters: EnvironmentMap
) -> None:
    browser.open(save(quarters))
    assert browser.run("document.getElementById('panel').hidden") is True
    browser.click(*place(browser, 40, 40))
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


def test_what_is_not_told_is_summed_up(
    browser: Browser, save: Save, make_town: MakeMap
) -> None:
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


def test_click_explains_a_landmark(
    browser: Browser, save: Save, quarters: EnvironmentMap
) -> None:
    browser.open(save(quarters))
    browser.click(*place(browser, 80, 20))
    assert browser.text("#panel h2") == "Shop"
    assert "n3" in browser.text("#panel .facts")
    confidence = round(100 * float(quarters.landmarks.confidence[3]))
    assert f"{confidence}%" in browser.text("#panel .facts")
    indicates = browser.text("#panel .indications")
    assert "Commercial 0.90: Shops stand where people trade." in indicates
    assert "plan" in indicates
    browser.run("document.querySelector('#panel .actions button').click()")
    assert "Segment 3-0-1" in browser.text("#panel .about")


def test_hover_tells_the_essentials(
    browser: Browser, save: Save, quarters: EnvironmentMap
) -> None:
    browser.open(save(quarters))
    browser.mouse("mouseMoved", *place(browser, 40, 45))
    browser.settle()
    p = round(100 * quarters.probability[0, 0])
    assert f"Residential {p}%" in browser.text("#tip")
    assert "3 landmarks" in browser.text("#tip")
    assert browser.text("#readout").startswith("x ")
    browser.mouse("mouseMoved", *place(browser, 80, 20))
    browser.settle()
    assert "Shop" in browser.text("#tip")
    assert "confidence" in browser.text("#tip")


def test_readout_in_degrees(browser: Browser, save: Save, make: MakeMap) -> None:
    frame = Frame.around(149.1, -35.2)
    box = (-1500.0, -1500.0, 1500.0, 1500.0)
    browser.open(save(make(np.zeros((1, 2)), ["House"], bbox=box, side=3, frame=frame)))
    x, y = place(browser, 1500 + 1000, 1500 + 500, 3000)
    browser.mouse("mouseMoved", round(x), round(y))
    browser.settle()
    found = re.match(r"([\d.]+)° S, ([\d.]+)° E", browser.text("#readout"))
    assert found
    lon, lat = frame.from_metres(1000.0, 500.0)
    assert float(found[1]) == pytest.approx(-float(lat), abs=5e-5)  # a pixel is 4 m
    assert float(found[2]) == pytest.approx(float(lon), abs=5e-5)
    assert browser.run("document.getElementById('north-text').textContent") == "N"


# ---- it can be steered --------------------------------------------------------------------


def test_legend_hides_an_environment(
    browser: Browser, save: Save, quarters: EnvironmentMap
) -> None:
    browser.open(save(quarters))
    at = place(browser, 20, 40)
    before = pixel(browser, *at)
    browser.run(
        "[...document.querySelectorAll('#legend label')]"
        ".find((l) => l.textContent.includes('Residential')).click()"
    )
    browser.settle()
    after = pixel(browser, *at)
    assert before != after
    assert max(after) - min(after) < 15  # hardly a colour


def test_colour_modes(browser: Browser, save: Save, quarters: EnvironmentMap) -> None:
    browser.open(save(quarters))
    home, shops = place(browser, 20, 40), place(browser, 70, 10)
    choose(browser, "#mode", "1")  # probability of Commercial
    pale, full = pixel(browser, *home), pixel(browser, *shops)
    assert sum(pale) > sum(full) + 60
    assert "Probability of Commercial" in browser.text("#ramp-text")
    choose(browser, "#mode", "margin")
    assert "Lead" in browser.text("#ramp-text")
    assert pixel(browser, *shops) != full


def test_layers(browser: Browser, save: Save, quarters: EnvironmentMap) -> None:
    browser.open(save(quarters))
    dot = place(browser, 80, 20)
    seen = pixel(browser, *dot)
    browser.run("document.getElementById('layer-landmarks').click()")
    browser.settle()
    ground = pixel(browser, *dot)
    assert ground != seen
    browser.run("document.getElementById('layer-segments').click()")
    browser.settle()
    assert pixel(browser, *dot) not in {ground, seen}


def test_search_finds_classes_segments_and_landmarks(
    browser: Browser, save: Save, quarters: EnvironmentMap
) -> None:
    browser.open(save(quarters))
    write(browser, "sho")
    assert "Shop\n2 landmarks" in browser.text("#found")
    browser.key("Enter")
    assert browser.text("#highlight-text") == "2 shops"
    browser.key("Escape")
    assert browser.run("document.getElementById('highlight').hidden") is True
    browser.run("document.getElementById('search').value = ''")
    write(browser, "3-1-1")
    browser.key("Enter")
    assert browser.run("document.documentElement.dataset.segment") == "3-1-1"
    browser.run("document.getElementById('search').value = ''")
    write(browser, "n5")
    browser.key("Enter")
    assert browser.text("#panel h2") == "School"
    browser.run("document.getElementById('search').value = ''")
    write(browser, "zebra")
    assert "Nothing has that name" in browser.text("#found")


def test_wheel_drag_and_buttons_move_the_map(
    browser: Browser, save: Save, quarters: EnvironmentMap
) -> None:
    browser.open(save(quarters))
    assert browser.text("#scale-text") == "10 m"
    x, y = place(browser, 50, 50)
    browser.mouse("mouseWheel", x, y, deltaX=0, deltaY=-900)
    browser.settle()
    assert browser.text("#scale-text") == "2 m"
    browser.run("document.getElementById('zoom-fit').click()")
    browser.settle()
    assert browser.text("#scale-text") == "10 m"
    start, end = place(browser, 20, 40), place(browser, 70, 40)
    yellow = pixel(browser, *start)
    browser.mouse("mousePressed", *start, button="left", clickCount=1)
    browser.mouse("mouseMoved", *end, button="left", buttons=1)
    browser.mouse("mouseReleased", *end, button="left", clickCount=1)
    browser.settle()
    assert pixel(browser, *end) == yellow  # the ground went along
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


# ---- it fits ------------------------------------------------------------------------------


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
    light = pixel(browser, *corner)
    browser.emulate(dark=True)
    browser.settle()
    dark = pixel(browser, *corner)
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
