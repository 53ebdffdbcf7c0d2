"""Where a map comes from and what its words mean, as RDF records."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Iterator
from datetime import datetime
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from symboslam import __version__
from symboslam.engine.writers.content import ontology_name, source_name
from symboslam.engine.writers.rdf_records import Record, Records, digits
from symboslam.engine.writers.rdf_syntax import ABSOLUTE_IRI, Properties
from symboslam.engine.writers.vocabulary import (
    DCTERMS,
    GEO,
    OWL,
    PROV,
    RDFS,
    SKOS,
    SOFTWARE,
    XSD,
)
from symboslam.reasoning.vocabulary import SL


def provenance(
    records: Records,
    ended: datetime | None,
    landmarks: tuple[int, Iterable[str]] | None = None,
    title: str = "",
) -> Iterator[Record]:
    """The map, the run that made it, and what the run used.

    Args:
        records: the map.
        ended: when the run ended; None leaves it out.
        landmarks: how many there are, and who observed them, where ``records`` holds only some.
        title: what people call the map, if anything.
    """
    s, m, a = records.syntax, records.map, records.a
    area = shapely.to_wkt(
        shapely.box(*records.content.bbox), rounding_precision=records.content.decimals
    )
    named: Properties = [(s.iri(DCTERMS + "title"), [s.text(title)])] if title else []
    yield (
        s.own("map"),
        [
            a(SL + "EnvironmentMap", PROV + "Entity"),
            *named,
            (s.iri(PROV + "wasGeneratedBy"), [s.own("run")]),
            (s.iri(DCTERMS + "spatial"), [[a(GEO + "Feature"), records.geometry(area)]]),
            (s.iri(SL + "considers"), list(records.environments)),
            *_rights(records),
        ],
    )
    agent = s.iri(SOFTWARE + __version__)
    run: Properties = [
        a(SL + "ClassificationRun", PROV + "Activity"),
        (s.iri(PROV + "used"), [s.own("landmarks"), s.own("ontology")]),
        (s.iri(PROV + "wasAssociatedWith"), [agent]),
    ]
    if ended is not None:
        when = s.typed(ended.isoformat(), XSD + "dateTime")
        run.append((s.iri(PROV + "endedAtTime"), [when]))
    settings = [_setting(records, n, v) for n, v in sorted(m.config.items()) if v is not None]
    if settings:
        run.append((s.iri(SL + "hasSetting"), list(settings)))
    yield s.own("run"), run
    yield (
        agent,
        [
            a(PROV + "SoftwareAgent"),
            (s.iri(RDFS + "label"), [s.text("SymboSLAM", "en")]),
            (s.iri(OWL + "versionInfo"), [s.text(__version__)]),
        ],
    )
    yield (
        s.own("ontology"),
        [
            a(SL + "OntologySource", PROV + "Entity"),
            (s.iri(DCTERMS + "source"), [s.text(ontology_name(m))]),
            (s.iri(SL + "sha256"), [s.text(m.knowledge.source_hash)]),
        ],
    )
    count, agents = landmarks or (len(m.landmarks), _agents(m.landmarks.agent))
    yield s.own("landmarks"), _landmark_set(records, count)
    for name in agents:
        yield s.own("agent", name), [a(PROV + "Agent"), (s.iri(RDFS + "label"), [s.text(name)])]


def terms(records: Records) -> Iterator[Record]:
    """The environments and features that occur, so that the file explains itself."""
    s, content = records.syntax, records.content
    levels = content.levels()
    for name, e in content.environments().items():
        above = [g["iri"] for g in levels.values() if name in g.get("members", ())]
        found = _term(records, [SL + "Environment", *above], name, e["label"])
        if e["definition"]:
            found.append((s.iri(SKOS + "definition"), [s.text(e["definition"], "en")]))
        found.append((s.iri(SL + "colour"), [s.text(e["colour"])]))
        yield records.environment_named[name], found
    iris = {e.name: e.iri for e in records.map.environments}
    for name, level in levels.items():
        found = _term(
            records, [iris[level["within"]]] if "within" in level else [], name, level["label"]
        )
        if level["definition"]:
            found.append((s.iri(SKOS + "definition"), [s.text(level["definition"], "en")]))
        yield records.level_named[name], found
    known = records.map.knowledge.features
    seen = [known[i] for i in np.unique(records.map.landmarks.feature).tolist()]
    explained = content.features()
    labels = {**{f.name: f.label for f in seen}, **content.mentioned}
    for name, label in sorted(labels.items()):
        found = _term(records, [SL + "Feature"], name, label)
        indications = explained.get(name, {}).get("indications", {})
        if indications:
            nodes = [_indication(records, e, i) for e, i in indications.items()]
            found.append((s.iri(SL + "hasIndication"), list(nodes)))
        yield records.feature_named[name], found


def _setting(records: Records, name: str, value: Any) -> Properties:
    s = records.syntax
    if isinstance(value, bool):
        term = s.typed(str(value).lower(), XSD + "boolean")
    elif isinstance(value, int):
        term = s.integer(value)
    elif isinstance(value, float) and math.isfinite(value):
        term = s.decimal(digits(value))
    else:
        term = s.text(value if isinstance(value, str) else json.dumps(value, default=str))
    return [
        records.a(SL + "Setting"),
        (s.iri(SL + "settingName"), [s.text(name)]),
        (s.iri(SL + "settingValue"), [term]),
    ]


def _landmark_set(records: Records, count: int) -> Properties:
    """What was read, and what of it was left out and why."""
    s, report = records.syntax, records.map.landmarks.report
    found: Properties = [
        records.a(SL + "LandmarkSet", PROV + "Entity"),
        (s.iri(SL + "landmarkCount"), [s.integer(count)]),
    ]
    if report.source:
        found.append((s.iri(DCTERMS + "source"), [s.text(source_name(records.map))]))
    found += _rights(records)
    left = [("not in the ontology", name, n) for name, n in sorted(report.unknown.items())]
    left += [("outside the area", "", report.outside), ("duplicate", "", report.duplicates)]
    for cause, what, number in left:
        if number:
            node: Properties = [
                records.a(SL + "LeftOut"),
                (s.iri(SL + "cause"), [s.text(cause, "en")]),
                (s.iri(SL + "count"), [s.integer(number)]),
            ]
            if what:
                node.append((s.iri(RDFS + "label"), [s.text(what)]))
            found.append((s.iri(SL + "leftOut"), [node]))
    if report.notes:
        found.append((s.iri(RDFS + "comment"), [s.text(note, "en") for note in report.notes]))
    return found


def _rights(records: Records) -> Properties:
    """Whose data the landmarks are; the map that was made of them says so too."""
    s, line = records.syntax, records.map.landmarks.report.attribution
    if not line:
        return []
    statement: Properties = [
        records.a(DCTERMS + "RightsStatement"),
        (s.iri(RDFS + "label"), [s.text(line)]),
    ]
    return [(s.iri(DCTERMS + "rights"), [statement])]


def _agents(agents: NDArray[Any] | None) -> list[str]:
    """Names of all agents, each once."""
    return [] if agents is None else sorted({str(a) for a in agents if a})


def _term(records: Records, kinds: list[str], name: str, label: str) -> Properties:
    s = records.syntax
    found: Properties = [records.a(OWL + "Class")]
    if kinds:
        found.append((s.iri(RDFS + "subClassOf"), [s.iri(kind) for kind in kinds]))
    found.append((s.iri(SKOS + "notation"), [s.text(name)]))
    found.append((s.iri(RDFS + "label"), [s.text(label, "en")]))
    return found


def _indication(records: Records, environment: str, indication: dict[str, Any]) -> Properties:
    s = records.syntax
    found: Properties = [
        records.a(SL + "Indication"),
        (s.iri(SL + "environment"), [records.environment_named[environment]]),
        (s.iri(SL + "strength"), [s.decimal(digits(indication["strength"]))]),
        (s.iri(SL + "steps"), [s.integer(indication["steps"])]),
        (s.iri(SL + "way"), [s.text(" > ".join(indication["path"]))]),
    ]
    if indication["reason"]:
        found.append((s.iri(RDFS + "comment"), [s.text(indication["reason"], "en")]))
    if indication["source"]:
        found.append((s.iri(DCTERMS + "source"), [s.text(indication["source"])]))
    if indication["stands"]:
        found.append((s.iri(SL + "statedAt"), [s.text(indication["stands"])]))
    if ABSOLUTE_IRI.fullmatch(indication["source_iri"]):
        found.append((s.iri(PROV + "wasDerivedFrom"), [s.iri(indication["source_iri"])]))
    return found
