"""HTML built from elements, so that every text is escaped unless it is markup already."""

from __future__ import annotations

import re
from collections.abc import Iterable
from html import escape
from typing import TypeAlias

_CONTROL = re.compile(r"[\x00-\x08\x0b\x0c\x0e-\x1f\x7f\ufffe\uffff]")
_VOID = frozenset(["input", "link", "meta", "br", "hr", "img"])
_BLOCKS = frozenset(
    ["article", "body", "dd", "details", "div", "dl", "dt", "footer", "h1", "h2", "h3", "head",
     "header", "html", "li", "link", "main", "meta", "nav", "ol", "p", "script", "section",
     "summary", "table", "tbody", "thead", "title", "tr", "ul"]
)  # fmt: skip
_COLOUR = re.compile(r"#[0-9a-fA-F]{6}\Z")
_SAFE_LINK = re.compile(r"https?://[^\s\"'<>\\^`{|}]+\Z", re.IGNORECASE)


class Markup(str):
    """Text that is HTML or SVG already."""

    __slots__ = ()


Content: TypeAlias = "str | int | Markup | Iterable[Content] | None"
Value: TypeAlias = "str | int | float | bool | None"


def text(content: Content) -> Markup:
    """Content as markup: text is escaped, markup kept, None left out, the rest joined.

    >>> text(["a < b", None, Markup("<br>")])
    'a &lt; b<br>'
    """
    if isinstance(content, Markup):
        return content
    if content is None:
        return Markup("")
    if isinstance(content, str | int):
        return Markup(escape(_CONTROL.sub("\ufffd", str(content))))
    return Markup("".join(text(part) for part in content))


def tag(name: str, /, *content: Content, **attributes: Value) -> Markup:
    """An element. ``class_`` is class, ``data_x`` is data-x; None and False leave one out.

    >>> tag("a", "R&D", href="x.html", class_="own", hidden=True)
    '<a href="x.html" class="own" hidden>R&amp;D</a>'
    """
    parts = [name]
    for key, value in attributes.items():
        if value is None or value is False:
            continue
        key = key.rstrip("_").replace("_", "-")
        parts.append(key if value is True else f'{key}="{text(str(value))}"')
    end = "" if name in _VOID else f"</{name}>"
    line = "\n" if name in _BLOCKS else ""
    return Markup(f"<{' '.join(parts)}>{text(content)}{end}{line}")


def join(separator: Content, parts: Iterable[Content]) -> Markup:
    """Content with a separator between the parts.

    >>> join(", ", ["a", "b"])
    'a, b'
    """
    return Markup(text(separator).join(text(part) for part in parts))


def external(iri: str, words: Content = None) -> Markup:
    """A link to the web; plain text where the IRI is none that a browser should open.

    >>> external("javascript:alert(1)")
    'javascript:alert(1)'
    """
    if not _SAFE_LINK.match(iri):
        return text(words or iri)
    return tag("a", words or iri, href=iri, class_="external", rel="noopener noreferrer")


def is_link(iri: str) -> bool:
    """Whether an IRI may be linked to.

    >>> is_link("https://example.org/a"), is_link("urn:x")
    (True, False)
    """
    return _SAFE_LINK.match(iri) is not None


def safe_colour(colour: str) -> str:
    """A colour that may stand in a style; grey for anything else.

    >>> safe_colour("#e04b4b"), safe_colour("red;x:url(y)")
    ('#e04b4b', '#888888')
    """
    return colour if _COLOUR.match(colour) else "#888888"
