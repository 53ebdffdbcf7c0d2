"""Segmentation: one way to cut a map into segments; all are found by name."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from importlib import import_module
from importlib.metadata import entry_points
from typing import TYPE_CHECKING, Any, ClassVar

from symboslam.errors import InputError, UnknownNameError

if TYPE_CHECKING:  # the names are wanted at start-up, what they stand for is not
    from symboslam.engine.environment_map import EnvironmentMap
    from symboslam.engine.landmarks import LandmarkMap
    from symboslam.engine.settings import Settings
    from symboslam.reasoning.knowledge import Knowledge

Progress = Callable[[str, float], None]
GROUP = "symboslam.segmentations"
"""Entry points of this group, in any installed package, are segmentations too."""


class Segmentation(ABC):
    """One way to cut a map (design 6).

    Attributes:
        name: what users call it.
        unused: settings that mean nothing to it; a map's configuration leaves them out.
    """

    name: ClassVar[str]
    unused: ClassVar[frozenset[str]] = frozenset()

    @abstractmethod
    def cut(
        self,
        landmarks: LandmarkMap,
        knowledge: Knowledge,
        scheme: str | None,
        settings: Settings,
        tell: Progress,
    ) -> EnvironmentMap:
        """Cut a map and classify its segments.

        Args:
            landmarks: what was seen where.
            knowledge: what each kind of landmark indicates.
            scheme: set of environment types; None takes the ontology's default.
            settings: every number that steers it.
            tell: called with a stage and the share that is done.
        """

    def configuration(self, settings: Settings, scheme: str) -> dict[str, Any]:
        """Every setting in force, as keywords of ``classify``."""
        used = {k: v for k, v in settings.as_dict().items() if k not in self.unused}
        return {**used, "scheme": scheme, "segmentation": self.name}


_OURS = {
    "grid": "symboslam.engine.grid_map:GridSegmentation",
    "branch": "symboslam.engine.branch:BranchSegmentation",
}
_registered: dict[str, type[Segmentation]] = {}


def register(segmentation: type[Segmentation]) -> type[Segmentation]:
    """Make a segmentation known under its name; usable as a decorator.

    Raises:
        InputError: its name is taken.
    """
    name = segmentation.name
    if name in segmentations() and _registered.get(name) is not segmentation:
        raise InputError(f"there is a segmentation {name!r} already")
    _registered[name] = segmentation
    return segmentation


def segmentations() -> tuple[str, ...]:
    """Names of all segmentations: ours, those of installed packages, those registered."""
    installed = sorted(entry_points(group=GROUP).names)
    return tuple(dict.fromkeys([*_OURS, *installed, *_registered]))


def segmentation_of(name: str) -> Segmentation:
    """The segmentation of a name; its module is imported now.

    Raises:
        UnknownNameError: there is none.
        InputError: the package that has it cannot be used.
    """
    if name in _registered:
        return _registered[name]()
    if name in _OURS:
        module, _, attribute = _OURS[name].partition(":")
        found: type[Segmentation] = getattr(import_module(module), attribute)
        return found()
    for point in entry_points(group=GROUP, name=name):
        try:
            loaded = point.load()
        except (ImportError, AttributeError) as error:
            raise InputError(f"segmentation {name!r} of {point.value} fails: {error}") from error
        if not (isinstance(loaded, type) and issubclass(loaded, Segmentation)):
            raise InputError(f"segmentation {name!r}: {point.value} is no Segmentation")
        return loaded()
    raise UnknownNameError(f"no segmentation {name!r}; there are: {', '.join(segmentations())}")
