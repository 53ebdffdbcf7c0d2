"""The site: all pages and files of an ontology's documentation, built and written as one."""

from __future__ import annotations

import json
import shutil
import tempfile
from collections.abc import Callable
from dataclasses import dataclass, field
from importlib.resources import files
from pathlib import Path

from rdflib import OWL

from symboslam.errors import OutputError
from symboslam.reasoning.documentation.diagrams.contents import ModuleDiagram, draw_overview
from symboslam.reasoning.documentation.environment_page import EnvironmentPages
from symboslam.reasoning.documentation.evidence import Evidence
from symboslam.reasoning.documentation.facts import Facts
from symboslam.reasoning.documentation.frame import Frame
from symboslam.reasoning.documentation.index_page import (
    index_content,
    root_module,
    terms_content,
)
from symboslam.reasoning.documentation.library import Library
from symboslam.reasoning.documentation.markup import safe_colour
from symboslam.reasoning.documentation.module_page import ModulePages
from symboslam.reasoning.documentation.modules import read_modules, slugs
from symboslam.reasoning.knowledge import Knowledge
from symboslam.reasoning.statements import Statements

MARKER = ".symboslam-docs"
"""An empty file that says a folder was made here and may be replaced."""

QUESTIONS = "competency-questions.html"

Progress = Callable[[str, float], None]


@dataclass
class Site:
    """A built site.

    Attributes:
        files: name -> content of each file.
        library: what it documents.
        evidence: what indicates which environment; None where nothing is indicated.
    """

    files: dict[str, str] = field(repr=False)
    library: Library = field(repr=False)
    evidence: Evidence | None = field(repr=False)

    def write(self, folder: Path) -> Path:
        """Write all files into a folder, which is replaced as a whole; the first page's path.

        Raises:
            OutputError: the folder holds something that was not made here, or cannot be written.
        """
        folder = folder.resolve()
        try:
            _refuse_foreign(folder)
            folder.parent.mkdir(parents=True, exist_ok=True)
            fresh = Path(tempfile.mkdtemp(prefix=".symboslam-docs-", dir=folder.parent))
        except OSError as error:
            raise OutputError(f"{folder} cannot be written: {error.strerror or error}") from error
        try:
            for name, content in {**self.files, MARKER: ""}.items():
                (fresh / name).write_text(content, encoding="utf-8", newline="\n")
            fresh.chmod(0o755)
            if folder.exists():
                old = fresh / ".old"
                folder.rename(old)
            fresh.rename(folder)
            shutil.rmtree(folder / ".old", ignore_errors=True)
        except OSError as error:
            if (fresh / ".old").exists() and not folder.exists():
                (fresh / ".old").rename(folder)
            raise OutputError(f"{folder} cannot be written: {error.strerror or error}") from error
        finally:
            shutil.rmtree(fresh, ignore_errors=True)
        return folder / "index.html"


def _refuse_foreign(folder: Path) -> None:
    """Refuse a folder that holds other things than an earlier site."""
    if folder.exists() and not folder.is_dir():
        raise OutputError(f"{folder} is a file; name a folder for the pages")
    if folder.is_dir() and any(folder.iterdir()) and not (folder / MARKER).exists():
        raise OutputError(
            f"{folder} holds files that are not an earlier build of these pages, and nothing was "
            "written; name a new or empty folder"
        )


def build_site(
    paths: list[Path] | None = None,
    *,
    questions: str | None = None,
    strict: bool = False,
    progress: Progress = lambda stage, share: None,
) -> Site:
    """Build the documentation of an ontology.

    Args:
        paths: a user's ontology files; None for the bundled ontology.
        questions: a report on competency questions in HTML, to go along.
        strict: refuse missing and cyclic imports.
        progress: called with what is done now and the share that is done.

    Raises:
        InputError: a file cannot be read.
        OntologyError: it does not parse, or its indications cannot be reasoned over.
        ReasonerError: it states indications, is not reasoned over yet, and there is no Java.
    """
    progress("reading modules", 0.05)
    library = Library(read_modules(paths, strict))
    evidence = None
    if Statements(library.graph).indications:
        progress("reasoning", 0.2)
        evidence = Evidence(Knowledge.load(paths), library.graph)
    progress("writing pages", 0.4)
    made = _pages(library, evidence, QUESTIONS if questions else None, progress)
    if questions:
        made[QUESTIONS] = questions
    return Site(made, library, evidence)


def _pages(
    library: Library, evidence: Evidence | None, questions: str | None, progress: Progress
) -> dict[str, str]:
    root = root_module(library)
    environments = evidence.environments if evidence else ()
    names = slugs(e.name for e in environments)
    environment_pages = {e.iri: f"environment-{names[e.name]}.html" for e in environments}
    menu = [("index.html", "Overview"), ("terms.html", "All terms")]
    if questions:
        menu.append((questions, "Questions"))
    frame = Frame(root.title, root.header(OWL.versionInfo), tuple(menu))
    made: dict[str, str] = {"terms.js": _search_index(library, environment_pages)}
    for name in ("style.css", "site.js"):
        asset = files("symboslam.reasoning.documentation") / "assets" / name
        made[name] = asset.read_text(encoding="utf-8")

    overview = draw_overview(library).svg("Which module imports which")
    made["overview.svg"] = overview
    first = index_content(library, evidence, environment_pages, overview, questions)
    made["index.html"] = frame.page(root.title, first, here="index.html")
    made["terms.html"] = frame.page("All terms", terms_content(library), here="terms.html")

    modules = ModulePages(library, Facts(library), evidence, environment_pages)
    for i, module in enumerate(library.modules):
        progress(f"page of {module.name}", 0.4 + 0.5 * i / len(library.modules))
        drawing = ModuleDiagram(library, evidence, module).draw()
        diagram = drawing.svg(f"Diagram of {module.title}") if drawing.height else None
        if diagram:
            made[f"{module.page}.svg"] = diagram
        made[f"{module.page}.html"] = frame.page(module.title, modules.content(module, diagram))
    if evidence:
        pages = EnvironmentPages(library, evidence, environment_pages)
        for e in environments:
            colour = safe_colour(e.colour)
            made[environment_pages[e.iri]] = frame.page(e.label, pages.content(e), colour=colour)
    return made


def _search_index(library: Library, environment_pages: dict[str, str]) -> str:
    """All terms for the search box, as a script: a page from a file may not fetch data."""
    entries = [
        [term.label, term.name, f"{term.kind} in {term.module.name}", term.href, term.definition]
        for term in sorted(library.terms.values(), key=lambda t: (t.label.casefold(), t.iri))
    ]
    for iri, page in sorted(environment_pages.items()):
        entries.append([library.label(iri), "", "environment type: its features", page, ""])
    return f"window.TERMS = {json.dumps(entries, ensure_ascii=True, indent=0)};\n"
