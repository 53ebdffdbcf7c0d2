"""What questions are asked of: an ontology, data, and what follows from them; each made once."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from functools import cached_property, partial
from pathlib import Path
from threading import Lock
from typing import TYPE_CHECKING, TypeVar

from pyoxigraph import DefaultGraph, Literal, NamedNode, Quad, RdfFormat, Store, Triple

from symboslam.errors import InputError
from symboslam.reasoning._base import Hierarchy, Reasoner
from symboslam.reasoning.questions import vocabulary as v
from symboslam.reasoning.questions.entailment import add_rdfs
from symboslam.reasoning.questions.manifest import quads_in
from symboslam.reasoning.questions.model import PROVOCATION, Data, Question, Term
from symboslam.reasoning.questions.rdf import graph_of, parse_quads, quads_of
from symboslam.reasoning.vocabulary import OWL_NAMESPACE

if TYPE_CHECKING:
    from importlib.resources.abc import Traversable

    from symboslam.reasoning.axioms import Axiom
    from symboslam.reasoning.questions.owl_direct import Logic

T = TypeVar("T")
Targets = tuple[str | Path, ...]
_WORKERS = 2  # HermiTs at a time; each is a process of its own


class Dataset:
    """An ontology with data.

    Args:
        quads: all that is stated.
    """

    def __init__(self, quads: Iterable[Quad]) -> None:
        self.quads = list(quads)

    @cached_property
    def terms(self) -> frozenset[str]:
        """Every IRI that is stated, as a name or as a datatype."""
        found: set[str] = set()
        for quad in self.quads:
            for term in (quad.subject, quad.predicate, quad.object, quad.graph_name):
                _add_iris(term, found)
        return frozenset(found)

    def store(self, follows: Iterable[Triple] = ()) -> Store:
        """A store of what is stated and of what follows."""
        store = Store()
        store.bulk_extend(self.quads)
        store.bulk_extend(Quad(t.subject, t.predicate, t.object) for t in follows)
        return store


def _add_iris(term: Term | DefaultGraph, found: set[str]) -> None:
    if isinstance(term, NamedNode):
        found.add(term.value)
    elif isinstance(term, Literal):
        found.add(term.datatype.value)
    elif isinstance(term, Triple):
        for part in (term.subject, term.predicate, term.object):
            _add_iris(part, found)


class Datasets:
    """All that the questions of a run share, each read and reasoned over once.

    HermiT works in the background: :meth:`prepare` starts it, the others wait for it.

    Args:
        reasoner: decides what follows under OWL-Direct.
        strict: refuse missing and cyclic imports.
    """

    def __init__(self, reasoner: Reasoner, strict: bool = True) -> None:
        self.reasoner, self.strict = reasoner, strict
        self._made: dict[Hashable, Future[object]] = {}
        self._lock = Lock()
        self._workers = ThreadPoolExecutor(_WORKERS, thread_name_prefix="hermit")

    def close(self) -> None:
        """Start nothing any more."""
        self._workers.shutdown(wait=True, cancel_futures=True)

    def _once(self, key: Hashable, make: Callable[[], T]) -> T:
        """What ``make`` returns; made by whoever asks first, the others wait."""
        with self._lock:
            waiting = self._made.get(key)
            if waiting is None:
                mine = self._made[key] = Future()
        if waiting is not None:
            return waiting.result()  # type: ignore[return-value]
        try:
            result = make()
        except BaseException as error:
            mine.set_exception(error)
            raise
        mine.set_result(result)
        return result

    # What is read.

    def ontology(self, targets: Targets) -> list[Quad]:
        """The statements of an ontology with its imports.

        Raises:
            OntologyError: it does not parse, or an import is missing or cyclic.
        """
        from symboslam.reasoning.sources import read_closure

        def make() -> list[Quad]:
            found = self._bundled(targets)
            if found is None:
                return quads_of(read_closure(targets, strict=self.strict).graph)
            return found

        return self._once(("ontology", targets), make)

    def _bundled(self, targets: Targets) -> list[Quad] | None:
        """The same for bundled documents, ten times faster; None if that does not do."""
        from symboslam.reasoning.sources import bundled_name, closure_files

        files = self._once("files", closure_files)
        waiting = [bundled_name(str(target)) for target in targets]
        found: dict[str, list[Quad]] = {}
        while waiting:
            name = waiting.pop()
            if name in found:
                continue
            if name not in files:
                return None
            try:
                found[name] = self._once(("module", name), partial(parse_module, files[name]))
            except InputError:
                return None  # the other way tells more about it
            waiting += (
                bundled_name(q.object.value)
                for q in found[name]
                if q.predicate.value == v.IMPORTS and isinstance(q.object, NamedNode)
            )
        return [quad for name in sorted(found) for quad in found[name]]

    def data(self, data: Data) -> list[Quad]:
        """The statements of input data."""
        return self._once(("data", data), lambda: quads_in(data))

    def all_data(self, question: Question) -> list[Quad]:
        """The statements of all input data of a question."""
        return [quad for data in question.data for quad in self.data(data)]

    def stated(self, question: Question) -> Dataset:
        """The ontology and data of a question."""
        return self._once(
            ("stated", question.ontologies, question.data),
            lambda: Dataset([*self.ontology(question.ontologies), *self.all_data(question)]),
        )

    # What follows.

    def store(self, question: Question) -> Store | None:
        """What a question is asked of; None if it contradicts itself under OWL-Direct."""
        stated = self.stated(question)
        regime = question.regime

        def make() -> Store | None:
            found = self.entailed(question) if regime == v.OWL_DIRECT else ()
            if found is None:
                return None
            store = stated.store(found)
            if regime != v.SIMPLE:
                add_rdfs(store)
            return store

        return self._once(("store", question.ontologies, question.data, regime), make)

    def logic(self, question: Question, with_data: bool = True) -> Logic:
        """The axioms of a question's ontology, and of its data."""
        from symboslam.reasoning.questions.owl_direct import Logic

        targets = question.ontologies
        own = self._once(("logic", targets), lambda: Logic.of(graph_of(self.ontology(targets))))
        if not with_data or not question.data:
            return own
        key = ("logic", targets, question.data)
        return self._once(key, lambda: own.with_data(self.all_data(question)))

    def consistent(self, question: Question, with_data: bool = True) -> bool:
        """Whether a question's ontology, with its data, is free of contradictions."""
        data = question.data if with_data else ()
        return self._once(
            ("consistent", question.ontologies, data),
            lambda: not self.reasoner.all_clashes([self.logic(question, with_data).module()])[0],
        )

    def ontologies_consistent(self, questions: Sequence[Question]) -> dict[Targets, bool]:
        """Which of the questions' ontologies, without data, are free of contradictions.

        One start of Java does for all of them, as long as they are.
        """
        own = {q.ontologies: q for q in questions}

        def make() -> dict[Targets, bool]:
            alone = [self.logic(q, with_data=False).module() for q in own.values()]
            clashing = self.reasoner.all_clashes(alone)
            return {t: not clash for t, clash in zip(own, clashing, strict=True)}

        return self._once(("consistent", frozenset(own)), make)

    def hierarchy(self, question: Question) -> Hierarchy | None:
        """The classes of a question's ontology; None if it contradicts itself."""
        own = self.logic(question, with_data=False)
        both = self.logic(question)
        alone = not own.has_members and not _has_terms(both.axioms[len(own.axioms) :])
        return self._once(
            ("hierarchy", question.ontologies, () if alone else question.data),
            lambda: self.reasoner.classify((own if alone else both).all()),
        )

    def entailed(self, question: Question) -> list[Triple] | None:
        """What follows under OWL-Direct; None if there is a contradiction."""
        from symboslam.reasoning.questions.owl_direct import realize, triples_of

        def make() -> list[Triple] | None:
            found = realize(self.logic(question), self.reasoner)
            hierarchy = self.hierarchy(question) if found is not None else None
            if found is None or hierarchy is None:
                return None
            return triples_of(hierarchy, found)

        return self._once(("entailed", question.ontologies, question.data), make)

    def prepare(self, questions: Sequence[Question]) -> None:
        """Start the reasoning that the questions will ask for; errors come when they do."""
        asking = [question for question in questions if question.needs_reasoner]
        provoking = [question for question in asking if question.kind == PROVOCATION]
        if provoking:
            self._workers.submit(self.ontologies_consistent, provoking)
        for question in asking:
            if question.kind == PROVOCATION:
                self._workers.submit(self.consistent, question)
            elif question.regime == v.OWL_DIRECT:
                self._workers.submit(self.hierarchy, question)
                self._workers.submit(self.entailed, question)
            else:
                self._workers.submit(self.consistent, question)


def parse_module(file: Traversable) -> list[Quad]:
    """The statements of a bundled module."""
    return parse_quads(file.read_bytes(), Path(file.name), RdfFormat.TURTLE)


def _has_terms(axioms: Iterable[Axiom]) -> bool:
    """Whether axioms of data say something about classes or properties."""
    from rdflib import OWL, RDF, RDFS

    about = {
        RDFS.subClassOf, OWL.equivalentClass, OWL.disjointWith, OWL.disjointUnionOf, RDFS.domain,
        RDFS.range, RDFS.subPropertyOf, OWL.inverseOf, OWL.equivalentProperty,
        OWL.propertyDisjointWith, OWL.propertyChainAxiom,
    }  # fmt: skip
    return any(
        a.predicate in about
        or (a.predicate == RDF.type and str(a.object).startswith(OWL_NAMESPACE))
        for a in axioms
    )
