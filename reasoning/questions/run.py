"""Ask questions and judge the answers."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from fnmatch import fnmatchcase
from pathlib import Path
from time import perf_counter

from symboslam.errors import InputError, UnknownNameError
from symboslam.reasoning._base import Reasoner
from symboslam.reasoning.questions import model
from symboslam.reasoning.questions import vocabulary as v
from symboslam.reasoning.questions.compare import difference, shorten, size
from symboslam.reasoning.questions.dataset import Datasets
from symboslam.reasoning.questions.model import Answer, Query, Question, Report, Result
from symboslam.reasoning.questions.query import (
    ask,
    close_to,
    is_ordered,
    prefixes_of,
    unknown_terms,
)

Progress = Callable[[str, float], None]


def choose(questions: Sequence[Question], patterns: Iterable[str]) -> list[Question]:
    """The questions that one of the patterns fits, by identifier or group; all without patterns.

    ``*`` stands for anything; a pattern without wildcards may be any part of the name.

    Raises:
        UnknownNameError: a pattern fits none.
    """
    found: dict[str, Question] = {}
    wanted = list(patterns)
    for pattern in wanted:
        plain = not any(c in pattern for c in "*?[")
        low = pattern.casefold()
        exact = [q for q in questions if q.id.casefold() == low or q.group.casefold() == low]
        fitting = exact or [
            q
            for q in questions
            for name in (q.id.casefold(), q.group.casefold())
            if (low in name if plain else fnmatchcase(name, low))
        ]
        if not fitting:
            ids = ", ".join(q.id for q in questions[:8])
            raise UnknownNameError(f"no question fits {pattern!r}; there are {ids}, ...")
        found.update((q.id, q) for q in fitting)
    return [q for q in questions if q.id in found] if wanted else list(questions)


def with_files(
    questions: Iterable[Question],
    ontologies: Sequence[Path | str] = (),
    data: Sequence[Path] = (),
) -> list[Question]:
    """The questions, asked of another ontology if one is given, and of more data.

    Raises:
        InputError: a file does not exist.
    """
    for path in (*ontologies, *data):
        if isinstance(path, Path) and not path.is_file():
            raise InputError(f"{path}: there is no such file")
    return [
        replace(q, ontologies=tuple(ontologies) or q.ontologies, data=(*q.data, *data))
        for q in questions
    ]


class Interview:
    """Asks questions one by one; what they share is read and reasoned over once.

    Args:
        questions: the questions that may be asked.
        reasoner: HermiT if left out.
        reasoning: ask the reasoner; without it, the questions that need it are skipped.
        strict: refuse ontologies with missing or cyclic imports.
    """

    def __init__(
        self,
        questions: Sequence[Question],
        *,
        reasoner: Reasoner | None = None,
        reasoning: bool = True,
        strict: bool = True,
    ) -> None:
        from symboslam.reasoning.hermit import Hermit

        self.reasoning = reasoning
        self.asking = [q for q in questions if not self._skipped(q)]
        self.datasets = Datasets(reasoner or Hermit(), strict)

    def prepare(self) -> None:
        """Read everything, then start the reasoner, which works on in the background.

        Raises:
            InputError: input data does not parse.
            OntologyError: an ontology does not parse, or lacks an import.
        """
        for question in self.asking:
            self.datasets.stated(question)
        self.datasets.prepare(self.asking)

    def ask(self, question: Question) -> Result:
        """The result of one question.

        Raises:
            InputError: input data does not parse.
            OntologyError: an ontology does not parse, is outside OWL 2 DL, or lacks an import.
            ReasonerError: the reasoner could not be run.
        """
        if skipped := self._skipped(question):
            return Result(question, model.SKIPPED, message=skipped)
        known = self.datasets.stated(question).terms
        if question.query is not None:
            self.datasets.store(question)  # shared: its making is not counted
        start = perf_counter()
        result = _broken(question, known) or self._judge(question)
        result = replace(result, seconds=perf_counter() - start)
        if not question.known_failing:
            return result
        if result.bad:
            text = f"{question.known_failing}\n{result.message}"
            return replace(result, status=model.KNOWN_FAILING, message=text)
        note = f"it passes, though it is said to be failing: {question.known_failing}"
        return replace(result, message=f"{result.message}\n{note}".strip())

    def close(self) -> None:
        """Wait for the reasoner, and start it no more."""
        self.datasets.close()

    def _skipped(self, question: Question) -> str:
        """Why a question is not asked; empty if it is."""
        needs = "it needs the reasoner" if question.needs_reasoner and not self.reasoning else ""
        return question.skip or needs

    def _judge(self, question: Question) -> Result:
        if question.kind == model.PROVOCATION:
            return self._provoke(question)
        if question.kind == model.ANNOTATION:
            from symboslam.reasoning.questions.annotation import violations

            text = violations(self.datasets.stated(question), question.shapes)
            return Result(question, model.FAILED if text else model.PASSED, message=text)
        contradiction = "ontology and data contradict each other"
        if question.query is None:
            good = self.datasets.consistent(question)
            message = "" if good else contradiction
            return Result(question, model.PASSED if good else model.FAILED, message=message)
        store = self.datasets.store(question)
        if store is None or (
            question.kind == model.INFERENCE
            and question.regime != v.OWL_DIRECT
            and not self.datasets.consistent(question)
        ):
            return Result(question, model.FAILED, message=contradiction)
        return _compare(question, question.query, ask(question.query, store))

    def _provoke(self, question: Question) -> Result:
        provoking = [q for q in self.asking if q.kind == model.PROVOCATION]
        text = ""
        if not self.datasets.ontologies_consistent(provoking)[question.ontologies]:
            text = "the ontology contradicts itself already without the data"
        elif self.datasets.consistent(question):
            text = "the data is not refused: with the ontology it is free of contradictions"
        return Result(question, model.FAILED if text else model.PASSED, message=text)


def run(
    questions: Sequence[Question],
    *,
    title: str = "competency questions",
    reasoner: Reasoner | None = None,
    reasoning: bool = True,
    strict: bool = True,
    progress: Progress | None = None,
) -> Report:
    """Ask all questions.

    Args:
        questions: the questions.
        title: name of the report.
        reasoner: HermiT if left out.
        reasoning: ask the reasoner; without it, the questions that need it are skipped.
        strict: refuse ontologies with missing or cyclic imports.
        progress: is told what is done and how far it is.

    Raises:
        InputError: input data does not parse.
        OntologyError: an ontology does not parse, is outside OWL 2 DL, or lacks an import.
        ReasonerError: the reasoner could not be run.
    """
    start = perf_counter()
    tell = progress or (lambda stage, share: None)
    results: dict[str, Result] = {}
    interview = Interview(questions, reasoner=reasoner, reasoning=reasoning, strict=strict)
    with contextlib.closing(interview):
        tell("reading", 0.02)
        interview.prepare()
        # The reasoner works on while the questions that can do without it are answered.
        for number, question in enumerate(sorted(questions, key=lambda q: q.needs_reasoner)):
            tell(question.id, 0.1 + 0.9 * number / len(questions))
            results[question.id] = interview.ask(question)
    ordered = tuple(results[question.id] for question in questions)
    return Report(title, ordered, perf_counter() - start)


def _broken(question: Question, known: frozenset[str]) -> Result | None:
    """A result for a question that looks for what nobody has heard of."""
    if question.query is None:
        return None
    unknown = unknown_terms(question.query, known)
    if not unknown:
        return None
    prefixes = prefixes_of(question.query)
    lines = []
    for term in unknown:
        close = [shorten(iri, prefixes) for iri in close_to(term, known)]
        hint = f"; close: {', '.join(close)}" if close else ""
        lines.append(f"neither ontology nor data knows {shorten(term, prefixes)}{hint}")
    return Result(question, model.BROKEN, message="\n".join(lines))


def _compare(question: Question, query: Query, answer: Answer) -> Result:
    expected = question.expected
    if expected is None and isinstance(answer, bool) and question.kind == model.INFERENCE:
        expected = True
    if expected is None:
        text = f"no answer is expected in particular; {size(answer)} found"
        return Result(question, model.PASSED, message=text, answer=answer)
    text = difference(
        expected,
        answer,
        columns=question.columns,
        ordered=is_ordered(query),
        prefixes=prefixes_of(query),
    )
    return Result(question, model.FAILED if text else model.PASSED, message=text, answer=answer)
