"""What is found of an ontology as a whole stays known and accepted when a class is added."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from symboslam.reasoning.pitfalls.baseline import apply, read_baseline
from symboslam.reasoning.pitfalls.model import Report, Result
from symboslam.reasoning.pitfalls.report import render

NAMES = ":House a owl:Class . :Road a owl:Class . :Wood a owl:Class . :river a owl:Class ."


def of(report: Report, code: str) -> Result:
    return next(r for r in report.results if r.pitfall.code == code)


def told(result: Result) -> list[tuple[tuple[str, ...], str, str]]:
    return [(o.finding.elements, o.finding.message, o.finding.mend) for o in result.occurrences]


@pytest.mark.parametrize("code", ["P10", "P22"])
@pytest.mark.parametrize("new", ["Aaa", "House_Boat", "ZooKeeper", "USA", "C_0001"])
def test_another_class_changes_no_word(scan_text: Any, code: str, new: str) -> None:
    before = of(scan_text(NAMES, codes=[code]), code)
    after = of(scan_text(f"{NAMES} :{new} a owl:Class .", codes=[code]), code)
    assert told(after) == told(before)
    assert len(told(before)) == 1


def test_messages(scan_text: Any) -> None:
    (whole,) = of(scan_text(NAMES, codes=["P10"]), "P10").occurrences
    assert whole.finding.message == "it says of no two classes that they have no members in common"
    body = ":HouseBoat a owl:Class . :RoadBridge a owl:Class . :river_bank a owl:Class ."
    (name,) = of(scan_text(body, codes=["P22"]), "P22").occurrences
    assert name.finding.message == (
        "river_bank starts with a small letter and joins words by _, "
        "where other classes start with a capital and join words without a mark"
    )


def test_a_baseline_knows_each_name(scan_text: Any, tmp_path: Path) -> None:
    path = tmp_path / "baseline.json"
    path.write_text(render(scan_text(NAMES, codes=["P22"]), "json"))
    later = apply(
        scan_text(f"{NAMES} :lake a owl:Class . :Field a owl:Class .", codes=["P22"]),
        read_baseline(path),
    )
    assert [o.iri.rpartition("#")[2] for o in of(later, "P22").counting] == ["lake"]


def test_accepting_one_name_accepts_no_other(scan_text: Any) -> None:
    body = f'{NAMES} :lake a owl:Class . :lake sl:acceptedPitfall "P22: an old name" .'
    report = scan_text(body, codes=["P22"])
    assert [o.iri.rpartition("#")[2] for o in of(report, "P22").counting] == ["river"]
    assert not report.notes
