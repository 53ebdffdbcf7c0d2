"""``symboslam sim table``: missions in all areas of the paper, and the page about them."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from symboslam.cli.common import load_knowledge, progress_bar, show
from symboslam.cli.sim_run import INTERRUPTED, Slam
from symboslam.errors import InputError, SymboSlamError

if TYPE_CHECKING:
    from symboslam.sim_bridge.table.plan import Plan

EXAMPLES = """
[bold]Examples[/]

symboslam sim table --record build/sim-table

symboslam sim table kingston city --quick --out trial/results.md

symboslam sim table --from build/sim-table
"""


def table(
    areas: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="AREA",
            help="kingston, train-depot, city, fyshwick, airport, gungahlin, city-10-robots (for "
            "its speed alone), demo or a world's file.",
            show_default="the six areas and city-10-robots",
        ),
    ] = None,
    out: Annotated[
        Path,
        typer.Option(
            metavar="FILE.md",
            help="The page: its part between the marks is written anew, pictures go to images "
            "beside it.",
        ),
    ] = Path("docs/results.md"),
    record: Annotated[
        Path,
        typer.Option(
            metavar="DIR",
            help="Where missions are recorded; finished ones that are there are not flown again.",
        ),
    ] = Path("sim-table"),
    source: Annotated[
        Path | None,
        typer.Option(
            "--from",
            metavar="DIR",
            help="Write the page of a record, and fly nothing.",
            show_default=False,
        ),
    ] = None,
    jobs: Annotated[int, typer.Option(min=1, help="Missions at once.")] = 2,
    robots: Annotated[int, typer.Option(min=1, help="In each area.")] = 3,
    search: Annotated[
        str, typer.Option(metavar="NAME", help="Search strategy, see symboslam sim run.")
    ] = "boustrophedon",
    slam: Annotated[Slam, typer.Option(help="Map building, see symboslam sim run.")] = Slam.OURS,
    speed: Annotated[float, typer.Option(metavar="M/S", help="Of the robots, at most.")] = 15.0,
    reach: Annotated[
        float,
        typer.Option("--range", metavar="M", help="Within which ground counts as looked at."),
    ] = 80.0,
    seed: Annotated[int, typer.Option(min=0, help="The same seed gives the same missions.")] = 0,
    world_seed: Annotated[int, typer.Option(min=0, help="Of named worlds.")] = 7,
    time_limit: Annotated[
        float | None,
        typer.Option(
            metavar="MIN",
            help="Simulated minutes of each mission.",
            show_default="the paper's, or 10",
        ),
    ] = None,
    quick: Annotated[
        bool, typer.Option("--quick", help="One minute each, to see that it works.")
    ] = False,
) -> None:
    """Fly missions in all areas of the paper and write tables, plots and a film.

    Ctrl-C keeps the missions that are finished; the same command goes on with the others. The exit
    code is then 130, and 1 if a mission failed.
    """
    from symboslam.sim_bridge.table.page import around, write_page

    around(out)
    names, folder = list(areas or ()), source or record
    failed: dict[str, str] = {}
    if source is None:
        names, failed = _fly(
            names, folder, jobs, 1.0 if quick and time_limit is None else time_limit,
            robots=robots, search=search, slam=str(slam), speed=speed, reach=reach, seed=seed,
            world_seed=world_seed,
        )  # fmt: skip
    from symboslam.sim_bridge.table.finished import failures_in, finished_in

    if source is None and not names:
        raise SymboSlamError(_failures(failed))
    with progress_bar() as progress:
        missions = finished_in(folder, names)
        written = write_page(
            missions, load_knowledge(None, progress), out, progress, failures_in(folder)
        )
    show("\n".join(f"wrote {path.resolve()}" for path in written))
    if failed:
        raise SymboSlamError(_failures(failed))


def _fly(
    areas: Sequence[str], folder: Path, jobs: int, minutes: float | None,
    **options: float | int | str,
) -> tuple[list[str], dict[str, str]]:  # fmt: skip
    """Fly what is not finished; names of what is then, and what went wrong."""
    from symboslam.sim_bridge.objects.bullet import import_pybullet
    from symboslam.sim_bridge.search.registry import get_search
    from symboslam.sim_bridge.table.area_run import is_finished
    from symboslam.sim_bridge.table.plan import MANY, plans
    from symboslam.sim_bridge.table.workers import run_all
    from symboslam.sim_bridge.worlds.generator import get_world

    if minutes is not None and not 0 < minutes < 1e5:
        raise InputError(f"--time-limit {minutes:g}: give minutes above 0")
    if not 0 < float(options["speed"]) <= 50:
        raise InputError(f"--speed {options['speed']:g}: give metres a second above 0, at most 50")
    if not 0 < float(options["reach"]) <= 500:
        raise InputError(f"--range {options['reach']:g}: give metres above 0, at most 500")
    import_pybullet()
    get_search(str(options["search"]))
    chosen = plans(areas, minutes, **options)
    for plan in chosen:
        if plan.name != MANY:
            get_world(plan.world, plan.world_seed)
    wanted = [plan for plan in chosen if not is_finished(plan, folder)]
    with _lines(wanted) as tell:
        try:
            failed = run_all(wanted, folder, jobs, tell)
        except KeyboardInterrupt:
            text = f"interrupted: what is finished is kept in {folder}; the same command goes on"
            show(text, error=True)
            raise typer.Exit(INTERRUPTED) from None
    return [plan.name for plan in chosen if plan.name not in failed], failed


def _failures(failed: dict[str, str]) -> str:
    return "; ".join(f"{name} failed: {text}" for name, text in failed.items())


@contextmanager
def _lines(wanted: Sequence[Plan]) -> Iterator[Callable[[str, str, float], None]]:
    """A bar for each mission on standard error; where that is no terminal, a line at its end."""
    if not sys.stderr.isatty():

        def line(name: str, stage: str, share: float) -> None:
            if share >= 1:
                show(f"{name}: {stage}", error=True)

        yield line
        return
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

    columns = (
        TextColumn("{task.fields[area]:15}"), BarColumn(), TimeElapsedColumn(),
        TextColumn("{task.description}"),
    )  # fmt: skip
    with Progress(*columns, console=Console(stderr=True)) as bars:
        tasks = {
            plan.name: bars.add_task("waiting", total=1.0, area=plan.name, start=False)
            for plan in wanted
        }

        def tell(name: str, stage: str, share: float) -> None:
            bars.start_task(tasks[name])
            bars.update(tasks[name], description=stage, completed=share)

        yield tell
