"""The page of an environment type: its features with strengths and reasons, and its rivals."""

from __future__ import annotations

from symboslam.reasoning.documentation.evidence import TELLING, Evidence, Row
from symboslam.reasoning.documentation.frame import chip, meter
from symboslam.reasoning.documentation.library import Library, anchors
from symboslam.reasoning.documentation.markup import Content, Markup, join, safe_colour, tag, text
from symboslam.reasoning.knowledge import Environment


class EnvironmentPages:
    """Writes the pages of environment types.

    Args:
        library: all modules.
        evidence: what indicates which environment.
        pages: IRI of an environment type -> its page.
    """

    def __init__(self, library: Library, evidence: Evidence, pages: dict[str, str]) -> None:
        self.library, self.evidence, self.pages = library, evidence, pages
        self.anchors = anchors((f.iri for f in evidence.knowledge.features), "feature-")

    def content(self, environment: Environment) -> list[Content]:
        """What stands below the page's heading."""
        rows = self.evidence.rows[environment.name]
        direct = sum(row.way.is_direct for row in rows)
        facts = [
            (len(rows), "features indicate it"),
            (direct, "of them directly"),
            (sum(row.share >= TELLING for row in rows), "and hardly any other type"),
            (sum(row.feature.static for row in rows), "static"),
        ]
        link = self.library.link(environment.iri, words="its class in the reference")
        parts: list[Content] = [
            tag("p", environment.definition, class_="lead"),
            tag("p", chip(safe_colour(environment.colour), None, safe_colour(environment.colour)),
                " ", link),
            tag("ul", [tag("li", tag("b", n), words) for n, words in facts], class_="facts"),
            self._zones(environment),
            self._telling(environment),
            self._rivals(environment),
            self._table(environment, rows),
        ]  # fmt: skip
        return parts

    def _zones(self, environment: Environment) -> Content:
        if not environment.zones:
            return None
        terms = self.library.terms
        listed = [
            tag("li", self.library.link(zone.iri, words=zone.label), ": ",
                terms[zone.iri].definition if zone.iri in terms else "")
            for zone in environment.zones
        ]  # fmt: skip
        return [tag("h2", "Plan zones"), tag("ul", listed)]

    def _telling(self, environment: Environment) -> Content:
        rows = self.evidence.telling(environment.name)
        title = tag("h2", "What tells it from the other types")
        if not rows:
            words = f"No feature gives {TELLING:.0%} of its proximity to it: all are shared."
            return [title, tag("p", words)]
        chips = [
            chip(f"{row.feature.label} {row.weight:.2f}", f"#{self.anchors[row.feature.iri]}")
            for row in rows
        ]
        words = f"These indicate it and hardly any other type ({TELLING:.0%} or more of what they "
        return [title, tag("p", f"{words}say is for it); the weightiest first.", class_="note"),
                tag("p", chips)]  # fmt: skip

    def _rivals(self, environment: Environment) -> Content:
        rows = []
        for rival in self.evidence.rivals(environment.name):
            if not rival.shared:
                continue
            other = rival.environment
            page = self.pages[other.iri]
            names = [
                chip(row.feature.label, f"#{self.anchors[row.feature.iri]}")
                for row in rival.telling
            ]
            rows.append(
                tag(
                    "tr",
                    tag("td", chip(other.label, page, safe_colour(other.colour))),
                    tag("td", rival.shared, data_name="shared"),
                    tag("td", names or "none leans this way", data_name="lean this way"),
                )
            )
        if not rows:
            return None
        head = tag("tr", [tag("th", n) for n in ("type", "shared features", "of these, what leans "
                                                 f"most to {environment.label}")])  # fmt: skip
        return [
            tag("h2", "Which types it shares features with"),
            tag("table", tag("thead", head), tag("tbody", rows), class_="stack"),
        ]

    def _table(self, environment: Environment, rows: tuple[Row, ...]) -> Content:
        names = ("feature", "weight", "strength", "only here", "because", "moves", "OSM tags")
        head = tag(
            "tr",
            [
                tag("th", tag("button", name, type="button"),
                    aria_sort="descending" if name == "weight" else None)
                for name in names
            ],
        )  # fmt: skip
        scheme = self.evidence.scheme_of(environment.name)
        box = tag("input", type="search", data_filter="features", aria_label="Filter features",
                  placeholder="Filter: name, reason, tag, static …")  # fmt: skip
        shown = [self._row(row) for row in rows]
        table = tag(
            "table",
            tag("thead", head),
            tag("tbody", shown),
            class_="sortable stack",
            id="features",
        )
        note = (
            "Strength is what the axiom states, halved for one step beyond a direct link, a third "
            "for two, and so on. Importance is 1 for a feature that points to one type and 0 for "
            "one that points to all alike. Weight = strength over steps × importance, which is "
            "what a landmark counts. Only here = the share of all that a feature says that is for "
            f"this type. Given for the types of the scheme “{scheme}”."
        )
        return [
            tag("h2", "Features"),
            tag("p", note, class_="note"),
            tag("p", box, " ", tag("small", id="features-count"), class_="filter"),
            table,
        ]

    def _row(self, row: Row) -> Markup:
        feature, way = row.feature, row.way
        label = self.library.link(feature.iri, words=feature.label)
        detector = feature.detector_label
        reasons: list[Content] = [way.reason, " ", self._source(way.source, way.source_iri)]
        if way.steps:
            reasons.append(tag("div", self._path(way.path, feature.iri), class_="path"))
        for other in row.also:
            place = self.library.link(other.place)
            words = ["also indicates ", place, f" {other.strength:.2f}: ", other.reason, " "]
            source = self._source(self.library.label(other.source), other.source)
            reasons.append(tag("div", words, source if other.source else None))
        strength = [meter(way.strength)]
        if way.steps:
            strength.append(tag("small", f"over {way.steps + 1} = {way.proximity:.2f}"))
        tags = [tag("code", t) for t in feature.osm_tags]
        return tag(
            "tr",
            tag("td", tag("b", label), tag("small", feature.definition),
                tag("small", "detector: ", tag("code", detector)) if detector else None),
            tag("td", meter(row.weight), data_value=f"{row.weight:.4f}", data_name="weight"),
            tag("td", strength, data_value=f"{way.proximity:.4f}", data_name="strength"),
            tag("td", f"{row.share:.0%}", data_value=f"{row.share:.4f}", data_name="only here"),
            tag("td", reasons, data_name="because"),
            tag("td", "static" if feature.static else "dynamic", data_name="moves"),
            tag("td", _tags(tags), data_name="OSM tags"),
            id=self.anchors[feature.iri],
            data_row=True,
        )  # fmt: skip

    def _path(self, path: tuple[str, ...], feature: str) -> Markup:
        """The way from a feature to the environment, with links."""
        links = []
        for i, name in enumerate(path):
            term = self.library.by_name.get(name)
            iri = feature if i == 0 else term.iri if term else None
            links.append(self.library.link(iri) if iri else text(name))
        return tag("small", join(" › ", links))

    def _source(self, words: str, iri: str) -> Content:
        if not words and not iri:
            return None
        shown = self.library.link(iri, words=words) if iri else text(words)
        return tag("span", "(", shown, ")", class_="source")


def _tags(tags: list[Markup], most: int = 4) -> Content:
    if len(tags) <= most + 1:
        return join(" ", tags)
    rest = tag("details", tag("summary", f"{len(tags) - most} more"), join(" ", tags[most:]))
    return [join(" ", tags[:most]), rest]
