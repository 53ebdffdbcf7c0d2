"""What the questions over the town must answer, told without SPARQL.

Each answer of ``competency_questions/maps`` follows here from the map as Python has it (shapely for
geometry, the engine for evidence) or from where ``scripts/question_data.py`` puts things.
"""

from __future__ import annotations

import importlib.util
from collections import Counter
from collections.abc import Callable, Iterable
from decimal import ROUND_HALF_UP, Decimal
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely

from symboslam.engine.environment_map import EnvironmentMap

FOLDER = Path(__file__).parents[1] / "competency_questions"
SCRIPT = Path(__file__).parents[1] / "scripts" / "question_data.py"
SL = "https://w3id.org/symboslam#"
XSD = "http://www.w3.org/2001/XMLSchema#"
Rows = Iterable[tuple[Any, ...]]


@pytest.fixture(scope="module")
def town() -> EnvironmentMap:
    """The map of ``scripts/question_data.py``."""
    spec = importlib.util.spec_from_file_location("question_data", SCRIPT)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    found: EnvironmentMap = module.town()
    return found


def _round(value: float, places: str = "0.01") -> Decimal:
    return Decimal(f"{value:.6f}").quantize(Decimal(places), ROUND_HALF_UP)


def _inside(m: EnvironmentMap, segment: str) -> list[int]:
    """Landmarks inside a segment."""
    outline = m.geometry[m.position_of(segment)]
    return [
        int(i) for i in np.flatnonzero(shapely.contains_xy(outline, m.landmarks.x, m.landmarks.y))
    ]


def _known(m: EnvironmentMap) -> dict[str, str | None]:
    return {str(name): m.name_of(i) for i, name in enumerate(m.segment_id)}


def _kind(m: EnvironmentMap, landmark: int) -> str:
    return str(m.knowledge.features[m.landmarks.feature[landmark]].name)


def _around(segment: str) -> set[str]:
    depth, row, column = map(int, segment.split("-"))
    return {
        f"{depth}-{r}-{c}"
        for r in (row - 1, row, row + 1)
        for c in (column - 1, column, column + 1)
        if (r, c) != (row, column)
    }


def _metres(m: EnvironmentMap, a: int, b: int) -> float:
    return float(np.hypot(m.landmarks.x[a] - m.landmarks.x[b], m.landmarks.y[a] - m.landmarks.y[b]))


def _of(m: EnvironmentMap, kind: str) -> list[int]:
    return [i for i in range(len(m.landmarks)) if _kind(m, i) == kind]


def _ids(m: EnvironmentMap, positions: Iterable[int]) -> list[tuple[str]]:
    return [(str(m.landmarks.id[i]),) for i in positions]


def _agents(m: EnvironmentMap) -> list[str | None]:
    assert m.landmarks.agent is not None
    return [a or None for a in m.landmarks.agent.tolist()]


def _moment(m: EnvironmentMap, landmark: int) -> str:
    assert m.landmarks.time is not None
    return str(m.landmarks.time[landmark]).replace("+00:00", "Z") + "^dateTime"


def _residential(m: EnvironmentMap) -> Rows:
    for name, kind in _known(m).items():
        if kind == "Residential":
            yield name, _round(m.explain(name).probabilities["Residential"])


def _divided(m: EnvironmentMap) -> Rows:
    labels = {e.name: e.label for e in m.environments}
    found = Counter(labels[k] if k else "unknown" for k in _known(m).values())
    return found.items()


def _evidence(m: EnvironmentMap) -> Rows:
    named, rest = m.explain("1-3-2").reasons[:4], m.explain("1-3-2").reasons[4:]
    for r in named:
        if "Commercial" in r.contribution:
            yield r.feature, r.count, _round(r.contribution["Commercial"])
    others = sum(r.contribution.get("Commercial", 0) for r in rest)
    yield "other", sum(r.count for r in rest), _round(others)


def _lead(m: EnvironmentMap) -> Rows:
    found = m.explain("1-4-4")
    first, second = sorted(found.probabilities, key=lambda e: -found.probabilities[e])[:2]
    for r in found.reasons[:4]:
        lead = _round(r.contribution.get(first, 0) - r.contribution.get(second, 0))
        if lead:
            yield SL + second, r.feature, lead


def _detections(m: EnvironmentMap) -> Rows:
    for i in _inside(m, "1-3-0"):
        confidence = _round(m.landmarks.confidence[i])
        yield m.landmarks.id[i], SL + _kind(m, i), confidence, _moment(m, i), _agents(m)[i]


def _stops(m: EnvironmentMap) -> Rows:
    for stop in _of(m, "BusStop"):
        nearest = min(_metres(m, stop, bank) for bank in _of(m, "Bank"))
        yield m.landmarks.id[stop], 10 * round(nearest / 10)


def _pairs(m: EnvironmentMap) -> Rows:
    known = _known(m)
    for name, kind in known.items():
        if kind == "Industrial":
            yield from ((name, n) for n in _around(name) if known.get(n) == "Commercial")


def _certain(m: EnvironmentMap) -> Rows:
    known = [i for i in range(len(m)) if m.label[i] >= 0]
    for i in sorted(known, key=lambda i: m.probability[i].max())[:3]:
        yield m.segment_id[i], SL + str(m.name_of(i))


def _weak(m: EnvironmentMap) -> Rows:
    named = {r.feature for reasons in m.reasons(range(len(m)), 4) for r in reasons}
    for kind in named & {_kind(m, i) for i in range(len(m.landmarks))}:
        strongest = max(i.strength for i in m.knowledge.indications if i.feature == kind)
        if strongest <= 0.5:
            yield kind, _round(strongest)


def _seen(m: EnvironmentMap) -> Rows:
    for robot in ("rover 1", "rover 2", "drone"):
        theirs = [_kind(m, i) for i, a in enumerate(_agents(m)) if a == robot]
        yield robot, len(theirs), len(set(theirs))


def _counts(m: EnvironmentMap) -> Rows:
    return Counter(SL + _kind(m, i) for i in range(len(m.landmarks))).items()


def _unsure(m: EnvironmentMap) -> Rows:
    for name, confidence in zip(m.landmarks.id, m.landmarks.confidence, strict=True):
        if confidence < 0.57:
            yield name, _round(confidence)


def _settings(m: EnvironmentMap) -> Rows:
    for name, value in m.config.items():
        if name != "absence" and value is not None:
            yield name, f"{value:g}" if isinstance(value, float) else str(value)


def _silo(m: EnvironmentMap) -> Rows:
    for i in m.knowledge.indications:
        if i.feature == "Silo":
            yield SL + i.environment, _round(i.strength), " > ".join(i.path), i.reason


def _moving(m: EnvironmentMap) -> Rows:
    return _ids(m, np.flatnonzero(~m.landmarks.static))


def _drone(m: EnvironmentMap) -> Rows:
    theirs = [i for i, agent in enumerate(_agents(m)) if agent == "drone"]
    for i in sorted(theirs, key=lambda i: _moment(m, i))[:5]:
        yield _moment(m, i), m.landmarks.id[i]


def _homes(m: EnvironmentMap) -> Rows:
    trades = {"Supermarket", "ConvenienceStore", "OfficeBuilding", "Bank", "Restaurant"}
    for name in _known(m):
        kinds = {_kind(m, i) for i in _inside(m, name)}
        if "House" in kinds and not kinds & trades:
            yield (name,)


ANSWERS: dict[str, Callable[[EnvironmentMap], Rows]] = {
    "map-01": _residential,
    "map-02": _divided,
    "map-03": lambda m: ((SL + e, _round(p)) for e, p in m.explain("1-3-2").probabilities.items()),
    "map-04": _evidence,
    "map-05": _lead,
    "map-06": lambda m: (),  # reasons are exact
    "map-07": lambda m: Counter(_agents(m)[i] for i in _inside(m, "1-5-2")).items(),
    "map-08": _detections,
    "map-09": lambda m: [("TrainStation-1",), ("RailPlatform-1",), ("RailPlatform-2",)],
    "map-10": lambda m: (),  # counts are right
    "map-11": _stops,
    "map-12": lambda m: [("RailPlatform-1",), ("RailPlatform-2",)],
    "map-13": lambda m: ((n, SL + k) for n, k in _known(m).items() if k and n in _around("1-4-2")),
    "map-14": _pairs,
    "map-15": lambda m: [("0-0-2",), ("1-2-5",)],  # the south-east, see SURVEYED
    "map-16": lambda m: (
        ("1-2-5", n) for n in ("ShippingContainer-3", "ShippingContainer-4", "Warehouse-3")
    ),
    "map-17": lambda m: [
        ("not in the ontology", "Obelisk", 2),
        ("outside the area", "", 1),
        ("duplicate", "", 1),
    ],
    "map-18": _settings,
    "map-19": lambda m: [("bundled", True)],
    "map-20": lambda m: [("SymboSLAM", "2026-03-02T10:30:00Z^dateTime")],
    "map-21": _unsure,
    "map-22": _counts,
    "map-23": _certain,
    "map-24": _silo,
    "map-25": lambda m: [("council-1",), ("council-2",), ("council-3",)],
    "map-26": _seen,
    "map-27": lambda m: [(SL + "Military",)],
    "map-28": lambda m: ((n, SL + k) for n, k in _known(m).items() if k and not len(_inside(m, n))),
    "map-29": _weak,
    "map-30": _moving,
    "map-31": _drone,
    "map-32": lambda m: [("SymboSLAM contributors, CC BY 4.0",)],
    "map-33": _homes,
}


def term(value: Any) -> str:
    """A value as SPARQL's TSV has it."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, Decimal):
        short = f"{value.normalize():f}"
        return short if "." in short else f"{short}.0"
    if isinstance(value, int | np.integer):
        return str(value)
    if value.startswith("http"):
        return f"<{value}>"
    text, _, datatype = str(value).partition("^")
    return f'"{text}"' + (f"^^<{XSD}{datatype}>" if datatype else "")


def lines(rows: Rows) -> list[str]:
    """Rows as SPARQL's TSV has them."""
    return ["\t".join(map(term, row)) for row in rows]


def test_every_question_has_an_answer_here() -> None:
    assert sorted(ANSWERS) == sorted(f.stem for f in (FOLDER / "maps").glob("*.rq"))


@pytest.mark.parametrize("question", ANSWERS)
def test_expected_answers_follow_from_the_map(town: EnvironmentMap, question: str) -> None:
    header, *expected = (FOLDER / "maps" / f"{question}.tsv").read_text().splitlines()
    assert header.startswith("?")
    found = lines(ANSWERS[question](town))
    if "ORDER BY" in (FOLDER / "maps" / f"{question}.rq").read_text().rsplit("}", 1)[1]:
        assert found == expected
    else:
        assert sorted(found) == sorted(expected)
