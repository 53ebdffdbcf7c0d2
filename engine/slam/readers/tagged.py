"""Lines of a tag, numbers of vertices and numbers: the form of g2o's, TORO's and GTSAM's files."""

from __future__ import annotations

from collections.abc import Callable, Container, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from symboslam.engine.slam.readers.pose_graph import PoseGraph
from symboslam.engine.slam.readers.text import Line, count, lines_of, number
from symboslam.errors import InputError


@dataclass(frozen=True)
class Fields:
    """What stands behind the tag of a line.

    Attributes:
        path: the file.
        line: number of the line.
        tag: its first word.
        words: the others.
    """

    path: Path
    line: int
    tag: str
    words: list[str]

    @property
    def where(self) -> str:
        """File and line, in words."""
        return f"{self.path}: line {self.line}"

    def ids(self, vertices: int, numbers: int) -> list[Any]:
        """So many whole numbers of vertices, then so many finite numbers.

        Raises:
            InputError: there are more or fewer, or something else.
        """
        if len(self.words) != vertices + numbers:
            raise InputError(
                f"{self.where}: {self.tag} has {len(self.words)} values, "
                f"{vertices + numbers} are needed"
            )
        found: list[Any] = []
        for word in self.words[:vertices]:
            if not (word.isascii() and word.isdigit()):
                raise InputError(f"{self.where}: {word[:60]!r} is no number of a vertex")
            found.append(int(word))
        what = f"a value of {self.tag}"
        return found + [number(w, what, self.path, self.line) for w in self.words[vertices:]]

    def new(self, vertex: int, known: Container[int]) -> int:
        """The number of a vertex that was not there before.

        Raises:
            InputError: it was.
        """
        if vertex in known:
            raise InputError(f"{self.where}: {self.tag} {vertex} is there twice")
        return vertex

    def apart(self, start: int, end: int) -> tuple[int, int]:
        """The two ends of an edge.

        Raises:
            InputError: they are one and the same.
        """
        if start == end:
            raise InputError(f"{self.where}: this {self.tag} leads from {start} to itself")
        return start, end


def parse(path: Path, tags: Mapping[str, Callable[[PoseGraph, Fields], None]]) -> PoseGraph:
    """The graph of a file.

    A last line that is cut short, and lines that NUL bytes made unreadable, are left out and noted.

    Args:
        path: the file.
        tags: what to do with each tag; others are counted.

    Raises:
        InputError: the file cannot be read, is empty, or a line is wrong.
    """
    graph = PoseGraph(path)
    broken: list[Line] = []
    for line in lines_of(path):
        tag, *words = line.words
        if tag not in tags:
            graph.ignored[tag[:40]] += 1
            continue
        try:
            tags[tag](graph, Fields(path, line.number, tag, words))
        except InputError:
            if not (line.damaged or line.last):
                raise
            broken.append(line)
    if broken:
        rows = count(broken, "damaged or cut line")
        graph.notes.append(f"{path.name}: {rows} left out, the first is line {broken[0].number}")
    return graph
