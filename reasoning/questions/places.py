"""Where a manifest says something, and which file an IRI in it means."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path
from urllib.parse import unquote, urlsplit

from symboslam.errors import InputError
from symboslam.reasoning.imports import find_beside, find_in_catalog
from symboslam.reasoning.vocabulary import DOCUMENTS, local_name

_DATA_ENDINGS = (".ttl", ".nt", ".nq", ".trig", ".rdf", ".owl", ".jsonld", ".json", ".xml")


class Lines:
    """The lines of a manifest, to say where something stands in it.

    Args:
        path: the manifest.
        text: its content.
    """

    def __init__(self, path: Path, text: str) -> None:
        self.path, self.text = path, text

    def of_iri(self, iri: str) -> int:
        """The line that first names an IRI: in full, relative to the file, or by a prefix."""
        folder = self.path.resolve().parent.as_uri() + "/"
        own = self.path.resolve().as_uri()
        names = [iri, iri.removeprefix(folder), iri.removeprefix(own), unquote(iri.rsplit("/")[-1])]
        names.append(local_name(iri))
        for name in names:
            if not name or name not in self.text:
                continue
            pattern = rf"<[^<>\s]*{re.escape(name)}>|:{re.escape(name)}(?![\w-])"
            if found := re.search(pattern, self.text):
                return self.text.count("\n", 0, found.start()) + 1
        return 1

    def of_text(self, value: str) -> int:
        """The line on which a literal starts."""
        first = next((line for line in value.split("\n") if line.strip()), value)
        skipped = value[: value.index(first)].count("\n") if first else 0
        for text in (first, first.replace("\\", "\\\\").replace('"', '\\"')):
            at = self.text.find(text)
            if text and at >= 0:
                return max(1, self.text.count("\n", 0, at) + 1 - skipped)
        return 1

    def error(self, line: int, problem: str) -> InputError:
        """An error of this manifest."""
        return InputError(f"{self.path}: line {line}: {problem}")


def file_of(iri: str) -> Path | None:
    """The file that a ``file:`` IRI means; None for another IRI."""
    parts = urlsplit(iri)
    return Path(unquote(parts.path)) if parts.scheme == "file" else None


def find_file(iri: str, what: str, lines: Lines) -> Path:
    """The file that an IRI in a manifest means; the network is never asked.

    Raises:
        InputError: there is none.
    """
    path = file_of(iri)
    if path is not None:
        if not path.is_file():
            kind = "is a folder" if path.is_dir() else "does not exist"
            shown = _relative(path, lines.path)
            raise lines.error(lines.of_iri(iri), f"the {what} {shown} {kind}")
        return path
    folder = lines.path.parent
    name = unquote(urlsplit(iri).path.rsplit("/", 1)[-1])
    for ending in ("", *_DATA_ENDINGS):
        if name and (folder / f"{name}{ending}").is_file():
            return folder / f"{name}{ending}"
    found = find_in_catalog(lines.path, iri) or find_beside(lines.path, iri)
    if found is None or found.resolve() == lines.path.resolve():
        problem = f"the {what} <{iri}> is not fetched from the network; put the file beside"
        raise lines.error(
            lines.of_iri(iri), f"{problem} the manifest and name it <{name or '...'}>"
        )
    return found


def find_ontology(iri: str, lines: Lines) -> str | Path:
    """The bundled document or the file that an IRI in a manifest means.

    Raises:
        InputError: there is neither.
    """
    from symboslam.reasoning.sources import bundled_name

    if not iri.startswith(DOCUMENTS):
        return find_file(iri, "ontology", lines)
    if bundled_name(iri) not in _modules():
        raise lines.error(lines.of_iri(iri), f"there is no bundled document <{iri}>")
    return iri


@cache
def _modules() -> frozenset[str]:
    from symboslam.reasoning.sources import closure_files

    return frozenset(closure_files())


def _relative(path: Path, manifest: Path) -> str:
    try:
        return str(path.relative_to(manifest.resolve().parent))
    except ValueError:
        return str(path)
