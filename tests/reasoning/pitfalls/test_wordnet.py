"""WordNet's nouns are found in Debian's files, and it is said what to install without them."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from symboslam.reasoning.pitfalls import wordnet as module
from symboslam.reasoning.pitfalls.model import NotCheckedError, Settings, Status
from symboslam.reasoning.pitfalls.scan import scan_pitfalls

FOLDER = Settings().wordnet


@pytest.fixture
def dictionary() -> module.WordNet:
    pytest.importorskip("nltk", reason="nltk is not installed")
    if not (FOLDER / "index.noun").is_file():
        pytest.skip(f"WordNet is not at {FOLDER}")
    return module.wordnet(FOLDER)


def test_known(dictionary: module.WordNet) -> None:
    assert dictionary.known("Bed and Breakfast")
    assert dictionary.known("black_and_white")  # an adjective
    assert dictionary.known("run")
    assert dictionary.known("'hood")  # the first noun
    assert dictionary.known("zymurgy")
    for unknown in ("thin and crispy", "", " ", "Licensee of", "zzzz", "!", "1 this software"):
        assert not dictionary.known(unknown)


def test_every_noun_is_found(dictionary: module.WordNet) -> None:
    lines = (FOLDER / "index.noun").read_text("utf-8").splitlines()
    lemmas = [line.split(" ")[0] for line in lines if not line.startswith(" ")]
    assert len(lemmas) == 117798  # of WordNet 3.0
    index = module._Lines(FOLDER / "index.noun")
    sample = [*lemmas[:50], *lemmas[::97], *lemmas[-50:]]
    assert [index.find(lemma)[0] for lemma in sample] == sample


def test_synsets(dictionary: module.WordNet) -> None:
    assert [s.name() for s in dictionary.synsets("Auto")] == ["car.n.01"]
    assert "car.n.01" in [s.name() for s in dictionary.synsets("cars")]
    assert dictionary.synsets("cars", plurals=False) == ()
    railway = {s.name() for s in dictionary.synsets("railway line")}
    assert railway == {"line.n.14", "railway.n.01"}
    assert dictionary.synsets("zzzz") == dictionary.synsets("") == ()
    assert dictionary.synsets("car")[0].lexname() == "noun.artifact"
    assert {"car", "railway car", "automobile"} <= dictionary.synonyms("car")


def test_relations(dictionary: module.WordNet) -> None:
    assert dictionary.relation("car", "vehicle") == "kind"
    assert dictionary.relation("vehicle", "car") == ""
    assert dictionary.relation("finger", "hand") == "part"
    assert dictionary.relation("car", "auto") == ""
    assert dictionary.relation("zzzz", "car") == ""


def test_words_above_as_in_oops(dictionary: module.WordNet) -> None:
    assert "vehicle" in dictionary.hypernym_words("Car")
    assert "entity" not in dictionary.hypernym_words("car")
    assert "class" in dictionary.hypernym_words("b")


@pytest.mark.parametrize("strict", [False, True])
def test_no_wordnet(tmp_path: Path, strict: bool) -> None:
    path = tmp_path / "o.ttl"
    path.write_text("<https://e.org/o> a <http://www.w3.org/2002/07/owl#Ontology> .")
    codes = ["P07", "P30", "P31"]
    report = scan_pitfalls([path], Settings(wordnet=tmp_path, strict_oops=strict), codes=codes)
    for result in report.results:
        if result.pitfall.code in codes:
            assert result.status is Status.NOT_CHECKED
            assert result.reason == (
                f"WordNet is not at {tmp_path}: apt-get install wordnet-base, or --wordnet DIR"
            )


def test_no_nltk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in module._NEEDED:
        (tmp_path / name).write_text("x")
    for name in [name for name in sys.modules if name.split(".")[0] == "nltk"]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "nltk", None)
    with pytest.raises(NotCheckedError, match=r"reads WordNet, .*'symboslam\[wordnet\]'"):
        module.WordNet(tmp_path)


def test_reading_hides_no_module(dictionary: module.WordNet) -> None:
    assert dictionary.known("statistics")
    assert sys.modules.get("scipy.stats", True) is not None


DAMAGE: dict[str, Callable[[bytes], bytes]] = {
    "nothing": lambda text: b"",
    "broken off within a line": lambda text: text[:300_000],
    "broken off after a line": lambda text: text[: text.index(b"\n", 300_000) + 1],
    "shifted": lambda text: b"  \n" + text,
    "synsets that are none": lambda text: text.replace(b" n 0", b" n zz"),
    "lexicographer files that are none": lambda text: text.replace(b" 06 n ", b" 99 n "),
}


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("damage", DAMAGE)
def test_damaged(
    dictionary: module.WordNet, tmp_path: Path, damage: str, capfd: pytest.CaptureFixture[str]
) -> None:
    folder, code = tmp_path / "wordnet", "P31"
    folder.mkdir()
    for name in module._NEEDED:
        (folder / name).write_bytes((FOLDER / name).read_bytes())
    data = folder / "data.noun"
    data.write_bytes(DAMAGE[damage](data.read_bytes()))
    path = tmp_path / "o.ttl"
    owl = "http://www.w3.org/2002/07/owl#"
    path.write_text(
        f"<https://e.org/o#Car> a <{owl}Class> ; <{owl}equivalentClass> <https://e.org/o#Vehicle> ."
    )
    report = scan_pitfalls([path], Settings(wordnet=folder), codes=[code])
    result = next(r for r in report.results if r.pitfall.code == code)
    assert result.status is Status.NOT_CHECKED
    assert result.reason == f"WordNet at {folder} is damaged (data.noun): install it anew"
    assert capfd.readouterr().err == ""


@pytest.mark.parametrize("line", ["car n x 1 @ 5 1 00000001  \n", "car n\n", "", "car n 1 1 @"])
def test_damaged_index(dictionary: module.WordNet, tmp_path: Path, line: str) -> None:
    for name in module._NEEDED:
        (tmp_path / name).write_bytes((FOLDER / name).read_bytes())
    (tmp_path / "index.noun").write_text(line)
    damaged = rf"WordNet at {tmp_path} is damaged \(index.noun\): install it anew"
    with pytest.raises(NotCheckedError, match=damaged):
        module.WordNet(tmp_path).synsets("car")
