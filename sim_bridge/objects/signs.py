"""Sign boards with text, outside the detector's classes: a name that robots can read."""

from __future__ import annotations

import hashlib
from functools import lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from symboslam.errors import InputError
from symboslam.sim_bridge.objects.parts import Colour, Model, Part, Shape

WIDTH = 300  # points across a board
LONGEST = 40  # characters
SCHEMES: tuple[tuple[Colour, Colour], ...] = (
    ((20, 90, 50), (255, 255, 255)),
    ((30, 70, 150), (255, 255, 255)),
    ((250, 250, 245), (20, 20, 24)),
    ((250, 205, 40), (20, 20, 20)),
    ((130, 50, 40), (255, 250, 240)),
)
FONTS = ("DejaVuSans-Bold.ttf", "DejaVuSans.ttf", "DejaVuSerif-Bold.ttf")


def sign(text: str, rng: np.random.Generator, *, width: float = 2.4) -> Shape:
    """A board on two posts with a text on its front, +x.

    Args:
        text: one to 40 printable characters.
        rng: draws colours, type and height of the board.
        width: of the board, metres.

    Raises:
        InputError: the text is empty or longer.
    """
    text = " ".join(text.split())
    if not 0 < len(text) <= LONGEST or not text.isprintable():
        raise InputError(f"a sign has 1 to {LONGEST} printable characters, not {text!r}")
    ground, ink = SCHEMES[int(rng.integers(len(SCHEMES)))]
    picture = draw_text(text, ground, ink, FONTS[int(rng.integers(len(FONTS)))])
    tall = width * picture.shape[0] / picture.shape[1]
    low = float(rng.uniform(0.7, 1.3))
    model = Model()
    for y in (-width * 0.36, width * 0.36):
        model.box((0, y, 0), (0.09, 0.09, low + tall), (120, 124, 128))
    model.box((0.07, 0, low), (0.06, width, tall), ground)
    made = model.build(f"SignBoard/{_name(text, picture, low, width)}")
    x, half = 0.11, width / 2
    corners = [(x, -half, low), (x, half, low), (x, half, low + tall), (x, -half, low + tall)]
    board = Part(
        np.array(corners, np.float32), np.array([(0, 1, 2), (0, 2, 3)], np.int32), (1, 1, 1, 1),
        np.array([(0, 0), (1, 0), (1, 1), (0, 1)], np.float32),
    )  # fmt: skip
    return Shape(made.name, (*made.parts, board), picture)


@lru_cache(maxsize=256)
def draw_text(text: str, ground: Colour, ink: Colour, font: str) -> NDArray[np.uint8]:
    """(height, 300, 3) bytes: the text in one or two lines as large as fits, within a frame."""
    import matplotlib
    from PIL import Image, ImageDraw, ImageFont

    path = Path(matplotlib.get_data_path()) / "fonts" / "ttf" / font
    lines = _lines(text)
    size = 80
    while size > 10:
        face = ImageFont.truetype(str(path), size)
        boxes = [face.getbbox(line) for line in lines]
        if max(b[2] - b[0] for b in boxes) <= WIDTH - 36:
            break
        size -= 2
    step = round(size * 1.25)
    height = step * len(lines) + 32
    image = Image.new("RGB", (WIDTH, height), ground)
    pen = ImageDraw.Draw(image)
    pen.rectangle((5, 5, WIDTH - 6, height - 6), outline=ink, width=3)
    for i, line in enumerate(lines):
        pen.text((WIDTH / 2, 16 + step * (i + 0.5)), line, fill=ink, font=face, anchor="mm")
    return np.asarray(image, np.uint8)


def _lines(text: str) -> list[str]:
    """One line, or two of about the same length."""
    words = text.split(" ")
    if len(text) <= 10 or len(words) == 1:
        return [text]
    cuts = [(" ".join(words[:i]), " ".join(words[i:])) for i in range(1, len(words))]
    first, second = min(cuts, key=lambda cut: max(len(cut[0]), len(cut[1])))
    return [first, second]


def _name(text: str, picture: NDArray[np.uint8], low: float, width: float) -> str:
    """A name that differs where the sign differs."""
    seed = hashlib.sha256(picture.tobytes() + f"{text}/{low}/{width}".encode())
    return f"{text}-{seed.hexdigest()[:8]}"
