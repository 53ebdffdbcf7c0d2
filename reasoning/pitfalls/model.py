"""What the scanner speaks of: pitfalls, findings, results and the report of a scan."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING

from symboslam.errors import SymboSlamError
from symboslam.reasoning.sources import Place

if TYPE_CHECKING:
    from symboslam.reasoning.axioms import Triple


class Severity(StrEnum):
    """How much a pitfall matters; the importance levels of the catalogue."""

    CRITICAL = "critical"
    IMPORTANT = "important"
    MINOR = "minor"


class Status(StrEnum):
    """What came of a rule."""

    CHECKED = "checked"
    NOT_CHECKED = "not checked"
    ERRORED = "errored"


NOT_SELECTED = "not selected"
"""Why a pitfall was not looked for, if nobody asked for it."""


class NotCheckedError(SymboSlamError):
    """A rule that cannot be applied here and now; the message says why."""


@dataclass(frozen=True)
class Pitfall:
    """An entry of the catalogue.

    Attributes:
        code: ``P01`` to ``P41``.
        title: as OOPS! calls it.
        severity: as the live OOPS! service has it.
        affects: kinds of what has the pitfall: ``class``, ``object property``,
            ``datatype property``, ``ontology``.
        categories: of the catalogue, such as ``N1`` (modelling decisions) and ``S4`` (consistency).
        description: what is wrong with it, in a sentence or two.
        remedy: how to mend it, in a sentence.
        advisory: a hint for people, by a rule of ours: OOPS! has none.
        variants: code -> title, where OOPS! tells several forms apart (``P08-L``).
        oops_group: class of OOPS!'s vocabulary for a finding of several elements
            (``sameLabel``); empty where it lists elements one by one.
        oops_severity: what the present source of OOPS! says, where the live service differs.
    """

    code: str
    title: str
    severity: Severity
    affects: tuple[str, ...]
    categories: tuple[str, ...]
    description: str
    remedy: str
    advisory: bool = False
    variants: Mapping[str, str] = field(default_factory=dict)
    oops_group: str = ""
    oops_severity: Severity | None = None


@dataclass(frozen=True)
class Finding:
    """One occurrence of a pitfall.

    Attributes:
        elements: IRIs of what has the pitfall, what it is mainly about first; none stands for the
            ontology as a whole.
        message: what is wrong here, in a sentence without a full stop at its end.
        axioms: the triples that are at fault or lead there, the one whose line counts first; none
            stands for the declaration of the first element.
        mend: how to mend it here; the pitfall's ``remedy`` by default.
        variant: which form of the pitfall, such as ``P08-L``.
        oops_group: class of OOPS!'s vocabulary for the elements together; the pitfall's by default.
    """

    elements: tuple[str, ...]
    message: str
    axioms: tuple[Triple, ...] = ()
    mend: str = ""
    variant: str = ""
    oops_group: str = ""


@dataclass(frozen=True)
class Occurrence:
    """A finding with its place, and whether anybody has accepted it.

    Attributes:
        finding: what was found.
        iri: the first element, or the ontology.
        place: where.
        axiom: the axiom at fault, in words; empty where something is missing.
        accepted: the reason that the ontology gives for it, None if it gives none.
        known: in the baseline.
    """

    finding: Finding
    iri: str
    place: Place
    axiom: str = ""
    accepted: str | None = None
    known: bool = False

    @property
    def counts(self) -> bool:
        """Whether it is neither accepted nor known, so that it can fail a build."""
        return self.accepted is None and not self.known


@dataclass(frozen=True)
class Result:
    """What came of one rule.

    Attributes:
        pitfall: which.
        status: whether it was looked for.
        reason: why it was not, or what went wrong; empty if checked.
        occurrences: what was found, by file, line and elements.
    """

    pitfall: Pitfall
    status: Status
    reason: str = ""
    occurrences: tuple[Occurrence, ...] = ()

    @property
    def counting(self) -> tuple[Occurrence, ...]:
        """What was found and is neither accepted nor known."""
        return tuple(o for o in self.occurrences if o.counts)


@dataclass(frozen=True)
class Settings:
    """How the rules are applied.

    Attributes:
        strict_oops: by OOPS!'s own rules, its defects included.
        online: ask the network, for P37 and P40.
        inherit: a sub-property has the domains and ranges of its super-properties (P11).
        wordnet: folder with WordNet's database files (``index.noun``, ``data.noun``), for P07, P30
            and P31.
        questions: a manifest of competency questions, for P09.
        seconds: time limit of the whole scan.
    """

    strict_oops: bool = False
    online: bool = False
    inherit: bool = True
    wordnet: Path = Path("/usr/share/wordnet")
    questions: Path | None = None
    seconds: float = 120.0


@dataclass(frozen=True)
class Report:
    """The results of a scan.

    Attributes:
        ontology: IRI of the ontology; the first file's name where it has none.
        files: the files that were scanned, as given.
        results: one for each of the 41 pitfalls, by code.
        settings: how it was done.
        notes: what a reader should know: imports that were not read, acceptances without effect.
        out_of_time: the time limit was reached before all rules had run.
        compared: it was compared with a baseline.
    """

    ontology: str
    files: tuple[str, ...]
    results: Sequence[Result]
    settings: Settings
    notes: tuple[str, ...] = ()
    out_of_time: bool = False
    compared: bool = False

    def failing(self, level: Severity, advisory: bool = False) -> Iterator[Occurrence]:
        """What is at least as severe as ``level`` and neither accepted nor known.

        Args:
            level: the least severity that counts.
            advisory: count advisory pitfalls too.
        """
        order = list(Severity)
        for result in self.results:
            severe = order.index(result.pitfall.severity) <= order.index(level)
            if severe and (advisory or not result.pitfall.advisory):
                yield from result.counting
