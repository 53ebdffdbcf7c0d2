"""Registry: search strategies by name."""

from __future__ import annotations

from difflib import get_close_matches
from importlib import import_module

from symboslam.errors import InputError, UnknownNameError
from symboslam.sim_bridge.search._base import Search
from symboslam.sim_bridge.search.area import Area

_HERE = "symboslam.sim_bridge.search"
_OURS = {
    "random-walk": f"{_HERE}.random_walk:RandomWalk",
    "correlated-walk": f"{_HERE}.random_walk:CorrelatedWalk",
    "ballistic": f"{_HERE}.ballistic:Ballistic",
    "random-waypoint": f"{_HERE}.random_waypoint:RandomWaypoint",
    "frontier": f"{_HERE}.frontier:Frontier",
    "boustrophedon": f"{_HERE}.boustrophedon:Boustrophedon",
}
_registered: dict[str, type[Search]] = {}


def searches() -> tuple[str, ...]:
    """Names of all strategies."""
    return (*_OURS, *_registered)


def register(search: type[Search]) -> type[Search]:
    """Make a strategy known under its name; usable as a decorator.

    Raises:
        InputError: its name is taken.
    """
    if search.name in _OURS or _registered.get(search.name, search) is not search:
        raise InputError(f"there is a search {search.name!r} already")
    _registered[search.name] = search
    return search


def get_search(name: str) -> type[Search]:
    """The strategy of a name; its module is imported now.

    Raises:
        UnknownNameError: there is none.
    """
    if name in _registered:
        return _registered[name]
    if name not in _OURS:
        near = get_close_matches(name.casefold(), searches(), n=3, cutoff=0.5)
        hint = f"did you mean {' or '.join(near)}? There" if near else "there"
        raise UnknownNameError(f"no search {name!r}; {hint} are: {', '.join(searches())}")
    module, _, attribute = _OURS[name].partition(":")
    found: type[Search] = getattr(import_module(module), attribute)
    return found


def search_of(name: str, area: Area, seed: int = 0) -> Search:
    """A strategy for an area.

    Raises:
        UnknownNameError: there is none of that name.
        InputError: the seed is negative.
    """
    return get_search(name)(area, seed)
