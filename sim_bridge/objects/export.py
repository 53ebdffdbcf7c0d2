"""Shapes for other programs: a scene of trimesh, which writes GLB, OBJ and more."""

from __future__ import annotations

from typing import Any

from symboslam.errors import MissingExtraError
from symboslam.sim_bridge.objects.parts import Shape


def scene(made: Shape) -> Any:
    """A ``trimesh.Scene`` of the shape's parts: ``scene(made).export("house.glb")``.

    Raises:
        MissingExtraError: trimesh is not installed.
    """
    try:
        import trimesh
    except ImportError as error:
        raise MissingExtraError("trimesh", "sim") from error
    return trimesh.Scene(
        [
            trimesh.Trimesh(
                part.vertices, part.faces, process=False,
                face_colors=[[round(255 * c) for c in part.rgba]] * len(part.faces),
            )
            for part in made.parts
        ]
    )  # fmt: skip
