"""Classes: the classes of a mission, found in an ontology by name, label or alias."""

from __future__ import annotations

from collections import Counter

import numpy as np
from numpy.typing import NDArray

from symboslam.engine.readers.columns import FeatureIndex
from symboslam.engine.slam.log import ROBOT

NAMELESS = "unknown"
"""Class of detections without one."""
_ROBOT = "robot"


class Classes:
    """Numbers classes in the order of their first use.

    A name that the ontology knows becomes the feature's own; others stay as they are and count as
    standing still. ``robot`` is a seen robot unless the ontology has a feature of that name.

    Args:
        knowledge: the ontology; None: all names are kept as they are.
    """

    def __init__(self, knowledge: FeatureIndex | None = None) -> None:
        self._knowledge = knowledge
        self._position: dict[str, int] = {}
        self._moves: list[bool] = []
        self._seen: dict[str, int] = {}
        self._unknown: Counter[str] = Counter()
        self._nameless = 0

    def position_of(self, name: str) -> int:
        """Position of the class of a detection, or ``ROBOT``."""
        if name in self._seen and name not in self._unknown and name:
            return self._seen[name]
        found = None if self._knowledge is None or not name else self._knowledge.index_of(name)
        if found is None and name.casefold() == _ROBOT:
            self._seen[name] = ROBOT
            return ROBOT
        if found is not None and self._knowledge is not None:
            feature = self._knowledge.features[found]
            self._seen[name] = self._number(feature.name, not feature.static)
        else:
            if not name:
                self._nameless += 1
            elif self._knowledge is not None:
                self._unknown[name] += 1
            self._seen[name] = self._number(name or NAMELESS, False)
        return self._seen[name]

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the classes."""
        return tuple(self._position)

    @property
    def dynamic(self) -> NDArray[np.bool_]:
        """(C,) which classes move."""
        return np.array(self._moves, np.bool_)

    @property
    def notes(self) -> list[str]:
        """What was not found."""
        found = []
        if self._unknown:
            listed = ", ".join(f"{name} ({n})" for name, n in self._unknown.most_common(20))
            found.append(f"classes that the ontology does not know, kept as they are: {listed}")
        if self._nameless:
            found.append(f"detections without a class, now of class {NAMELESS}: {self._nameless}")
        return found

    def _number(self, name: str, moves: bool) -> int:
        if name not in self._position:
            self._position[name] = len(self._position)
            self._moves.append(moves)
        return self._position[name]
