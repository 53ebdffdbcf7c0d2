"""What an army drives: a Humvee, a tank, a lorry with missiles."""

from __future__ import annotations

import numpy as np

from symboslam.sim_bridge.objects.draw import Draw
from symboslam.sim_bridge.objects.parts import Colour, Model
from symboslam.sim_bridge.objects.vehicles import GLASS, LAMP, wheels

ARMY: tuple[Colour, ...] = ((92, 100, 62), (180, 156, 110), (72, 84, 64), (128, 118, 84))


def humvee(m: Model, d: Draw) -> None:
    """A wide, flat army car: slatted grille, small windows, high wheels, some with a gun."""
    paint = d.tint(d.turn(ARMY))
    dark: Colour = (int(paint[0] * 0.72), int(paint[1] * 0.72), int(paint[2] * 0.72))
    b = 1.0
    m.box((0, 0, 0.55), (4.5, 2 * b, 0.5), paint)
    m.extrude([(0.7, 1.05), (2.2, 1.05), (2.2, 1.12), (0.7, 1.32)], (-b, b), paint)
    style = d.style(3)
    rear = -2.2 if style == 0 else -1.0
    top = d.between(1.75, 1.9)
    m.extrude(
        [(0.75, 1.05), (0.4, top), (rear + 0.25, top), (rear, 1.05)], (-b + 0.08, b - 0.08), paint
    )
    if style:
        for s in (-1, 1):
            m.box((-1.6, s * (b - 0.05), 1.05), (1.2, 0.1, 0.35), paint)
        m.box((-2.2, 0, 1.05), (0.1, 2 * b, 0.35), paint)
    for y in (-0.45, 0.45):
        m.add(
            [
                (0.75, y - 0.38, 1.12),
                (0.75, y + 0.38, 1.12),
                (0.47, y + 0.38, top - 0.1),
                (0.47, y - 0.38, top - 0.1),
            ],
            [(0, 1, 2), (0, 2, 3)],
            GLASS,
        )
    for side, y in (("+y", b - 0.08), ("-y", -b + 0.08)):
        for x in (0.05, -0.6):
            m.panel(side, (x, y, 1.43), (0.5, 0.4), GLASS)
        for x in (0.4, -0.3, -0.95):
            m.panel(side, (x, y * 1.09, 0.85), (0.05, 0.55), dark)
    m.panel("+x", (2.25, 0, 0.85), (1.2, 0.4), dark)
    for y in np.linspace(-0.48, 0.48, 7):
        m.panel("+x", (2.28, y, 0.85), (0.07, 0.36), (20, 22, 20))
    for s in (-1, 1):
        m.panel("+x", (2.25, s * 0.78, 0.9), (0.26, 0.24), LAMP)
    m.box((2.35, 0, 0.5), (0.2, 1.9, 0.18), dark)
    wheels(m, [-1.45, 1.5], b - 0.02, 0.48, 0.34)
    if style == 2 or d.style(2, 3):
        x = -0.3
        m.lathe((x, 0, top), [(0.42, 0), (0.42, 0.2)], dark)
        m.rod((x, 0, top + 0.35), (x + 1.2, 0, top + 0.4), 0.05, (30, 32, 30))
        m.box((x + 0.1, 0, top + 0.15), (0.08, 0.9, 0.4), paint)
    m.rod((-1.9, 0.8, 1.3), (-1.95, 0.8, 2.6), 0.02, dark, n=3)


def tank(m: Model, d: Draw) -> None:
    """A hull between tracks with wheels, a turret and a long gun."""
    paint = d.tint(d.turn(ARMY))
    dark: Colour = (int(paint[0] * 0.7), int(paint[1] * 0.7), int(paint[2] * 0.7))
    m.extrude(
        [(-3.2, 0.6), (2.6, 0.5), (3.4, 1.1), (2.6, 1.45), (-3.3, 1.45)], (-1.35, 1.35), paint
    )
    for s in (-1, 1):
        y = s * 1.4
        m.extrude(
            [(-3.3, 0.4), (-2.8, 0), (2.6, 0), (3.5, 0.6), (3.3, 1.05), (-3.2, 1.05), (-3.5, 0.75)],
            (y - 0.3, y + 0.3),
            (44, 44, 42),
        )
        for x in np.linspace(-2.5, 2.4, 6):
            ring = [
                (0.36 * np.cos(t) + x, 0.36 * np.sin(t) + 0.42) for t in np.arange(8) * np.pi / 4
            ]
            face = [(u, y + s * 0.33, v) for u, v in ring]
            fan = [(0, i + 1, i) if s > 0 else (0, i, i + 1) for i in range(1, 7)]
            m.add(face, fan, dark)
        m.box((-0.2, y, 1.06), (6.6, 0.7, 0.1), paint)
        if d.style(2):
            m.box((0, s * 1.75, 0.75), (5.8, 0.06, 0.35), paint)
    long = d.between(1.0, 1.3)
    turret = d.style(3)
    if turret == 1:
        m.ball((-0.3, 0, 1.5), (1.7, 1.3, 0.9), paint, n=10, rings=4)
    else:
        m.plate(
            [(1.3, 0.5), (1.3, -0.5), (0.6, -1.2), (-1.8, -1.1), (-1.8, 1.1), (0.6, 1.2)],
            (1.45, 2.15),
            paint,
        )
        if turret == 2:
            m.box((-2.1, 0, 1.6), (0.6, 1.8, 0.4), dark)
    m.rod((0.9, 0, 1.85), (1.6, 0, 1.85), 0.22, dark, n=8)
    m.rod((1.2, 0, 1.85), (1.3 + 3.4 * long, 0, 1.95), 0.12, paint, end=0.09, n=8)
    m.rod((1.0 + 3.2 * long, 0, 1.94), (1.3 + 3.4 * long, 0, 1.95), 0.16, dark, n=8)
    m.lathe((-0.6, 0.45, 2.15), [(0.34, 0), (0.34, 0.2)], dark)
    m.rod((-0.6, 0.45, 2.45), (0.4, 0.45, 2.48), 0.04, (30, 30, 30))
    m.rod((-1.5, -0.7, 2.1), (-1.6, -0.7, 3.0), 0.02, dark, n=3)


def missile_launcher(m: Model, d: Draw) -> None:
    """An army lorry that carries missiles, on rails or in tubes, raised to fire."""
    paint = d.tint(d.turn(ARMY))
    dark: Colour = (int(paint[0] * 0.7), int(paint[1] * 0.7), int(paint[2] * 0.7))
    m.box((0, 0, 0.8), (9, 2.0, 0.35), dark)
    m.extrude([(2.6, 0.7), (4.5, 0.7), (4.5, 1.7), (4.1, 2.6), (2.6, 2.6)], (-1.3, 1.3), paint)
    m.add(
        [(4.53, -1.1, 1.75), (4.53, 1.1, 1.75), (4.18, 1.1, 2.5), (4.18, -1.1, 2.5)],
        [(0, 1, 2), (0, 2, 3)],
        GLASS,
    )
    for s in (-1, 1):
        m.panel("+y" if s > 0 else "-y", (3.6, s * 1.3, 2.1), (0.9, 0.6), GLASS)
        m.panel("+x", (4.5, s * 0.95, 1.1), (0.35, 0.25), LAMP)
    wheels(m, [-3.5, -2.2, 2.0, 3.4], 1.15, 0.58, 0.36)
    m.box((-2.4, 0, 1.15), (2.4, 2.0, 0.6), paint)
    tilt = d.between(0.5, 0.75)
    c, s_ = np.cos(tilt), np.sin(tilt)
    aim = np.array((c, 0, s_))
    root = np.array((-3.6, 0, 1.7))
    length = 5.6
    tip = d.turn([(200, 40, 36), (240, 240, 236), (220, 190, 60)])
    if d.style(3) == 1:  # a box of tubes
        m.beam((-3.6, 0, 1.9), (-3.6 + length * c, 0, 1.9 + length * s_), (2.2, 1.1), paint)
        for y in (-0.72, 0, 0.72):
            for up in (-0.25, 0.25):
                x, z = -3.6 + length * c - up * s_, 1.9 + length * s_ + up * c
                m.rod(
                    (x - 0.1 * c, y, z - 0.1 * s_),
                    (x + 0.05 * c, y, z + 0.05 * s_),
                    0.22,
                    (24, 26, 24),
                    n=8,
                )
    else:
        rows = (-0.7, 0.0, 0.7) if d.style(3) == 0 else (-0.5, 0.5)
        r = 0.24 if len(rows) == 3 else 0.34
        for y in rows:
            a = root + np.array((0, y, 0.35))
            b = a + np.array((length * c, 0, length * s_))
            e = b + np.array((0.9 * c, 0, 0.9 * s_))
            m.rod(tuple(a), tuple(b), r, (226, 226, 220), n=8)
            m.rod(tuple(b), tuple(e), r, tip, end=0.02, n=8)
            for side in (-1, 1):
                f = a + np.array((0.5 * c, side * r * 1.5, 0.5 * s_))
                m.beam(
                    tuple(f - 0.4 * aim),
                    tuple(f + 0.4 * aim),
                    (r * 1.3, 0.05),
                    tip,
                )
        m.beam(
            (-3.6, 0, 1.65),
            (-3.6 + length * 0.9 * c, 0, 1.65 + length * 0.9 * s_),
            (1.8, 0.2),
            dark,
        )
    m.beam((-0.6, 0, 1.2), (-3.6 + 3.6 * c, 0, 1.7 + 3.6 * s_), (0.3, 0.3), (150, 154, 158))
