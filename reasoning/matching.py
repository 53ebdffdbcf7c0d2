"""Find the feature that a name or a set of OpenStreetMap tags means, or what comes close."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from symboslam.errors import UnknownNameError
from symboslam.reasoning.vocabulary import local_name

if TYPE_CHECKING:
    from symboslam.reasoning.knowledge import Feature

_MEMORY = 100_000  # combinations of tags whose answers are kept


def name_index(features: Sequence[Feature]) -> dict[str, int]:
    """Case-folded name -> position; where several features bear a name the better kind wins.

    The kinds, best first: detector label, local name, IRI, alias and its local name, label.
    """
    index: dict[str, int] = {}
    for kind in (_detector_label, _name, _iri, _aliases, _label):
        for position, feature in enumerate(features):
            for name in kind(feature):
                index.setdefault(name.casefold(), position)
    return index


def _detector_label(feature: Feature) -> Iterable[str]:
    return (feature.detector_label,) if feature.detector_label else ()


def _name(feature: Feature) -> Iterable[str]:
    return (feature.name,)


def _iri(feature: Feature) -> Iterable[str]:
    return (feature.iri,)


def _aliases(feature: Feature) -> Iterable[str]:
    return (*feature.aliases, *map(local_name, feature.aliases))


def _label(feature: Feature) -> Iterable[str]:
    return (feature.label,)


class TagMatcher:
    """Matches OpenStreetMap tags to features.

    Args:
        features: all features.
        informativeness: one number for each; the larger wins among unrelated features.
    """

    def __init__(self, features: Sequence[Feature], informativeness: Sequence[float]) -> None:
        self._features, self._informativeness = features, informativeness
        self._exact: dict[tuple[str, str], list[int]] = {}
        self._any: dict[str, list[int]] = {}
        for position, feature in enumerate(features):
            for tag in feature.osm_tags:
                key, _, value = tag.partition("=")
                if value == "*":
                    self._any.setdefault(key, []).append(position)
                else:
                    self._exact.setdefault((key, value), []).append(position)
        self.keys = frozenset(self._any) | frozenset(key for key, _ in self._exact)
        self._memory: dict[tuple[tuple[str, str], ...], int | None] = {}

    def match(self, tags: Mapping[str, str]) -> int | None:
        """Position of the best feature, or None."""
        keys = self.keys
        known = tuple((key, value) for key, value in tags.items() if key in keys)
        if not known:
            return None
        try:
            return self._memory[known]
        except KeyError:
            found = self._best(set(self._candidates(known)))
            if len(self._memory) < _MEMORY:
                self._memory[known] = found
            return found

    def _candidates(self, tags: Iterable[tuple[str, str]]) -> Iterator[int]:
        for key, value in tags:
            parts = [part.strip() for part in value.split(";")] if ";" in value else [value]
            exact = [i for part in (value, *parts) for i in self._exact.get((key, part), ())]
            if exact:
                yield from exact
            elif any(part not in ("", "no") for part in parts):
                yield from self._any.get(key, ())

    def _best(self, candidates: set[int]) -> int | None:
        general = {kind for i in candidates for kind in self._features[i].kinds}
        special = [i for i in candidates if self._features[i].name not in general]
        return min(special, key=lambda i: (-self._informativeness[i], i), default=None)


def unknown_name(kind: str, name: str, known: list[str]) -> UnknownNameError:
    """The error for a name that nothing bears, which lists what comes close."""
    from difflib import get_close_matches

    by_case = {n.casefold(): n for n in known}
    close = [by_case[n] for n in get_close_matches(name.casefold(), by_case, n=4, cutoff=0.6)]
    if close:
        hint = f"; did you mean {' or '.join(close)}?"
    else:
        hint = f"; there are: {', '.join(known)}" if len(known) <= 12 else ""
    return UnknownNameError(f"there is no {kind} {name!r}{hint}")
