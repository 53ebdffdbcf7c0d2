"""What the competency question code hands around: questions, answers, results."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

from pyoxigraph import BlankNode, Literal, NamedNode, Triple

from symboslam.reasoning.questions import vocabulary as v

Term = NamedNode | BlankNode | Literal | Triple

PASSED, FAILED, KNOWN_FAILING = "passed", "failed", "known failing"
BROKEN, SKIPPED = "broken", "skipped"
STATUSES = (PASSED, FAILED, KNOWN_FAILING, BROKEN, SKIPPED)

QUESTION = "competency question"
INFERENCE = "inference verification"
PROVOCATION = "error provocation"
ANNOTATION = "annotation verification"


@dataclass(frozen=True)
class Table:
    """Rows of a SELECT query.

    Attributes:
        columns: names of the variables.
        rows: one term for each column, None where there is none.
        lexical: the terms are known as text only (CSV, YAML); language and datatype do not count.
    """

    columns: tuple[str, ...]
    rows: tuple[tuple[Term | None, ...], ...]
    lexical: bool = False


@dataclass(frozen=True)
class Triples:
    """The graph of a CONSTRUCT or DESCRIBE query."""

    triples: tuple[Triple, ...]


@dataclass(frozen=True)
class RowCount:
    """How many rows are expected; None is no limit."""

    least: int | None = None
    most: int | None = None


@dataclass(frozen=True)
class Contains:
    """Rows that have to be among the answers; each says some columns only."""

    rows: tuple[tuple[tuple[str, Term], ...], ...]


Answer = bool | Table | Triples
Expected = Answer | RowCount | Contains


@dataclass(frozen=True)
class Query:
    """A SPARQL query and where it stands.

    Attributes:
        text: the query.
        file: the file that holds it.
        line: the line of ``file`` on which it starts.
        prefixes: prefixes that it may use without declaring them.
        inline: it stands inside a manifest.
    """

    text: str
    file: Path
    line: int = 1
    prefixes: tuple[tuple[str, str], ...] = ()
    inline: bool = False


@dataclass(frozen=True)
class InlineData:
    """Turtle that a manifest holds itself."""

    text: str
    file: Path
    line: int


Data = Path | InlineData


@dataclass(frozen=True)
class Question:
    """One test case of a manifest.

    Attributes:
        id: its name, unique in all manifests that are read together.
        text: the question, or what is verified, in words.
        kind: one of ``QUESTION``, ``INFERENCE``, ``PROVOCATION``, ``ANNOTATION``.
        group: the heading that it stands under.
        query: what is asked; None for error provocations and the like.
        expected: the right answer; None if any will do.
        data: files with individuals.
        ontologies: files, or IRIs of bundled documents.
        regime: IRI of the entailment regime.
        columns: the columns that count; empty for all.
        known_failing: why a failure is expected; empty if it is not.
        skip: why it is not to be asked; empty if it is.
        shapes: SHACL files of an annotation verification.
        manifest: the file that states it.
        line: where it does.
    """

    id: str
    text: str
    kind: str = QUESTION
    group: str = ""
    query: Query | None = None
    expected: Expected | None = None
    data: tuple[Data, ...] = ()
    ontologies: tuple[str | Path, ...] = ()
    regime: str = v.SIMPLE
    columns: tuple[str, ...] = ()
    known_failing: str = ""
    skip: str = ""
    shapes: tuple[Path, ...] = ()
    manifest: Path = Path()
    line: int = 1

    @property
    def needs_reasoner(self) -> bool:
        """Whether HermiT has to be asked."""
        return self.kind in (INFERENCE, PROVOCATION) or self.regime == v.OWL_DIRECT


@dataclass(frozen=True)
class Result:
    """What became of a question.

    Attributes:
        question: the question.
        status: one of ``STATUSES``.
        seconds: how long it took; loading what it shares with others is not in it.
        message: why it did not pass, or a remark; may have several lines.
        answer: what the query answered; None if it was not asked.
    """

    question: Question
    status: str
    seconds: float = 0.0
    message: str = ""
    answer: Answer | None = None

    @property
    def bad(self) -> bool:
        """Whether the run has failed because of it."""
        return self.status in (FAILED, BROKEN)


@dataclass(frozen=True)
class Report:
    """The results of a run, in the order of the manifest.

    Attributes:
        title: what was run.
        results: one for each question.
        seconds: the whole run, loading included.
    """

    title: str
    results: tuple[Result, ...] = ()
    seconds: float = 0.0
    counts: Counter[str] = field(default_factory=Counter, init=False)

    def __post_init__(self) -> None:
        self.counts.update(result.status for result in self.results)

    @property
    def ok(self) -> bool:
        """Whether nothing failed and nothing is broken."""
        return not any(result.bad for result in self.results)

    @property
    def groups(self) -> dict[str, Sequence[Result]]:
        """Results by heading, in the order in which the headings first appear."""
        found: dict[str, list[Result]] = {}
        for result in self.results:
            found.setdefault(result.question.group or result.question.kind + "s", []).append(result)
        return dict(found)
