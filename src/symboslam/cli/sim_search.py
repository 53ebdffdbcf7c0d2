"""``symboslam sim search``: search strategies against each other on open ground."""

from __future__ import annotations

import json
import math
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from symboslam.cli.common import progress_bar, show
from symboslam.errors import InputError, UnknownNameError

if TYPE_CHECKING:
    from rich.table import Table

    from symboslam.sim_bridge.search.comparison import Comparison
    from symboslam.sim_bridge.search.paper_areas import PaperArea

    Rows = list[tuple[PaperArea, bool, list[Comparison]]]

EXAMPLES = """
[bold]Examples[/]

symboslam sim search --area kingston

symboslam sim search --area all --speed 15 --range 80 --strategies boustrophedon --json

symboslam sim search --area 800x600 --minutes 10 --robots 5 --picture paths.png
"""

STRATEGIES = "random-walk,ballistic,frontier,boustrophedon"


def search(
    areas: Annotated[
        str,
        typer.Option(
            "--area",
            help="kingston, train-depot, city, fyshwick, airport, gungahlin, several with commas, "
            "all; or a size in metres, such as 800x600.",
        ),
    ] = "city",
    robots: Annotated[int, typer.Option(min=1, help="How many.")] = 3,
    strategies: Annotated[
        str,
        typer.Option(
            help="random-walk, correlated-walk, ballistic, random-waypoint, frontier, "
            "boustrophedon; several with commas, or all."
        ),
    ] = STRATEGIES,
    minutes: Annotated[
        float | None,
        typer.Option(
            help="The time at which coverage is taken.",
            show_default="the paper's for the area, else 30",
        ),
    ] = None,
    until: Annotated[
        float, typer.Option(min=1, help="So many times as long a trial goes on to find it all.")
    ] = 4.0,
    speed: Annotated[float, typer.Option(help="Of the robots, metres a second.")] = 10.0,
    reach: Annotated[float, typer.Option("--range", help="Of the sensor, metres.")] = 60.0,
    fov: Annotated[float, typer.Option(help="Field of view of the sensor, degrees.")] = 360.0,
    features: Annotated[
        int, typer.Option(min=0, help="To be found, where a size is given as area.")
    ] = 100,
    seeds: Annotated[int, typer.Option(min=1, help="Trials, each with other starts.")] = 3,
    as_json: Annotated[bool, typer.Option("--json", help="All figures, as JSON.")] = False,
    picture: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE.png",
            help="Paths of the first trials.",
            show_default=False,
        ),
    ] = None,
) -> None:
    """Compare search strategies on flat open ground, without physics or pictures.

    Times are minutes and means over the seeds; > says that some trial had not got there in the end.
    """
    from symboslam.sim_bridge.search.comparison import compare
    from symboslam.sim_bridge.search.paper_areas import AREAS, open_area, square

    names = _names(strategies)
    listed = list(AREAS) if areas.strip() == "all" else _listed(areas)
    wanted = [_area(name, minutes, features) for name in listed]
    if not wanted:
        raise InputError(f"--area {areas!r}: name one at least")
    if picture is not None:
        from symboslam.engine.writers import check_targets

        check_targets([picture], [], lambda _: "png")
    rows: Rows = []
    with progress_bar() as progress:
        for place, is_paper, size in wanted:
            budget = 60 * (place.minutes if minutes is None else minutes)
            grounds = [
                open_area(
                    *(size or square(place.km2)), robots, place.features, seed,
                    speed=speed, reach=reach, fov=math.radians(fov),
                )
                for seed in range(seeds)
            ]  # fmt: skip
            made: list[Comparison] = []
            rows.append((place, is_paper, made))
            for name in names:
                total = len(wanted) * len(names)
                done = (len(rows) - 1) * len(names) + len(made)
                progress(f"{place.name}, {name}", done / total)
                made.append(compare(name, grounds, budget, until * budget))
            if picture is not None and len(rows) == 1:
                from symboslam.sim_bridge.search.picture import draw_paths

                panels = [(c.search, *grounds[0], c.trials[0]) for c in made]
                draw_paths(panels, budget, picture)
    if as_json:
        sys.stdout.write(json.dumps(_json(rows), indent=1, allow_nan=False) + "\n")
    else:
        show(_table(rows, minutes is None))
    if picture is not None:
        show(f"wrote {picture.resolve()}", error=True)


def _listed(text: str) -> list[str]:
    return list(dict.fromkeys(part.strip() for part in text.split(",") if part.strip()))


def _names(text: str) -> list[str]:
    """Names of strategies, all of them known."""
    from symboslam.sim_bridge.search.registry import get_search, searches

    names = list(searches()) if text.strip() == "all" else _listed(text)
    if not names:
        raise InputError(f"--strategies {text!r}: name one at least, of {', '.join(searches())}")
    for name in names:
        get_search(name)
    return names


def _area(
    name: str, minutes: float | None, features: int
) -> tuple[PaperArea, bool, tuple[float, float] | None]:
    """An area by its name or size; whether it is the paper's; its width and height if given."""
    from symboslam.sim_bridge.search.paper_areas import PaperArea, get_paper_area

    width, cross, height = name.casefold().partition("x")
    try:
        size = (float(width), float(height)) if cross else None
    except ValueError:
        size = None
    if size is None:
        try:
            return get_paper_area(name), True, None
        except UnknownNameError as error:
            raise UnknownNameError(f"{error}, all; or give metres such as 800x600") from None
    if not all(math.isfinite(side) and side > 0 for side in size):
        raise InputError(f"--area {name}: give a width and a height above 0")
    km2 = size[0] * size[1] / 1e6
    return PaperArea(name, km2, features, minutes or 30.0, 0.0, False), False, size


def _table(rows: Rows, timed: bool) -> Table:
    from symboslam.cli.common import table

    result = table(
        "area", "min", "A'/A", "strategy", "seen", "paper", "95 %", "all found",
        "apart", "of diag.",
    )  # fmt: skip
    result.columns[3].no_wrap = True
    for column in result.columns:
        column.justify = "left" if column.header in ("area", "strategy") else "right"
    for place, is_paper, made in rows:
        for number, c in enumerate(made):
            ideal = c.mean(lambda m, at=c.budget: m.ideal_share(at))  # type: ignore[misc]
            head = (place.name, f"{c.budget / 60:g}", f"{ideal:.2f}") if number == 0 else ("",) * 3
            told = f"{place.coverage:.1%}{'' if place.known else '*'}" if is_paper and timed else ""
            result.add_row(
                *head, c.search, f"{c.coverage:.1%}", told, c.time_to_95.text, c.time_to_all.text,
                f"{c.mean(lambda m, at=c.budget: m.mean_dispersion(at)):.0f}",  # type: ignore[misc]
                f"{c.mean(lambda m, at=c.budget: m.normalised_dispersion(at)):.2f}",  # type: ignore[misc]
            )  # fmt: skip
    if timed and any(is_paper and not place.known for place, is_paper, _ in rows):
        result.caption = "* an extreme of the paper's six areas: its own for this one is not known"
    return result


def _json(rows: Rows) -> list[dict[str, Any]]:
    return [
        {
            "area": place.name,
            "km2": place.km2,
            "features": place.features,
            "paper_coverage": place.coverage if is_paper and place.known else None,
            "strategies": [c.to_json() for c in made],
        }
        for place, is_paper, made in rows
    ]
