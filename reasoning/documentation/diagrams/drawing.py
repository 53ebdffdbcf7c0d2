"""SVG drawing: boxes with words in them, lines between them, colours for light and dark."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from symboslam.reasoning.documentation.markup import Content, Markup, tag

ROW = 26.0
"""Height of a box."""

# Widths at 12 px in DejaVu Sans, the widest of the fonts that are asked for.
_WIDTHS = {
    3.6: "'IJijl", 4.3: " ,./:;\\f|", 4.8: "()-[]t!r", 6.5: "\"*_`?Lcsz", 7.2: "FPkvxy",
    7.7: "$0123456789ESTYabdeghnopqu{}", 8.5: "ABKVXZCR", 9.5: "DHNU&GOQ", 10.3: "#+<=>^w~M",
    12.0: "%m@W",
}  # fmt: skip
_WIDTH = {letter: width for width, letters in _WIDTHS.items() for letter in letters}
_OTHER, _IDEOGRAPH = 9.0, 13.0

STYLE = """
.dg{--dg-ink:#1d2733;--dg-soft:#6b7785;--dg-line:#b4bec9;--dg-box:#ffffff;--dg-edge:#8a97a6;
--dg-fill:#eef3f8;--dg-group:#f6f8fa;--dg-accent:#2f6f9f;--dg-bridge:#a05a2c;
font:12px system-ui,"Segoe UI",Roboto,Helvetica,Arial,sans-serif}
@media (prefers-color-scheme:dark){@media screen{.dg{--dg-ink:#e6ebf0;--dg-soft:#9aa7b4;
--dg-line:#4b5866;--dg-box:#1d252d;--dg-edge:#66758a;--dg-fill:#26323e;--dg-group:#192027;
--dg-accent:#7db8e0;--dg-bridge:#e0a070}}}
.dg text{fill:var(--dg-ink)}
.dg .dg-box rect{fill:var(--dg-box);stroke:var(--dg-edge)}
.dg .dg-inner rect{fill:var(--dg-fill);stroke:var(--dg-accent)}
.dg .dg-up rect{fill:var(--dg-box);stroke:var(--dg-bridge)}
.dg .dg-outside rect{stroke-dasharray:4 3;fill:none}
.dg .dg-outside text{fill:var(--dg-soft)}
.dg .dg-group{fill:var(--dg-group);stroke:var(--dg-line);stroke-dasharray:1 0}
.dg .dg-line{fill:none;stroke:var(--dg-line);stroke-width:1.3}
.dg .dg-arrow{fill:none;stroke:var(--dg-accent);stroke-width:1.2}
.dg .dg-head{fill:var(--dg-accent)}
.dg .dg-note,.dg .dg-title{fill:var(--dg-soft)}
.dg .dg-title{font-weight:600}
.dg a:hover rect{stroke-width:2}
.dg a{text-decoration:none}
""".replace("\n", "")


def width_of(words: str) -> float:
    """Width in pixels that words need at 12 px, rather too wide than too narrow."""
    return sum(_WIDTH.get(c, _IDEOGRAPH if ord(c) > 0x2E80 else _OTHER) for c in words)


def clipped(words: str, most: int = 34) -> str:
    """Words cut to a length that fits a box.

    >>> clipped("a very long name of a class", 12)
    'a very long…'
    """
    return words if len(words) <= most else words[: most - 1].rstrip() + "…"


@dataclass(frozen=True)
class Box:
    """What stands in a box.

    Attributes:
        words: its text.
        href: where a click leads; None for nowhere.
        style: ``box``, ``inner`` for one with others below it, ``outside`` for one of another
            module.
        title: shown when the pointer rests on it.
        dots: colour and words of small marks behind the text.
        note: further words, in a softer colour.
    """

    words: str
    href: str | None = None
    style: str = "box"
    title: str = ""
    dots: tuple[tuple[str, str], ...] = ()
    note: str = ""

    @property
    def width(self) -> float:
        """Pixels from edge to edge."""
        note = width_of(clipped(self.note)) + 6 if self.note else 0.0
        return (
            width_of(clipped(self.words)) + note + 16 + (11 * len(self.dots) + 3) * bool(self.dots)
        )


@dataclass
class Canvas:
    """Shapes, and how far they reach.

    Attributes:
        below, above: shapes in drawing order; those in ``below`` lie under the others.
        width, height: reach in pixels.
    """

    below: list[Markup] = field(default_factory=list)
    above: list[Markup] = field(default_factory=list)
    width: float = 0.0
    height: float = 0.0

    def reach(self, x: float, y: float) -> None:
        """Make the drawing large enough for a point."""
        self.width, self.height = max(self.width, x), max(self.height, y)

    def box(self, box: Box, x: float, y: float, width: float | None = None) -> None:
        """A box with its top left corner at a point."""
        wide = width or box.width
        self.reach(x + wide, y + ROW - 4)
        note = tag("tspan", clipped(box.note), class_="dg-note", dx=6) if box.note else None
        shapes: list[Content] = [
            tag("title", box.title) if box.title else None,
            tag("rect", x=num(x), y=num(y), width=num(wide), height=num(ROW - 4), rx=4),
            tag("text", clipped(box.words), note, x=num(x + 8), y=num(y + 15)),
        ]
        start = x + wide - 11 * len(box.dots)
        for i, (colour, words) in enumerate(box.dots):
            shapes.append(_mark(start + 11 * i, y + 11, colour, words))
        kind = f"dg-box dg-{box.style}"
        if box.href is None:
            self.above.append(tag("g", shapes, class_=kind))
        else:
            self.above.append(tag("a", shapes, href=box.href, class_=kind))

    def mark(self, x: float, y: float, colour: str, words: str) -> None:
        """A small disc of a colour with words behind it."""
        self.above.append(_mark(x + 4, y - 4, colour, words))
        self.words(words, x + 13, y)

    def words(self, words: str, x: float, y: float, style: str = "dg-note") -> None:
        """A line of text whose baseline starts at a point."""
        self.reach(x + width_of(words), y + 4)
        shape = tag("text", words, x=num(x), y=num(y), class_=style)
        self.above.append(shape)

    def curve(self, x: float, y: float, to_x: float, to_y: float, style: str = "dg-line") -> None:
        """A line that leaves and arrives horizontally."""
        bend = max(12.0, abs(to_x - x) / 2)
        path = (f"M{num(x)} {num(y)}C{num(x + bend)} {num(y)} {num(to_x - bend)} {num(to_y)} "
                f"{num(to_x)} {num(to_y)}")  # fmt: skip
        self.below.append(tag("path", d=path, class_=style))

    def line(self, x: float, y: float, to_x: float, to_y: float, style: str = "dg-line") -> None:
        """A straight line."""
        path = f"M{num(x)} {num(y)}L{num(to_x)} {num(to_y)}"
        self.below.append(tag("path", d=path, class_=style))

    def head(self, x: float, y: float) -> None:
        """An arrow head that points to the right, its tip at a point."""
        path = f"M{num(x)} {num(y)}l-8 -4v8z"
        self.above.append(tag("path", d=path, class_="dg-head"))

    def group(self, x: float, y: float, width: float, height: float) -> None:
        """A frame around what belongs together."""
        self.reach(x + width, y + height)
        shape = tag("rect", x=num(x), y=num(y), width=num(width), height=num(height), rx=6,
                    class_="dg-group")  # fmt: skip
        self.below.append(shape)

    def place(self, other: Canvas, x: float, y: float) -> None:
        """Another drawing, moved to a point."""
        move = f"translate({num(x)} {num(y)})"
        self.below.append(tag("g", other.below, transform=move))
        self.above.append(tag("g", other.above, transform=move))
        self.reach(x + other.width, y + other.height)

    def svg(self, label: str) -> Markup:
        """The drawing as an SVG element that also makes a file of its own."""
        wide, high = num(self.width + 8), num(self.height + 8)
        return tag(
            "svg", tag("title", label), tag("style", Markup(STYLE)), self.below, self.above,
            xmlns="http://www.w3.org/2000/svg", width=wide, height=high, role="img",
            viewBox=f"-4 -4 {wide} {high}", class_="dg", aria_label=label,
            style=f"max-width:100%;min-width:{num(0.72 * self.width)}px;height:auto",
        )  # fmt: skip


def _mark(x: float, y: float, colour: str, words: str) -> Markup:
    return tag("circle", tag("title", words), cx=num(x), cy=num(y), r=4, fill=colour,
               stroke="#0006", stroke_width="0.6")  # fmt: skip


def num(value: float) -> str:
    """A number as short as it can be.

    >>> num(12.0), num(3.14159)
    ('12', '3.1')
    """
    return f"{value:.1f}".removesuffix(".0")


def stacked(drawings: Iterable[tuple[str, Canvas]], gap: float = 28) -> Canvas:
    """Drawings one below the other, each under a title; empty ones are left out."""
    whole = Canvas()
    y = 0.0
    for title, drawing in drawings:
        if drawing.height:
            if title:
                whole.words(title, 0, y + 12, "dg-title")
                y += 24
            whole.place(drawing, 0, y)
            y += drawing.height + gap
    return whole
