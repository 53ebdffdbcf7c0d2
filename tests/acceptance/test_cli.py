"""The command line as users meet it."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from rdflib import RDF, Graph, Namespace

import symboslam
from symboslam.errors import InputError, ReasonerError, ServiceError

SUFFIXES = ("geojson", "ttl", "nq", "png", "html")


def test_help_names_every_command(run: Any) -> None:
    result = run("--help")
    assert result.code == 0
    for name in ("classify", "explain", "feature", "environments", "ontology", "sample"):
        assert name in result.out


@pytest.mark.parametrize(
    "command", [["classify"], ["explain"], ["feature"], ["environments"], ["ontology", "check"]]
)
def test_every_command_has_help(run: Any, command: list[str]) -> None:
    assert run(*command, "--help").code == 0


def test_version(run: Any) -> None:
    assert run("--version").out.strip() == f"symboslam {symboslam.__version__}"


def test_one_run_writes_every_format(run: Any, town: Path, tmp_path: Path) -> None:
    outs = [tmp_path / f"map.{suffix}" for suffix in SUFFIXES]
    result = run("classify", town, *(part for out in outs for part in ("--out", out)))
    assert result.code == 0, result.err
    assert "Residential" in result.out
    for out in outs:
        assert out.stat().st_size > 1000
        assert str(out) in result.out.replace("\n", "")


def test_the_map_meets_the_contract(run: Any, town: Path, tmp_path: Path) -> None:
    out = tmp_path / "map.geojson"
    assert run("classify", town, "--out", out, "--scheme", "territory-plan").code == 0
    data = json.loads(out.read_text())
    names = {e.name for e in symboslam.Knowledge.load().scheme("territory-plan")}
    assert len(names) == 7
    assert len(data["features"]) > 50
    for feature in data["features"]:
        p = feature["properties"]
        assert p["environment"] in names
        assert set(p["probabilities"]) == names
        assert sum(p["probabilities"].values()) == pytest.approx(1, abs=1e-5)
        assert p["probabilities"][p["environment"]] == max(p["probabilities"].values())
        parts = sum(r["contribution"].get(p["environment"], 0) for r in p["reasons"])
        assert parts == pytest.approx(p["probabilities"][p["environment"]], abs=1e-4)
    assert data["symboslam"]["config"]["profile"] == "default"
    counted = sum(f["properties"]["landmark_count"] for f in data["features"])
    assert counted == data["symboslam"]["report"]["read"]


def test_standard_input_and_output(run_process: Any, town_text: str) -> None:
    result = run_process("classify", "-", "--out", "-", stdin=town_text)
    assert result.code == 0, result.err
    assert json.loads(result.out)["type"] == "FeatureCollection"
    assert "Residential" in result.err  # the summary does not mix with the data
    assert "\x1b" not in result.err  # no progress bar without a terminal


def test_quiet_prints_nothing(run: Any, town: Path, tmp_path: Path) -> None:
    result = run("classify", town, "--out", tmp_path / "map.geojson", "--quiet")
    assert (result.code, result.out, result.err) == (0, "", "")


@pytest.mark.parametrize("suffix", ["geojson", "ttl", "nq"])
def test_explain_reads_what_classify_wrote(
    run: Any, town: Path, tmp_path: Path, suffix: str
) -> None:
    geojson, out = tmp_path / "first.geojson", tmp_path / f"map.{suffix}"
    assert run("classify", town, "--out", geojson, "--out", out, "--cells", 8).code == 0
    features = json.loads(geojson.read_text())["features"]
    home = next(f for f in features if f["properties"]["environment"] == "Residential")
    name = home["properties"]["segment_id"]
    told = run("explain", out, name)
    assert told.code == 0, told.err
    assert told.out.startswith(f"Segment {name} is Residential (P = ")
    assert "Why not " in told.out
    assert told.out == run("explain", geojson, name).out
    numbers = json.loads(run("explain", out, name, "--json").out)
    assert numbers["environment"] == "Residential"
    for word in ("Industrial", "industrial"):
        against = run("explain", out, name, "--against", word)
        assert "Why not Industrial" in against.out
    wrong = run("explain", out, name, "--against", "Nowhere")
    assert wrong.code == 2
    assert "Residential" in wrong.err  # lists what there is
    assert run("explain", out, name, "--limit", -1).code == 2


@pytest.fixture
def explained(town: Path, tmp_path: Path) -> tuple[Path, str]:
    """A map of the town and one of its segments, a residential one."""
    out = tmp_path / "explained.geojson"
    knowledge = symboslam.Knowledge.load()
    found = symboslam.classify(symboslam.read_landmarks(town, knowledge), knowledge, cells=8)
    symboslam.write_map(found, out)
    return out, next(
        f["properties"]["segment_id"]
        for f in json.loads(out.read_text())["features"]
        if f["properties"]["environment"] == "Residential"
    )


def test_explain_in_three_lengths(run: Any, town: Path, explained: tuple[Path, str]) -> None:
    out, name = explained
    line, paragraph, full = (
        run("explain", out, name, "--length", length).out
        for length in ("line", "paragraph", "full")
    )
    assert line.startswith(f"Segment {name} is Residential (P = ")
    assert line.count("\n") == 1
    assert paragraph == run("explain", out, name).out
    assert "All probabilities:" not in paragraph
    for part in ("All probabilities:", "Why Residential rather than", "What the ontology states:"):
        assert part in full
    assert "The strongest landmarks" not in full  # the map does not say where they are
    more = run("explain", out, name, "--length", "full", "--landmarks", town)
    assert more.code == 0, more.err
    assert "The strongest landmarks for Residential:" in more.out
    assert run("explain", out, name, "--length", "word").code == 2


def test_explain_in_three_formats(run: Any, explained: tuple[Path, str]) -> None:
    out, name = explained
    text, numbers, turtle = (
        run("explain", out, name, "--format", form) for form in ("text", "json", "ttl")
    )
    assert text.out == run("explain", out, name).out
    assert numbers.out == run("explain", out, name, "--json").out
    told = json.loads(numbers.out)
    assert (told["segment_id"], told["environment"]) == (name, "Residential")
    graph = Graph().parse(data=turtle.out, format="turtle")
    sl = Namespace("https://w3id.org/symboslam#")
    (found,) = graph.subjects(RDF.type, sl.SegmentExplanation)
    assert graph.value(found, sl.environment) == sl.Residential
    said = {
        str(graph.value(node, sl.environment)).partition("#")[2]: float(
            str(graph.value(node, sl.probability))
        )
        for node in graph.objects(found, sl.hasProbability)
    }
    assert said == pytest.approx(told["probabilities"], abs=1e-6)
    assert run("explain", out, name, "--format", "xml").code == 2


def test_explain_compares_with_what_is_asked_for(run: Any, explained: tuple[Path, str]) -> None:
    out, name = explained
    sl = Namespace("https://w3id.org/symboslam#")
    others, nodes = set(), set()
    for more in ((), ("--against", "Military"), ("--against", "Industrial")):
        turtle = run("explain", out, name, "--format", "ttl", *more).out
        graph = Graph().parse(data=turtle, format="turtle")
        (comparison,) = graph.objects(None, sl.hasComparison)
        others.add(graph.value(comparison, sl.environment))
        nodes |= set(graph.subjects(RDF.type, sl.SegmentExplanation))
    assert len(others) == len(nodes) == 3
    line = run("explain", out, name, "--length", "line", "--against", "military").out
    assert ", rather than Military (P = 0." in line
    itself = run("explain", out, name, "--against", "residential")
    assert itself.code == 2
    assert f"segment {name} is Residential itself" in itself.err


def test_explain_points_to_the_segment_of_the_map(run: Any, town: Path, tmp_path: Path) -> None:
    outs = [tmp_path / f"map.{suffix}" for suffix in ("ttl", "nq", "geojson")]
    assert run("classify", town, *(p for o in outs for p in ("--out", o)), "--cells", 3).code == 0
    sl, dcterms = Namespace("https://w3id.org/symboslam#"), Namespace("http://purl.org/dc/terms/")
    segments = Graph().parse(outs[0])
    for out in outs[:2]:
        graph = Graph().parse(data=run("explain", out, "0-0-0", "--format", "ttl").out)
        (segment,) = graph.objects(None, sl.explains)
        assert (segment, RDF.type, sl.Segment) in segments
        assert str(segments.value(segment, dcterms.identifier)) == "0-0-0"
    graph = Graph().parse(data=run("explain", outs[2], "0-0-0", "--format", "ttl").out)
    assert not list(graph.objects(None, sl.explains))  # GeoJSON names no IRI of it


def test_explain_lists_as_many_landmarks_as_asked_for(
    run: Any, town: Path, explained: tuple[Path, str]
) -> None:
    out, name = explained
    asked = ("explain", out, name, "--landmarks", town, "--json")
    for more, n in (((), 20), (("--limit", 3), 3), (("--limit", 100_000), 100_000)):
        told = json.loads(run(*asked, *more).out)
        count = len(told["landmarks"])
        assert count == min(n, count + told["other_landmarks"]["count"])
        assert len(told["pairs"]) <= n
        parts = [mark["contribution"] for mark in told["landmarks"]]
        whole = sum(parts) + told["other_landmarks"]["contribution"] + told["ground"]
        assert whole == pytest.approx(told["probabilities"]["Residential"], abs=1e-9)


def test_explain_tells_what_would_change_it(
    run: Any, town: Path, explained: tuple[Path, str], tmp_path: Path
) -> None:
    out, name = explained
    asked = ("explain", out, name, "--landmarks", town, "--counterfactual")
    told = run(*asked)
    assert told.code == 0, told.err
    assert "It would be something else" in told.out
    changes = json.loads(run(*asked, "--json").out)["counterfactuals"]
    assert changes
    assert all(c["environment"] != "Residential" for c in changes)
    first, *more = run(*asked, "--length", "line").out.splitlines()
    assert first.startswith(f"Segment {name} is ")
    assert len(more) >= 1 + len(changes)  # asked for, so told, however short the rest is
    only = json.loads(run(*asked, "--against", "Commercial", "--json").out)["counterfactuals"]
    assert {c["environment"] for c in only} == {"Commercial"}

    alone = run("explain", out, name, "--counterfactual")
    assert alone.code == 2
    assert "--landmarks FILE" in alone.err
    data = json.loads(town.read_text())
    data["features"] = data["features"][:-1]
    fewer = tmp_path / "fewer.geojson"
    fewer.write_text(json.dumps(data))
    other = run("explain", out, name, "--landmarks", fewer)
    assert other.code == 2  # not the landmarks that the map was made from
    assert other.err.count("\n") == 1
    assert run("explain", out, name, "--landmarks", tmp_path / "none.geojson").code == 2


def test_a_map_without_reasons_says_how_to_get_them(run: Any, town: Path, tmp_path: Path) -> None:
    out = tmp_path / "map.geojson"
    assert run("classify", town, "--out", out, "--reasons", 0, "--cells", 1).code == 0
    told = run("explain", out, "0-0-0").out
    assert "--reasons" in told
    assert "Why not" not in told


def test_feature_says_what_how_strongly_and_why(run: Any) -> None:
    told = run("feature", "house")
    assert told.code == 0
    for word in ("Residential", "0.90", "building=house", "RZ1", "importance 1.00"):
        assert word in told.out
    assert "building=* applies" in run("feature", "building=nonsense").err
    record = json.loads(run("feature", "building=barn", "--json").out)
    assert record["name"] == "Barn"
    assert record["indications"][0]["environment"] == "NonUrban"


def test_environments_lists_zones_and_schemes(run: Any) -> None:
    told = run("environments")
    assert told.code == 0
    for word in ("Residential", "RZ5", "NUZ5", "Military", "territory-plan (7)"):
        assert word in told.out
    assert len(json.loads(run("environments", "--scheme", "territory-plan", "--json").out)) == 7


def test_sample_is_deterministic(run: Any, tmp_path: Path) -> None:
    one, two = tmp_path / "one.geojson", tmp_path / "two.geojson"
    assert run("sample", "--out", one, "--seed", 5).code == 0
    assert run("sample", "--out", two, "--seed", 5).code == 0
    assert one.read_bytes() == two.read_bytes()


def test_the_profile_can_come_from_the_environment(
    run: Any, town: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("SYMBOSLAM_PROFILE", "paper")
    out = tmp_path / "map.geojson"
    assert run("classify", town, "--out", out).code == 0
    assert json.loads(out.read_text())["symboslam"]["config"]["profile"] == "paper"


def test_shell_completion_is_offered(run_process: Any) -> None:
    assert "--install-completion" in run_process("--help").out


def test_a_first_classification_starts_no_jvm(town: Path, tmp_path: Path) -> None:
    code = (
        "import subprocess, sys\n"
        "def stop(*a, **k): raise SystemExit('a process was started')\n"
        "subprocess.Popen.__init__ = stop\n"
        f"sys.argv = ['symboslam', 'classify', {str(town)!r}, '-o', 'map.geojson']\n"
        "from symboslam.cli import main\n"
        "main()\n"
        "assert 'owlready2' not in sys.modules and 'rdflib' not in sys.modules\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, timeout=60
    )
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "map.geojson").exists()


def test_errors_of_ours_have_exit_code_3(run: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(*_: object, **__: object) -> None:
        raise RuntimeError("boom")

    monkeypatch.setattr(symboslam.Knowledge, "load", broken)
    result = run("environments")
    assert result.code == 3
    assert "internal error" in result.err
    assert "boom" in result.err


ROOMS = Path(__file__).parents[2] / "examples" / "indoor-rooms"


@pytest.mark.usefixtures("java")
def test_an_ontology_of_ones_own_goes_through_the_whole_chain(run: Any, tmp_path: Path) -> None:
    out, page = tmp_path / "flat.geojson", tmp_path / "flat.html"
    own = ("--ontology", ROOMS / "rooms.ttl")
    result = run("classify", ROOMS / "flat.csv", *own, "--cells", 12, "--out", out, "--out", page)
    assert result.code == 0, result.err
    data = json.loads(out.read_text())
    assert data["crs_units"] == "m"
    found = {f["properties"]["environment"] for f in data["features"]}
    assert {"Kitchen", "Bathroom", "Bedroom", "LivingRoom", "Office"} <= found
    assert "Residential" not in page.read_text()
    # The flat's stove stands where the kitchen is.
    name = next(
        f["properties"]["segment_id"]
        for f in data["features"]
        if f["properties"]["environment"] == "Kitchen" and f["properties"]["landmark_count"]
    )
    assert f"Segment {name} is Kitchen" in run("explain", out, name).out
    assert "Kitchen" in run("feature", "cup", *own).out
    assert "LivingRoom" in run("environments", *own).out
    assert run("ontology", "check", ROOMS / "rooms.ttl").code == 0


CLASH = """
:Here a owl:Class ; rdfs:subClassOf sl:Environment ; owl:disjointWith :There .
:There a owl:Class ; rdfs:subClassOf sl:Environment .
:Both a owl:Class ; rdfs:subClassOf :Here , :There .
:Lamp a owl:Class ; rdfs:subClassOf sl:StaticFeature ,
    [ a owl:Restriction ; owl:onProperty sl:indicates ; owl:someValuesFrom :Here ] .
"""
HEAD = """@prefix : <https://example.org/mine#> .
@prefix sl: <https://w3id.org/symboslam#> .
@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
"""


@pytest.mark.proof
@pytest.mark.usefixtures("java")
@pytest.mark.parametrize(
    ("text", "words"),
    [
        (CLASH, ["Both", "no Here is a There"]),
        (CLASH + ":thing a :Both .\n", ["Both", "thing"]),
    ],
)
def test_an_ontology_that_clashes_is_refused_with_the_axioms(
    run: Any, town: Path, tmp_path: Path, text: str, words: list[str]
) -> None:
    mine = tmp_path / "mine.ttl"
    mine.write_text(HEAD + text)
    commands = (["classify", town, "--ontology", mine], 2), (["ontology", "check", mine], 1)
    for command, code in commands:
        result = run(*command)
        assert result.code == code, result
        for word in words:
            assert word in result.err + result.out


@pytest.mark.usefixtures("java")
def test_findings_have_exit_code_1(run: Any, tmp_path: Path) -> None:
    mine = tmp_path / "mine.ttl"
    mine.write_text(HEAD + CLASH.replace(":Both", ":Other").replace(":Here , :There", ":Here"))
    result = run("ontology", "check", mine)
    assert result.code == 1, result
    assert "There" in result.out  # nothing indicates it


@pytest.mark.proof
@pytest.mark.usefixtures("java")
def test_our_own_ontology_is_clean(run: Any) -> None:
    assert run("ontology", "check").code == 0


def test_a_reader_that_has_seen_enough_is_no_error(town: Path) -> None:
    command = f"{sys.executable} -m symboslam classify {town} --out - -q | head -c 10"
    done = subprocess.run(
        ["bash", "-c", f"set -o pipefail; {command}"], capture_output=True, text=True, timeout=60
    )
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""


def test_the_help_says_what_exit_codes_mean(run: Any) -> None:
    assert (ServiceError.exit_code, ReasonerError.exit_code, InputError.exit_code) == (3, 3, 2)
    told = " ".join(run("--help").out.split())
    assert "2 bad input, 3 a service or the reasoner is out of reach or has failed" in told
    assert "internal error" in told
