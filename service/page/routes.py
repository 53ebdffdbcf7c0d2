"""The query page at ``/query`` and the files that it needs; nothing comes from elsewhere."""

from __future__ import annotations

import json
from functools import cache
from hashlib import sha256
from importlib.resources import files

from fastapi import APIRouter, Request, Response
from fastapi.responses import HTMLResponse

from symboslam.service.problems import Problem
from symboslam.service.responses import not_modified
from symboslam.service.vocabulary import QUERY_PREFIXES

router = APIRouter(tags=["SPARQL"])

_YASGUI = ("yasgui.min.css", "yasgui.min.js")
"""Built by ``scripts/query-page``; where they are missing the page has a plain field."""
_FILES = {
    "query.css": "text/css",
    "query.js": "text/javascript",
    "editor.js": "text/javascript",
    "plain.js": "text/javascript",
    "yasgui.min.css": "text/css",
    "yasgui.min.js": "text/javascript",
}
_POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; "
    "img-src 'self' data:; connect-src 'self'; form-action 'self'; base-uri 'none'; "
    "frame-ancestors 'none'"
)
_HEADERS = {"Cache-Control": "no-cache", "X-Content-Type-Options": "nosniff"}


@router.get("/query", summary="A page to ask queries on", response_class=HTMLResponse)
@router.head("/query", include_in_schema=False)
async def query_page() -> Response:
    """The page; ``?query=`` and ``?example=`` say what it opens with."""
    headers = {
        **_HEADERS, "Content-Security-Policy": _POLICY, "Referrer-Policy": "no-referrer",
    }  # fmt: skip
    return Response(_page(), media_type="text/html; charset=utf-8", headers=headers)


@router.get("/query/{name}", include_in_schema=False)
@router.head("/query/{name}", include_in_schema=False)
async def page_file(request: Request, name: str) -> Response:
    """A script or style of the page."""
    content = _content(name) if name in _FILES else None
    if content is None:
        raise Problem(404, "not-found", f"there is nothing at {request.url.path}")
    tag = f'W/"{sha256(content).hexdigest()[:16]}"'
    if same := not_modified(request, tag):
        return same
    return Response(content, media_type=_FILES[name], headers={**_HEADERS, "ETag": tag})


@cache
def _page() -> str:
    built = all(_content(name) is not None for name in _YASGUI)
    script = '<script src="query/yasgui.min.js" defer></script>' if built else ""
    style = '<link rel="stylesheet" href="query/yasgui.min.css">' if built else ""
    prefixes = json.dumps(QUERY_PREFIXES).replace("<", "\\u003c")
    page = (files("symboslam.service.page") / "query.html").read_text("utf-8")
    page = page.replace("<!-- styles of YASGUI -->", style)
    page = page.replace("<!-- scripts of YASGUI -->", script)
    return page.replace("<!-- prefixes -->", prefixes)


@cache
def _content(name: str) -> bytes | None:
    folder = files("symboslam.service.page")
    path = folder / "built" / name if name in _YASGUI else folder / name
    return path.read_bytes() if path.is_file() else None
