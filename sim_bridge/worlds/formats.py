"""Formats: which reader a world's file is for."""

from __future__ import annotations

from pathlib import Path

from symboslam.errors import InputError
from symboslam.sim_bridge.worlds.checks import Notes
from symboslam.sim_bridge.worlds.world import World


def read_any(source: str | Path, *, area_km2: float | None = None) -> tuple[World, Notes]:
    """A world of a file in any format that is known, and notes on what is odd in it.

    ``.json``: a world file; ``.geojson`` (may be gzipped): landmarks, with zones beside them;
    ``.sim``, ``.wld``, ``.txt``: EyeSim scenes, worlds and oracle files.

    Args:
        source: the file.
        area_km2: EyeSim: what the toy world stands for; default: millimetres are taken as such.

    Raises:
        InputError: the file cannot be read or is wrong, or its format is not known.
    """
    name = str(source).lower()
    if area_km2 is not None and not name.endswith((".sim", ".wld", ".txt")):
        raise InputError(f"{source}: an area is for EyeSim files: .sim, .wld or .txt")
    if name.endswith((".geojson", ".geojson.gz")):
        from symboslam.sim_bridge.worlds.geojson_world import read_geojson_world

        return read_geojson_world(source)
    if name.endswith((".sim", ".wld", ".txt")):
        from symboslam.sim_bridge.worlds.eyesim import read_eyesim

        return read_eyesim(source, area_km2=area_km2)
    if name.endswith(".json"):
        from symboslam.sim_bridge.worlds.world_file import read_world

        return read_world(source)
    raise InputError(f"{source}: what is it? Known are .json, .geojson, .sim, .wld and .txt")
