"""Write what a scan found: the formats, and what they share."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from importlib import import_module

from symboslam.errors import InputError
from symboslam.reasoning.pitfalls.model import Occurrence, Report, Result, Severity, Status
from symboslam.reasoning.questions.report_junit import clean
from symboslam.reasoning.vocabulary import local_name

_WRITERS = {
    "text": ("text", "render"),
    "json": ("json", "render"),
    "md": ("md", "render"),
    "html": ("html", "render"),
    "sarif": ("sarif", "render"),
    "junit": ("junit", "render"),
    "oops-rdf": ("oops", "render_rdf"),
    "oops-xml": ("oops", "render_xml"),
}
FORMATS = tuple(_WRITERS)


def render(report: Report, form: str) -> str:
    """The report in one of ``FORMATS``.

    Characters that XML and UTF-8 cannot hold are replaced in all formats.

    Raises:
        InputError: there is no such format.
    """
    if form not in FORMATS:
        raise InputError(f"--format {form}: known formats are {', '.join(FORMATS)}")
    name, function = _WRITERS[form]
    module = import_module(f"symboslam.reasoning.pitfalls.report_{name}")
    write: Callable[[Report], str] = getattr(module, function)
    return clean(write(report))


def counts(report: Report) -> dict[str, int]:
    """How much was found and looked for.

    ``critical``, ``important`` and ``minor`` are what neither is accepted nor known; ``advisory``
    is likewise, and in none of the three.
    """
    found: Counter[str] = Counter()
    for result in report.results:
        found[result.status] += 1
        kind = "advisory" if result.pitfall.advisory else str(result.pitfall.severity)
        for o in result.occurrences:
            found["accepted" if o.accepted is not None else "known" if o.known else kind] += 1
    order = (*map(str, Severity), "advisory", *map(str, Status), "accepted", "known")
    return {name: found[name] for name in order}


def summary(report: Report) -> str:
    """The counts in words: ``3 critical, 2 important, 10 minor; 28 checked, 13 not checked``."""
    found = counts(report)

    def say(always: tuple[str, ...], some: tuple[str, ...]) -> str:
        return ", ".join(f"{found[n]} {n}" for n in always + some if n in always or found[n])

    parts = (
        say(tuple(Severity), ("advisory",)),
        say((Status.CHECKED,), (Status.NOT_CHECKED, Status.ERRORED)),
        say((), ("accepted", "known")),
    )
    return "; ".join(part for part in parts if part)


def most_severe_first(report: Report) -> list[Result]:
    """The results in which something was found; advisory pitfalls come last."""
    order = list(Severity)
    return sorted(
        (result for result in report.results if result.occurrences),
        key=lambda r: (r.pitfall.advisory, order.index(r.pitfall.severity), r.pitfall.code),
    )


def severity(result: Result) -> str:
    """How much a pitfall matters, and whether it is advisory, in words."""
    return f"{result.pitfall.severity}{', advisory' if result.pitfall.advisory else ''}"


def number(result: Result) -> str:
    """How many findings there are: ``2 + 1 accepted``."""
    accepted = sum(o.accepted is not None for o in result.occurrences)
    known = len(result.occurrences) - len(result.counting) - accepted
    more = [f"{n} {what}" for n, what in ((accepted, "accepted"), (known, "known")) if n]
    return " + ".join([str(len(result.counting)), *more])


def place(occurrence: Occurrence) -> str:
    """``file:line``."""
    file, line = occurrence.place
    return file if line is None else f"{file}:{line}"


def subject(occurrence: Occurrence) -> str:
    """The elements by their local names, by their IRIs where those would be the same."""
    elements = occurrence.finding.elements
    names = [local_name(element) or element for element in elements]
    shown = names if len({*names}) == len({*elements}) else elements
    return ", ".join(shown) or "ontology"


def shared_mends(result: Result) -> dict[str, str]:
    """What several findings say about how to mend them -> their variants; to be told once."""
    uses: dict[str, list[str]] = {}
    for occurrence in result.counting:
        uses.setdefault(occurrence.finding.mend, []).append(occurrence.finding.variant)
    return {
        mend: ", ".join(sorted({*variants} - {""}))
        for mend, variants in uses.items()
        if mend and len(variants) > 1
    }
