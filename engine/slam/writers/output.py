"""Output: what a writer of maps gets, and what it hands back."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, field
from pathlib import Path

from symboslam.engine.readers.columns import FeatureIndex
from symboslam.engine.slam.log import Mission
from symboslam.engine.slam.slam_map import SlamMap
from symboslam.engine.writers.atomic import atomic_file


@dataclass(frozen=True)
class Output:
    """A map to write.

    Attributes:
        path: the file.
        slam_map: the map.
        mission: the logs that it was made of.
        origin: GeoJSON: longitude and latitude of the map's (0, 0), x pointing east; None leaves
            local metres.
        paths: GeoJSON: another file, for the trajectories.
        base: RDF: IRI below which the map's own IRIs lie; None derives one from the content.
        knowledge: RDF: ontology whose terms the classes are.
    """

    path: Path
    slam_map: SlamMap
    mission: Mission
    origin: tuple[float, float] | None = None
    paths: Path | None = None
    base: str | None = None
    knowledge: FeatureIndex | None = None


@dataclass(frozen=True)
class Written:
    """What was written.

    Attributes:
        files: the files.
        notes: what the format cannot hold, one sentence each.
    """

    files: tuple[Path, ...]
    notes: tuple[str, ...] = field(default=())


def write_files(files: Sequence[tuple[Path, Iterable[str]]]) -> None:
    """Write texts; no file is replaced before all are written.

    Raises:
        OutputError: one cannot be written.
    """
    with ExitStack() as stack:
        streams = [stack.enter_context(atomic_file(path)) for path, _ in files]
        for stream, (_, texts) in zip(streams, files, strict=True):
            for text in texts:
                stream.write(text.encode("utf-8", "replace"))
