"""Landmarks, their observations and the maps that they are in, as RDF records."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np

from symboslam import __version__
from symboslam.engine.slam.planar import wrap
from symboslam.engine.slam.writers.output import Output
from symboslam.engine.slam.writers.robot_graph import RobotGraph
from symboslam.engine.slam.writers.turtle_poses import (
    a,
    covariance_matrix,
    pose_name,
    translation,
)
from symboslam.engine.slam.writers.vocabulary import OS
from symboslam.engine.writers.rdf_records import Record, digits
from symboslam.engine.writers.rdf_syntax import Properties, Syntax
from symboslam.engine.writers.vocabulary import (
    DCTERMS,
    GEO,
    LOCAL_METRES,
    OWL,
    PROV,
    RDFS,
    SOFTWARE,
    SOSA,
)
from symboslam.reasoning.vocabulary import SL


class LandmarkRecords:
    """The landmarks of a map.

    The map of one robot is a sl:AgentMap. Of several robots each has its own, with what it saw,
    and a sl:CollectiveMap is merged from them.

    Args:
        output: the map.
        syntax: how terms are written.
        graphs: the robots that were placed.
    """

    def __init__(self, output: Output, syntax: Syntax, graphs: list[RobotGraph]) -> None:
        self.output, self.syntax, self.graphs = output, syntax, graphs
        self.marks = output.slam_map.landmarks
        self.kinds = [self._class(name) for name in output.mission.classes]
        self.whole = syntax.own("map")

    def _class(self, name: str) -> str:
        """The ontology's term, or one of the map's own for what the ontology does not know."""
        knowledge = self.output.knowledge
        found = None if knowledge is None else knowledge.index_of(name)
        if knowledge is None or found is None:
            return self.syntax.own("class", name)
        return self.syntax.iri(knowledge.features[found].iri)

    def _map_of(self, graph: RobotGraph) -> str:
        """The map that a robot's observations belong to first."""
        return self.whole if len(self.graphs) == 1 else self.syntax.own("map-of", graph.log.name)

    def maps(self) -> Iterator[Record]:
        """The map, the maps of the robots, and the robots."""
        s, count = self.syntax, self.syntax.iri(SL + "landmarkCount")
        said = [*self.output.slam_map.doubts, *self.output.slam_map.notes]
        about: Properties = [(count, [s.integer(len(self.marks))])]
        if said:
            about.append((s.iri(RDFS + "comment"), [s.text(text, "en") for text in said]))
        if len(self.graphs) > 1:
            maps: list[str | Properties] = [self._map_of(graph) for graph in self.graphs]
            yield (
                self.whole,
                [
                    a(s, SL + "CollectiveMap"),
                    *about,
                    (s.iri(SL + "mergedFrom"), maps),
                    (s.iri(PROV + "wasGeneratedBy"), [s.own("merging")]),
                ],
            )
            software = s.iri(f"{SOFTWARE}{__version__}")
            yield (
                s.own("merging"),
                [
                    a(s, SL + "MapMerging"),
                    (s.iri(PROV + "used"), maps),
                    (s.iri(PROV + "wasAssociatedWith"), [software]),
                ],
            )
            yield (
                software,
                [
                    a(s, PROV + "SoftwareAgent"),
                    (s.iri(RDFS + "label"), [s.text("SymboSLAM", "en")]),
                    (s.iri(OWL + "versionInfo"), [s.text(__version__)]),
                ],
            )
        elif not self.graphs:
            yield self.whole, [a(s, SL + "LandmarkSet"), *about]
        for graph in self.graphs:
            agent, own = s.own("agent", graph.log.name), len(np.unique(graph.landmark))
            yield (
                self._map_of(graph),
                [
                    a(s, SL + "AgentMap"),
                    *(about if len(self.graphs) == 1 else [(count, [s.integer(own)])]),
                    (s.iri(PROV + "wasAttributedTo"), [agent]),
                    (s.iri(SL + "builtFrom"), [s.own("graph", graph.log.name)]),
                ],
            )
            yield (
                agent,
                [
                    a(s, SL + "EdgeAgent"),
                    (s.iri(RDFS + "label"), [s.text(graph.log.name)]),
                ],
            )

    def classes(self) -> Iterator[Record]:
        """The classes that occur, as features."""
        s, mission = self.syntax, self.output.mission
        used = set(self.marks.feature.tolist())
        for graph in self.graphs:
            used |= {i for i in graph.log.seen.feature[graph.seen].tolist() if i >= 0}
        told = set()
        for i in sorted(used):
            if self.kinds[i] in told:
                continue
            told.add(self.kinds[i])
            above = [SL + "Feature", *([SL + "DynamicFeature"] if mission.dynamic[i] else [])]
            yield (
                self.kinds[i],
                [
                    a(s, OWL + "Class"),
                    (s.iri(RDFS + "subClassOf"), [s.iri(c) for c in above]),
                    (s.iri(RDFS + "label"), [s.text(mission.classes[i], "en")]),
                ],
            )

    def landmarks(self) -> Iterator[Record]:
        """Each landmark with its position; one that nobody saw so has an observation of the map."""
        s, marks = self.syntax, self.marks
        seen_as = {
            (int(landmark), int(kind))
            for graph in self.graphs
            for landmark, kind in zip(
                graph.landmark, graph.log.seen.feature[graph.seen], strict=True
            )
        }
        for i, name in enumerate(marks.id.tolist()):
            kind, (x, y) = int(marks.feature[i]), marks.xy[i].tolist()
            literal = s.typed(
                f"<{LOCAL_METRES}> POINT ({digits(x)} {digits(y)})", GEO + "wktLiteral"
            )
            node: Properties = [a(s, GEO + "Geometry"), (s.iri(GEO + "asWKT"), [literal])]
            landmark = s.own("landmark", str(name))
            yield (
                landmark,
                [
                    a(s, SL + "Landmark", GEO + "Feature"),
                    (s.iri(DCTERMS + "identifier"), [s.text(str(name))]),
                    (s.iri(SL + "featureClass"), [self.kinds[kind]]),
                    (s.iri(GEO + "hasGeometry"), [node]),
                    (s.iri(OS + "hasPosition"), [s.own("position", str(name))]),
                ],
            )
            yield from self._position(i)
            if (i, kind) not in seen_as:
                confidence = float(marks.confidence[i])
                found = self._observation(landmark, kind, confidence, [self.whole])
                yield s.own("observation", f"of-{name}"), found

    def _position(self, i: int) -> Iterator[Record]:
        s, marks, name = self.syntax, self.marks, str(self.marks.id[i])
        x, y = marks.xy[i].tolist()
        position: Properties = [a(s, SL + "LandmarkPosition"), translation(s, x, y)]
        matrix = marks.covariance[i]
        elements: list[Record] = []
        if np.isfinite(matrix).all():
            sigma = float(np.sqrt(np.trace(matrix) / 2))
            position.append((s.iri(SL + "standardDeviation"), [s.decimal(digits(sigma))]))
            link, elements = covariance_matrix(s, f"landmark-{name}", matrix)
            position.append(link)
        yield s.own("position", name), position
        yield from elements

    def _observation(
        self,
        landmark: str,
        kind: int,
        confidence: float,
        maps: list[str],
        *result: tuple[str, float],
    ) -> Properties:
        """An observation of a class.

        Args:
            landmark: what was observed.
            kind: position of the class.
            confidence: of it.
            maps: what it is part of.
            result: further numbers of the detection: property and value.
        """
        s = self.syntax
        detection: Properties = [
            a(s, SL + "Detection"),
            (s.iri(SL + "featureClass"), [self.kinds[kind]]),
            (s.iri(SL + "confidence"), [s.decimal(digits(confidence))]),
            *self._numbers(result),
        ]
        return [
            a(s, SL + "LandmarkObservation", SOSA + "Observation"),
            (s.iri(DCTERMS + "isPartOf"), [*maps]),
            (s.iri(SOSA + "hasFeatureOfInterest"), [landmark]),
            (s.iri(SOSA + "observedProperty"), [s.iri(SL + "featureClass")]),
            (s.iri(SOSA + "hasResult"), [detection]),
        ]

    def _numbers(self, values: Iterable[tuple[str, float]]) -> Properties:
        """Properties of ours with their numbers."""
        s = self.syntax
        return [(s.iri(SL + name), [s.decimal(digits(value))]) for name, value in values]

    def seen_by(self, graph: RobotGraph) -> Iterator[Record]:
        """A robot's observations, and the edges of its pose graph that rest on them."""
        s, log = self.syntax, graph.log
        maps = list(dict.fromkeys([self._map_of(graph), self.whole]))
        agent = s.own("agent", log.name)
        rows = zip(graph.seen, graph.landmark, graph.seen_from, strict=True)
        for row, mark, vertex in rows:
            name, identifier = f"{log.name}-{row}", str(self.marks.id[mark])
            pose = s.own("pose", pose_name(graph, int(vertex)))
            both = (
                ("range", float(log.seen.range[row])),
                (
                    "bearing",
                    float(wrap(log.seen.bearing[row])),
                ),
            )
            numbers = [(what, value) for what, value in both if np.isfinite(value)]
            kind, sure = int(log.seen.feature[row]), float(log.seen.confidence[row])
            kind = kind if kind >= 0 else int(self.marks.feature[mark])
            landmark = s.own("landmark", identifier)
            yield (
                s.own("observation", name),
                [
                    *self._observation(landmark, kind, sure, maps, *numbers),
                    (s.iri(PROV + "wasAssociatedWith"), [agent]),
                    (s.iri(SL + "observedFrom"), [pose]),
                ],
            )
            yield (
                s.own("edge", f"{log.name}-seen-{row}"),
                [
                    a(s, SL + "LandmarkMeasurement"),
                    (s.iri(SL + "constraintFrom"), [pose]),
                    (s.iri(SL + "constraintTo"), [s.own("position", identifier)]),
                    (s.iri(SL + "measuredBy"), [s.own("observation", name)]),
                    *self._numbers(numbers),
                ],
            )
