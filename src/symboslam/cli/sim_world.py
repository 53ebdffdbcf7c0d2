"""``symboslam sim world``: make or read a world, tell what is in it, write it and its truth."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from symboslam.cli.common import progress_bar, show
from symboslam.cli.slam_common import plural
from symboslam.errors import InputError, OutputError

if TYPE_CHECKING:
    from rich.table import Table

    from symboslam.sim_bridge.worlds.world import World

EXAMPLES = """
[bold]Examples[/]

symboslam sim world city --out city.json --out city.png

symboslam sim world kingston --seed 3 --out zones.geojson --out landmarks.geojson

symboslam sim world ACT_Sim_03_city.sim --area 1.8225 --out city.json
"""


def world(
    name: Annotated[
        str | None,
        typer.Argument(
            metavar="NAME|FILE",
            help="gungahlin, airport, fyshwick, kingston, train-depot, city or demo; or a file: "
            "a world (.json), landmarks (.geojson) or EyeSim (.sim, .wld, .txt).",
            show_default=False,
        ),
    ] = None,
    seed: Annotated[int, typer.Option(help="Of a named area: another seed, another world.")] = 7,
    area: Annotated[
        float | None,
        typer.Option(
            metavar="KM2",
            help="EyeSim: the area that the toy world stands for.",
            show_default="millimetres as they are",
        ),
    ] = None,
    outs: Annotated[
        list[Path] | None,
        typer.Option(
            "--out",
            metavar="FILE",
            help="Write: a world (.json), its picture (.png), its zones (zones.geojson) or its "
            "objects (landmarks.geojson). May be given several times.",
            show_default=False,
        ),
    ] = None,
    classes: Annotated[
        bool, typer.Option("--classes", help="List the 56 classes of objects with their sizes.")
    ] = False,
) -> None:
    """Make a world for robots, or read one, and tell what is in it."""
    if classes:
        show(_sizes())
        return
    if name is None:
        raise InputError("name an area or a file: see symboslam sim world --help")
    targets = list(outs or [])
    _check(targets, name)
    from symboslam.sim_bridge.worlds.formats import read_any
    from symboslam.sim_bridge.worlds.generator import get_world

    with progress_bar() as progress:
        progress("making the world", 0.1)
        made, notes = get_world(name, seed) if area is None else read_any(name, area_km2=area)
        for number, target in enumerate(targets):
            progress(f"writing {target.name}", 0.5 + 0.5 * number / len(targets))
            _write(made, target)
    show(_summary(made), _by_zone(made))
    files = [f"wrote {target.resolve()}" for target in targets]
    if notes or files:
        show("\n".join([*notes, *files]))


def _kind_of(target: str | Path) -> str:
    """What a file is to hold: world, picture, zones or landmarks."""
    name = Path(target).name.lower()
    if name.endswith(".png"):
        return "picture"
    if name.endswith(".geojson"):
        if "landmarks" in name:
            return "landmarks"
        if "zones" in name:
            return "zones"
        raise OutputError(
            f"{target}: zones or landmarks? Put one of the words in the name of the .geojson file"
        )
    if name.endswith(".json"):
        return "world"
    raise OutputError(f"{target}: what is it to be? Give .json, .png or .geojson")


def _check(targets: Sequence[Path], name: str) -> None:
    """Refuse outputs that cannot be written before any work is done for them."""
    from symboslam.engine.writers import check_targets

    source = Path(name)
    check_targets(targets, [source] if source.is_file() else [], _kind_of)


def _write(made: World, target: Path) -> None:
    from symboslam.sim_bridge.worlds import truth

    kind = _kind_of(target)
    if kind == "picture":
        from symboslam.sim_bridge.worlds.picture import draw_world

        draw_world(made, target)
    elif kind == "world":
        from symboslam.sim_bridge.worlds.world_file import write_world

        write_world(made, target)
    elif kind == "zones":
        truth.write_geojson(truth.zones_geojson(made), target)
    else:
        truth.write_geojson(truth.landmarks_geojson(made), target)


def _summary(made: World) -> str:
    e = made.extent
    return (
        f"{made.name}: {e.width:,.1f} m x {e.height:,.1f} m = {e.area_km2:.4f} km2, "
        f"{plural(len(made.objects), 'object')} of "
        f"{plural(len(made.class_counts), 'class', 'classes')}, "
        f"{plural(len(made.zones), 'zone')}, {plural(len(made.starts), 'robot start')}"
    )


def _by_zone(made: World) -> Table:
    """Area, objects and most frequent classes of each environment."""
    from symboslam.cli.common import table

    result = table("environment", "share", "objects", "most frequent")
    result.columns[2].justify = "right"
    where = made.environments_at(made.positions)
    areas = made.zone_areas_km2()
    rows: list[str | None] = [*areas, None] if None in where else [*areas]
    for environment in rows:
        here = [o.kind for o, e in zip(made.objects, where, strict=True) if e == environment]
        share = f"{areas[environment] / made.extent.area_km2:.1%}" if environment else ""
        most = ", ".join(f"{kind} {n}" for kind, n in Counter(here).most_common(5))
        result.add_row(environment or "(no zone)", share, f"{len(here):,}", most)
    return result


def _sizes() -> Table:
    from symboslam.cli.common import table
    from symboslam.sim_bridge.worlds.sizes import SIZES

    result = table("class", "length m", "width m", "height m", "moves")
    for name, size in SIZES.items():
        numbers = (f"{value:g}" for value in size[:3])
        result.add_row(name, *numbers, "yes" if size.moves else "")
    return result
