"""YAML as a tree whose every value knows its line."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import yaml

from symboslam.reasoning.questions.places import Lines

_DEEPEST = 50  # levels
_LARGEST = 100_000  # values; aliases can make more of them than the file has


@dataclass(frozen=True)
class Node:
    """A value of a YAML file and the line on which it stands; below it are nodes again."""

    value: Any
    line: int

    def get(self, key: str) -> Node | None:
        """The value of a key; None if there is none, or no mapping."""
        return self.value.get(key) if isinstance(self.value, Mapping) else None

    def plain(self) -> Any:
        """The value without lines."""
        if isinstance(self.value, Mapping):
            return {key: node.plain() for key, node in self.value.items()}
        if isinstance(self.value, list):
            return [node.plain() for node in self.value]
        return self.value


def read_tree(text: str, lines: Lines) -> Node:
    """The tree of a YAML document.

    Raises:
        InputError: it is not YAML, gives a key twice, or is larger or deeper than makes sense.
    """
    try:
        loader = yaml.SafeLoader(text)
        root = loader.get_single_node()
        return Node({}, 1) if root is None else _Builder(loader, lines).build(root, 0)
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        line = mark.line + 1 if mark else 1
        raise lines.error(line, f"it is not YAML: {error.problem}") from error
    except (yaml.YAMLError, ValueError, RecursionError) as error:
        raise lines.error(1, f"it is not YAML: {' '.join(str(error).split())}") from error


class _Builder:
    def __init__(self, loader: yaml.SafeLoader, lines: Lines) -> None:
        self.loader, self.lines, self.made = loader, lines, 0

    def build(self, node: yaml.Node, depth: int) -> Node:
        line = node.start_mark.line + 1
        self.made += 1
        if depth > _DEEPEST or self.made > _LARGEST:
            raise self.lines.error(line, "it is nested too deeply, or grows by its aliases")
        if isinstance(node, yaml.MappingNode):
            found: dict[str, Node] = {}
            for key, value in node.value:
                name = str(key.value)
                if name in found:
                    where = key.start_mark.line + 1
                    raise self.lines.error(where, f"the key {name!r} is given twice")
                found[name] = self.build(value, depth + 1)
            return Node(found, line)
        if isinstance(node, yaml.SequenceNode):
            return Node([self.build(one, depth + 1) for one in node.value], line)
        if isinstance(node, yaml.ScalarNode) and node.style in ("|", ">"):
            line += 1  # the text starts below the bar
        return Node(self.loader.construct_object(node), line)
