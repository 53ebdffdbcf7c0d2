"""Classes: what agents need to know of an ontology's features, as columns."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from symboslam.reasoning.knowledge import Knowledge

_ABOVE_ALL = {"StaticFeature", "DynamicFeature"}


@dataclass(frozen=True)
class Classes:
    """Classes of what robots see.

    Attributes:
        names: (C,) of the classes.
        dynamic: (C,) which of them move.
        similarity: (C, C) how alike two are, in [0, 1].
    """

    names: tuple[str, ...]
    dynamic: NDArray[np.bool_]
    similarity: NDArray[np.float64]

    @classmethod
    def of(cls, knowledge: Knowledge) -> Classes:
        """The features of an ontology.

        Two are as alike as the classes that they are kinds of: 2 |A and B| / (|A| + |B|), A and B
        being a feature and all classes above it. In a tree of classes that is the similarity of
        Wu and Palmer (ACL 1994).
        """
        features = knowledge.features
        above = [{f.name, *f.kinds} - _ABOVE_ALL for f in features]
        column = {name: i for i, name in enumerate(sorted(set().union(*above)))}
        member = np.zeros((len(features), len(column)))
        for row, kinds in enumerate(above):
            member[row, [column[kind] for kind in kinds]] = 1
        size = member.sum(1)
        return cls(
            tuple(f.name for f in features),
            np.array([not f.static for f in features], np.bool_),
            2 * (member @ member.T) / (size[:, None] + size[None, :]),
        )
