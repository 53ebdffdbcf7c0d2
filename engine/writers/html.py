"""HTML: an environment map as one page that needs no network, no server and no other file.

The page is a template with style, scripts and data written into it. What comes from the input is
never markup: the data are JSON in which no ``<``, ``>`` or ``&`` occurs, the scripts show it as
text only, and a content security policy forbids every other script and every request.
"""

from __future__ import annotations

import html
import json
import re
from base64 import b64encode
from functools import cache
from hashlib import sha256
from importlib.resources import files
from typing import Any, BinaryIO

from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.writers.options import REASONS, WriteOptions
from symboslam.engine.writers.page.payload import payload

_SCRIPTS = ("data.js", "view.js", "painter.js", "panel.js", "search.js", "page.js")


def write(environment_map: EnvironmentMap, stream: BinaryIO, options: WriteOptions) -> None:
    """Write the page in UTF-8.

    Args:
        environment_map: the map to show.
        stream: where to.
        options: ``reasons`` and ``progress`` mean something here.
    """
    options.tell("drawing the page", 0.0)
    stream.write(render_html(environment_map, reasons=options.reasons).encode())
    options.tell("drawing the page", 1.0)


def render_html(environment_map: EnvironmentMap, *, reasons: int = REASONS) -> str:
    """The whole page.

    Args:
        environment_map: the map to show.
        reasons: how many to tell at most for each environment of a segment; 0 = none.

    Returns:
        A document in HTML; equal maps give equal documents.
    """
    data = payload(environment_map, reasons)
    style, script = _part("page.css"), _script()
    parts = {
        "title": html.escape(printable(data["title"])),
        "summary": html.escape(printable(_summary(data))),
        "style-hash": csp_hash(style),
        "script-hash": csp_hash(script),
        "style": style,
        "script": script,
        "data": _json(data),
    }
    return re.sub(r"@@([a-z-]+)@@", lambda match: parts[match[1]], _part("page.html"))


@cache
def _part(name: str) -> str:
    return (files("symboslam.engine.writers.page") / name).read_text("utf-8")


@cache
def _script() -> str:
    """All scripts as one, in a scope of their own."""
    return '"use strict";\n(() => {\n' + "\n".join(map(_part, _SCRIPTS)) + "})();\n"


def csp_hash(text: str) -> str:
    """What the content security policy calls a script or style that is allowed."""
    return "sha256-" + b64encode(sha256(text.encode()).digest()).decode()


def _json(data: dict[str, Any]) -> str:
    """JSON that can stand inside a script element, whatever words the input holds."""
    text = json.dumps(data, separators=(",", ":"), allow_nan=False)
    return text.replace("<", r"\u003c").replace(">", r"\u003e").replace("&", r"\u0026")


def printable(text: str) -> str:
    """Text that has a form in UTF-8: half a surrogate pair becomes a question mark."""
    return text.encode("utf-8", "replace").decode("utf-8")


def _summary(data: dict[str, Any]) -> str:
    """One sentence for readers without scripts."""
    segments = data["segments"]
    total = sum(segments["area"]) or 1.0
    share = dict.fromkeys(range(-1, len(data["envs"])), 0.0)
    for label, area in zip(segments["label"], segments["area"], strict=True):
        share[label] += area / total
    ranked = sorted(share, key=lambda k: -share[k])
    names = {k: "unknown" if k < 0 else data["envs"][k]["label"] for k in ranked}
    told = ", ".join(f"{names[k]} {share[k]:.0%}" for k in ranked if share[k] >= 0.005)
    return f"{data['count']} landmarks in {len(segments['id'])} segments: {told or 'no segment'}."
