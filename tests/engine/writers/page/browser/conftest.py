"""A real browser without a network for the page's tests."""

from __future__ import annotations

import base64
import contextlib
import io
import json
import os
import select
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.writers.html import render_html

NAMES = ("chromium", "chromium-browser", "google-chrome", "chrome")
CHROMIUM = next((found for found in map(shutil.which, NAMES) if found), None)
OFFLINE = ["unshare", "-n"]
PATIENCE = 60  # seconds
READY = "document.documentElement?.dataset.ready === 'true'"
LAUNCH = """
import fcntl, os, sys
inbox, outbox = (fcntl.fcntl(int(n), fcntl.F_DUPFD, 10) for n in sys.argv[1:3])
os.dup2(inbox, 3)  # the browser reads commands here
os.dup2(outbox, 4)  # and answers here
os.execv(sys.argv[3], sys.argv[3:])
"""
MakeMap = Callable[..., EnvironmentMap]
Save = Callable[..., Path]


class Browser:
    """Headless Chromium, driven over a pipe by its DevTools protocol: no port, no driver needed.

    Args:
        profile: a folder that the browser may fill.
        offline: without any network; else this machine can be reached, and nothing beyond it.
    """

    def __init__(self, profile: Path, offline: bool = True) -> None:
        assert CHROMIUM
        inbox, self._outbox = os.pipe()
        self._inbox, outbox = os.pipe()
        no_network = OFFLINE if offline and _can_unshare() else []
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
            assert select.select([self._inbox], [], [], PATIENCE)[0], "the browser says nothing"
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
        page: Path | str,
        fragment: str = "",
        width: int = 1200,
        height: int = 800,
        ready: str = READY,
    ) -> None:
        """Load a page in a window of this size and wait until it says that it is ready."""
        self.call("Page.navigate", url="about:blank")
        self._page = page if isinstance(page, str) else page.as_uri()
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

    def run(self, script: str) -> Any:
        """The value of an expression in the page."""
        answer = self.call(
            "Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True
        )
        assert "exceptionDetails" not in answer, answer["exceptionDetails"]
        return answer["result"].get("value")

    def wait(self, condition: str) -> None:
        """Wait until an expression is true."""
        end = time.monotonic() + PATIENCE
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
            more: dict[str, Any] = {"text": text} if text and kind == "keyDown" else {}
            self.call(
                "Input.dispatchKeyEvent", type=kind, key=key, windowsVirtualKeyCode=code, **more
            )
        self.settle()

    def text(self, selector: str) -> str:
        """The visible text of an element."""
        return str(self.run(f"document.querySelector({json.dumps(selector)}).innerText"))

    def place(self, x: float, y: float, extent: float = 100.0) -> tuple[float, float]:
        """Where a place of a square map, all of which is shown, is in the window."""
        left, top, width, height = self.run(
            "(() => { const b = document.getElementById('map').getBoundingClientRect();"
            " return [b.left, b.top, b.width, b.height]; })()"
        )
        k = min(width - 56, height - 56) / extent
        return left + width / 2 + (x - extent / 2) * k, top + height / 2 - (y - extent / 2) * k

    def pixel(self, x: float, y: float) -> tuple[int, int, int]:
        """Colour at a place of the window, 0 to 255."""
        from matplotlib.image import imread

        clip = {"x": int(x), "y": int(y), "width": 1, "height": 1, "scale": 1}
        picture = base64.b64decode(self.call("Page.captureScreenshot", clip=clip)["data"])
        red, green, blue = imread(io.BytesIO(picture))[0, 0, :3] * 255
        return round(red), round(green), round(blue)

    def choose(self, selector: str, value: str) -> None:
        """Take an option of a select."""
        self.run(
            f"(() => {{ const s = document.querySelector('{selector}'); s.value = '{value}';"
            " s.dispatchEvent(new Event('change')); })()"
        )
        self.settle()

    def search(self, text: str) -> None:
        """Type into the search box."""
        self.run(
            "(() => { const s = document.getElementById('search'); s.value = ''; s.focus(); })()"
        )
        self.call("Input.insertText", text=text)
        self.settle()

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
    """One browser for all tests of a file."""
    if not CHROMIUM:
        pytest.skip(f"needs Chromium: none of {', '.join(NAMES)} is on the path")
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
        np.array(xy),
        ["House"] * 3 + ["Shop"] * 2 + ["School"],
        bbox=(0.0, 0.0, 100.0, 100.0),
        side=2,
    )
