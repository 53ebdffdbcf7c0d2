"""Read OWL 2 functional syntax into a graph, with lines: from text to forms ``Name(arguments)``.

Written here since no reader that we tried tells lines; see decision 9 in ``docs/decisions``.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from rdflib import RDF, XSD, Literal, URIRef
from rdflib.term import Node

from symboslam.reasoning.functional_axioms import Axioms
from symboslam.reasoning.functional_expressions import DEEPEST, Form, FormError, Names

if TYPE_CHECKING:
    from symboslam.reasoning.located import LocatedGraph

__all__ = ["parse_functional"]

# A name and its parenthesis are one token; words with a colon are terms: HasKey(:A (:p) ()).
_TOKEN = re.compile(
    r"\s+|\#[^\n]*"
    r'|"(?P<text>(?:[^"\\]|\\.)*+)"(?:\^\^(?:<(?P<type>[^<>"\s]*)>|(?P<short>[^\s()<>"\#]+))'
    r"|@(?P<language>[A-Za-z0-9-]+))?"
    r'|(?:(?P<name>[^\s()<>"\#:]++)(?:\s|\#[^\n]*+)*+)?(?P<open>\()|(?P<close>\))'
    r'|<(?P<iri>[^<>"\s{}|\\^`]*)>|(?P<word>[^\s()<>"\#]+)|(?P<bad>.)',
    re.DOTALL,
)


def parse_functional(graph: LocatedGraph, data: bytes) -> None:
    """Read functional syntax (OWL 2 Structural Specification, section 3.7).

    The line of a triple is that on which its axiom begins.

    Raises:
        FormError: it does not parse.
        UnicodeDecodeError: it is not UTF-8.
    """
    reader = _Reader(data.decode())
    for prefix, namespace in reader.names.prefixes.items():
        graph.bind(prefix, namespace)
    ontologies = [form for form in reader.forms if form.name == "Ontology"]
    if len(ontologies) != 1:
        line = ontologies[1].line if ontologies else None
        problem = "there is a second Ontology(...)" if ontologies else "there is no Ontology(...)"
        raise FormError(line, problem + " in it")
    Axioms(graph).ontology(ontologies[0])


class _Reader:
    """The forms of a document.

    Attributes:
        forms: the outermost ones.
        names: the prefixes and anonymous individuals.
    """

    def __init__(self, text: str) -> None:
        self.forms: list[Form] = []
        self.names = Names()
        self._line = 1
        self._open: list[Form] = []
        self._read(text)

    def _error(self, problem: str) -> FormError:
        return FormError(self._line, problem)

    def _read(self, text: str) -> None:
        counted = 0
        for found in _TOKEN.finditer(text):
            kind = found.lastgroup
            if kind is None:  # white space or a comment
                continue
            self._line += text.count("\n", counted, found.start())
            counted = found.start()
            if kind == "open":
                self._enter(Form(found["name"] or "", self._line))
            elif kind == "close":
                self._leave()
            elif kind == "word":
                self._add(self._word(found["word"]))
            elif kind == "iri":
                self._add(URIRef(found["iri"]))
            elif kind == "bad":
                quoted = found["bad"] == '"'
                what = "a text that does not end" if quoted else "something that is no <IRI>"
                raise self._error(f"there is {what}")
            else:
                self._add(self._literal(found))
        if self._open:
            self._line = text.rstrip().count("\n") + 1
            raise self._error("the file ends in the middle of something: a ) is missing")

    def _enter(self, form: Form) -> None:
        if len(self._open) == DEEPEST:
            raise self._error("it is nested too deeply")
        if self._open:
            self._open[-1].arguments.append(form)
        elif form.name in ("Prefix", "Ontology"):
            self.forms.append(form)
        else:
            raise self._error(f"Prefix(...) or Ontology(...) is expected, not {form.name}(")
        self._open.append(form)

    def _leave(self) -> None:
        if not self._open:
            raise self._error("there is a ) too many")
        form = self._open.pop()
        if form.name == "Prefix" and not self._open:
            *words, namespace = form.arguments or [""]
            declared = "".join(map(str, words))  # "x:=" or "x:" "="
            if not (isinstance(namespace, URIRef) and declared.endswith(":=")):
                raise self._error("a prefix is declared so: Prefix(name:=<namespace>)")
            self.names.prefixes[declared[:-2]] = str(namespace)

    def _add(self, item: Node | str) -> None:
        if not self._open:
            if self.forms:
                raise self._error(f"{str(item)!r} has no place here")
            raise self._error(f"Prefix(...) or Ontology(...) is expected, not {item}")
        self._open[-1].arguments.append(item)

    def _word(self, word: str) -> Node | str:
        if ":" not in word or not self._open or self._open[0].name == "Prefix":
            return word
        if word.startswith("_:"):
            return self.names.anonymous(word)
        return self.names.short(word, self._line)

    def _literal(self, found: re.Match[str]) -> Literal:
        text = re.sub(r"\\(.)", r"\1", found["text"], flags=re.DOTALL)
        language, datatype = found["language"], XSD.string
        if found["short"]:
            datatype = self.names.short(found["short"], self._line)
        elif found["type"]:
            datatype = URIRef(found["type"])
        if datatype == RDF.PlainLiteral:
            text, _, language = text.rpartition("@")
        if language:
            return self.names.tagged(text, language, self._line)
        return self.names.typed(text, XSD.string if datatype == RDF.PlainLiteral else datatype)
