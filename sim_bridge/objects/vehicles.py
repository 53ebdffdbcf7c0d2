"""What drives: cars, buses, trains, lorries and tractors."""

from __future__ import annotations

import numpy as np

from symboslam.sim_bridge.objects.draw import Draw
from symboslam.sim_bridge.objects.parts import Colour, Flat, Model

TYRE: Colour = (34, 34, 36)
GLASS: Colour = (60, 80, 96)
LAMP: Colour = (250, 240, 190)
REAR: Colour = (190, 30, 30)
PAINTS: tuple[Colour, ...] = (
    (190, 34, 36), (40, 80, 160), (222, 224, 226), (60, 64, 70), (230, 180, 40), (60, 120, 80),
    (150, 156, 164), (220, 110, 40),
)  # fmt: skip


def wheels(m: Model, places: list[float], half: float, r: float, width: float = 0.24) -> None:
    """Pairs of wheels at places along x."""
    for x in places:
        for s in (-1, 1):
            m.wheel((x, s * half, r), r, width, TYRE)


def lamps(
    m: Model, front: float, rear: float, half: float, z: float, size: Flat = (0.3, 0.18)
) -> None:
    """Head lamps and rear lamps."""
    for s in (-1, 1):
        m.panel("+x", (front, s * half, z), size, LAMP)
        m.panel("-x", (rear, s * half, z), size, REAR)


def car(m: Model, d: Draw) -> None:
    """A saloon, hatchback, estate or small sport car."""
    paint = d.tint(d.turn(PAINTS))
    style = d.style(4)
    a, b = 2.2, 0.86
    belt = d.between(0.86, 0.94)
    m.extrude(
        [
            (-a, 0.3),
            (a, 0.28),
            (a, 0.62),
            (a - 0.25, 0.74),
            (0.9, belt),
            (-a + 0.1, belt),
            (-a, 0.75),
        ],
        (-b, b),
        paint,
    )
    roof = d.between(1.38, 1.5)
    cabin: list[Flat] = [
        [(1.0, belt), (0.25, roof), (-1.0, roof), (-1.75, belt)],  # saloon
        [(1.05, belt), (0.3, roof), (-1.75, roof), (-2.1, belt)],  # hatchback
        [(1.0, belt), (0.3, roof), (-1.95, roof), (-2.15, belt)],  # estate
        [(0.7, belt), (-0.05, roof - 0.16), (-0.8, roof - 0.16), (-1.8, belt)],  # sport
    ][style]
    m.extrude(cabin, (-b + 0.14, b - 0.14), GLASS)
    (_, _), (fx, fz), (rx, _), (_, _) = cabin
    m.box(((fx + rx) / 2, 0, fz - 0.03), (fx - rx + 0.1, 2 * b - 0.24, 0.07), paint)
    for y in (-b + 0.13, b - 0.13):
        for lower, upper in (
            (cabin[0], cabin[1]),
            (cabin[3], cabin[2]),
            ((-0.35, belt), (-0.35, fz)),
        ):
            m.beam((lower[0], y, lower[1]), (upper[0], y, upper[1]), (0.04, 0.1), paint)
    r = 0.33
    for x in (-1.3, 1.35):
        for s in (-1, 1):
            m.panel("+y" if s > 0 else "-y", (x, s * (b - 0.005), 0.42), (0.78, 0.5), (24, 24, 26))
    wheels(m, [-1.3, 1.35], b - 0.06, r, 0.22)
    lamps(m, a, -a, b * 0.72, 0.6)
    m.panel("+x", (a, 0, 0.48), (0.8, 0.16), (30, 30, 32))
    m.panel("-x", (-a, 0, 0.55), (0.5, 0.14), (240, 240, 230))
    for s in (-1, 1):
        m.box((0.75, s * (b + 0.06), belt), (0.12, 0.16, 0.12), paint)


def bus(m: Model, d: Draw) -> None:
    """A city bus: a long box with rows of windows, doors and a line number; some have two decks."""
    one = d.tint(
        d.turn(
            [
                (200, 36, 40),
                (40, 110, 180),
                (240, 190, 50),
                (60, 140, 80),
                (236, 238, 240),
                (230, 120, 40),
            ]
        )
    )
    two = d.turn([(240, 240, 240), (40, 50, 70), (250, 210, 60), (90, 90, 96)])
    a, b = d.between(5, 6), 1.25
    double = d.style(4) == 3
    high = 4.0 if double else d.between(2.9, 3.2)
    m.box((0, 0, 0.35), (2 * a, 2 * b, high - 0.35), one)
    m.box((0, 0, high), (2 * a - 0.4, 2 * b - 0.2, 0.12), two)
    levels = [1.95, 3.35] if double else [high - 0.95]
    for z in levels:
        for side, y in (("+y", b), ("-y", -b)):
            m.panel(side, (0, y, z), (2 * a - 0.3, 1.0), (30, 36, 42))
            for i in range(6):
                m.panel(
                    side,
                    (-a + (i + 0.5) * 2 * a / 6, y * 1.02, z),
                    (a / 3 * 0.84, 0.82),
                    (110, 140, 160),
                )
    for side, y in (("+y", b), ("-y", -b)):
        m.panel(side, (0, y, 0.85), (2 * a, d.pick([0.2, 0.35])), two)
    m.panel("+x", (a, 0, levels[0] - 0.1), (2.2, 1.4), (70, 96, 114))
    if double:
        m.panel("+x", (a, 0, levels[1]), (2.2, 0.8), (70, 96, 114))
    m.panel("+x", (a, 0, high - 0.24 if not double else 2.75), (1.7, 0.26), (20, 20, 20))
    m.panel("+x", (a + 0.03, 0, high - 0.24 if not double else 2.75), (1.2, 0.14), (255, 190, 40))
    m.panel("-x", (-a, 0, high - 0.8), (2.0, 0.8), (70, 96, 114))
    for x in (a - 0.9, -0.4):
        m.panel("-y", (x, -b * 1.03, 1.35), (1.1, 1.9), (50, 60, 70))
        m.panel("-y", (x, -b * 1.05, 1.35), (0.06, 1.9), (200, 200, 200))
    wheels(m, [-a * 0.55, a * 0.58], b - 0.1, 0.5, 0.3)
    lamps(m, a, -a, 0.95, 0.75, (0.4, 0.24))
    for s in (-1, 1):
        m.box((a + 0.15, s * (b + 0.12), high - 1.1), (0.1, 0.14, 0.5), (30, 30, 32))


def train(m: Model, d: Draw) -> None:
    """An engine or a railcar on bogies and rails: diesel, electric or steam."""
    one = d.tint(
        d.turn(
            [
                (30, 80, 150),
                (190, 40, 40),
                (230, 180, 40),
                (70, 110, 80),
                (180, 184, 190),
                (90, 50, 110),
            ]
        )
    )
    two = d.turn([(240, 240, 236), (250, 200, 40), (40, 44, 50)])
    a, b = 9.5, 1.4
    for s in (-1, 1):
        m.box((0, s * 0.75, 0), (2 * a + 1, 0.14, 0.16), (120, 110, 104))
    for x in np.linspace(-a, a, 9):
        m.box((x, 0, 0), (0.3, 2.6, 0.08), (96, 76, 60))
    style = d.style(3)
    if style == 2:  # steam engine
        m.rod((-2, 0, 2.3), (8, 0, 2.3), 1.15, (40, 42, 46), n=12)
        m.rod((8, 0, 2.3), (8.4, 0, 2.3), 0.9, (90, 90, 94), n=12)
        m.lathe((6.8, 0, 3.2), [(0.4, 0), (0.32, 0.9), (0.55, 1.3)], (40, 42, 46))
        m.ball((3, 0, 3.4), (0.6, 0.6, 0.6), (200, 160, 60))
        m.box((-3.6, 0, 1.1), (3.4, 2.7, 2.9), one)
        m.box((-3.6, 0, 4.0), (3.9, 3.0, 0.2), (40, 42, 46))
        for s in (-1, 1):
            m.panel("+y" if s > 0 else "-y", (-3.4, s * 1.35, 3.1), (1.5, 1.0), GLASS)
        m.box((1.5, 0, 1.0), (15, 2.3, 0.25), one)
        m.box((-7.4, 0, 1.0), (3.8, 2.6, 2.0), one)
        m.box((-7.4, 0, 3.0), (3.2, 2.0, 0.3), (30, 30, 30))
        wheels(m, [-1.5, 0.6, 2.7], 1.0, 0.85, 0.2)
        wheels(m, [5.5, 7.2, -6.4, -8.2], 1.0, 0.5, 0.2)
        m.extrude([(8.4, 0.2), (9.6, 0.2), (8.4, 1.1)], (-1.2, 1.2), (190, 40, 40))
        for s in (-1, 1):
            m.box((1.0, s * 1.15, 0.75), (5, 0.1, 0.16), (170, 174, 180))
        return
    nose = 1.6 if style else 0.5
    m.extrude(
        [
            (-a, 0.9),
            (a, 0.9),
            (a, 1.9),
            (a - nose, 3.6),
            (a - nose - 0.5, 3.75),
            (-a + 0.3, 3.75),
            (-a, 3.5),
        ],
        (-b, b),
        one,
    )
    for side, y in (("+y", b), ("-y", -b)):
        m.panel(side, (-nose / 2, y, 1.45), (2 * a - nose - 0.2, 0.4), two)
        m.panel(side, (-nose / 2 - 0.2, y, 2.7), (2 * a - nose - 1.4, 0.95), (40, 46, 54))
        for i in range(7):
            m.panel(side, (-a + 1.6 + i * 2.35, y * 1.02, 2.7), (1.7, 0.75), (120, 150, 170))
        for x in (-a * 0.5, a * 0.35):
            m.panel(side, (x, y * 1.03, 2.1), (1.0, 2.1), two)
    slope = nose / 1.7
    w = 1.05
    for z0, z1 in ((2.2, 3.3),):
        x0, x1 = a - (z0 - 1.9) * slope + 0.03, a - (z1 - 1.9) * slope + 0.03
        m.add(
            [(x0, -w, z0), (x0, w, z0), (x1, w, z1), (x1, -w, z1)],
            [(0, 1, 2), (0, 2, 3)],
            (50, 66, 80),
        )
    m.panel("+x", (a, 0, 1.5), (2.6, 0.5), two)
    for s in (-1, 1):
        m.panel("+x", (a + 0.03, s * 1.0, 1.5), (0.4, 0.3), LAMP)
    for x in (-a * 0.66, a * 0.66):
        m.box((x, 0, 0.45), (3.2, 2.0, 0.45), (50, 50, 54))
        wheels(m, [x - 1.1, x + 1.1], 0.85, 0.48, 0.2)
    m.box((a + 0.3, 0, 0.9), (0.6, 1.4, 0.3), (50, 50, 54))
    m.box((0, 0, 3.7), (5, 1.6, 0.3), (120, 124, 130))
    if style == 1:
        m.beam((-4, 0, 3.8), (-3.2, 0, 4.4), (0.9, 0.1), (60, 60, 64))
        m.beam((-3.2, 0, 4.4), (-4, 0, 4.9), (0.9, 0.1), (60, 60, 64))
        m.box((-4, 0, 4.9), (0.4, 1.5, 0.08), (60, 60, 64))


def land_vehicle(m: Model, d: Draw) -> None:
    """A lorry, a farm tractor, a pickup or a van."""
    one = d.tint(d.turn(PAINTS))
    style = d.style(4)
    if style == 0:  # lorry with a box or a tipper
        m.box((0, 0, 0.65), (6.4, 1.0, 0.25), (50, 52, 56))
        m.extrude([(1.5, 0.55), (3.2, 0.55), (3.2, 1.6), (2.9, 2.6), (1.5, 2.6)], (-1.1, 1.1), one)
        m.add(
            [(3.23, -0.95, 1.62), (3.23, 0.95, 1.62), (2.95, 0.95, 2.45), (2.95, -0.95, 2.45)],
            [(0, 1, 2), (0, 2, 3)],
            GLASS,
        )
        for s in (-1, 1):
            m.panel("+y" if s > 0 else "-y", (2.4, s * 1.1, 2.0), (0.9, 0.7), GLASS)
        load = d.tint(d.turn([(236, 236, 232), (70, 110, 160), (200, 170, 60)], 4))
        m.box((-0.95, 0, 0.9), (4.6, 2.3, d.between(1.3, 2.2)), load)
        wheels(m, [-2.3, -1.3, 2.3], 1.0, 0.48, 0.28)
        lamps(m, 3.2, -3.25, 0.8, 0.85)
        m.panel("+x", (3.2, 0, 1.2), (1.3, 0.45), (40, 42, 46))
    elif style == 1:  # tractor
        paint = d.turn([(50, 130, 60), (190, 40, 36), (40, 90, 160), (230, 120, 30)], 4)
        m.box((0.9, 0, 0.9), (2.6, 0.9, 0.85), paint, top=(0.94, 0.8))
        m.panel("+x", (2.2, 0, 1.3), (0.6, 0.6), (30, 30, 30))
        m.box((-0.9, 0, 0.8), (1.4, 1.2, 0.8), paint)
        m.box((-0.8, 0, 1.6), (1.4, 1.3, 1.1), GLASS, top=(0.85, 0.85))
        m.box((-0.8, 0, 2.7), (1.6, 1.5, 0.16), paint)
        m.rod((1.3, 0.3, 1.7), (1.3, 0.3, 2.6), 0.07, (40, 40, 40))
        for s in (-1, 1):
            m.wheel((-0.95, s * 1.0, 0.85), 0.85, 0.45, TYRE, n=12)
            m.wheel((1.6, s * 0.8, 0.5), 0.5, 0.3, TYRE)
            m.box((-0.95, s * 1.0, 1.7), (1.5, 0.55, 0.08), paint)
    elif style == 2:  # pickup
        m.box((0, 0, 0.5), (5.2, 1.9, 0.5), one)
        m.box((1.85, 0, 1.0), (1.5, 1.85, 0.25), one)
        m.extrude([(1.3, 1.0), (0.75, 1.85), (-0.5, 1.85), (-0.6, 1.0)], (-0.85, 0.85), GLASS)
        m.box((0.1, 0, 1.83), (1.35, 1.75, 0.08), one)
        for s in (-1, 1):
            m.box((-1.6, s * 0.9, 1.0), (2.0, 0.1, 0.4), one)
            m.beam((-0.55, s * 0.84, 1.0), (-0.5, s * 0.84, 1.85), (0.06, 0.2), one)
            m.beam((0.35, s * 0.84, 1.0), (0.3, s * 0.84, 1.85), (0.06, 0.12), one)
        m.box((-2.55, 0, 1.0), (0.1, 1.9, 0.4), one)
        m.box((-1.6, 0, 1.0), (1.8, 1.7, 0.1 if d.style(2, 4) else 0.5), (60, 50, 40))
        wheels(m, [-1.6, 1.7], 0.85, 0.42, 0.28)
        lamps(m, 2.6, -2.6, 0.7, 0.85)
        m.panel("+x", (2.6, 0, 0.8), (0.9, 0.3), (36, 36, 40))
    else:  # van
        m.extrude(
            [(-2.7, 0.4), (2.7, 0.4), (2.7, 1.1), (1.9, 1.3), (1.2, 2.4), (-2.7, 2.4)],
            (-0.95, 0.95),
            one,
        )
        m.add(
            [(1.93, -0.85, 1.33), (1.93, 0.85, 1.33), (1.28, 0.85, 2.32), (1.28, -0.85, 2.32)],
            [(0, 1, 2), (0, 2, 3)],
            GLASS,
        )
        for side, y in (("+y", 0.95), ("-y", -0.95)):
            m.panel(side, (0.8, y, 1.75), (0.9, 0.65), GLASS)
            m.panel(
                side,
                (-1.2, y, 1.4),
                (2.4, 0.5),
                d.turn([(240, 240, 240), (240, 120, 40), (60, 140, 90)], 4),
            )
        wheels(m, [-1.7, 1.7], 0.85, 0.38)
        lamps(m, 2.7, -2.7, 0.7, 0.85)
        m.panel("+x", (2.7, 0, 0.6), (1.2, 0.16), (36, 36, 40))
