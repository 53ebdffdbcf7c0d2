"""The reference page of a module: its head, its diagram, and an entry for each of its terms."""

from __future__ import annotations

from collections.abc import Iterable

from rdflib import DCTERMS, OWL, RDF, RDFS, BNode, URIRef

from symboslam.reasoning.documentation.evidence import Evidence
from symboslam.reasoning.documentation.expressions import Expressions
from symboslam.reasoning.documentation.facts import Facts, folded
from symboslam.reasoning.documentation.frame import chip, figure, meter
from symboslam.reasoning.documentation.library import KINDS, ORDER, Library, Term
from symboslam.reasoning.documentation.markup import Content, Markup, external, join, tag, text
from symboslam.reasoning.documentation.modules import Module
from symboslam.reasoning.statements import Stated

_MOST_CRUMBS = 20
_PLURAL = {
    "class": "Classes",
    "object property": "Object properties",
    "datatype property": "Datatype properties",
    "annotation property": "Annotation properties",
    "datatype": "Datatypes",
    "individual": "Individuals",
}


class ModulePages:
    """Writes the pages of modules.

    Args:
        library: all modules.
        facts: what is stated about terms.
        evidence: what indicates which environment; None where nothing is indicated.
        environment_pages: IRI of an environment type -> its page.
    """

    def __init__(
        self,
        library: Library,
        facts: Facts,
        evidence: Evidence | None,
        environment_pages: dict[str, str],
    ) -> None:
        self.library, self.facts, self.evidence = library, facts, evidence
        self.environment_pages = environment_pages

    def content(self, module: Module, diagram: Markup | None) -> list[Content]:
        """What stands below the page's heading."""
        terms = self.library.declared[module]
        parts: list[Content] = [tag("p", module.description, class_="lead")]
        if module.comment:
            parts.append(tag("p", module.comment))
        parts.append(self._head(module))
        if diagram:
            parts.append([tag("h2", "Diagram"), figure(diagram, f"{module.page}.svg")])
        if terms:
            parts.append(self._contents(terms))
        listed = [
            [tag("h2", _PLURAL[kind]), [self._entry(t) for t in terms if t.kind == kind]]
            for kind in ORDER
            if any(t.kind == kind for t in terms)
        ]
        parts.append(tag("div", listed, id="terms"))
        parts.append(self._bridges(module))
        return parts

    def _head(self, module: Module) -> Markup:
        """Document, version, licence, creators, imports."""

        def documents(iris: Iterable[str]) -> Markup:
            return join(", ", (self.library.link(iri) for iri in iris))

        users = [m.iri for m in self.library.modules if module.iri and module.iri in m.imports]
        creators = [*module.headers(DCTERMS.creator), *module.headers(DCTERMS.contributor)]
        licences = module.headers(DCTERMS.license)
        prior = module.headers(OWL.priorVersion)
        rows: list[tuple[str, Content]] = [
            ("document", external(module.iri) if module.iri else "none declared"),
            ("version", module.header(OWL.versionInfo)),
            ("version before", join(", ", (external(str(o)) for o in prior))),
            ("licence", join(", ", (_external_or_text(str(o)) for o in licences))),
            ("creators", ", ".join(str(o) for o in creators)),
            ("imports", documents(module.imports)),
            ("imported by", folded([self.library.link(iri) for iri in users])),
        ]
        shown = [[tag("dt", name), tag("dd", value)] for name, value in rows if value]
        return tag("section", tag("dl", shown), class_="term")

    def _contents(self, terms: tuple[Term, ...]) -> Markup:
        """Filter and list of all terms."""
        box = tag("input", type="search", data_filter="terms", placeholder="Filter this page …",
                  aria_label="Filter this page")  # fmt: skip
        lists = [
            [
                tag("p", tag("b", f"{_PLURAL[kind]} ({len(found)})")),
                tag("ul", [tag("li", tag("a", t.label, href=f"#{t.anchor}")) for t in found],
                    class_="toc"),
            ]
            for kind in ORDER
            if (found := [t for t in terms if t.kind == kind])
        ]  # fmt: skip
        count = tag("small", id="terms-count")
        return text([tag("h2", "Terms"), lists, tag("p", box, " ", count, class_="filter")])

    def _entry(self, term: Term) -> Markup:
        """All about one term."""
        environment = self.environment_pages.get(term.iri)
        page = [" · ", tag("a", "features, strengths, reasons", href=environment)]
        rows = self.facts.about(term)
        listed = [
            [tag("dt", heading), tag("dd", _values(heading, shown))] for heading, shown in rows
        ]
        return tag(
            "article",
            tag(
                "header",
                tag("h3", term.label),
                tag("small", term.kind),
                page if environment else None,
                tag("a", "#", href=f"#{term.anchor}", class_="self", aria_label="link to this"),
            ),
            tag("div", tag("span", term.iri, class_="iri")),
            tag("p", term.definition) if term.definition else None,
            self._crumbs(term),
            tag("dl", listed) if listed else None,
            self._indications(term),
            class_="term",
            id=term.anchor,
            data_row=True,
        )

    def _crumbs(self, term: Term) -> Markup | None:
        """The way down to a class or property from the top, by its first superclass."""
        way, iri = [term.iri], term.iri
        while above := [a for a in self.library.kinds_above(iri) if a not in way]:
            iri = above[0]
            way.append(iri)
            if len(way) > _MOST_CRUMBS:
                break
        if len(way) < 3:
            return None
        links = [self.library.link(iri, term.module) for iri in reversed(way[1:])]
        return tag("p", join(" › ", [*links, term.label]), class_="crumbs")

    def _indications(self, term: Term) -> Content:
        """What a class indicates, what indicates it, and what follows for the environments."""
        if self.evidence is None or term.kind != "class":
            return None
        parts: list[Content] = []
        if stated := self.evidence.by_class.get(term.iri, ()):
            parts.append(self._table(stated, term))
        if pairs := self.evidence.of_feature.get(term.iri, ()):
            chips = [
                chip(f"{e.label} {row.weight:.2f}", self.environment_pages[e.iri], e.colour)
                for e, row in pairs
            ]
            hint = "weight = strength over steps, times importance"
            parts.append(tag("p", tag("small", "Points to ", title=hint), chips))
        if by := self.evidence.by_place.get(term.iri, ()):
            links = [
                text([self.library.link(s.feature, term.module), " ",
                      tag("small", f"{s.strength:.2f}")])
                for s in by
            ]  # fmt: skip
            parts.append(tag("p", tag("small", f"Indicated by {len(by)}: "), folded(links)))
        return parts

    def _table(self, stated: tuple[Stated, ...], term: Term) -> Markup:
        head = tag("tr", [tag("th", name) for name in ("indicates", "strength", "because")])
        rows = [
            tag(
                "tr",
                tag("td", self.library.link(s.place, term.module), data_name="indicates"),
                tag("td", meter(s.strength), data_name="strength"),
                tag("td", s.reason, " ", self.source(s.source, term.module), data_name="because"),
            )
            for s in stated
        ]
        return tag("table", tag("thead", head), tag("tbody", rows), class_="stack")

    def source(self, source: str, here: Module | None = None) -> Content:
        """Where an indication comes from."""
        if not source:
            return None
        return tag("span", "(", self.library.link(source, here), ")", class_="source")

    def _bridges(self, module: Module) -> Content:
        """What a module says about terms that other modules declare."""
        own = self.library.on_page(module)
        expressions = Expressions(module.graph, self.library.link)
        rows = []
        for s, p, o in module.graph:
            if isinstance(s, URIRef) and str(s) not in own and str(s) != module.iri:
                if not (p == RDF.type and o in KINDS):
                    phrase = self.library.link(str(p), words=_PHRASES.get(URIRef(str(p)), ""))
                    shown = self.facts.value(URIRef(str(p)), o, module, module)
                    rows.append((self.library.link(str(s)), phrase, shown))
            elif isinstance(s, BNode) and p == RDFS.subClassOf:
                rows.append((expressions.show(s), text("kind of"), expressions.show(o)))
        if not rows:
            return None
        cells = [tag("tr", [tag("td", cell) for cell in row]) for row in sorted(rows)]
        return [
            tag("h2", "What it says about terms of other modules"),
            tag("div", tag("table", tag("tbody", cells)), class_="wide"),
        ]


_PHRASES = {
    RDFS.subClassOf: "kind of",
    RDFS.subPropertyOf: "kind of",
    OWL.equivalentClass: "same as",
    OWL.equivalentProperty: "same as",
    OWL.disjointWith: "disjoint with",
    OWL.inverseOf: "inverse of",
    RDF.type: "is",
    RDFS.seeAlso: "see also",
}


def _values(heading: str, shown: list[Markup]) -> Content:
    """Values in a line where they are short, else one a paragraph."""
    if all(len(one) < 200 for one in shown) and heading not in ("comment", "same as"):
        return join(", ", shown)
    return [tag("p", one) for one in shown]


def _external_or_text(iri: str) -> Markup:
    return external(iri, "CC BY 4.0" if "creativecommons.org/licenses/by/4.0" in iri else iri)
