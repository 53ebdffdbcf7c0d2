"""Pages about an ontology: complete, linked, safe, the same each time, and right."""

import doctest
import importlib
import json
import os
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from html.parser import HTMLParser
from pathlib import Path
from typing import NamedTuple

import pytest
from rdflib import OWL, RDF, RDFS, SKOS, URIRef

from symboslam.errors import InputError, OntologySyntaxError, OutputError
from symboslam.reasoning.documentation.diagrams.drawing import Box
from symboslam.reasoning.documentation.diagrams.overview import draw_layers
from symboslam.reasoning.documentation.diagrams.tree import Forest, draw_forest
from symboslam.reasoning.documentation.site import MARKER, Site, build_site
from symboslam.reasoning.vocabulary import ENVIRONMENT

CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser"))), None)
SVG = "{http://www.w3.org/2000/svg}"
HEAD = """
@prefix : <https://example.org/mine#> .
@prefix sl: <https://w3id.org/symboslam#> .
@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
@prefix skos: <http://www.w3.org/2004/02/skos/core#> .
@prefix prov: <http://www.w3.org/ns/prov#> .
<https://example.org/mine> a owl:Ontology ; owl:imports <https://w3id.org/symboslam/core> ;
  rdfs:label "My rooms"@en .
"""
ROOMS = (
    HEAD
    + """
:Kitchen a owl:Class ; rdfs:subClassOf sl:Environment ; rdfs:label "Kitchen"@en ;
  sl:colour "#112233" ; skos:definition "For cooking."@en .
:Bathroom a owl:Class ; rdfs:subClassOf sl:Environment ; rdfs:label "Bathroom"@en ;
  skos:definition "For washing."@en .
:Corner a owl:Class ; rdfs:label "Cooking corner"@en ; rdfs:subClassOf sl:Place ,
  [ a owl:Restriction ; owl:onProperty sl:partOf ; owl:someValuesFrom :Kitchen ] .
:Stove a owl:Class ; rdfs:subClassOf sl:StaticFeature , _:1 ; rdfs:label "Stove"@en ;
  skos:definition "Makes pots hot."@en ; sl:osmTag "amenity=stove" .
_:1 a owl:Restriction ; owl:onProperty sl:indicates ; owl:someValuesFrom :Kitchen .
[] a owl:Axiom ; owl:annotatedSource :Stove ; owl:annotatedProperty rdfs:subClassOf ;
  owl:annotatedTarget _:1 ; sl:strength 0.9 ; rdfs:comment "Stoves cook."@en ;
  prov:wasDerivedFrom sl:source-judgement .
:Sink a owl:Class ; rdfs:subClassOf sl:DynamicFeature , _:2 , _:3 , _:4 ; rdfs:label "Sink"@en .
_:2 a owl:Restriction ; owl:onProperty sl:indicates ; owl:someValuesFrom :Kitchen .
_:3 a owl:Restriction ; owl:onProperty sl:indicates ; owl:someValuesFrom :Bathroom .
_:4 a owl:Restriction ; owl:onProperty sl:indicates ; owl:someValuesFrom :Corner .
[] a owl:Axiom ; owl:annotatedSource :Sink ; owl:annotatedProperty rdfs:subClassOf ;
  owl:annotatedTarget _:2 ; sl:strength 0.5 ; rdfs:comment "Dishes are washed up."@en .
[] a owl:Axiom ; owl:annotatedSource :Sink ; owl:annotatedProperty rdfs:subClassOf ;
  owl:annotatedTarget _:3 ; sl:strength 0.5 ; rdfs:comment "Hands are washed."@en .
[] a owl:Axiom ; owl:annotatedSource :Sink ; owl:annotatedProperty rdfs:subClassOf ;
  owl:annotatedTarget _:4 ; sl:strength 0.2 ; rdfs:comment "Water is near the pots."@en .
:Oven a owl:Class ; rdfs:subClassOf sl:StaticFeature , _:5 ; rdfs:label "Oven"@en .
_:5 a owl:Restriction ; owl:onProperty sl:indicates ; owl:someValuesFrom :Corner .
[] a owl:Axiom ; owl:annotatedSource :Oven ; owl:annotatedProperty rdfs:subClassOf ;
  owl:annotatedTarget _:5 ; sl:strength 0.8 ; rdfs:comment "Ovens bake."@en .
"""
)


class Page(HTMLParser):
    """What the tests ask of a page: texts by id, links, elements."""

    def __init__(self, content: str) -> None:
        super().__init__()
        self.ids: list[str] = []
        self.texts: dict[str, str] = {}
        self.elements: list[tuple[str, dict[str, str | None]]] = []
        self._open: list[tuple[str, str | None]] = []
        self.words = ""
        self.feed(content)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        found = dict(attrs)
        self.elements.append((tag, found))
        if (name := found.get("id")) is not None:
            self.ids.append(name)
        if tag not in ("input", "link", "meta", "br"):
            self._open.append((tag, name))

    def handle_endtag(self, tag: str) -> None:
        assert self._open[-1][0] == tag, f"</{tag}> closes <{self._open[-1][0]}>"
        self._open.pop()

    def handle_data(self, data: str) -> None:
        self.words += data
        for _, name in self._open:
            if name:
                self.texts[name] = self.texts.get(name, "") + data

    @property
    def links(self) -> list[str]:
        return [
            found["href"] or "" for tag, found in self.elements if tag == "a" and "href" in found
        ]


class Rectangle(NamedTuple):
    x: float
    y: float
    width: float
    height: float


def pages_of(site: Site) -> dict[str, Page]:
    return {name: Page(text) for name, text in site.files.items() if name.endswith(".html")}


@pytest.fixture(scope="module")
def bundled() -> Site:
    return build_site()


@pytest.fixture(scope="module")
def pages(bundled: Site) -> dict[str, Page]:
    return pages_of(bundled)


@pytest.fixture
def rooms(tmp_path: Path) -> Path:
    file = tmp_path / "rooms.ttl"
    file.write_text(ROOMS)
    return file


def spaces(text: str) -> str:
    return " ".join(text.split())


# The bundled ontology


def test_every_module_has_a_page_and_all_its_terms_are_on_it(
    bundled: Site, pages: dict[str, Page]
) -> None:
    modules = bundled.library.modules
    assert {"core", "environments", "map"} <= {m.name for m in modules}
    seen = 0
    for module in modules:
        page = pages[f"{module.page}.html"]
        anchors = {t.iri: t.anchor for t in bundled.library.declared[module]}
        graph = module.graph
        kinds = (OWL.Class, OWL.ObjectProperty, OWL.DatatypeProperty, OWL.AnnotationProperty)
        declared = {s for kind in kinds for s in graph.subjects(RDF.type, kind)}
        for iri in (s for s in declared if isinstance(s, URIRef)):
            text = spaces(page.texts[anchors[str(iri)]])
            label, definition = graph.value(iri, RDFS.label), graph.value(iri, SKOS.definition)
            assert spaces(str(label)) in text, iri
            if definition is not None:
                assert spaces(str(definition)) in text, iri
            seen += 1
    assert seen > 500


def test_anchors_are_local_names(pages: dict[str, Page]) -> None:
    assert "indicates" in pages["module-core.html"].ids
    assert {"Residential", "RZ1"} <= set(pages["module-environments.html"].ids)
    assert "House" in pages["module-features-detector.html"].ids


def test_every_reason_is_on_the_page_of_its_environment(
    bundled: Site, pages: dict[str, Page]
) -> None:
    assert bundled.evidence is not None
    knowledge = bundled.evidence.knowledge
    words = {e.name: spaces(pages[f"environment-{e.name}.html"].words)
             for e in knowledge.environments}  # fmt: skip
    assert len(words) == 8
    for way in knowledge.indications:
        assert way.reason
        assert spaces(way.reason) in words[way.environment]
        assert spaces(way.source) in words[way.environment]
    names = {e.iri: e.name for e in knowledge.environments}
    features = {f.iri for f in knowledge.features}
    stated = [
        s for s in bundled.evidence.stated.indications
        if s.place in names and s.feature in features
    ]  # fmt: skip
    assert len(stated) > 500
    assert not [s for s in stated if spaces(s.reason) not in words[names[s.place]]]


def test_links_lead_somewhere(bundled: Site, pages: dict[str, Page]) -> None:
    ids = {name: set(page.ids) for name, page in pages.items()}
    checked = 0
    links = [(name, link) for name, page in pages.items() for link in page.links]
    entries = json.loads(bundled.files["terms.js"].partition("=")[2].rstrip(" ;\n"))
    links += [("index.html", entry[3]) for entry in entries]
    for name, svg in bundled.files.items():
        if name.endswith(".svg"):
            links += [(name, a.attrib["href"]) for a in ET.fromstring(svg).iter(f"{SVG}a")]
    for name, link in links:
        if re.match(r"https?://", link):
            continue
        target, _, anchor = link.partition("#")
        target = target or name
        assert target in bundled.files, f"{name}: {link}"
        assert not anchor or anchor in ids[target], f"{name}: {link}"
        checked += 1
    assert checked > 5000


def test_no_id_twice(pages: dict[str, Page]) -> None:
    for name, page in pages.items():
        assert len(page.ids) == len(set(page.ids)), name


def test_nothing_is_loaded_from_elsewhere(bundled: Site, pages: dict[str, Page]) -> None:
    for name, page in pages.items():
        for tag, found in page.elements:
            for key in ("src", "srcset", "data", "poster", "action", "xlink:href"):
                assert "//" not in (found.get(key) or ""), (name, tag)
            if tag not in ("a",):
                assert "//" not in (found.get("href") or ""), (name, tag)
            assert tag not in ("iframe", "object", "embed", "img", "base")
    for name, text in bundled.files.items():
        assert not re.search(r"@import|url\(|fetch\(|XMLHttpRequest|import\(", text), name


def test_two_builds_are_equal(bundled: Site) -> None:
    """Blank nodes are called differently in each."""
    assert build_site().files == bundled.files


def test_index_says_what_there_is(bundled: Site, pages: dict[str, Page]) -> None:
    page = pages["index.html"]
    links = set(page.links)
    assert {f"{m.page}.html" for m in bundled.library.modules} <= links
    assert bundled.evidence is not None
    for environment in bundled.evidence.environments:
        assert f"environment-{environment.name}.html" in links
        assert environment.label in page.words
    assert f"{len(bundled.library.modules)}modules" in spaces(page.words).replace(" ", "")
    assert "competency-questions.html" not in links  # no report was given


def test_diagrams_show_every_class(bundled: Site) -> None:
    for module in bundled.library.modules:
        classes = [t for t in bundled.library.declared[module] if t.kind == "class"]
        if not classes:
            continue
        root = ET.fromstring(bundled.files[f"{module.page}.svg"])
        linked = {a.attrib["href"] for a in root.iter(f"{SVG}a")}
        assert {t.href for t in classes} <= linked, module.name


def test_no_box_lies_on_another(bundled: Site) -> None:
    drawings = {n: t for n, t in bundled.files.items() if n.endswith(".svg")}
    assert len(drawings) > 15
    for name, svg in drawings.items():
        assert not overlapping(ET.fromstring(svg)), name


# Numbers, by hand


def test_weights_paths_and_reasons(rooms: Path) -> None:
    site = build_site([rooms])
    assert site.evidence is not None
    kitchen = {r.feature.name: r for r in site.evidence.rows["Kitchen"]}
    # Stove: 0.9, only here. Oven: 0.8 over two steps, only here. Sink: 0.5 for both rooms, so that
    # its importance is 0.
    assert [r.feature.name for r in site.evidence.rows["Kitchen"]] == ["Stove", "Oven", "Sink"]
    assert [round(kitchen[n].weight, 6) for n in ("Stove", "Oven", "Sink")] == [0.9, 0.4, 0.0]
    assert [kitchen[n].share for n in ("Stove", "Oven", "Sink")] == [1.0, 1.0, 0.5]
    assert [r.feature.name for r in site.evidence.telling("Kitchen")] == ["Stove", "Oven"]
    assert site.evidence.telling("Bathroom") == ()
    (rival,) = site.evidence.rivals("Kitchen")
    assert (rival.environment.name, rival.shared, rival.telling) == ("Bathroom", 1, ())

    page = Page(site.files["environment-Kitchen.html"])
    oven = spaces(page.texts["feature-Oven"])
    assert "Oven › Cooking corner › Kitchen" in oven
    assert "Ovens bake." in oven
    assert "over 2 = 0.40" in oven
    sink = spaces(page.texts["feature-Sink"])
    assert "Dishes are washed up." in sink
    assert "also indicates Cooking corner 0.20: Water is near the pots." in sink
    assert "dynamic" in sink
    stove = spaces(page.texts["feature-Stove"])
    assert "Judgement of the SymboSLAM contributors" in stove
    assert "amenity=stove" in stove
    assert "background:#112233" in site.files["environment-Kitchen.html"]


def test_an_ontology_without_indications_needs_no_reasoner(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("symboslam.reasoning.knowledge.Knowledge.load", None)
    file = tmp_path / "a.ttl"
    file.write_text(
        HEAD.replace("; owl:imports <https://w3id.org/symboslam/core>", "")
        + ':A a owl:Class . :B a owl:Class ; rdfs:subClassOf :A , [ a owl:Restriction ; '
        'owl:onProperty :p ; owl:minQualifiedCardinality 2 ; owl:onClass :A ] . '
        ':p a owl:ObjectProperty ; rdfs:range [ a owl:Class ; owl:unionOf ( :A :B ) ] .'
    )  # fmt: skip
    site = build_site([file])
    assert site.evidence is None
    page = Page(site.files["module-a.html"])
    assert "kind of A, p min 2 A" in spaces(page.texts["B"])
    assert "to (range) A or B" in spaces(page.texts["p"])
    assert not [name for name in site.files if name.startswith("environment-")]


def test_a_term_in_two_modules_is_described_where_it_is_lowest(tmp_path: Path) -> None:
    (tmp_path / "low.ttl").write_text(
        HEAD.replace("example.org/mine>", "example.org/low>").replace(
            "; owl:imports <https://w3id.org/symboslam/core>", ""
        )
        + ':A a owl:Class ; rdfs:label "Alpha"@en ; skos:definition "The first."@en .'
    )
    high = tmp_path / "high.ttl"
    high.write_text(
        HEAD.replace("example.org/mine>", "example.org/high>").replace(
            "https://w3id.org/symboslam/core", "https://example.org/low"
        )
        + ":A a owl:Class . :A rdfs:subClassOf <https://example.org/other#A> . "
        "<https://example.org/other#A> a owl:Class . :B a owl:Class ; rdfs:subClassOf :A ."
    )
    site = build_site([high])
    library = site.library
    assert [m.name for m in library.modules] == ["low", "high"]
    assert library.terms["https://example.org/mine#A"].href == "module-low.html#A"
    high_page = Page(site.files["module-high.html"])
    assert {"A", "A-2", "B"} <= set(high_page.ids)  # two classes with one local name
    assert "Alpha" in high_page.texts["A"]
    assert "The first." in high_page.texts["A"]
    assert "https://example.org/other#A" in high_page.texts["A-2"]
    low_page = Page(site.files["module-low.html"])
    assert "(stated in high)" in spaces(low_page.texts["A"])


# Diagrams


def rectangles(element: ET.Element, x: float = 0, y: float = 0) -> Iterator[Rectangle]:
    """The boxes of a drawing, without frames around groups, where they come to stand."""
    if move := re.match(r"translate\((\S+) (\S+)\)", element.get("transform", "")):
        x, y = x + float(move[1]), y + float(move[2])
    if element.tag == f"{SVG}rect" and "dg-group" not in element.get("class", ""):
        a, b, w, h = (float(element.attrib[k]) for k in ("x", "y", "width", "height"))
        yield Rectangle(a + x, b + y, w, h)
    for child in element:
        yield from rectangles(child, x, y)


def overlapping(root: ET.Element) -> list[tuple[Rectangle, Rectangle]]:
    boxes = sorted(rectangles(root), key=lambda r: r.y)
    found = []
    for i, one in enumerate(boxes):
        for other in boxes[i + 1 :]:
            if other.y >= one.y + one.height - 0.11:
                break
            if other.x < one.x + one.width - 0.11 and one.x < other.x + other.width - 0.11:
                found.append((one, other))
    return found


def test_four_hundred_leaves_stay_on_a_page() -> None:
    boxes = {"top": Box("Top")} | {f"g{i}": Box(f"Group {i}") for i in range(20)}
    boxes |= {f"g{i}-{j}": Box(f"Leaf {j} of {i}") for i in range(20) for j in range(20)}
    below = {"top": [f"g{i}" for i in range(20)]}
    below |= {f"g{i}": [f"g{i}-{j}" for j in range(20)] for i in range(20)}
    canvas = draw_forest(Forest(boxes, below))
    root = ET.fromstring(canvas.svg("test"))
    assert len(list(rectangles(root))) == 421
    assert not overlapping(root)
    # A block of twenty has two columns of ten rows of 26 px and 20 px around them.
    assert canvas.height <= 20 * (10 * 26 + 20)
    assert canvas.width < 700


def test_the_deepest_levels_of_a_huge_tree_are_counted() -> None:
    boxes = {"top": Box("Top")} | {f"g{i}": Box(f"Group {i}") for i in range(60)}
    boxes |= {f"g{i}-{j}": Box(f"Leaf {j}") for i in range(60) for j in range(60)}
    below = {"top": [f"g{i}" for i in range(60)]}
    below |= {f"g{i}": [f"g{i}-{j}" for j in range(60)] for i in range(60)}
    svg = str(draw_forest(Forest(boxes, below)).svg("test"))
    assert len(list(rectangles(ET.fromstring(svg)))) == 61
    assert svg.count("+ 60 below") == 60


def test_a_long_chain_of_classes_is_drawn() -> None:
    boxes = {str(i): Box(f"Class {i}") for i in range(3000)}
    canvas = draw_forest(Forest(boxes, {str(i): [str(i + 1)] for i in range(2999)}))
    assert "+ 2960 below" in canvas.svg("test")


def test_layers_follow_imports_and_cut_rings() -> None:
    boxes = {name: Box(name) for name in "abcd"}
    edges = {"b": ["a"], "c": ["b", "a"], "d": ["c"], "a": ["d"]}  # a ring through all
    root = ET.fromstring(draw_layers(boxes, edges).svg("test"))
    texts = {
        "".join(g.find(f"{SVG}text").itertext()): float(g.find(f"{SVG}rect").attrib["x"])  # type: ignore[union-attr]
        for g in root.iter(f"{SVG}g")
        if g.find(f"{SVG}rect") is not None
    }
    assert set(texts) == set("abcd")
    assert len(set(texts.values())) == 4
    lines = [p for p in root.iter(f"{SVG}path")]
    assert len(lines) == 3  # c needs a through b already; the ring is cut


@pytest.mark.parametrize("name", ["markup", "modules", "library", "diagrams.drawing"])
def test_examples_in_docstrings(name: str) -> None:
    module = importlib.import_module(f"symboslam.reasoning.documentation.{name}")
    result = doctest.testmod(module)
    assert result.attempted
    assert not result.failed


# Bad input and hostile text


def test_text_is_never_markup(tmp_path: Path) -> None:
    evil = '<script>alert(1)</script><img src=x onerror=alert(2)>\\" onload=\\"x'
    file = tmp_path / "evil.ttl"
    file.write_text(
        ROOMS.replace('"Stove"@en', f'"{evil}"@en')
        .replace("Stoves cook.", evil)
        .replace("Makes pots hot.", evil + "\\u0007")
        .replace("#112233", "red;background:url(//x)")
        .replace("amenity=stove", evil)
        .replace("My rooms", evil)
        .replace("sl:source-judgement", "<javascript:alert(3)>")
        + ":Stove rdfs:seeAlso <javascript:alert(4)> , <data:text/html,x> ."
    )
    site = build_site([file])
    for name, page in pages_of(site).items():
        scripts = [found for tag, found in page.elements if tag == "script"]
        assert [s["src"] for s in scripts] == ["terms.js", "site.js"], name
        for tag, found in page.elements:
            assert tag != "img"
            assert not [key for key in found if key.startswith("on")]
            assert "url(" not in (found.get("style") or "")
            link = found.get("href") or ""
            assert not re.match(r"\s*(javascript|vbscript|data:text)", link, re.IGNORECASE)
    assert "<script>alert(1)" in Page(site.files["environment-Kitchen.html"]).words
    for name, text in site.files.items():
        if name.endswith(".svg"):
            assert not [e for e in ET.fromstring(text).iter() if e.tag.endswith("script")]


def test_a_broken_file_is_named(tmp_path: Path) -> None:
    file = tmp_path / "broken.ttl"
    file.write_text(HEAD + "\n:A a owl:Class ;; ]\n")
    with pytest.raises(OntologySyntaxError, match=r"broken\.ttl: line \d+"):
        build_site([file])
    with pytest.raises(InputError, match="absent"):
        build_site([tmp_path / "absent.ttl"])


# Writing


def test_a_folder_of_others_is_left_alone(tmp_path: Path) -> None:
    site = Site({"index.html": "new"}, None, None)  # type: ignore[arg-type]
    out = tmp_path / "out"
    out.mkdir()
    (out / "thesis.txt").write_text("years of work")
    with pytest.raises(OutputError, match="nothing was written"):
        site.write(out)
    assert [p.name for p in out.iterdir()] == ["thesis.txt"]
    with pytest.raises(OutputError, match="is a file"):
        site.write(out / "thesis.txt")
    assert [p.name for p in tmp_path.iterdir()] == ["out"]


def test_an_earlier_build_is_replaced_as_a_whole(tmp_path: Path) -> None:
    out = tmp_path / "deep" / "out"
    first = Site({"index.html": "old", "old.html": "old"}, None, None)  # type: ignore[arg-type]
    assert first.write(out) == out / "index.html"
    Site({"index.html": "new"}, None, None).write(out)  # type: ignore[arg-type]
    assert sorted(p.name for p in out.iterdir()) == [MARKER, "index.html"]
    assert (out / "index.html").read_text() == "new"
    assert [p.name for p in out.parent.iterdir()] == ["out"]


def test_the_questions_go_along(rooms: Path) -> None:
    site = build_site([rooms], questions="<!DOCTYPE html><p>asked")
    assert site.files["competency-questions.html"] == "<!DOCTYPE html><p>asked"
    assert "competency-questions.html" in Page(site.files["index.html"]).links


def test_command(rooms: Path, tmp_path: Path) -> None:
    """Two runs with differently seeded hashes write the same."""
    for seed in ("1", "2"):
        command = [sys.executable, "-W", "error", "-m", "symboslam", "ontology", "docs"]
        done = subprocess.run(
            [*command, str(rooms), "--out", str(tmp_path / seed)],
            env={**os.environ, "PYTHONHASHSEED": seed}, capture_output=True, text=True, check=False,
        )  # fmt: skip
        assert done.returncode == 0, done.stderr
        assert str(tmp_path / seed / "index.html") in done.stdout
    one, two = (
        {p.name: p.read_text(encoding="utf-8") for p in (tmp_path / seed).iterdir()}
        for seed in ("1", "2")
    )
    assert one == two
    bad = [*command, str(rooms), "--out", str(tmp_path)]
    done = subprocess.run(bad, capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert "name a new or empty folder" in done.stderr


# In a browser


@pytest.mark.browser
def test_search_filter_and_sort(rooms: Path, tmp_path: Path) -> None:
    if CHROMIUM is None:
        pytest.skip("needs Chromium: make system")
    out = tmp_path / "out"
    build_site([rooms]).write(out)
    page = out / "environment-Kitchen.html"
    script = """
    window.addEventListener("load", () => {
      const said = [];
      const type = (box, text) => { box.value = text; box.dispatchEvent(new Event("input")); };
      const search = document.getElementById("site-search");
      type(search, "CORNER cook");
      const results = document.getElementById("site-results");
      said.push([...results.querySelectorAll("a")].map((a) => a.getAttribute("href")).join());
      const rows = () => [...document.querySelectorAll("#features tbody tr")]
        .filter((row) => !row.hidden).map((row) => row.id.slice(8)).join();
      said.push(rows());
      document.querySelectorAll("#features th button")[0].click();
      said.push(rows());
      document.querySelectorAll("#features th button")[1].click();
      document.querySelectorAll("#features th button")[1].click();
      said.push(rows());
      type(document.querySelector("input[data-filter=features]"), "bake");
      said.push(rows());
      document.title = said.join(" | ");
    });"""
    page.write_text(page.read_text().replace("</body>", f"<script>{script}</script></body>"))
    done = subprocess.run(
        [CHROMIUM, "--headless", "--no-sandbox", "--disable-gpu", "--no-first-run",
         "--disable-background-networking", "--proxy-server=127.0.0.1:9",
         f"--user-data-dir={tmp_path / 'profile'}", "--virtual-time-budget=4000", "--dump-dom",
         page.as_uri()],
        capture_output=True, text=True, check=False, timeout=120,
    )  # fmt: skip
    title = re.search(r"<title>(.*?)</title>", done.stdout)
    assert title, done.stderr
    assert title[1] == (
        "module-rooms.html#Corner | Stove,Oven,Sink | Oven,Sink,Stove | Sink,Oven,Stove | Oven"
    )


def test_environment_iri_is_what_pages_are_made_for(bundled: Site) -> None:
    assert bundled.evidence is not None
    graph = bundled.library.graph
    for environment in bundled.evidence.environments:
        assert (URIRef(environment.iri), RDFS.subClassOf, URIRef(ENVIRONMENT)) in graph
