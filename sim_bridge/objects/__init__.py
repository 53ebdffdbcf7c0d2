"""Objects of the simulated worlds: one model for each of the detector's 56 classes, in variants.

::

    made = shape("House", "3")          # triangles and colours, in metres
    bodies = Bodies(client)             # in a physics client of pybullet
    body = bodies.add(made, (10, 0, 0), yaw=1.57)
"""

from symboslam.sim_bridge.objects.bullet import Bodies
from symboslam.sim_bridge.objects.catalogue import (
    ShapeError,
    classes,
    placeholder,
    shape,
    variants,
)
from symboslam.sim_bridge.objects.export import scene
from symboslam.sim_bridge.objects.parts import Part, Shape
from symboslam.sim_bridge.objects.signs import sign
from symboslam.sim_bridge.worlds.sizes import SIZES

__all__ = [
    "SIZES",
    "Bodies",
    "Part",
    "Shape",
    "ShapeError",
    "classes",
    "placeholder",
    "scene",
    "shape",
    "sign",
    "variants",
]
