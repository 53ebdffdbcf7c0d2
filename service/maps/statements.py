"""What the store says of a map, as N-Quads; and what a change of the map changes in it.

The model and the graphs are those of N-Quads files (engine/writers/rdf.py), with IRIs in the place
of blank nodes, and one graph more, ``overrides``.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from datetime import datetime

from symboslam.engine.live import Change, LiveMap
from symboslam.engine.table import Landmark
from symboslam.engine.writers.content import Content
from symboslam.engine.writers.options import WriteOptions
from symboslam.engine.writers.rdf_lineage import provenance, terms
from symboslam.engine.writers.rdf_records import Record, Records
from symboslam.engine.writers.rdf_syntax import Properties, Skolemised
from symboslam.engine.writers.vocabulary import PROV, RDF, RDFS, XSD
from symboslam.reasoning.vocabulary import SL
from symboslam.service.maps.records import Override

GRAPHS = ("landmarks", "segments", "terms", "overrides", "provenance")
"""Named graphs below a map's base, in the order in which a new map is written."""
Lines = frozenset[str]
NONE: Lines = frozenset()
_MOST_LANDMARKS = 5000
"""Landmarks whose statements are remembered, because what was seen just now is seen again."""


class Statements:
    """The statements about one map.

    Args:
        live: the map.
        base: IRI below which its own IRIs and graphs lie, ending in ``/``.
        reasons: how many reasons of a segment are stated, the strongest first.
        title: what people call the map.
    """

    def __init__(self, live: LiveMap, base: str, reasons: int, title: str = "") -> None:
        self._live, self.base, self._options = live, base, WriteOptions(reasons)
        self._title = title
        self._syntax = Skolemised(base, {})
        self._landmarks: dict[str, Lines] = {}
        self._segments: dict[str, Lines] = {}
        self._terms = self._provenance = NONE
        self._mentioned: dict[str, str] = {}
        self._features: set[int] = set()
        self._agents: set[str] = set()
        self._overrides: dict[str, list[Override]] = {}

    def everything(self, ended: datetime, overrides: Iterable[Override]) -> dict[str, str]:
        """All statements as N-Triples by the name of their graph, whatever was stated before."""
        self._landmarks, self._segments, self._overrides = {}, {}, {}
        self._terms = self._provenance = NONE
        for override in overrides:
            self._overrides.setdefault(override.segment, []).append(override)
        rows = self._live.table.rows().tolist()
        landmarks = [self._live.table[row] for row in rows]
        self._features = {each.feature for each in landmarks}
        self._agents = {each.agent for each in landmarks if each.agent}
        whole = self._live.environment_map()
        content = Content(whole, self._options.reasons)
        records = Records(content, self._syntax)
        found = {"landmarks": self._text(records.landmarks(), "landmarks")}
        self._segments.update(self._by_segment(records))
        found["segments"] = "".join(line for lines in self._segments.values() for line in lines)
        self._mentioned = content.mentioned
        self._terms = self._lines(terms(records), "terms")
        self._lineage(records, ended)
        found["terms"], found["provenance"] = "".join(self._terms), "".join(self._provenance)
        found["overrides"] = "".join(self._about_overrides())
        return {
            name: text.replace(f" {self._graph(name)} .\n", " .\n") for name, text in found.items()
        }

    def change(self, change: Change, ended: datetime) -> tuple[str, str]:
        """The statements that a change takes back, and those that it adds."""
        after = [each for _, each in change.landmarks.values() if each is not None]
        removed, added = self._of_landmarks(change)
        self._agents.update(each.agent for each in after if each.agent)
        told = change.changed or self._live.described(after)
        content = Content(told, self._options.reasons)
        records = Records(content, self._syntax)
        for name in change.gone:
            removed |= self._segments.pop(name)
            added |= self._snapshots(name)
        for name, lines in self._by_segment(records).items():
            removed |= self._segments.get(name) or self._snapshots(name)
            added |= lines
            self._segments[name] = lines
        added |= self._new_terms(content, after)
        removed |= self._provenance
        added |= self._lineage(records, ended)
        return "".join(removed - added), "".join(added - removed)

    def _new_terms(self, content: Content, landmarks: Sequence[Landmark]) -> Lines:
        """What is to be said of features that occur for the first time."""
        features = {each.feature for each in landmarks}
        if features <= self._features and content.mentioned.keys() <= self._mentioned.keys():
            return NONE
        self._features |= features
        content.mentioned.update(self._mentioned)
        self._mentioned = content.mentioned
        new = self._lines(terms(Records(content, self._syntax)), "terms") - self._terms
        self._terms |= new
        return new

    def override(self, overrides: Sequence[Override], ended: datetime) -> tuple[str, str]:
        """What operators say now, or take back: statements to take back and to add."""
        removed, added = set(self._provenance), set[str]()
        for override in overrides:
            known = self._overrides.setdefault(override.segment, [])
            removed.update(line for e in known if e.id == override.id for line in self._of(e))
            known[:] = [each for each in known if each.id != override.id] + [override]
            added.update(self._of(override))
        records = Records(Content(self._live.described([])), self._syntax)
        added |= self._lineage(records, ended)
        return "".join(removed - added), "".join(added - removed)

    def of_segment(self, name: str) -> str:
        """What is stated of a segment now, to be kept with an override of it."""
        return "".join(sorted(self._segments.get(name, NONE)))

    def _lineage(self, records: Records, ended: datetime) -> Lines:
        """Where the statements come from, as of now."""
        seen = len(self._live.table), sorted(self._agents)
        told = provenance(records, ended, seen, self._title)
        self._provenance = self._lines(told, "provenance")
        return self._provenance

    def _of_landmarks(self, change: Change) -> tuple[set[str], set[str]]:
        """What was stated of the landmarks that changed, and what is to be stated."""
        known = self._landmarks
        unknown = [
            before
            for name, (before, _) in change.landmarks.items()
            if before is not None and name not in known
        ]
        known.update(self._by_landmark(unknown))
        removed = {line for name in change.landmarks for line in known.pop(name, NONE)}
        new = self._by_landmark([each for _, each in change.landmarks.values() if each is not None])
        known.update(new)  # at the end: what was changed last is forgotten last
        while len(known) > _MOST_LANDMARKS:
            del known[next(iter(known))]
        return removed, {line for lines in new.values() for line in lines}

    def _by_landmark(self, landmarks: Sequence[Landmark]) -> dict[str, Lines]:
        """Landmark -> its statements and those about its observation."""
        if not landmarks:
            return {}
        records = Records(Content(self._live.described(landmarks)), self._syntax)
        graph = self._graph("landmarks")
        told = [self._syntax.lines(graph, s, p) for s, p in records.landmarks()]
        return {
            each.id: frozenset(told[2 * i] + told[2 * i + 1]) for i, each in enumerate(landmarks)
        }

    def _by_segment(self, records: Records) -> dict[str, Lines]:
        """Segment -> its statements and those about its classification."""
        found: dict[str, list[str]] = {}
        graph, name = self._graph("segments"), ""
        segment = self._syntax.own("segment")[:-1] + "/"
        for subject, properties in records.segments(self._options):
            if subject.startswith(segment):
                name = subject[len(segment) : -1]
            found.setdefault(name, []).extend(self._syntax.lines(graph, subject, properties))
        return {name: frozenset(lines) for name, lines in found.items()}

    def _about_overrides(self) -> Iterator[str]:
        for segment, overrides in self._overrides.items():
            for override in overrides:
                yield from self._of(override)
            if segment not in self._segments:
                yield from self._snapshots(segment)

    def _snapshots(self, segment: str) -> Lines:
        """What was stated of an overridden segment, to be stated as long as it is gone."""
        found = self._overrides.get(segment, [])
        own, other = self._graph("segments"), self._graph("overrides")
        lines = _lines_of(found[-1].snapshot) if found else []
        return frozenset(line.replace(f" {own} .\n", f" {other} .\n") for line in lines)

    def _of(self, override: Override) -> list[str]:
        s = self._syntax
        operator = s.own("operator", override.operator)
        stated: Properties = [
            (s.iri(RDF + "type"), [s.iri(SL + "Override"), s.iri(PROV + "Entity")]),
            (s.iri(SL + "madeBy"), [operator]),
            (s.iri(PROV + "wasAttributedTo"), [operator]),
            (s.iri(SL + "overriddenSegment"), [s.own("segment", override.segment)]),
            (s.iri(PROV + "generatedAtTime"), [s.typed(override.made, XSD + "dateTime")]),
        ]
        if override.environment:
            stated.append((s.iri(SL + "environmentGiven"), [s.iri(override.environment)]))
        if f"{s.own('classification', override.segment)} " in override.snapshot:
            replaced = s.own("classification", override.segment)
            stated.append((s.iri(SL + "replaces"), [replaced]))
        if override.reason:
            stated.append((s.iri(SL + "overrideReason"), [s.text(override.reason)]))
        if override.undone:
            when = s.typed(override.undone, XSD + "dateTime")
            stated.append((s.iri(PROV + "invalidatedAtTime"), [when]))
        who: Properties = [
            (s.iri(RDF + "type"), [s.iri(SL + "Operator"), s.iri(PROV + "Agent")]),
            (s.iri(RDFS + "label"), [s.text(override.operator)]),
        ]
        records = [(s.own("override", override.id), stated), (operator, who)]
        return _lines_of(self._text(records, "overrides"))

    def _graph(self, name: str) -> str:
        return self._syntax.own(name)

    def _text(self, records: Iterable[Record], graph: str) -> str:
        name = self._graph(graph)
        return "".join(self._syntax.statements(name, s, p) for s, p in records)

    def _lines(self, records: Iterable[Record], graph: str) -> Lines:
        return frozenset(_lines_of(self._text(records, graph)))


def _lines_of(text: str) -> list[str]:
    """The lines of N-Quads: others take more than a line feed for the end of a line."""
    return [line + "\n" for line in text.split("\n")[:-1]]
