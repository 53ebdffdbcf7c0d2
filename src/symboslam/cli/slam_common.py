"""What the commands of ``symboslam slam`` share: options, reading logs, writing maps."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from symboslam.cli.common import Progress, load_knowledge, show
from symboslam.errors import GeometryError, InputError, MissingExtraError

if TYPE_CHECKING:
    from symboslam.engine.slam.log import Mission
    from symboslam.engine.slam.slam_map import SlamMap
    from symboslam.reasoning.knowledge import Knowledge

FromOption = Annotated[
    str | None,
    typer.Option(
        "--from", help="mrclam, csv, g2o, gtsam, tum or ndjson.", show_default="by content"
    ),
]
ClassesOption = Annotated[
    int | None,
    typer.Option(help="mrclam: so many classes in the place of identities.", show_default=False),
]
StartsOption = Annotated[
    str | None,
    typer.Option(
        "--starts",
        "--start",
        help="mrclam: robots whose start is known: all, first or none.",
        show_default="all",
    ),
]
IdentitiesOption = Annotated[
    str | None,
    typer.Option(help="g2o, gtsam: landmarks' numbers shown or hidden.", show_default="shown"),
]
OriginOption = Annotated[
    str | None,
    typer.Option(metavar="LON,LAT", help="geojson: where (0, 0) lies.", show_default="metres"),
]
OutOption = Annotated[
    list[Path] | None,
    typer.Option(
        "--out",
        metavar="FILE",
        help="Write the map: .tum, .g2o, .geojson, .ttl or .dsg.json. May be given several times.",
        show_default=False,
    ),
]
JsonOption = Annotated[bool, typer.Option("--json", help="Print one JSON object.")]


def check_outs(outs: Sequence[Path], inputs: Sequence[Path], origin: str | None) -> None:
    """Refuse outputs that cannot be written, before any work is done for them.

    Raises:
        OutputError: one has no format, is an input or another output, or may not be written.
        InputError: an origin, and no output that has one.
    """
    from symboslam.engine.slam import writers
    from symboslam.engine.writers import check_targets

    check_targets(outs, inputs, writers.format_of)
    if origin is not None and not any(writers.format_of(out) == "geojson" for out in outs):
        raise InputError("--origin is for GeoJSON: give an --out that ends in .geojson")


def knowledge_for(
    read_as: str, outs: Sequence[Path], ontology: Path | None, progress: Progress
) -> Knowledge | None:
    """The ontology, where a reader or a writer asks for it."""
    from symboslam.engine.slam import readers, writers

    asks = read_as in readers.FORMATS and "knowledge" in readers.FORMATS[read_as].options
    if asks or any(writers.format_of(out) == "turtle" for out in outs):
        return load_knowledge(ontology, progress)
    return None


def write_outs(
    outs: Sequence[Path],
    slam_map: SlamMap,
    mission: Mission,
    origin: tuple[float, float] | None,
    knowledge: Knowledge | None,
) -> tuple[list[Path], list[str]]:
    """Write a map in the format of each file; files that were written, and notes."""
    from symboslam.engine.slam import writers

    files: list[Path] = []
    notes: list[str] = []
    for out in outs:
        name = writers.format_of(out)
        options: dict[str, Any] = {}
        if name == "geojson":
            options["origin"] = origin
        elif name == "turtle":
            options["knowledge"] = knowledge
        written = writers.write_slam_map(out, slam_map, mission, name, **options)
        files += written.files
        notes += written.notes
    return files, notes


@contextmanager
def needs_slam() -> Iterator[None]:
    """Imports of what map building needs.

    Raises:
        MissingExtraError: it is not installed.
    """
    try:
        yield
    except ModuleNotFoundError as error:
        if error.name in ("gtsam", "httpx", "networkx"):
            raise MissingExtraError(error.name, "slam") from error
        raise


def estimator() -> Callable[..., SlamMap]:
    """Our way to build maps.

    Raises:
        MissingExtraError: what it needs is not installed.
    """
    with needs_slam():
        from symboslam.engine.slam.estimate import estimate
    made: Callable[..., SlamMap] = estimate
    return made


def between(progress: Progress, first: float, last: float) -> Progress:
    """Progress of a part of the work, from one share of the whole to another."""
    return lambda what, share: progress(what, first + (last - first) * share)


def tell_doubts(doubts: Sequence[str]) -> None:
    """Print on standard error why a map should not be trusted."""
    for doubt in doubts:
        show(f"doubt: {doubt}", error=True)


def starts_of(mission: Mission) -> dict[str, str]:
    """Robot -> which start of it is used.

    ``known``: it was given; ``first``: nobody's is known, and the map is laid through that of the
    first robot; ``none``: it has to be found.
    """
    known = {log.name for log in mission.robots if log.start is not None}
    alone = not known and all(log.fixes is None for log in mission.robots)
    return {
        log.name: "known" if log.name in known else "first" if alone and n == 0 else "none"
        for n, log in enumerate(mission.robots)
    }


def robots_lost(slam_map: SlamMap, mission: Mission) -> list[str]:
    """Robots that have no place in a map."""
    return [log.name for log in mission.robots if log.name not in slam_map.trajectories]


def plural(number: int, one: str, many: str | None = None) -> str:
    """Number and noun."""
    return f"{number} {one if number == 1 else many or one + 's'}"


def origin_of(text: str | None) -> tuple[float, float] | None:
    """The two numbers of ``LON,LAT``.

    Raises:
        GeometryError: not two numbers.
    """
    if text is None:
        return None
    try:
        longitude, latitude = (float(v) for v in text.replace(" ", "").split(","))
    except ValueError:
        raise GeometryError(
            f"--origin {text!r}: give two numbers LON,LAT, such as 149.13,-35.28"
        ) from None
    return longitude, latitude
