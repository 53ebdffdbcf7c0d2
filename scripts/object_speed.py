"""Time to load, step and render objects, for three ways to give them colours: object_speed.py.

palette: what symboslam.sim_bridge.objects does; a mesh from memory with one texture for all.
links:   one link of a body for each colour, each with a colour of its own.
files:   the same mesh as the palette's, as OBJ and MTL files with the texture.
box:     a plain box, to compare.

Each way and number is measured in a process of its own, for the memory's sake.
"""

from __future__ import annotations

import platform
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from symboslam.sim_bridge.objects import Bodies, Shape, classes, shape, variants
from symboslam.sim_bridge.objects.bullet import import_pybullet, mesh, palette

bullet: Any = import_pybullet()
Maker = Callable[[Shape, tuple[float, float, float]], None]


def palette_maker(client: int, folder: Path) -> Maker:
    """Our own way."""
    bodies = Bodies(client)
    return lambda made, at: void(bodies.add(made, at))


def links_maker(client: int, folder: Path) -> Maker:
    """A link for each colour."""
    shared: dict[str, list[int]] = {}

    def make(made: Shape, at: tuple[float, float, float]) -> None:
        if made.name not in shared:
            shared[made.name] = []
            for part in made.parts:
                rows, faces = mesh(Shape(made.name, (part,)))
                shared[made.name].append(
                    bullet.createVisualShape(
                        bullet.GEOM_MESH, vertices=rows[:, :3].tolist(),
                        normals=rows[:, 3:6].tolist(), indices=faces.ravel().tolist(),
                        rgbaColor=part.rgba,
                        physicsClientId=client,
                    )
                )  # fmt: skip
        seen = shared[made.name]
        n = len(seen) - 1
        bullet.createMultiBody(
            0, -1, seen[0], at, linkMasses=[0] * n, linkCollisionShapeIndices=[-1] * n,
            linkVisualShapeIndices=seen[1:], linkPositions=[(0, 0, 0)] * n,
            linkOrientations=[(0, 0, 0, 1)] * n, linkInertialFramePositions=[(0, 0, 0)] * n,
            linkInertialFrameOrientations=[(0, 0, 0, 1)] * n, linkParentIndices=[0] * n,
            linkJointTypes=[bullet.JOINT_FIXED] * n, linkJointAxis=[(0, 0, 1)] * n,
            physicsClientId=client,
        )  # fmt: skip

    return make


def files_maker(client: int, folder: Path) -> Maker:
    """OBJ files with a texture."""
    shared: dict[str, int] = {}
    Image.fromarray(palette()).save(folder / "palette.png")
    (folder / "palette.mtl").write_text("newmtl all\nKd 1 1 1\nmap_Kd palette.png\n")

    def make(made: Shape, at: tuple[float, float, float]) -> None:
        if made.name not in shared:
            path = folder / f"{made.name.replace('/', '-')}.obj"
            rows, faces = mesh(made)
            lines = ["mtllib palette.mtl"]
            for word, data in (("v", rows[:, :3]), ("vn", rows[:, 3:6]), ("vt", rows[:, 6:])):
                lines += [" ".join([word, *(f"{x:.6g}" for x in row)]) for row in data]
            lines.append("usemtl all")
            for face in faces + 1:
                lines.append("f " + " ".join(f"{j}/{j}/{j}" for j in face))
            path.write_text("\n".join(lines) + "\n")
            shared[made.name] = bullet.createVisualShape(
                bullet.GEOM_MESH, fileName=str(path), physicsClientId=client
            )
        bullet.createMultiBody(0, -1, shared[made.name], at, physicsClientId=client)

    return make


def box_maker(client: int, folder: Path) -> Maker:
    """Plain boxes."""
    seen = bullet.createVisualShape(bullet.GEOM_BOX, halfExtents=(2, 2, 2), physicsClientId=client)
    return lambda made, at: void(bullet.createMultiBody(0, -1, seen, at, physicsClientId=client))


def void(_: object) -> None:
    """Nothing."""


MAKERS: dict[str, Callable[[int, Path], Maker]] = {
    "palette": palette_maker, "links": links_maker, "files": files_maker, "box": box_maker,
}  # fmt: skip


def measure(way: str, count: int) -> str:
    """A row of the table."""
    names = [(c, v) for v in variants("Tree")[:12] for c in classes()]
    made = [shape(*names[i % len(names)]) for i in range(count)]
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    side = int(np.ceil(np.sqrt(count)))
    client = bullet.connect(bullet.DIRECT)
    with tempfile.TemporaryDirectory() as folder:
        make = MAKERS[way](client, Path(folder))
        start = time.perf_counter()
        for i, one in enumerate(made):
            make(one, (30.0 * (i % side), 30.0 * (i // side), 0.0))
        load = (time.perf_counter() - start) / count * 1000
    start = time.perf_counter()
    for _ in range(50):
        bullet.stepSimulation(physicsClientId=client)
    step = (time.perf_counter() - start) / 50 * 1000
    view = bullet.computeViewMatrix((-60, -60, 40), (side * 12, side * 12, 0), (0, 0, 1))
    lens = bullet.computeProjectionMatrixFOV(60, 4 / 3, 1, 2000)
    times = []
    for _ in range(7):
        start = time.perf_counter()
        picture = bullet.getCameraImage(
            320, 240, view, lens, shadow=0, renderer=bullet.ER_TINY_RENDERER, physicsClientId=client
        )
        times.append(time.perf_counter() - start)
    render, seen = float(np.median(times)) * 1000, len(np.unique(picture[4])) - 1
    memory = (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) / 1024
    return f"| {way} | {count} | {load:.2f} | {step:.2f} | {render:.0f} | {seen} | {memory:.0f} |"


def main() -> None:
    """Print a table."""
    if len(sys.argv) == 3:
        print(measure(sys.argv[1], int(sys.argv[2])))
        return
    print(f"{platform.machine()}, Python {platform.python_version()}, {time.strftime('%Y-%m-%d')}")
    sizes = [shape(c, v).triangles for c in classes() for v in variants(c)]
    print(f"triangles of a shape: median {np.median(sizes):.0f}, most {max(sizes)}\n")
    print("| way | objects | load, ms each | step, ms | render 320x240, ms | seen | memory, MB |")
    print("|---|---|---|---|---|---|---|")
    for way in MAKERS:
        for count in (60, 500, 3000):
            done = subprocess.run(
                [sys.executable, __file__, way, str(count)], capture_output=True, text=True,
                check=True,
            )  # fmt: skip
            print(done.stdout.splitlines()[-1], flush=True)


if __name__ == "__main__":
    main()
