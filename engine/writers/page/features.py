"""Features: the classes of landmarks that a page mentions, and what each of them indicates."""

from __future__ import annotations

from collections import defaultdict
from typing import Any

from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.writers.page.words import local_name, plural
from symboslam.reasoning.knowledge import Indication


class Features:
    """The features that occur, numbered in the order in which they are first asked for."""

    def __init__(self, environment_map: EnvironmentMap) -> None:
        self.rows: list[dict[str, Any]] = []
        self._knowledge = environment_map.knowledge
        self._number: dict[str, int] = {}
        self._feature = {f.name: f for f in self._knowledge.features}
        self._env = {e.name: k for k, e in enumerate(environment_map.environments)}
        self._indications: dict[str, list[Indication]] = defaultdict(list)
        for indication in self._knowledge.indications:
            if indication.environment in self._env:
                self._indications[indication.feature].append(indication)

    def number(self, name: str, label: str = "") -> int:
        """The number of a feature; one that the knowledge does not have gets a bare row."""
        if name not in self._number:
            self._number[name] = len(self.rows)
            feature = self._feature.get(name)
            label = feature.label if feature and feature.label else label or name
            self.rows.append(
                {
                    "name": name,
                    "label": label,
                    "plural": plural(label),
                    "definition": feature.definition if feature else "",
                    "static": feature.static if feature else True,
                    "absence": name in self._knowledge.absence,
                    "indicates": self._said(name),
                }
            )
        return self._number[name]

    def _said(self, name: str) -> list[list[Any]]:
        """[environment, strength, steps, way in words, reason, source], the closest first."""
        labels = self._knowledge.labels
        return [
            [
                self._env[i.environment],
                round(i.strength, 4),
                i.steps,
                [labels.get(step, step) for step in i.path],
                i.reason,
                labels.get(i.source) or local_name(i.source),
            ]
            for i in sorted(self._indications[name], key=lambda i: -i.proximity)
        ]
