"""What a scan for pitfalls costs, on real ontologies and on ever larger made-up ones."""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path
from random import Random

from bench.measure import Run, process, table

ROOT = Path(__file__).resolve().parents[1]
SYMBOSLAM = [sys.executable, "-m", "symboslam"]
SHARED = ROOT.parent / "shared"
REAL = (
    SHARED / "data" / "oops-cases" / "input" / "pizza.owl",
    SHARED / "upstream" / "Onto4MAT.owl",
)
TRIPLES_PER_CLASS = 13.3
HEAD = """@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
@prefix skos: <http://www.w3.org/2004/02/skos/core#> .
@prefix dcterms: <http://purl.org/dc/terms/> .
@prefix : <https://example.org/made-up#> .
<https://example.org/made-up> a owl:Ontology ;
    dcterms:license <https://creativecommons.org/publicdomain/zero/1.0/> .
"""
WORDS = "soil water lake river forest sea air ice sand rock urban farm marsh reef cave dune".split()


def pitfalls(sizes: Sequence[int], repeat: int = 3) -> str:
    """Scans as whole processes, from the start of Python to its end."""
    rows: list[list[object]] = []
    with tempfile.TemporaryDirectory() as folder:
        for path in (path for path in REAL if path.is_file()):
            run = _scan(repeat, str(path), "--imports", "ignore")
            rows.append([f"`{path.name}`", _triples(path), *_figures(run), ""])
        run = _scan(repeat, "https://w3id.org/symboslam/symboslam")
        rows.append(["our ontology, all modules", "", *_figures(run), ""])
        for shape, make in SHAPES.items():
            before: tuple[int, float] | None = None
            for size in sizes if make is made_up else sizes[1:3]:
                path = Path(folder) / "made-up.ttl"
                path.write_text(make(size), encoding="utf-8")
                run = _scan(repeat if size < 100_000 else 1, str(path))
                growth = run.seconds / before[1] / (size / before[0]) if before else None
                times = "" if growth is None else f"{growth:.2f}"
                rows.append([shape, f"{size:,}", *_figures(run), times])
                before = (size, run.seconds)
    head = ("ontology", "triples", "seconds", "peak MB", "times linear from the line above")
    return (
        f"## Pitfalls (whole process `symboslam pitfalls`, medians of {repeat}, one run from "
        "100,000 triples)\n\n"
        "All rules, WordNet's included where it is installed. What is made up like ENVO is a deep "
        "hierarchy of named classes, each with label, definition, synonyms and every third with a "
        "restriction. The other shapes are the worst for rules that compare things with each "
        "other.\n\n" + table(head, rows)
    )


def made_up(triples: int) -> str:
    """An ontology in Turtle of about so many triples, the same every time."""
    random = Random(triples)
    lines = [HEAD]
    for number in range(20):
        lines += [
            f":relates{number} a owl:ObjectProperty ; rdfs:domain :C0 ; rdfs:range :C{number} ;",
            f'    rdfs:label "relates {number}"@en ; rdfs:comment "Relation number {number}."@en .',
        ]
    for number in range(max(int(triples / TRIPLES_PER_CLASS), 30)):
        words = " ".join(random.sample(WORDS, 2))
        above = f"rdfs:subClassOf :C{random.randrange(max(number, 1))} ; " if number else ""
        lines += [
            f':C{number} a owl:Class ; {above}rdfs:label "{words} {number}"@en ;',
            f'    rdfs:comment "A {words} of kind {number}, made up."@en ;',
            f'    skos:definition "A {words} that is number {number} of its kind."@en ;',
            f'    skos:altLabel "{words}"@en , "{words} {number}"@en , "kind {number}"@en ;',
            f'    skos:notation "C{number}" ; rdfs:isDefinedBy <https://example.org/made-up> ;',
            f'    skos:example "{words} no. {number}"@en ; skos:editorialNote "made up"@en',
        ]
        if number % 3 == 0 and number:
            lines.append(
                f"    ; rdfs:subClassOf [ a owl:Restriction ; owl:onProperty "
                f":relates{number % 20} ; owl:someValuesFrom :C{random.randrange(number)} ]"
            )
        lines.append("    .")
    lines.append("[] a owl:AllDisjointClasses ; owl:members ( :C1 :C2 ) .")
    return "\n".join(lines) + "\n"


def deep(triples: int) -> str:
    """A chain of classes, each below the one before."""
    return _classes(
        triples, 4, lambda n: f":C{n}", lambda n: f"rdfs:subClassOf :C{max(n - 1, 0)} ;"
    )


def alike(triples: int) -> str:
    """Classes of one label, each equivalent to the one before."""
    return _classes(triples, 4, lambda _: "thing", lambda n: f"owl:equivalentClass :C{n - 1} ;")


def synonyms(triples: int) -> str:
    """Classes called car and automobile by turns, in one list of disjoint classes."""
    number = triples // 5
    members = " ".join(f":C{n}" for n in range(number))
    names = ("car", "automobile")
    return (
        _classes(number * 3, 3, lambda n: names[n % 2], lambda _: "")
        + f"[] a owl:AllDisjointClasses ; owl:members ( {members} ) .\n"
    )


def undeclared(triples: int) -> str:
    """One union of classes that are declared nowhere."""
    members = " ".join(f":U{n}" for n in range(triples // 2))
    return HEAD + f":C0 a owl:Class ; rdfs:subClassOf [ owl:unionOf ( {members} ) ] .\n"


def _classes(
    triples: int, each: int, label: Callable[[int], str], more: Callable[[int], str]
) -> str:
    return HEAD + "\n".join(
        f':C{n} a owl:Class ; {more(n)} rdfs:label "{label(n)}"@en ; rdfs:comment "No. {n}."@en .'
        for n in range(triples // each)
    )


SHAPES = {
    "made up, like ENVO": made_up,
    "one chain of subclasses": deep,
    "one label, equivalent in a chain": alike,
    "two synonyms, all disjoint": synonyms,
    "one union of undeclared classes": undeclared,
}


def _scan(repeat: int, *arguments: str) -> Run:
    """The run of median time; pitfalls that were found are no failure here."""
    shell = '"$0" -m symboslam pitfalls "$@" || [ $? -eq 1 ]'
    command = ["bash", "-c", shell, sys.executable, *arguments, "--format", "json"]
    runs = sorted((process(command) for _ in range(repeat)), key=lambda run: run.seconds)
    return runs[len(runs) // 2]


def _figures(run: Run) -> tuple[str, str]:
    return f"{run.seconds:.2f}", f"{run.peak_mb:.0f}"


def _triples(path: Path) -> str:
    from symboslam.reasoning.parsing import parse

    return f"{len(parse(path.name, path.read_bytes())):,}"
