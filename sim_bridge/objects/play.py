"""Sport and play: baskets, courts, goals, slides and swings."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from symboslam.sim_bridge.objects.draw import Draw
from symboslam.sim_bridge.objects.parts import Colour, Model

WHITE: Colour = (244, 244, 242)
ORANGE: Colour = (240, 96, 30)
BRIGHT: tuple[Colour, ...] = (
    (220, 50, 40),
    (250, 200, 40),
    (40, 120, 200),
    (60, 160, 80),
    (240, 130, 40),
    (130, 70, 160),
)


def basket(
    m: Model,
    x: float,
    y: float,
    turn: int,
    axis: str,
    board: Colour,
    rim: Colour,
    pole: Colour,
    wide: float,
    tall: float,
    arm: float,
    *,
    fine: bool = True,
) -> None:
    """A pole with a board and a ring; ``axis`` is where it looks, ``turn`` the sign of that."""

    def at(forward: float, side: float, z: float) -> tuple[float, float, float]:
        return (
            (x + turn * forward, y + side, z) if axis == "x" else (x + side, y + turn * forward, z)
        )

    side = ("+" if turn > 0 else "-") + axis
    m.box(at(0, 0, 0), (0.2, 0.2, 2.9), pole)
    m.beam(at(0, 0, 2.7), at(arm, 0, 3.3), (0.14, 0.14), pole)
    m.box(at(arm, 0, 2.85), (0.06, wide, tall) if axis == "x" else (wide, 0.06, tall), board)
    face = arm + 0.03
    middle = 2.85 + tall / 2
    for z, h in ((2.9, 0.08), (2.81 + tall, 0.08)):
        m.panel(side, at(face, 0, z), (wide, h), rim)
    for s in (-1, 1):
        m.panel(side, at(face, s * (wide / 2 - 0.04), middle), (0.08, tall), rim)
        m.panel(side, at(face + 0.01, s * 0.27, 3.28), (0.07, 0.5), rim)
    for z in (3.08, 3.5):
        m.panel(side, at(face + 0.01, 0, z), (0.6, 0.07), rim)
    n = 8
    ring = [
        at(arm + 0.3 + 0.26 * np.cos(t), 0.26 * np.sin(t), 3.05)
        for t in np.arange(n + 1) * 2 * np.pi / n
    ]
    for a, b in pairwise(ring):
        m.beam(a, b, (0.05, 0.05), ORANGE)
    if not fine:
        return
    lower = [
        at(arm + 0.3 + 0.16 * np.cos(t), 0.16 * np.sin(t), 2.62)
        for t in (np.arange(n + 1) + 0.5) * 2 * np.pi / n
    ]
    for i in range(n):
        for a, b in ((ring[i], lower[i]), (ring[i + 1], lower[i])):
            p, q = np.asarray(a), np.asarray(b)
            across = np.array((0.012, 0.012, 0))
            m.add([p - across, p + across, q], [(0, 1, 2), (0, 2, 1)], WHITE)


def basketball_backboard(m: Model, d: Draw) -> None:
    """A pole with an arm, a board with a painted square, a ring and its net."""
    board = d.tint(d.turn([WHITE, (206, 226, 232), (240, 236, 220), (60, 70, 90)]), 6)
    rim = d.turn([(200, 40, 36), (30, 60, 140), (30, 32, 34), (236, 120, 40)])
    if d.style(4) == 3:
        rim = WHITE
    pole = d.tint(d.turn([(60, 64, 68), (40, 80, 150), (150, 154, 158), (50, 110, 70)]))
    wide, tall = d.between(1.5, 1.85), d.between(0.95, 1.1)
    basket(m, -0.7, 0, 1, "x", board, rim, pole, wide, tall, d.between(0.5, 0.8))
    if d.style(2):
        m.box(
            (-0.7, 0, 0.2),
            (0.34, 0.34, 1.6),
            d.turn([(40, 60, 130), (190, 50, 40), (240, 200, 50)]),
        )
    m.box((-0.7, 0, 0), (0.8, 0.8, 0.1), (150, 150, 148))


def basketball_court(m: Model, d: Draw) -> None:
    """A coloured floor with white lines, zones in another colour and a basket at either end."""
    floor = d.tint(
        d.turn([(178, 96, 62), (60, 110, 150), (70, 130, 90), (200, 150, 96), (110, 114, 120)])
    )
    zone = d.tint(d.turn([(60, 120, 80), (190, 80, 60), (40, 80, 130), (150, 50, 50)]))
    half, wide, z = 13.0, 7.0, 0.06
    m.box((0, 0, 0), (2 * wide + 1.6, 2 * half + 1.8, z), floor)

    def flat(x: float, y: float, w: float, length: float, colour: Colour, level: int) -> None:
        a, b, h = w / 2, length / 2, z + 0.015 * level
        m.add(
            [(x - a, y - b, h), (x + a, y - b, h), (x + a, y + b, h), (x - a, y + b, h)],
            [(0, 1, 2), (0, 2, 3)],
            colour,
        )

    line = 0.16
    for s in (-1, 1):
        flat(s * wide, 0, line, 2 * half, WHITE, 2)
        flat(0, s * half, 2 * wide, line, WHITE, 2)
        flat(0, s * (half - 2.9), 4.9, 5.8, zone, 1)
        for x in (-2.45, 2.45):
            flat(x, s * (half - 2.9), line, 5.8, WHITE, 2)
        flat(0, s * (half - 5.8), 4.9, line, WHITE, 2)
        arc = [
            (6.2 * np.sin(t), s * (half - 1.5 - 6.2 * np.cos(t)), z + 0.03)
            for t in np.linspace(-1.5, 1.5, 9)
        ]
        for a, b in pairwise(arc):
            m.beam(a, b, (line, 0.02), WHITE)
        board = d.turn([WHITE, (206, 226, 232)])
        basket(
            m,
            0,
            s * (half + 0.5),
            -s,
            "y",
            board,
            (200, 40, 36),
            (60, 64, 68),
            1.8,
            1.05,
            1.0,
            fine=False,
        )
    flat(0, 0, 2 * wide, line, WHITE, 2)
    m.lathe((0, 0, z), [(1.9, 0), (1.9, 0.012)], WHITE, n=14)
    m.lathe((0, 0, z), [(1.74, 0), (1.74, 0.024)], zone, n=14)


def soccer_goals(m: Model, d: Draw) -> None:
    """A white frame with a net behind it, open to the front."""
    half, high, deep = d.between(3.2, 3.7), d.between(2.2, 2.5), d.between(1.5, 2.0)
    r = d.between(0.07, 0.11)
    frame = d.turn([WHITE, WHITE, (240, 210, 60), (230, 90, 40)])
    net = d.tint(d.turn([(206, 210, 214), (170, 176, 180), (120, 170, 210), (210, 160, 120)]))
    back, top = -deep, d.turn([0.0, -0.8, -0.5])
    for s in (-1, 1):
        y = s * half
        m.rod((0, y, 0), (0, y, high), r, frame)
        m.rod((0, y, r), (back, y, r), r * 0.5, frame, n=4)
        if top:
            m.rod((0, y, high), (top, y, high), r * 0.5, frame, n=4)
        m.rod((top, y, high), (back, y, r), r * 0.5, frame, n=4)
    m.rod((0, -half - r, high), (0, half + r, high), r, frame)
    m.rod((back, -half, r), (back, half, r), r * 0.5, frame, n=4)
    thin = 0.022

    def thread(a: np.ndarray, b: np.ndarray, across: tuple[float, float, float]) -> None:
        v = np.asarray(across) * thin
        m.add([a - v, a + v, b + v, b - v], [(0, 1, 2), (0, 2, 3), (0, 2, 1), (0, 3, 2)], net)

    upper, lower = np.array((top, 0, high)), np.array((back, 0, 0.05))
    for y in np.linspace(-half, half, 16):
        thread(upper + np.array((0, y, 0)), lower + np.array((0, y, 0)), (0, 1, 0))
        if top:
            thread(np.array((0, y, high)), upper + np.array((0, y, 0)), (0, 1, 0))
    for t in np.linspace(0.14, 0.86, 6):
        p = upper + np.array(lower - upper) * t
        thread(p + np.array((0, -half, 0)), p + np.array((0, half, 0)), (0.5, 0, 1))
        for s in (-1, 1):
            thread(p + np.array((0, s * half, 0)), np.array((0, s * half, p[2])), (0, 0, 1))


def slide(m: Model, d: Draw) -> None:
    """A ladder to a platform with rails, and a chute with sides down to the front."""
    chute, frame = (
        d.turn(BRIGHT),
        d.tint(d.turn([(60, 110, 190), (220, 60, 50), (70, 150, 80), (150, 154, 160)], 2)),
    )
    if chute == frame:
        frame = (250, 200, 40)
    high, wide = d.between(1.4, 1.75), d.between(0.5, 0.62)
    b = wide / 2
    x0 = -1.0
    path = [(x0 + 0.35, high), (x0 + 0.7, high - 0.08), (1.1, 0.36), (1.7, 0.26)]
    if d.style(3) == 1:  # with a hump
        path = [
            (x0 + 0.35, high),
            (x0 + 0.8, high - 0.25),
            (0.1, high * 0.52),
            (0.45, high * 0.48),
            (1.2, 0.34),
            (1.7, 0.26),
        ]
    for (xa, za), (xb, zb) in pairwise(path):
        m.beam((xa, 0, za), (xb, 0, zb), (wide, 0.05), chute)
        for s in (-1, 1):
            m.beam((xa, s * b, za + 0.09), (xb, s * b, zb + 0.09), (0.06, 0.22), chute)
    m.box((x0, 0, high - 0.05), (0.75, wide, 0.07), frame)
    for s in (-1, 1):
        m.beam((x0 - 0.95, s * b, 0), (x0 - 0.35, s * b, high), (0.07, 0.07), frame)
        m.beam((x0 - 0.35, s * b, high), (x0 - 0.35, s * b, high + 0.65), (0.06, 0.06), frame)
        m.box((x0 + 0.3, s * b, 0), (0.08, 0.08, high + 0.65), frame)
        m.beam((x0 - 0.35, s * b, high + 0.62), (x0 + 0.3, s * b, high + 0.62), (0.06, 0.06), frame)
        m.beam((x0 - 0.35, s * b, high + 0.32), (x0 + 0.3, s * b, high + 0.32), (0.05, 0.05), frame)
        m.box((1.45, s * b * 0.8, 0), (0.07, 0.07, 0.26), frame)
    rungs = 5
    for i in range(1, rungs + 1):
        t = i / (rungs + 0.5)
        m.box(
            (x0 - 0.95 + 0.6 * t, 0, high * t), (0.1, wide, 0.05), d.pick(((240, 240, 236), chute))
        )
    if d.style(3) == 2:  # a roof
        m.front(
            [(-b - 0.15, high + 1.15), (b + 0.15, high + 1.15), (0, high + 1.55)],
            (x0 - 0.5, x0 + 0.45),
            chute,
        )
        for x in (x0 - 0.35, x0 + 0.3):
            for s in (-1, 1):
                m.box((x, s * b, high + 0.6), (0.06, 0.06, 0.56), frame)


def swingset(m: Model, d: Draw) -> None:
    """Two A-shaped ends under a bar, with seats on chains or a tyre."""
    frame, seat = d.tint(d.turn(BRIGHT)), d.turn(BRIGHT[2:])
    wood = d.style(4) == 2
    if wood:
        frame = d.tint((150, 104, 62))
    half, high, foot = d.between(1.6, 2.1), d.between(2.1, 2.4), d.between(0.75, 0.95)
    r = 0.07 if wood else 0.05
    m.rod((0, -half, high), (0, half, high), r * 1.1, frame)
    for s in (-1, 1):
        for x in (-1, 1):
            m.rod((x * foot, s * (half + 0.05), 0), (0, s * (half - 0.08), high), r, frame)
        m.rod(
            (-foot * 0.55, s * half, high * 0.45),
            (foot * 0.55, s * half, high * 0.45),
            r * 0.7,
            frame,
            n=4,
        )
    count = d.turn((2, 3, 2, 1))
    for i in range(count):
        y = (i - (count - 1) / 2) * 2 * half / (count + 0.4)
        sway = d.between(-0.35, 0.35)
        low = 0.5
        for s in (-1, 1):
            m.rod((0, y + s * 0.24, high), (sway, y + s * 0.24, low), 0.016, (70, 72, 76), n=3)
        if d.style(3) == 1 and i == 0:
            m.rod((sway, y, low - 0.06), (sway, y, low + 0.1), 0.32, (34, 34, 36), n=10)
        else:
            m.box((sway, y, low - 0.03), (0.24, 0.54, 0.06), seat)
