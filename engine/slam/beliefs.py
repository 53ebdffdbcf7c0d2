"""ClassBeliefs: which class a thing is of, given sightings that may be misclassified."""

from __future__ import annotations

import numpy as np

from symboslam.engine.slam.log import Floats, Ints

SUREST = 0.999
"""No sighting is believed more than this."""


class ClassBeliefs:
    """What sightings say about classes.

    A sighting of confidence p is of its class with probability p; the rest is spread over the other
    classes, more to those that are like it.

    Args:
        similarity: (C, C) how alike classes are, in [0, 1].
    """

    def __init__(self, similarity: Floats) -> None:
        self.size = len(similarity)
        mistaken = np.array(similarity, float) + 0.05
        np.fill_diagonal(mistaken, 0)
        self._mistaken = mistaken / np.maximum(mistaken.sum(1, keepdims=True), 1e-12)
        self._prior = np.full(self.size, 1 / max(self.size, 1))

    def learn(self, features: Ints) -> None:
        """Take over how frequent classes are, from (L,) landmarks."""
        counts = np.bincount(features, minlength=self.size) + 0.5
        self._prior = counts / counts.sum()

    def likelihood(self, feature: int, confidence: float) -> Floats:
        """(C,) log probability of such a sighting for a thing of each class."""
        sure = min(max(confidence, 1 / self.size), SUREST) if self.size > 1 else 1.0
        shares = (1 - sure) * self._mistaken[:, feature]
        shares[feature] = sure
        return np.asarray(np.log(np.maximum(shares, 1e-6)))

    def posterior(self, evidence: Floats) -> Floats:
        """(..., C) probabilities from (..., C) summed log likelihoods."""
        logs = evidence + np.log(self._prior)
        shares = np.exp(logs - logs.max(-1, keepdims=True))
        return np.asarray(shares / shares.sum(-1, keepdims=True))

    def alike(self, one: Floats, other: Floats) -> Floats:
        """(n, m) log odds that things are of one class rather than of any, by evidence.

        Args:
            one: (n, C) summed log likelihoods of n things.
            other: (m, C) of m others.
        """
        odds = (self.posterior(one) / self._prior) @ self.posterior(other).T
        return np.asarray(np.log(np.maximum(odds, 1e-12)))
