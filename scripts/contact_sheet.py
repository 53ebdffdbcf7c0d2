"""Pictures of the objects, rendered by pybullet's TinyRenderer: contact_sheet.py [OPTIONS].

python scripts/contact_sheet.py                      docs/images/objects.png: all 56 classes
python scripts/contact_sheet.py --variants Tree --out tree.png     all variants of one class
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

from symboslam.sim_bridge.objects import Bodies, Shape, classes, shape, variants
from symboslam.sim_bridge.objects.bullet import import_pybullet

ROOT = Path(__file__).resolve().parents[1]
SKY, GROUND = (214, 228, 238), (150, 160, 140)


def picture(made: Shape, size: int, *, turn: float = 35.0, tilt: float = 16.0) -> NDArray[np.uint8]:
    """(size, size, 3) bytes: the object from its front side, ``turn`` and ``tilt`` in degrees."""
    bullet: Any = import_pybullet()
    client = bullet.connect(bullet.DIRECT)
    try:
        Bodies(client).add(made)
        points = np.concatenate([part.vertices for part in made.parts]).astype(float)
        middle = made.bounds.astype(float).mean(0)
        a, b = np.radians(turn), np.radians(tilt)
        way = np.array([np.cos(a) * np.cos(b), -np.sin(a) * np.cos(b), np.sin(b)])
        away = 4 * float(np.linalg.norm(points - middle, axis=1).max())
        right = np.array([np.sin(a), np.cos(a), 0.0])
        up = np.cross(way, right)
        for _ in range(2):  # aim at the middle of what is seen
            rest = points - middle
            depth = away - rest @ way
            seen_at = np.stack([rest @ right, rest @ up], 1) / depth[:, None]
            aim = (seen_at.min(0) + seen_at.max(0)) / 2 * away
            middle = middle + right * aim[0] + up * aim[1]
        fov = 2 * np.degrees(np.arctan(np.ptp(seen_at, axis=0).max() / 2 * 1.08))
        view = bullet.computeViewMatrix((middle + way * away).tolist(), middle.tolist(), (0, 0, 1))
        lens = bullet.computeProjectionMatrixFOV(fov, 1, away * 0.2, away * 3)
        _, _, colours, _, mask = bullet.getCameraImage(
            size, size, view, lens, shadow=0, lightDirection=(2.0, -0.9, 2.6),
            lightAmbientCoeff=0.6, lightDiffuseCoeff=0.55, lightSpecularCoeff=0.0,
            renderer=bullet.ER_TINY_RENDERER, physicsClientId=client,
        )  # fmt: skip
    finally:
        bullet.disconnect(client)
    image = np.reshape(colours, (size, size, 4))[..., :3].astype(np.uint8)
    seen = np.reshape(mask, (size, size)) >= 0
    shade = np.linspace(0, 1, size)[:, None, None]
    ground = (np.array(SKY) * (1 - shade) + np.array(GROUND) * shade).astype(np.uint8)
    return np.where(seen[..., None], image, np.broadcast_to(ground, image.shape))


def sheet(shown: list[tuple[str, Shape]], columns: int, cell: int) -> Image.Image:
    """All objects in rows, each with its name below."""
    line = 18
    rows = -(-len(shown) // columns)
    page = Image.new("RGB", (columns * cell, rows * (cell + line)), (255, 255, 255))
    pen = ImageDraw.Draw(page)
    font = ImageFont.truetype(
        str(Path(matplotlib.get_data_path()) / "fonts" / "ttf" / "DejaVuSans.ttf"), 12
    )
    for i, (name, made) in enumerate(shown):
        x, y = i % columns * cell, i // columns * (cell + line)
        large = Image.fromarray(picture(made, 2 * (cell - 4)))
        page.paste(large.resize((cell - 4, cell - 4), Image.Resampling.LANCZOS), (x + 2, y + 2))
        pen.text((x + cell / 2, y + cell + line / 2 - 2), name, (20, 20, 20), font, anchor="mm")
    return page


def main() -> None:
    """Write the picture."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--variants", metavar="CLASS", action="append", help="all variants of it")
    parser.add_argument("--variant", default="0", help="the variant on the sheet of all classes")
    parser.add_argument("--columns", type=int, default=8)
    parser.add_argument("--cell", type=int, default=150, help="points along a side of a picture")
    parser.add_argument("--out", type=Path, default=ROOT / "docs" / "images" / "objects.png")
    options = parser.parse_args()
    if options.variants:
        shown = [(f"{c} {v}", shape(c, v)) for c in options.variants for v in variants(c)]
    else:
        shown = [(c, shape(c, options.variant)) for c in classes()]
    page = sheet(shown, options.columns, options.cell)
    page.save(options.out, optimize=True)
    print(f"wrote {options.out}: {len(shown)} objects, {options.out.stat().st_size // 1024} kB")


if __name__ == "__main__":
    main()
