"""The first page, and the list of all terms."""

from __future__ import annotations

from collections import Counter

from rdflib import DCTERMS, OWL

from symboslam.reasoning.documentation.diagrams.contents import whole_module
from symboslam.reasoning.documentation.evidence import Evidence
from symboslam.reasoning.documentation.frame import figure
from symboslam.reasoning.documentation.library import Library
from symboslam.reasoning.documentation.markup import Content, Markup, external, safe_colour, tag
from symboslam.reasoning.documentation.modules import Module

_GROUPS = {"": "Modules", "upstream": "Upstream modules", "alignments": "Alignments"}
_READ = (
    "A feature is a thing that can be seen and located, such as a house. It is never a kind of "
    "place: it indicates one, with a strength between 0 and 1, a source and a reason. A reasoner "
    "follows these indications through smaller places, such as a sports field, to the types of "
    "environment that a map is divided into."
)


def root_module(library: Library) -> Module:
    """The module that stands for the whole: one that none imports and that reaches the most."""
    imported = {
        library.documents[iri].page
        for module in library.modules
        for iri in module.imports
        if iri in library.documents
    }
    tops = [m for m in library.modules if m.page not in imported and m.is_own]
    return max(
        tops or library.modules, key=lambda m: (m.group == "", len(library.reach(m)), m.name)
    )


def index_content(
    library: Library,
    evidence: Evidence | None,
    environment_pages: dict[str, str],
    overview: Markup,
    questions: str | None,
) -> list[Content]:
    """What stands below the first page's heading.

    Args:
        library: all modules.
        evidence: what indicates which environment; None where nothing is indicated.
        environment_pages: IRI of an environment type -> its page.
        overview: the diagram of imports.
        questions: the page of the report on competency questions, if there is one.
    """
    root = root_module(library)
    kinds = Counter(term.kind for term in library.terms.values())
    facts: list[tuple[int, str]] = [
        (len(library.modules), "modules"),
        (kinds["class"], "classes"),
        (kinds["object property"] + kinds["datatype property"], "properties"),
    ]
    if evidence is not None:
        facts += [
            (len(evidence.environments), "environment types"),
            (len(evidence.knowledge.features), "features"),
            (len(evidence.stated.indications), "indications"),
        ]
    parts: list[Content] = [tag("p", root.description, class_="lead")]
    if evidence is not None:
        parts.append(tag("p", _READ))
    parts.append(tag("ul", [tag("li", tag("b", n), words) for n, words in facts], class_="facts"))
    parts.append(_about(root, questions))
    if evidence is not None:
        parts += [tag("h2", "Environment types"), _environments(evidence, environment_pages)]
    hint = "A line leads from a module to those on its right that import it."
    if any(m.group in _GROUPS and m.group for m in library.modules):
        hint += " Blue: our modules; brown: terms of upstream ontologies; grey: alignments."
    if (whole := whole_module(library)) is not None:
        hint += f" {whole.title} imports all of them and is left out."
    parts += [
        tag("h2", "How the modules import each other"),
        tag("p", hint, class_="note"),
        figure(overview, "overview.svg"),
    ]
    parts.append(_modules(library))
    return parts


def _about(root: Module, questions: str | None) -> Markup:
    licences = [external(str(o)) for o in root.headers(DCTERMS.license)]
    rows: list[tuple[str, Content]] = [
        ("document", external(root.iri) if root.iri else None),
        ("version", root.header(OWL.versionInfo)),
        ("licence", licences or None),
        ("creators", ", ".join(str(o) for o in root.headers(DCTERMS.creator))),
        ("all terms", tag("a", "A to Z", href="terms.html")),
        ("competency questions",
         tag("a", "what it is asked, and whether it answers", href=questions)
         if questions else None),
    ]  # fmt: skip
    shown = [[tag("dt", name), tag("dd", value)] for name, value in rows if value]
    return tag("section", tag("dl", shown), class_="term")


def _environments(evidence: Evidence, pages: dict[str, str]) -> Markup:
    cards = []
    for environment in evidence.environments:
        count = len(evidence.rows[environment.name])
        more = f"{count} features"
        if environment.zones:
            more += " · zones " + ", ".join(zone.name for zone in environment.zones)
        cards.append(
            tag(
                "li",
                tag(
                    "a",
                    tag("b", environment.label),
                    tag("small", environment.definition),
                    tag("small", more, class_="note"),
                    href=pages[environment.iri],
                    class_="card",
                    style=f"--own:{safe_colour(environment.colour)}",
                ),
            )
        )
    return tag("ul", cards, class_="cards")


def _modules(library: Library) -> Content:
    parts: list[Content] = []
    groups = sorted({m.group for m in library.modules}, key=lambda g: (*_GROUPS, g).index(g))
    for group in groups:
        cards = []
        for module in library.modules:
            if module.group != group:
                continue
            kinds = Counter(term.kind.rpartition(" ")[2] for term in library.declared[module])
            count = ", ".join(
                f"{kinds[kind]} {many if kinds[kind] != 1 else kind}"
                for kind, many in (("class", "classes"), ("property", "properties"),
                                   ("individual", "individuals"))
                if kinds[kind]
            )  # fmt: skip
            cards.append(
                tag(
                    "li",
                    tag(
                        "a",
                        tag("b", module.title),
                        tag("small", module.description),
                        tag("small", f"{module.name} · {count or 'ties only'}", class_="note"),
                        href=f"{module.page}.html",
                        class_="card",
                    ),
                )
            )
        title = _GROUPS.get(group, f"Modules in {group}/")
        parts += [tag("h2", title), tag("ul", cards, class_="cards")]
    return parts


def terms_content(library: Library) -> list[Content]:
    """What stands below the heading of the list of all terms."""
    terms = sorted(library.terms.values(), key=lambda t: (t.label.casefold(), t.iri))
    names = ("term", "kind", "module", "definition")
    head = tag("tr", [tag("th", tag("button", n, type="button")) for n in names])
    rows = [
        tag(
            "tr",
            tag("td", tag("a", term.label, href=term.href), tag("small", library.short(term.iri))),
            tag("td", term.kind, data_name="kind"),
            tag("td", tag("a", term.module.name, href=f"{term.module.page}.html"),
                data_name="module"),
            tag("td", term.definition),
            data_row=True,
        )
        for term in terms
    ]  # fmt: skip
    box = tag("input", type="search", data_filter="all-terms", placeholder="Filter …",
              aria_label="Filter terms")  # fmt: skip
    return [
        tag("p", f"{len(terms)} terms; the heads of the columns sort.", class_="note"),
        tag("p", box, " ", tag("small", id="all-terms-count"), class_="filter"),
        tag("table", tag("thead", head), tag("tbody", rows), class_="sortable stack",
            id="all-terms"),
    ]  # fmt: skip
