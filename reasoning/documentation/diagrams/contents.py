"""What a module's diagram shows: its class tree, its properties, what it ties to other modules."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from rdflib import OWL, RDFS, SKOS, XSD, BNode, URIRef
from rdflib.term import Node

from symboslam.reasoning import vocabulary as v
from symboslam.reasoning.documentation.diagrams.drawing import Box, Canvas, stacked, width_of
from symboslam.reasoning.documentation.diagrams.overview import draw_layers
from symboslam.reasoning.documentation.diagrams.relations import Relation, draw_relations
from symboslam.reasoning.documentation.diagrams.tree import Forest, draw_forest, draw_grid
from symboslam.reasoning.documentation.evidence import Evidence
from symboslam.reasoning.documentation.expressions import Expressions
from symboslam.reasoning.documentation.library import Library, Term, named
from symboslam.reasoning.documentation.markup import is_link, safe_colour, text
from symboslam.reasoning.documentation.modules import Module

_MOST_RELATIONS, _MOST_LOOSE = 120, 60
_FEW = 8
_PROPERTIES = ("object property", "datatype property", "annotation property")
_FOLDERS = {"upstream": "up", "alignments": "box"}
_DATATYPES = (str(XSD), str(RDFS.Literal))
_TIES = {
    OWL.equivalentClass: "same as",
    OWL.equivalentProperty: "same as",
    OWL.sameAs: "same as",
    SKOS.exactMatch: "exact match",
    SKOS.closeMatch: "close match",
    SKOS.broadMatch: "broad match",
    SKOS.narrowMatch: "narrow match",
    SKOS.relatedMatch: "related match",
    OWL.inverseOf: "inverse of",
}


def draw_overview(library: Library) -> Canvas:
    """Which module imports which."""
    whole = whole_module(library)
    shown = [m for m in library.modules if m != whole]
    boxes = {
        m.page: Box(m.name, f"{m.page}.html", _FOLDERS.get(m.group, "inner"), m.title)
        for m in shown
    }
    needs = {
        m.page: [library.documents[i].page for i in m.imports if i in library.documents]
        for m in shown
    }
    return draw_layers(boxes, needs)


def whole_module(library: Library) -> Module | None:
    """The module that imports all others, directly or not, where a picture is clearer without."""
    for module in reversed(library.modules):
        if module.is_own and len(library.reach(module)) == len(library.modules) > _FEW:
            return module
    return None


class ModuleDiagram:
    """The diagram of one module.

    Args:
        library: all modules.
        evidence: which feature indicates which environment; None where nothing is indicated.
        module: the module to draw.
    """

    def __init__(self, library: Library, evidence: Evidence | None, module: Module) -> None:
        self.library, self.evidence, self.module = library, evidence, module
        self.graph = module.graph
        self.own = library.on_page(module)

    def draw(self) -> Canvas:
        """Class tree, relations, and what remains, one below the other."""
        return stacked(
            [
                (
                    "Classes: a kind stands to the right of what it is a kind of",
                    self._tree(("class",), RDFS.subClassOf),
                ),
                ("", self._legend()),
                ("Properties and ties: from whom, by what, to whom", self._chart()),
                (
                    "Properties that are kinds of others",
                    self._tree(_PROPERTIES, RDFS.subPropertyOf),
                ),
                ("Further terms", self._loose()),
            ]
        )

    def _box(self, iri: str, style: str = "") -> Box:
        term = self.own.get(iri)
        href = self.library.href(iri, self.module) or (iri if is_link(iri) else None)
        style = style or ("box" if term else "outside")
        known = self.library.terms.get(iri)
        return Box(self.library.label(iri), href, style, known.definition if known else iri,
                   self._dots(iri))  # fmt: skip

    def _dots(self, iri: str) -> tuple[tuple[str, str], ...]:
        """A mark in the colour of each environment that a feature indicates, or that it is."""
        if self.evidence is None:
            return ()
        found = [
            (safe_colour(e.colour), e.label) for e in self.evidence.environments if e.iri == iri
        ]
        if iri in self.own:
            for e, row in self.evidence.of_feature.get(iri, ()):
                found.append((safe_colour(e.colour), f"{e.label}: weight {row.weight:.2f}"))
        return tuple(found)

    def _tree(self, kinds: tuple[str, ...], predicate: URIRef) -> Canvas:
        """What is a kind of what: a tree of classes or of properties."""
        above: dict[str, list[str]] = {t.iri: [] for t in self.own.values() if t.kind in kinds}
        for s, o in self.graph.subject_objects(predicate):
            if isinstance(s, URIRef):
                uppers = [iri for iri in named(self.graph, o) if iri != str(s)]
                above.setdefault(str(s), []).extend(uppers)
        if predicate == RDFS.subPropertyOf:  # those without kinds are in the chart
            uppers = [iri for found in above.values() for iri in found]
            above = {iri: found for iri, found in above.items() if found or iri in uppers}
        for iri in [iri for iri in above if iri not in self.own and not above[iri]]:
            del above[iri]
        by_label = sorted(above, key=lambda iri: (self.library.label(iri).casefold(), iri))
        upper: dict[str, str] = {}
        for iri in by_label:
            choice = sorted(above[iri], key=lambda up: (up not in above, self.library.label(up)))
            free = (up for up in choice if not _is_below(up, iri, upper))
            if (chosen := next(free, None)) is not None:
                upper[iri] = chosen
        outside = sorted({up for up in upper.values() if up not in above}, key=self.library.label)
        below: dict[str, list[str]] = {}
        for iri in by_label:
            if iri in upper:
                below.setdefault(upper[iri], []).append(iri)
        boxes = {iri: self._box(iri) for iri in [*outside, *by_label]}
        for iri in by_label:
            if others := sorted(set(above[iri]) - {upper.get(iri)}):
                names = ", ".join(self.library.label(o) for o in others)
                title = f"{boxes[iri].title} Also a kind of {names}."
                boxes[iri] = replace(boxes[iri], note=f"+ {names}", title=title)
        for iri in below:
            if boxes[iri].style == "box":
                boxes[iri] = replace(boxes[iri], style="inner")
        if not boxes:
            return Canvas()
        return draw_forest(Forest(boxes, below))

    def _legend(self) -> Canvas:
        """Which colour is which environment, if the tree has marks."""
        canvas = Canvas()
        if self.evidence is None or not any(
            iri in self.evidence.of_feature for iri in self.own
        ):  # fmt: skip
            return canvas
        x = 0.0
        for e in self.evidence.environments:
            canvas.mark(x, 12, safe_colour(e.colour), e.label)
            x += width_of(e.label) + 30
        return canvas

    def _chart(self) -> Canvas:
        boxes: dict[str, Box] = {}
        relations = list(self._properties(boxes))
        told = {(r.via.href, r.left, right) for r in relations for right in (r.right, ())}
        relations += [
            r for r in self._restrictions(boxes) if (r.via.href, r.left, r.right) not in told
        ]
        relations += self._ties(boxes)
        chart = draw_relations(boxes, relations, _MOST_RELATIONS)
        if (more := len(relations) - _MOST_RELATIONS) > 0:
            chart.words(f"and {more} more, listed below", 0, chart.height + 20)
        return chart

    def _properties(self, boxes: dict[str, Box]) -> Iterable[Relation]:
        for term in self.own.values():
            if term.kind in ("object property", "datatype property"):
                left = self._ends(term, RDFS.domain, boxes)
                right = self._ends(term, RDFS.range, boxes)
                if left or right:
                    yield self._relation(self._box(term.iri), left, right)

    def _relation(self, via: Box, left: tuple[str, ...], right: tuple[str, ...]) -> Relation:
        """A relation; datatypes stand beside the property, so that no line leads to them."""
        types = [key for key in right if key.startswith(_DATATYPES)]
        note = ", ".join(self.library.short(key).removeprefix("xsd:") for key in types)
        return Relation(replace(via, note=note), left, tuple(k for k in right if k not in types))

    def _ends(self, term: Term, predicate: URIRef, boxes: dict[str, Box]) -> tuple[str, ...]:
        found = []
        for node in sorted(self.graph.objects(URIRef(term.iri), predicate), key=str):
            found += self._classes(node, boxes)
        return tuple(dict.fromkeys(found))

    def _classes(self, node: Node, boxes: dict[str, Box]) -> list[str]:
        """Keys of boxes for a class, for each of a union, or for an expression in words."""
        if isinstance(node, URIRef):
            boxes.setdefault(str(node), replace(self._box(str(node)), dots=()))
            return [str(node)]
        words = Expressions(self.graph, lambda iri: text(self.library.label(iri)))
        if (listed := self.graph.value(node, OWL.unionOf)) is not None:
            return [key for m in words.members(listed) for key in self._classes(m, boxes)]
        shown = _plain(words.show(node))
        boxes.setdefault(shown, Box(shown, None, "outside", shown))
        return [shown]

    def _restrictions(self, boxes: dict[str, Box]) -> Iterable[Relation]:
        """Classes whose members have something of another class; indications are left out.

        All that a class has by one property is one relation. "Only" is left out where it closes
        what "some" has opened.
        """
        some: dict[tuple[str, str], set[str]] = {}
        only: dict[tuple[str, str], set[str]] = {}
        links = ((OWL.someValuesFrom, some), (OWL.onClass, some), (OWL.allValuesFrom, only))
        for s, node in self.graph.subject_objects(RDFS.subClassOf):
            on = self.graph.value(node, OWL.onProperty) if isinstance(node, BNode) else None
            if not isinstance(s, URIRef) or not isinstance(on, URIRef) or str(on) == v.INDICATES:
                continue
            for predicate, found in links:
                if (filler := self.graph.value(node, predicate)) is not None:
                    fillers = self._classes(filler, boxes)
                    found.setdefault((str(s), str(on)), set()).update(fillers)
        for word, found in (("", some), ("only", only)):
            for (iri, on_iri), keys in sorted(found.items()):
                if word and keys <= some.get((iri, on_iri), set()):
                    continue
                via = self._box(on_iri)
                via = replace(via, words=f"{via.words} {word}".strip())
                left = tuple(self._classes(URIRef(iri), boxes))
                yield self._relation(via, left, tuple(sorted(keys)))

    def _ties(self, boxes: dict[str, Box]) -> Iterable[Relation]:
        """What is said to be the same as, or like, a term of another module."""
        for predicate, words in _TIES.items():
            for s, o in self.graph.subject_objects(predicate):
                if isinstance(s, URIRef) and isinstance(o, URIRef):
                    if str(s) in self.own and str(o) in self.own and predicate == OWL.inverseOf:
                        continue
                    left, right = self._classes(s, boxes), self._classes(o, boxes)
                    yield Relation(Box(words, None, "outside"), tuple(left), tuple(right))

    def _loose(self) -> Canvas:
        """Properties without domain and range, annotations and individuals."""
        terms = [
            term
            for term in self.own.values()
            if term.kind in ("annotation property", "individual", "datatype")
            or ("property" in term.kind and not self._is_placed(term))
        ]
        boxes = {term.iri: replace(self._box(term.iri), dots=()) for term in terms[:_MOST_LOOSE]}
        if len(terms) > _MOST_LOOSE:
            boxes["more"] = Box(f"and {len(terms) - _MOST_LOOSE} more", None, "outside")
        return draw_grid(list(boxes.values()))

    def _is_placed(self, term: Term) -> bool:
        predicates = (RDFS.domain, RDFS.range, RDFS.subPropertyOf, *_TIES)
        iri = URIRef(term.iri)
        return (None, RDFS.subPropertyOf, iri) in self.graph or any(
            (iri, p, None) in self.graph for p in predicates
        )


def _is_below(upper: str, key: str, chosen: dict[str, str]) -> bool:
    """Whether a key would hang below itself."""
    seen = set()
    while upper not in seen:
        if upper == key:
            return True
        seen.add(upper)
        if upper not in chosen:
            return False
        upper = chosen[upper]
    return True


def _plain(markup: str) -> str:
    """The words of markup, for a box."""
    import re
    from html import unescape

    return unescape(re.sub(r"<[^>]*>", "", markup))
