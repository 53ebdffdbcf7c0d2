"""Run the pitfall rules over an ontology; every rule ends as checked, not checked or errored."""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from types import FrameType

from rdflib import OWL, RDF, RDFS, URIRef

from symboslam.errors import InputError, OntologyError, SymboSlamError
from symboslam.reasoning.pitfalls.acceptance import Acceptances
from symboslam.reasoning.pitfalls.model import (
    NOT_SELECTED,
    Finding,
    NotCheckedError,
    Occurrence,
    Report,
    Result,
    Settings,
    Status,
)
from symboslam.reasoning.pitfalls.ontology import Document, Ontology
from symboslam.reasoning.pitfalls.registry import CODES, Rule, rule
from symboslam.reasoning.sources import CLOSURE, Place, bundled_name, read_closure, refuse
from symboslam.reasoning.vocabulary import DOCUMENTS

Progress = Callable[[str, float], None]
_AXIOMS = (
    RDFS.subClassOf, RDFS.subPropertyOf, RDFS.domain, RDFS.range, OWL.equivalentClass,
    OWL.equivalentProperty, OWL.inverseOf, OWL.disjointWith,
)  # fmt: skip
_REFUSED = ("missing-import", "cyclic-import", "empty-file")  # a byte-order mark is no harm here


class _OutOfTime(BaseException):
    """The time limit was reached; no ``except Exception`` on the way may keep it."""


def scan_pitfalls(
    targets: Sequence[str | Path] = (),
    settings: Settings | None = None,
    codes: Sequence[str] = CODES,
    follow: bool = True,
    strict_imports: bool = True,
    progress: Progress = lambda stage, share: None,
) -> Report:
    """Look for the pitfalls in an ontology.

    Several files are scanned as one ontology. Imports are read for what they declare, and findings
    are reported where a given file has a part in them; under ``strict_oops`` also in the imports,
    as OOPS! does.

    Args:
        targets: files, or IRIs of bundled modules; the whole bundled ontology if left out.
        settings: how the rules are applied.
        codes: the pitfalls to look for; the others are reported as not checked.
        follow: read the imports.
        strict_imports: refuse imports that are missing or go in a circle, instead of noting them.
        progress: told the stage and the share that is done.

    Raises:
        InputError: a file cannot be read, is no ontology, or takes longer than the time limit.
        OntologyError: a file does not parse, or an import is missing.
    """
    settings = settings or Settings()
    with _time_limit(settings.seconds):
        progress("reading the ontology", 0.02)
        try:
            ontology = load(targets, follow, strict_imports)
        except _OutOfTime:
            raise InputError(
                f"reading took longer than the time limit of {settings.seconds:g} s "
                "(--seconds raises it)"
            ) from None
        accepted = Acceptances(ontology)
        results = list(_run(ontology, settings, codes, progress))
    results = [accepted.apply(result) for result in results]
    return Report(
        ontology=ontology.iri,
        files=tuple(d.name for d in ontology.documents if d.given),
        results=results,
        settings=settings,
        notes=(*_notes(ontology, follow), *accepted.notes(results, settings.strict_oops)),
        out_of_time=any(result.reason == _late(settings) for result in results),
    )


def load(targets: Sequence[str | Path], follow: bool, strict_imports: bool) -> Ontology:
    """The ontology in files, ready for the rules.

    Raises:
        InputError: a file cannot be read.
        OntologyError: a file does not parse, states no ontology, or an import is missing.
    """
    sources = read_closure(targets or [CLOSURE], strict=False, follow=follow)
    refuse(note for note in sources.notes if strict_imports and note.kind in _REFUSED)
    given = [_shown(target) for target in targets] or list(sources.documents)
    names = dict.fromkeys([*given, *sources.documents])  # as given, then what they import
    documents = [
        Document(n, sources.documents[n], Path(n) if Path(n).is_file() else None, n in given)
        for n in names
        if n in sources.documents  # not if it was given twice under different names
    ]
    ontology = Ontology(sources, documents, sources.missing)
    if not _is_ontology(ontology):
        shown = ", ".join(given)
        raise OntologyError(f"{shown}: it declares no class and no property; is it an ontology?")
    return ontology


def _is_ontology(ontology: Ontology) -> bool:
    """Whether anything is declared, or stated of classes or properties."""
    declared = ontology.terms or ontology.annotation_properties
    axioms = any(map(ontology.statements, _AXIOMS))
    return bool(declared) or axioms or OWL.Ontology in ontology.graph.objects(None, RDF.type)


def _shown(target: str | Path) -> str:
    """What a file or a bundled module is called in places."""
    text = str(target)
    return bundled_name(text) if text.startswith(DOCUMENTS) else str(Path(target))


def _run(
    ontology: Ontology, settings: Settings, codes: Sequence[str], progress: Progress
) -> Iterator[Result]:
    late = ""
    for at, code in enumerate(CODES):
        one = rule(code)
        if code not in codes:
            yield Result(one.PITFALL, Status.NOT_CHECKED, NOT_SELECTED)
        elif late:
            yield Result(one.PITFALL, Status.NOT_CHECKED, late)
        else:
            progress(f"{code} {one.PITFALL.title}", 0.2 + 0.8 * at / len(CODES))
            try:
                yield _check(one, ontology, settings)
            except _OutOfTime:
                late = _late(settings)
                yield Result(one.PITFALL, Status.NOT_CHECKED, late)


def _late(settings: Settings) -> str:
    return f"the time limit of {settings.seconds:g} s was reached (--seconds raises it)"


def _check(one: Rule, ontology: Ontology, settings: Settings) -> Result:
    """The result of a rule; whatever a rule raises is told, so that no crash looks like a pass."""
    check = getattr(one, "check_as_oops", one.check) if settings.strict_oops else one.check
    try:
        occurrences = [
            found
            for finding in check(ontology, settings)
            if (found := _locate(ontology, finding, settings.strict_oops))
        ]
    except NotCheckedError as why:
        return Result(one.PITFALL, Status.NOT_CHECKED, str(why))
    except SymboSlamError:  # what the user gave is wrong: a manifest that is not there
        raise
    except Exception as error:  # any defect of a rule
        return Result(one.PITFALL, Status.ERRORED, f"{type(error).__name__}: {error}")
    occurrences.sort(key=_order)
    return Result(one.PITFALL, Status.CHECKED, "", tuple(occurrences))


def _order(o: Occurrence) -> tuple[str, int, tuple[str, ...], str, str]:
    f = o.finding
    return o.place.file, o.place.line or 0, f.elements, f.variant, f.message


def _locate(ontology: Ontology, finding: Finding, everywhere: bool) -> Occurrence | None:
    """A finding with its place; None if no given file has a part in it."""
    finding = replace(finding, elements=tuple(map(str, finding.elements)))  # no URIRef leaves here
    first = next(iter(finding.elements), None)
    triples = [t for t in finding.axioms if ontology.place(t)]
    if not triples and first is not None:
        triples = [t for e in finding.elements if (t := ontology.declaration(URIRef(e)))]
    places = [place for t in triples if (place := ontology.place(t))]
    here = [place for place in places if place.file in ontology.given]
    if first is None:
        here = here or [_head(ontology)]
    elif not here and places and not everywhere:
        return None
    place = next(iter(here or places), _head(ontology))
    text = ontology.text(finding.axioms[0]) if finding.axioms else ""
    return Occurrence(finding, first or ontology.iri, place, text)


def _head(ontology: Ontology) -> Place:
    """Where the ontology is declared: the place of what concerns it as a whole."""
    triple = ontology.declaration(URIRef(ontology.iri))
    if triple and (place := ontology.place(triple)):
        return place
    return Place(next(d.name for d in ontology.documents if d.given), 1)


def _notes(ontology: Ontology, follow: bool) -> Iterable[str]:
    for note in ontology.sources.notes:
        yield note.message
    if not follow:
        for iri in ontology.unread:
            yield f"the import <{iri}> was not read, as asked"


@contextmanager
def _time_limit(seconds: float) -> Iterator[None]:
    """Raise ``_OutOfTime`` in here after so many seconds; in the main thread only."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return

    def late(_signal: int, _frame: FrameType | None) -> None:
        raise _OutOfTime

    before = signal.signal(signal.SIGALRM, late)
    signal.setitimer(signal.ITIMER_REAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
