"""Robot Framework keywords: ask questions in sentences that an expert of the domain reads.

Robot Framework itself is not imported: it takes keyword names from attributes, and the extra
``acceptance`` installs it.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from symboslam.errors import UnknownNameError
from symboslam.reasoning.questions import model
from symboslam.reasoning.questions.compare import TOLERANCE, show, size
from symboslam.reasoning.questions.manifest import default_manifest, load_manifest
from symboslam.reasoning.questions.model import Question, Result, Table
from symboslam.reasoning.questions.query import prefixes_of
from symboslam.reasoning.questions.run import Interview
from symboslam.reasoning.vocabulary import DOCUMENTS

if TYPE_CHECKING:
    from symboslam.reasoning.knowledge import Knowledge

F = TypeVar("F", bound=Callable[..., Any])


def named(name: str) -> Callable[[F], F]:
    """Give a keyword a name, which may hold arguments in ``${...}``."""

    def mark(function: F) -> F:
        function.robot_name = name  # type: ignore[attr-defined]
        return function

    return mark


class Skipped(Exception):
    """Tells Robot Framework that a test is skipped."""

    ROBOT_SKIP_EXECUTION = True
    ROBOT_SUPPRESS_NAME = True


class Keywords:
    """Questions of a manifest, and what features say about environments.

    Args:
        manifest: the manifest; ours if left out.
        each: make a test of every question of the manifest.
        reasoner: ask the reasoner; without it, what needs it is skipped.
    """

    ROBOT_LIBRARY_SCOPE = "SUITE"
    ROBOT_LISTENER_API_VERSION = 3
    ROBOT_AUTO_KEYWORDS = False

    def __init__(
        self, manifest: str = "", each: bool | str = False, reasoner: bool | str = True
    ) -> None:
        self.ROBOT_LIBRARY_LISTENER = self
        self._each, self._reasoning = _is_true(each), _is_true(reasoner)
        self._manifest = Path(manifest) if manifest else default_manifest()
        self._ontology: str | None = None
        self._result: Result | None = None

    # What Robot Framework calls.

    def start_suite(self, data: Any, result: Any) -> None:
        """Add a test for every question, under its own words."""
        if not self._each:
            return
        for question in self._questions.values():
            name = f"{question.id}: {question.text}"
            test = data.tests.create(name=name, tags=[question.group or question.kind])
            test.body.create_keyword(name=f'The question "{question.id}" should pass')

    def end_suite(self, data: Any, result: Any) -> None:
        """Stop the reasoner."""
        if "_interview" in self.__dict__:
            self._interview.close()
            del self._interview

    @cached_property
    def _questions(self) -> dict[str, Question]:
        return {question.id: question for question in load_manifest(self._manifest)}

    @cached_property
    def _interview(self) -> Interview:
        interview = Interview(list(self._questions.values()), reasoning=self._reasoning)
        interview.prepare()
        return interview

    # Questions.

    @named("Load the questions")
    def load_the_questions(self, manifest: str = "") -> int:
        """Read a manifest, ours if none is given; returns the number of questions."""
        self.end_suite(None, None)
        self._manifest = Path(manifest) if manifest else default_manifest()
        self.__dict__.pop("_questions", None)
        return len(self._questions)

    @named("Ask question")
    def ask_question(self, identifier: str) -> str:
        """Ask one question of the manifest; returns its status."""
        if identifier not in self._questions:
            raise UnknownNameError(f"no question {identifier!r} in {self._manifest}")
        self._result = self._interview.ask(self._questions[identifier])
        return self._result.status

    @named("The answer should be as expected")
    def the_answer_should_be_as_expected(self) -> None:
        """Fail unless the question asked last has passed."""
        result = self._asked()
        if result.status in (model.SKIPPED, model.KNOWN_FAILING):
            raise Skipped(result.message)
        if result.bad:
            raise AssertionError(f"{result.status}: {result.question.text}\n{result.message}")

    @named('The question "${identifier}" should pass')
    def the_question_should_pass(self, identifier: str) -> None:
        """Ask a question and fail unless the answer is as expected."""
        self.ask_question(identifier)
        self.the_answer_should_be_as_expected()

    @named('All questions about "${group}" should pass')
    def all_questions_about_should_pass(self, group: str) -> None:
        """Ask every question of a group; one that is known to fail or skipped does not count."""
        asked = [q for q in self._questions.values() if q.group.casefold() == group.casefold()]
        if not asked:
            raise UnknownNameError(f"no question is about {group!r}")
        bad = [r for r in map(self._interview.ask, asked) if r.bad]
        if bad:
            raise AssertionError("\n".join(f"{r.question.id}: {r.message}" for r in bad))

    @named("The answer should have ${number} rows")
    def the_answer_should_have_rows(self, number: str) -> None:
        """Compare the number of rows."""
        answer = self._asked().answer
        found = 0 if answer is None else size(answer)
        if found != int(number):
            raise AssertionError(f"the answer has {found} rows")

    @named("The answer should mention")
    def the_answer_should_mention(self, *words: str) -> None:
        """Look for a row that holds all of the words."""
        result = self._asked()
        question, answer = result.question, result.answer
        prefixes = prefixes_of(question.query) if question.query else {}
        rows = answer.rows if isinstance(answer, Table) else ()
        shown = [" ".join(show(term, prefixes) for term in row) for row in rows]
        if not any(all(word.casefold() in row.casefold() for word in words) for row in shown):
            raise AssertionError(f"no row mentions {', '.join(words)}:\n" + "\n".join(shown[:20]))

    def _asked(self) -> Result:
        if self._result is None:
            raise AssertionError("no question has been asked: use `Ask question` first")
        return self._result

    # Features and environments.

    @named("Load the ontology")
    def load_the_ontology(self, file: str = "") -> None:
        """Choose the ontology that features are looked up in: ours, or that of a file."""
        self._ontology = file or None
        self.__dict__.pop("_knowledge", None)
        self._knowledge  # noqa: B018 (read now, so that its errors are this keyword's)

    @cached_property
    def _knowledge(self) -> Knowledge:
        from symboslam.reasoning.knowledge import Knowledge

        return Knowledge.load(self._ontology)

    @named("${feature} should indicate ${environment} with strength ${strength}")
    def should_indicate_with_strength(self, feature: str, environment: str, strength: str) -> None:
        """Compare the strength of the strongest indication."""
        found = self._strength(feature, environment)
        if found is None:
            raise AssertionError(f"{feature} does not indicate {environment}")
        if abs(found - float(strength)) > TOLERANCE:
            raise AssertionError(f"{feature} indicates {environment} with strength {found:g}")

    @named("${feature} should indicate ${environment}")
    def should_indicate(self, feature: str, environment: str) -> None:
        """Fail unless there is an indication, of whatever strength."""
        if self._strength(feature, environment) is None:
            raise AssertionError(f"{feature} does not indicate {environment}")

    @named("${feature} should not indicate ${environment}")
    def should_not_indicate(self, feature: str, environment: str) -> None:
        """Fail if there is an indication."""
        if (found := self._strength(feature, environment)) is not None:
            raise AssertionError(f"{feature} indicates {environment} with strength {found:g}")

    @named("${feature} should stay in its place")
    def should_stay(self, feature: str) -> None:
        """Fail unless a feature is static."""
        if not self._knowledge.get_feature(feature).static:
            raise AssertionError(f"{feature} is dynamic")

    @named("${feature} should come and go")
    def should_move(self, feature: str) -> None:
        """Fail unless a feature is dynamic."""
        if self._knowledge.get_feature(feature).static:
            raise AssertionError(f"{feature} is static")

    def _strength(self, feature: str, environment: str) -> float | None:
        known = self._knowledge.get_feature(feature)
        wanted = environment.replace(" ", "").casefold()
        found = [
            indication.proximity
            for indication in self._knowledge.indications_of(known.name)
            if indication.environment.casefold() == wanted
        ]
        return max(found, default=None)

    # Data.

    @named("Data should be refused")
    def data_should_be_refused(self, file: str, *ontologies: str) -> None:
        """Fail unless data contradicts the ontology: ours, or the given files or documents."""
        self._provoke(file, ontologies, refused=True)

    @named("Data should be accepted")
    def data_should_be_accepted(self, file: str, *ontologies: str) -> None:
        """Fail if data contradicts the ontology: ours, or the given files or documents."""
        self._provoke(file, ontologies, refused=False)

    def _provoke(self, file: str, ontologies: tuple[str, ...], refused: bool) -> None:
        if not self._reasoning:
            raise Skipped("it needs the reasoner")
        targets = ontologies or (f"{DOCUMENTS}symboslam",)
        question = Question(
            id=file,
            text=f"Is {file} refused?",
            kind=model.PROVOCATION if refused else model.INFERENCE,
            data=(Path(file),),
            ontologies=tuple(t if t.startswith(DOCUMENTS) else Path(t) for t in targets),
        )
        interview = Interview([question])
        try:
            result = interview.ask(question)
        finally:
            interview.close()
        if result.bad:
            raise AssertionError(f"{file}: {result.message}")


def _is_true(value: bool | str) -> bool:
    return str(value).strip().casefold() not in ("", "0", "false", "no", "off", "none")
