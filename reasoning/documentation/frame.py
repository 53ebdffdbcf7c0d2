"""The frame of every page: head, links between pages, search box, foot."""

from __future__ import annotations

from dataclasses import dataclass

from symboslam.reasoning.documentation.markup import Content, Markup, tag, text


@dataclass(frozen=True)
class Frame:
    """What all pages of a site share.

    Attributes:
        title: of the site.
        version: of the ontology; may be empty.
        pages: link and words of the pages that every page leads to.
    """

    title: str
    version: str
    pages: tuple[tuple[str, str], ...]

    def page(
        self, title: str, *content: Content, here: str = "", colour: str | None = None
    ) -> Markup:
        """A whole page.

        Args:
            title: its heading.
            content: what stands below the heading.
            here: its own link, which the menu marks.
            colour: of the bar above the heading; a safe ``#rrggbb``.
        """
        heading = title if title == self.title else f"{title} · {self.title}"
        menu = [
            tag("a", words, href=href, aria_current="page" if href == here else None)
            for href, words in self.pages
        ]
        search = tag(
            "div",
            tag("input", type="search", id="site-search", placeholder="Search all terms …",
                aria_label="Search all terms", autocomplete="off", spellcheck="false"),
            tag("ul", id="site-results", hidden=True),
            class_="search",
        )  # fmt: skip
        bar = tag("div", class_="bar", style=f"background:{colour}") if colour else None
        return text(
            [
                Markup("<!DOCTYPE html>\n"),
                tag(
                    "html",
                    tag(
                        "head",
                        tag("meta", charset="utf-8"),
                        tag("meta", name="viewport", content="width=device-width,initial-scale=1"),
                        tag("meta", name="color-scheme", content="light dark"),
                        tag("meta", name="generator", content="symboslam ontology docs"),
                        tag("title", heading),
                        tag("link", rel="icon", href="data:,"),
                        tag("link", rel="stylesheet", href="style.css"),
                        tag("script", src="terms.js", defer=True),
                        tag("script", src="site.js", defer=True),
                    ),
                    tag(
                        "body",
                        tag("header", tag("nav", menu), search, class_="top"),
                        bar,
                        tag("main", tag("h1", title, id="section-top"), content),
                        tag("footer", f"{self.title} {self.version}".strip()),
                    ),
                    lang="en",
                ),
            ]
        )


def figure(drawing: Markup, file: str) -> Markup:
    """A diagram on a page, with a link to its file."""
    return tag(
        "div",
        tag("div", drawing, class_="scroll", tabindex=0),
        tag("p", tag("a", "the diagram as a file", href=file), class_="note"),
        class_="figure",
    )


def chip(words: str, href: str | None, colour: str | None = None) -> Markup:
    """A word in a rounded frame, with a dot of a colour before it."""
    dot = tag("i", class_="dot", style=f"background:{colour}") if colour else None
    if href is None:
        return tag("span", dot, words, class_="chip")
    return tag("a", dot, words, href=href, class_="chip")


def meter(value: float) -> Markup:
    """A number in [0, 1] with a bar as long as it says; ``nan`` shows no bar."""
    share = min(max(value, 0.0), 1.0) if value == value else 0.0
    bar = tag("i", style=f"width:{100 * share:.0f}%")
    return tag("span", tag("span", bar, class_="track"), f"{value:.2f}", class_="meter")
