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
    parts = [trimesh.Trimesh(p.vertices, p.faces, process=False) for p in made.parts]
    for mesh, part in zip(parts, made.parts, strict=True):
        mesh.visual.face_colors = part.rgba
    return trimesh.Scene(parts)
