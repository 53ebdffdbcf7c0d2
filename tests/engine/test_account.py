"""Accounts: exact parts, exact removals, counterfactuals that hold, words that the JSON has."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from functools import cache
from itertools import combinations
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from symboslam.engine._base import normalised
from symboslam.engine.account import Account, account_of, full_account
from symboslam.engine.account_formats import as_json, record_of, schema
from symboslam.engine.account_rdf import as_turtle
from symboslam.engine.changes import applied
from symboslam.engine.classify import classify
from symboslam.engine.counterfactual import counterfactuals, without
from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.local import local_evidence
from symboslam.engine.readers import read_landmarks
from symboslam.engine.sample import sample_area
from symboslam.engine.wording import text_of
from symboslam.errors import InputError
from symboslam.reasoning.knowledge import Knowledge

PROFILES = ("default", "paper")
KINDS = ["House", "Apartment", "ClothesShop", "Hotel", "Tree", "Factory", "Barn", "BusStop"]
ROWS = st.lists(
    st.tuples(st.sampled_from(KINDS), st.floats(0, 240), st.floats(0, 240), st.floats(0.1, 1.0)),
    min_size=2,
    max_size=14,
)


@cache
def town(profile: str) -> EnvironmentMap:
    """The sample town, classified."""
    knowledge = Knowledge.load()
    return classify(read_landmarks(sample_area(seed=7), knowledge), knowledge, profile=profile)


@cache
def small_town(segmentation: str, profile: str) -> EnvironmentMap:
    """A town of one square kilometre."""
    knowledge = Knowledge.load()
    marks = read_landmarks(sample_area(7, 1000.0), knowledge)
    return classify(marks, knowledge, profile=profile, segmentation=segmentation)


def some(found: EnvironmentMap, step: int = 80) -> list[int]:
    """Segments all over a map that are known."""
    return [i for i in range(5, len(found), step) if found.label[i] >= 0]


@pytest.mark.parametrize("profile", PROFILES)
@settings(max_examples=15, deadline=None)
@given(rows=ROWS, seed=st.integers(0, 9))
def test_any_removal_changes_p_by_what_is_said(
    profile: str, rows: list[Any], seed: int, bundled: Knowledge, area: Any
) -> None:
    found = classify(area(rows), bundled, profile=profile, cells=3)
    for i in range(0, len(found), 3):
        if found.label[i] < 0:
            continue
        local = local_evidence(found, i)
        m = len(local.landmark)
        sets = np.random.default_rng(seed).random((4, m)) < 0.4
        said = normalised(local.without(np.arange(m), sets))
        for chosen, p in zip(sets, said, strict=True):
            gone = local.landmark[chosen].tolist()
            anew = without(found, str(found.segment_id[i]), gone)
            assert list(anew.values()) == pytest.approx(p.tolist(), abs=1e-12)


@pytest.mark.parametrize("profile", PROFILES)
def test_removals_in_a_town(profile: str) -> None:
    found = town(profile)
    for i in some(found, 150):
        name, label = str(found.segment_id[i]), int(found.label[i])
        for mark in full_account(found, name).parts.landmarks[:2]:
            position = int(np.flatnonzero(found.landmarks.id == mark.id)[0])
            again = classify(
                found.landmarks.without(position), found.knowledge, **dict(found.config)
            )
            values = again.evidence.of(found.regions.take(np.array([i])))
            p = normalised(values)[0, label]
            assert mark.without == pytest.approx(float(p), abs=1e-12)


@pytest.mark.parametrize("profile", PROFILES)
@settings(max_examples=10, deadline=None)
@given(rows=ROWS, kind=st.sampled_from(KINDS))
def test_additions_change_p_by_what_is_said(
    profile: str, rows: list[Any], kind: str, bundled: Knowledge, area: Any
) -> None:
    found = classify(area(rows), bundled, profile=profile, cells=3)
    feature = bundled.index_of(kind)
    assert feature is not None
    for i in range(0, len(found), 4):
        place = np.array(found.geometry[i].centroid.coords[0])
        said = local_evidence(found, i).plus(feature, place, np.array([1, 3]))
        for n, values in zip((1, 3), said, strict=True):
            more = area([*rows, *[(kind, *place.tolist(), 1.0)] * n])
            again = classify(more, bundled, **dict(found.config))
            anew = again.evidence.of(found.regions.take(np.array([i])))[0]
            assert values.tolist() == pytest.approx(anew.tolist(), rel=1e-9, abs=1e-12)


def test_fragments_are_weighed_anew_like_cells(bundled: Knowledge) -> None:
    marks = read_landmarks(sample_area(7, 1000.0), bundled)
    found = classify(marks, bundled, segmentation="branch")
    known = np.flatnonzero(found.label >= 0)[::3].tolist()
    assert known
    for i in known:
        name, local = str(found.segment_id[i]), local_evidence(found, i)
        for row, position in enumerate(local.landmark.tolist()[:3]):
            values = local.without(np.array([row]), np.ones((1, 1), np.bool_))
            anew = without(found, name, [position])
            assert normalised(values)[0].tolist() == pytest.approx(list(anew.values()), abs=1e-12)


def test_pairs_add_up_to_all_that_others_add() -> None:
    found = town("paper")
    for i in some(found):
        local, label = local_evidence(found, i), int(found.label[i])
        through = local.between(np.arange(len(local.landmark)), label)
        # Half of each pair is booked with each of the two, and C is the sum over all.
        assert through.sum() == pytest.approx(local.pairs[:, label].sum(), abs=1e-12)
        assert np.diag(through).tolist() == [0] * len(through)


def test_what_neighbours_deny_adds_up(bundled: Knowledge, area: Any) -> None:
    rows = [(kind, 100 + 7 * i, 120 - 5 * i) for i, kind in enumerate(KINDS)]
    found = classify(area(rows), bundled, cells=1)
    local = local_evidence(found, 0)
    assert len(local.landmark) == len(rows)  # so that nobody denies from outside
    for e in range(len(found.environments)):
        through = local.between(np.arange(len(rows)), e)
        assert through.sum(1).tolist() == pytest.approx(local.pairs[:, e].tolist(), abs=1e-12)


def test_pairs_by_hand(knowledge: Knowledge, landmarks_at: Any) -> None:
    # Two houses 60 m apart in a cell with a diagonal of 240 * sqrt(2): both P~ are for Home alone.
    rows = [("House", 60, 60), ("House", 120, 60)]
    found = classify(landmarks_at(rows), knowledge, profile="paper", cells=1)
    account = full_account(found, "0-0-0")
    c = 0.5 * (1 - 60 / (240 * np.sqrt(2)))  # a * 1/2 * 1/2 (1 + 1) (1 - d) * 2
    (pair,) = account.parts.pairs
    assert pair.contribution == pytest.approx(c / (c + 0.5))
    assert (pair.first, pair.second) == ("0", "1") or (pair.first, pair.second) == ("1", "0")


def test_denial_by_hand(knowledge: Knowledge, landmarks_at: Any) -> None:
    # All that is around the house is a shop, which points away from Home: it loses 0.3 of all.
    rows = [("House", 110, 120), ("Shop", 130, 120)]
    found = classify(landmarks_at(rows), knowledge, bandwidth=40, cells=1, absence=0.0)
    account = full_account(found, "0-0-0", against="Work")
    house = next(mark for mark in account.parts.landmarks if mark.feature == "House")
    assert house.pairs == pytest.approx(-0.3 * house.own)
    assert account.parts.pairs[0].contribution == pytest.approx(house.pairs)


@pytest.mark.parametrize("listed", [1, 20, 100_000])
@pytest.mark.parametrize("profile", PROFILES)
@pytest.mark.parametrize("segmentation", ["grid", "branch"])
def test_lists_of_landmarks_and_pairs_are_closed(
    segmentation: str, profile: str, listed: int, bundled: Knowledge
) -> None:
    found = small_town(segmentation, profile)
    counted = 0
    for i in some(found, 1 if segmentation == "branch" else 13):
        name, label = str(found.segment_id[i]), int(found.label[i])
        parts, local = full_account(found, name, listed=listed).parts, local_evidence(found, i)
        assert parts.other_landmarks is not None
        assert parts.other_pairs is not None
        assert parts.ground is not None
        said = sum(mark.contribution for mark in parts.landmarks) + parts.ground
        said += parts.other_landmarks.contribution
        assert said == pytest.approx(float(found.probability[i, label]), abs=1e-9)
        through = sum(pair.contribution for pair in parts.pairs) + parts.other_pairs
        all_pairs = local.pairs[:, label].sum() / local.total.sum()
        assert through == pytest.approx(all_pairs, abs=1e-9)
        adding = np.count_nonzero(local.own[:, label] + local.pairs[:, label])
        assert len(parts.landmarks) == min(listed, adding)
        assert len(parts.landmarks) + parts.other_landmarks.count == adding
        assert len(parts.pairs) <= listed
        if listed > adding**2:
            assert parts.other_landmarks.contribution == 0
            if parts.counted:  # all of the pairs are among the landmarks inside
                assert parts.other_pairs == pytest.approx(0, abs=1e-9)
        counted += parts.counted
    assert counted if "paper" == profile or segmentation == "branch" else not counted


@pytest.mark.parametrize("profile", PROFILES)
def test_differences_sum_to_the_lead(profile: str) -> None:
    found = town(profile)
    for i in some(found):
        told = found.explain(str(found.segment_id[i]))
        for against in told.probabilities.keys() - {told.environment}:
            account = account_of(told, found.knowledge.find_indication, against=against)
            lead = told.probabilities[str(told.environment)] - told.probabilities[against]
            total = sum(d.difference for d in account.differences)
            assert total == pytest.approx(lead, abs=1e-12)
            sizes = [abs(d.difference) for d in account.differences]
            assert sizes == sorted(sizes, reverse=True)
            for side in (account.why, account.against):
                assert side is not None
                parts = sum(n.contribution for n in side.named) + side.rest
                assert parts == pytest.approx(side.probability, abs=1e-12)


@pytest.mark.parametrize("profile", PROFILES)
def test_counterfactuals_flip_the_label(profile: str) -> None:
    found, seen = town(profile), 0
    for i in some(found, 130):
        name = str(found.segment_id[i])
        for change in counterfactuals(found, name):
            seen += 1
            again = classify(applied(found, change), found.knowledge, **dict(found.config))
            values = again.evidence.of(found.regions.take(np.array([i])))
            p = normalised(values)[0]
            now = again.environments[int(p.argmax())].name if p.any() else None
            assert now == change.environment != found.name_of(i)
            assert change.probability == pytest.approx(float(p.max()), abs=1e-12)
    assert seen >= 8


@pytest.mark.parametrize("profile", PROFILES)
def test_a_counterfactual_leads_to_what_is_wanted(profile: str) -> None:
    found = town(profile)
    i = some(found, 130)[1]
    for change in counterfactuals(found, str(found.segment_id[i]), against="Industrial"):
        assert change.environment == "Industrial"


@pytest.mark.parametrize("profile", PROFILES)
@settings(max_examples=8, deadline=None)
@given(rows=ROWS)
def test_minimal_is_minimal(profile: str, rows: list[Any], bundled: Knowledge, area: Any) -> None:
    """Brute force over all smaller sets of landmarks, classified anew, finds none."""
    found = classify(area(rows[:8]), bundled, profile=profile, cells=1)
    if found.label[0] < 0:
        return
    name, cells = str(found.segment_id[0]), found.regions.take(np.array([0]))
    fewer = [c for c in counterfactuals(found, name) if c.removed]
    size = len(fewer[0].removed) if fewer else len(rows[:8]) + 1
    assert not fewer or fewer[0].minimal
    for k in range(1, min(size, 4)):
        for gone in combinations(range(len(found.landmarks)), k):
            rest = classify(found.landmarks.without(*gone), bundled, **dict(found.config))
            p = normalised(rest.evidence.of(cells))[0]
            others = np.delete(p, found.label[0]).max()
            assert p.any()
            assert p[found.label[0]] >= others - 1e-9, gone


def test_a_counterfactual_by_hand(knowledge: Knowledge, landmarks_at: Any) -> None:
    # Three houses (0.9 each) against two shops (0.8 each): without one house it is 1.8 to 1.6,
    # without two 0.9 to 1.6; one shop more makes it 2.7 to 2.4, two 2.7 to 3.2.
    rows = [("House", 120, 120)] * 3 + [("Shop", 120, 120)] * 2
    found = classify(
        landmarks_at(rows), knowledge, bandwidth=40, cells=1, absence=0.0, dissimilarity=0.0
    )
    fewer, *more = counterfactuals(found, "0-0-0")
    assert (fewer.environment, len(fewer.removed), fewer.minimal) == ("Work", 2, True)
    assert set(fewer.removed) <= {0, 1, 2}
    assert [(c.environment, c.count, c.place) for c in more] == [("Work", 2, (120.0, 120.0))]
    told = text_of(full_account(found, "0-0-0", counterfactual=True), "line")
    assert told == (
        "Segment 0-0-0 is Home (P = 0.63): 3 x house.\n"
        "It would be something else\n"
        "  without 2 x house (0, 1): Work (P = 0.64); no smaller set does it.\n"
        "  with 2 more landmarks in its middle (shop): Work (P = 0.54)."
    )
    words = text_of(full_account(found, "0-0-0", counterfactual=True))
    assert "without 2 x house (0, 1): Work (P = 0.64); no smaller set does it." in words
    assert "with 2 more landmarks in its middle (shop): Work (P = 0.54)." in words


def test_a_counterfactual_names_its_landmarks(knowledge: Knowledge, landmarks_at: Any) -> None:
    rows = [("House", 120, 120)] * 9 + [("Shop", 120, 120)] * 4
    found = classify(
        landmarks_at(rows), knowledge, bandwidth=40, cells=1, absence=0.0, dissimilarity=0.0
    )
    told = full_account(found, "0-0-0", counterfactual=True)
    assert told.counterfactuals is not None
    (taken,) = told.counterfactuals[0].without
    assert len(taken.ids) == taken.count == 6  # 0.9 * 3 < 0.8 * 4
    assert f"without 6 x house ({', '.join(taken.ids[:3])}, ...): Work" in text_of(told)


def test_a_part_by_being_counted_is_called_so(knowledge: Knowledge, landmarks_at: Any) -> None:
    rows = [("House", 60, 60), ("House", 120, 60)]
    for profile, words in (("paper", "by being counted"), ("default", "by itself")):
        found = classify(landmarks_at(rows), knowledge, profile=profile, cells=1)
        told = full_account(found, "0-0-0")
        assert told.parts.counted == (profile == "paper")
        assert f"({words} +0." in text_of(told, "full")
    alone = classify(landmarks_at(rows[:1]), knowledge, segmentation="branch")
    told = full_account(alone, "b-1")  # one landmark makes no pair
    assert "(by itself +1.0000, through others +0.0000" in text_of(told, "full")


def test_a_line_tells_the_comparison_that_was_asked_for(
    knowledge: Knowledge, landmarks_at: Any
) -> None:
    rows = [("House", 120, 120)] * 3 + [("Shop", 120, 120)] * 2
    found = classify(
        landmarks_at(rows), knowledge, bandwidth=40, cells=1, absence=0.0, dissimilarity=0.0
    )
    assert text_of(full_account(found, "0-0-0"), "line") == (
        "Segment 0-0-0 is Home (P = 0.63): 3 x house."
    )
    assert text_of(full_account(found, "0-0-0", against="Work"), "line") == (
        "Segment 0-0-0 is Home (P = 0.63), rather than Work (P = 0.37): 3 x house."
    )
    with pytest.raises(InputError, match="segment 0-0-0 is Home itself"):
        full_account(found, "0-0-0", against="Home")


def test_an_unknown_segment_has_no_counterfactual(knowledge: Knowledge, landmarks_at: Any) -> None:
    found = classify(
        landmarks_at([("House", 20, 20)]), knowledge, profile="paper", cells=2, empty="unknown"
    )
    account = full_account(found, str(found.segment_id[-1]), counterfactual=True)
    assert account.counterfactuals == ()
    assert text_of(account).startswith("Segment")
    assert text_of(account, "line").endswith("is unknown.")


def values_of(record: Any) -> Iterator[Any]:
    """All names and values of a JSON document but its words."""
    if isinstance(record, dict):
        for key, value in record.items():
            if key != "text":
                yield key
                yield from values_of(value)
    elif isinstance(record, list):
        for value in record:
            yield from values_of(value)
    else:
        yield record


def accounts() -> Iterator[Account]:
    for profile in PROFILES:
        found = town(profile)
        for i in some(found, 110):
            yield full_account(found, str(found.segment_id[i]), counterfactual=i % 3 == 0)


def test_the_words_say_nothing_that_the_json_lacks() -> None:
    for account in accounts():
        for length in ("line", "paragraph", "full"):
            record = json.loads(as_json(account, length))
            known = list(values_of(record))
            numbers = [v for v in known if isinstance(v, int | float) and not isinstance(v, bool)]
            texts = sorted({v for v in known if isinstance(v, str) and v}, key=len, reverse=True)
            left = record["text"]
            for text in texts:
                left = re.sub(rf"(?<!\w){re.escape(text)}(?!\w)", " ", left)
            for number in re.findall(r"[-+]?\d+(?:\.\d+)?", left):
                digits = len(number.partition(".")[2])
                assert any(round(v, digits) == float(number) for v in numbers), (number, left)
            words = set(re.findall(r"[^\W\d_]{2,}", left))
            assert {w for w in words if w[0].isupper()} <= {
                "Segment", "What", "Why", "It", "By", "Which", "All", "The", "No",
            }  # fmt: skip


def test_json_follows_its_schema() -> None:
    jsonschema = pytest.importorskip("jsonschema")
    jsonschema.Draft202012Validator.check_schema(schema())
    validator = jsonschema.Draft202012Validator(schema())
    for account in accounts():
        validator.validate(json.loads(as_json(account, "full")))
    record = record_of(next(accounts()))
    assert not validator.is_valid({**record, "surprise": 1})
    assert not validator.is_valid({k: v for k, v in record.items() if k != "differences"})


def test_rdf_is_valid_and_says_where_axioms_stand() -> None:
    pytest.importorskip("pyshacl", reason="pySHACL comes with symboslam[shapes]")
    from rdflib import Graph, Namespace

    from symboslam.engine.validate import validate_map

    sl = Namespace("https://w3id.org/symboslam#")
    found = town("default")
    account = full_account(found, "3-11-10", counterfactual=True)
    graph = Graph().parse(data=as_turtle(account, {}), format="turtle")
    assert str(validate_map(graph)) == "The map conforms to the shapes."
    assert len(list(graph.objects(None, sl.hasCounterfactual))) == len(
        account.counterfactuals or ()
    )
    lines = {int(str(o)) for o in graph.objects(None, sl.lineNumber)}
    assert lines
    assert {i.stands.rpartition(" ")[2] for i in account.indications} == {str(n) for n in lines}


def test_axioms_stand_where_they_are_said_to(bundled: Knowledge) -> None:
    from importlib.resources import files

    folder, seen = files("symboslam.ontology"), 0
    for way in bundled.indications[::40]:
        name, _, line = way.stands.partition(": line ")
        text = (folder / name).read_text(encoding="utf-8").splitlines()
        said = next(a for a in way.axioms if "indicates" in a)
        assert said
        stated = re.search(r"_:(\w+)-(\w+)", text[int(line) - 1])
        assert stated, (way.stands, text[int(line) - 1])
        assert stated[1] in way.path
        seen += 1
    assert seen > 15
