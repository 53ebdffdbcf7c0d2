"""What flies: airliner, light plane, transport, fighter, helicopters; on their wheels."""

from __future__ import annotations

import numpy as np

from symboslam.sim_bridge.objects.draw import Draw
from symboslam.sim_bridge.objects.parts import Colour, Flat, Model, Point

GLASS: Colour = (54, 74, 92)
TYRE: Colour = (34, 34, 36)
WHITE: Colour = (240, 242, 244)
ARMY: tuple[Colour, ...] = ((90, 98, 64), (110, 116, 110), (150, 136, 100), (70, 78, 72))


def body(
    m: Model,
    outline: list[tuple[float, float, float]],
    colour: Colour,
    *,
    n: int = 10,
    squash: float = 1.0,
) -> None:
    """A fuselage along x: (x, height of its middle, radius) of each section."""
    m.tube(
        [(x, 0, z) for x, z, _ in outline], [r for _, _, r in outline], colour, n=n, squash=squash
    )


def wings(
    m: Model, root: Flat, tip: Flat, span: Flat, z: Flat, thick: float, colour: Colour
) -> None:
    """Two wings: (rear, front) x at the root and the tip, y at both, height at both."""
    for s in (-1, 1):
        rings = []
        for (rear, front), y, high, t in (
            (root, span[0], z[0], thick),
            (tip, span[1], z[1], thick * 0.5),
        ):
            rings.append(
                [
                    (rear, s * y, high),
                    (front, s * y, high),
                    (front - 0.3 * (front - rear), s * y, high + t),
                    (rear, s * y, high + t * 0.4),
                ]
            )
        m.loft(rings, colour)


def gear(m: Model, places: list[Point], r: float, colour: Colour = (150, 154, 158)) -> None:
    """Legs with a wheel; each place is the upper end of a leg."""
    for x, y, z in places:
        m.box((x, y, r), (r * 0.4, r * 0.4, max(z - r, 0.01)), colour)
        m.rod((x, y - r * 0.35, r), (x, y + r * 0.35, r), r, TYRE, n=8)


def airplane(m: Model, d: Draw) -> None:
    """An airliner: white tube with a row of windows, swept wings with engines, coloured tail."""
    tail = d.turn(
        [(200, 40, 50), (30, 80, 170), (240, 170, 30), (20, 130, 110), (110, 50, 140), (60, 66, 80)]
    )
    hull = d.tint(d.turn([WHITE, (236, 238, 240), (206, 212, 218)]), 6)
    a, r, z = d.between(15, 18), 1.95, 3.6
    body(
        m,
        [
            (-a, z + 1.3, 0.3),
            (-a * 0.55, z + 0.5, 1.5),
            (-a * 0.3, z, r),
            (a * 0.72, z, r),
            (a * 0.9, z - 0.25, 1.4),
            (a, z - 0.6, 0.3),
        ],
        hull,
        n=12,
    )
    for side, y in (("+y", r), ("-y", -r)):
        m.panel(side, (a * 0.18, y * 0.99, z + 0.35), (a * 1.0, 0.5), (60, 80, 100))
        for x in np.linspace(-a * 0.3, a * 0.66, 9):
            m.panel(side, (x, y * 1.0, z + 0.35), (0.8, 0.52), hull)
        if d.style(2):
            m.panel(side, (a * 0.2, y * 0.98, z - 0.5), (a * 1.02, 0.35), tail)
    for s in (-1, 1):
        m.add(
            [
                (a * 0.9, s * 0.1, z + 0.95),
                (a * 0.8, s * 0.1, z + 1.75),
                (a * 0.79, s * 1.35, z + 1.15),
                (a * 0.88, s * 1.05, z + 0.75),
            ],
            [(0, 1, 2), (0, 2, 3), (0, 2, 1), (0, 3, 2)],
            GLASS,
        )
    wings(m, (-3.5, 4), (-5.5, -3.5), (0.8, 16), (z - 1, z + 0.3), 0.55, d.tint((176, 182, 188)))
    wings(
        m,
        (-a + 0.8, -a + 4),
        (-a - 0.6, -a + 1),
        (0.3, 6),
        (z + 1.2, z + 1.7),
        0.3,
        d.tint((176, 182, 188)),
    )
    m.extrude(
        [(-a + 0.4, z + 1), (-a + 5, z + 1.2), (-a + 0.4, z + 7), (-a - 1.4, z + 7)],
        (-0.2, 0.2),
        tail,
    )
    four = d.style(3) == 2
    for y in (5.2, 10) if four else (5.6,):
        for s in (-1, 1):
            x = 2.4 - (y - 5) * 0.75
            m.rod(
                (x - 2.2, s * y, z - 1.6),
                (x + 1.0, s * y, z - 1.6),
                0.7,
                tail if d.style(2, 2) else WHITE,
                end=0.95,
                n=8,
            )
            m.rod((x + 1.0, s * y, z - 1.6), (x + 1.05, s * y, z - 1.6), 0.75, (40, 42, 46), n=8)
            m.box((x - 1.2, s * y, z - 1.2), (2, 0.25, 0.8), (176, 182, 188))
    gear(m, [(a * 0.75, 0, z - 1.5), (-1.5, 2.4, z - 0.9), (-1.5, -2.4, z - 0.9)], 0.55)


def aircraft(m: Model, d: Draw) -> None:
    """A light propeller plane, with high or low wings; some with two."""
    one = d.tint(d.turn([WHITE, (240, 210, 60), (200, 50, 46), (60, 110, 180), (230, 230, 220)]))
    two = d.turn([(190, 40, 40), (30, 70, 150), (40, 44, 50), (230, 140, 40), (30, 120, 80)])
    z, style = 1.4, d.style(3)
    body(
        m,
        [
            (-4.2, z + 0.35, 0.1),
            (-1.2, z + 0.1, 0.5),
            (-0.4, z, 0.68),
            (1.4, z, 0.66),
            (2.9, z - 0.05, 0.48),
            (3.3, z - 0.05, 0.3),
        ],
        one,
        n=8,
    )
    m.extrude(
        [(-1.4, z + 0.35), (1.5, z + 0.45), (0.8, z + 1.05), (-0.5, z + 1.05)], (-0.52, 0.52), GLASS
    )
    m.rod((3.3, 0, z - 0.05), (3.75, 0, z - 0.05), 0.26, two, end=0.03)
    blade = d.between(0, 3)
    c, s_ = np.cos(blade) * 1.05, np.sin(blade) * 1.05
    m.beam((3.45, -c, z - 0.05 - s_), (3.45, c, z - 0.05 + s_), (0.07, 0.2), (50, 50, 54))
    levels = [z + 1.0, z - 0.5] if style == 2 else ([z + 1.0] if style == 0 else [z - 0.5])
    half = 4.6 if style == 2 else 5.4
    for level in levels:
        wings(m, (-0.6, 1.2), (-0.5, 0.9), (0, half), (level, level + 0.12), 0.2, one)
        for s in (-1, 1):
            m.box((0.25, s * (half - 0.3), level + 0.03), (1.45, 0.5, 0.24), two)
    for s in (-1, 1):
        if style == 0:
            m.beam((0.3, s * 0.5, z - 0.4), (0.3, s * 2.8, z + 1.05), (0.16, 0.08), one)
        if style == 2:
            for x in (-0.2, 0.8):
                m.beam((x, s * 3.2, levels[1]), (x, s * 3.2, levels[0]), (0.1, 0.1), two)
        m.panel("+y" if s > 0 else "-y", (0.3, s * 0.64, z), (2.6, 0.2), two)
    wings(m, (-4.3, -3.4), (-4.2, -3.6), (0, 1.7), (z + 0.4, z + 0.4), 0.1, one)
    m.extrude(
        [(-4.4, z + 0.3), (-3.2, z + 0.4), (-4.0, z + 1.4), (-4.5, z + 1.4)], (-0.07, 0.07), two
    )
    gear(m, [(2.6, 0, z - 0.3), (0, 1.1, 0.5), (0, -1.1, 0.5)], 0.25)
    for s in (-1, 1):
        m.beam((0, s * 0.4, z - 0.5), (0, s * 1.1, 0.4), (0.14, 0.08), one)


def c17(m: Model, d: Draw) -> None:
    """A grey four-engined transport: high wings, T-tail, thick hull, winglets."""
    grey = d.tint(d.turn([(146, 154, 162), (120, 128, 134), (168, 172, 172), (128, 136, 124)]))
    dark: Colour = (int(grey[0] * 0.75), int(grey[1] * 0.75), int(grey[2] * 0.75))
    a, r, z = d.between(21, 25), d.between(3.1, 3.8), 4.6
    body(
        m,
        [
            (-a, z + 3, 0.6),
            (-a * 0.4, z + 0.6, r * 0.9),
            (-a * 0.2, z, r),
            (a * 0.7, z, r),
            (a * 0.88, z - 0.5, r * 0.75),
            (a, z - 1.2, 0.6),
        ],
        grey,
        n=12,
    )
    for s in (-1, 1):
        m.add(
            [
                (a * 0.91, s * 0.1, z + 1.3),
                (a * 0.8, s * 0.1, z + 3.2),
                (a * 0.79, s * 2.2, z + 2.2),
                (a * 0.88, s * 1.9, z + 1.1),
            ],
            [(0, 1, 2), (0, 2, 3), (0, 2, 1), (0, 3, 2)],
            (30, 36, 42),
        )
    half = d.between(23, 25.5)
    wings(m, (-3, 6), (-8, -5), (0, half), (z + r - 0.3, z + r - 1.5), 0.9, grey)
    for s in (-1, 1):
        m.extrude(
            [(-8, z + r - 1.5), (-5, z + r - 1.5), (-8, z + r + 1.4)],
            (s * half - 0.1, s * half + 0.1),
            dark,
        )
        for y, x in ((8.5, 4.6), (15, 1.2)):
            m.rod((x - 3.5, s * y, z + 1.0), (x + 1.2, s * y, z + 1.0), 0.9, grey, end=1.25, n=8)
            m.rod((x + 1.2, s * y, z + 1.0), (x + 1.28, s * y, z + 1.0), 1.05, (36, 38, 42), n=8)
            m.box((x - 2.2, s * y, z + 1.8), (3, 0.3, 1.4), dark)
        m.box((-2, s * (r + 0.2), 0.9), (9, 1.8, 2.2), grey, top=(0.8, 0.8))
        for x in (-4.4, -2, 0.4):
            m.rod((x, s * (r + 0.2) - 0.5, 0.7), (x, s * (r + 0.2) + 0.5, 0.7), 0.7, TYRE, n=8)
    m.extrude(
        [(-a + 1, z + 2.4), (-a + 8, z + 2.0), (-a + 2.5, z + 11), (-a - 2, z + 11)],
        (-0.35, 0.35),
        grey,
    )
    wings(m, (-a - 2, -a + 3), (-a - 4, -a - 1.6), (0, 9), (z + 10.8, z + 10.4), 0.4, grey)
    for side, y in (("+y", 0.38), ("-y", -0.38)):
        m.panel(
            side,
            (-a + 1.3, y, z + 8),
            (3.4, 0.9),
            d.turn([(40, 60, 110), (60, 62, 66), (170, 40, 40)]),
        )
    gear(m, [(a * 0.72, 0, z - 2.6)], 0.6)


def fighter_jet(m: Model, d: Draw) -> None:
    """A pointed nose, a bubble canopy, swept or delta wings, one or two fins, missiles below."""
    grey = d.tint(d.turn([(134, 144, 154), (104, 112, 120), (150, 140, 116), (92, 104, 110)]))
    dark: Colour = (int(grey[0] * 0.72), int(grey[1] * 0.72), int(grey[2] * 0.72))
    z, style = 2.0, d.style(4)
    body(
        m,
        [(-7, z, 0.7), (-3, z, 0.95), (1.5, z, 0.9), (4.5, z, 0.62), (7.8, z - 0.15, 0.05)],
        grey,
        n=8,
    )
    m.rod((-7.5, 0, z), (-7, 0, z), 0.5, (50, 48, 46), end=0.62, n=8)
    for s in (-1, 1):
        m.extrude(
            [(-5, z - 0.6), (2.6, z - 0.6), (2.2, z + 0.35), (-5, z + 0.35)],
            (s * 0.6, s * 1.35),
            grey,
        )
        m.panel("+x", (2.5, s * 1.0, z - 0.1), (0.6, 0.75), (30, 32, 36))
    m.ball((3.3, 0, z + 0.55), (1.7, 0.5, 0.6), d.tint((70, 100, 120)), n=8, rings=4)
    half = d.between(4.4, 5.4)
    if style % 2:  # delta
        wings(m, (-5.5, 2), (-5.3, -4), (0.8, half), (z - 0.1, z - 0.1), 0.2, grey)
        wings(m, (2.5, 4.2), (2.0, 2.6), (0.6, 2.2), (z + 0.3, z + 0.3), 0.1, dark)
    else:
        wings(m, (-3, 1.8), (-3.4, -1.8), (0.8, half), (z, z), 0.2, grey)
        wings(m, (-7, -4.6), (-7.4, -6), (0.8, 2.9), (z, z), 0.14, grey)
    fins = (0.0,) if style in (1, 2) else (-1.1, 1.1)
    for y in fins:
        m.extrude(
            [(-6.6, z + 0.3), (-3.4, z + 0.3), (-6.2, z + 2.8), (-7.3, z + 2.8)],
            (y - 0.07, y + 0.07),
            dark,
        )
    for s in (-1, 1):
        for y in (half * 0.55, half * 0.99):
            m.rod((-4.4, s * y, z - 0.25), (-1.2, s * y, z - 0.25), 0.12, WHITE, end=0.02, n=5)
        m.rod(
            (-2.5, s * half * 0.4, z - 0.75),
            (1.5, s * half * 0.4, z - 0.75),
            0.26,
            dark,
            end=0.02,
            n=6,
        )
    gear(m, [(3.6, 0, z - 0.5), (-2.2, 1.0, z - 0.5), (-2.2, -1.0, z - 0.5)], 0.34)


def _rotor(m: Model, at: Point, r: float, blades: int, start: float, width: float = 0.32) -> None:
    x, y, z = at
    m.rod((x, y, z - 0.5), (x, y, z + 0.1), 0.14, (60, 62, 66))
    for i in range(blades):
        t = start + i * 2 * np.pi / blades
        m.beam(at, (x + r * np.cos(t), y + r * np.sin(t), z - 0.12), (width, 0.07), (50, 52, 56))


def helicopter(m: Model, d: Draw) -> None:
    """A round glass cabin, a thin tail boom with a rotor, a main rotor, skids."""
    one = d.tint(
        d.turn(
            [
                (210, 40, 40),
                (30, 90, 170),
                (240, 190, 40),
                (236, 238, 240),
                (50, 130, 90),
                (240, 120, 30),
            ]
        )
    )
    two = d.turn([WHITE, (40, 44, 50), (250, 210, 60)])
    z = 1.55
    m.ball((0.6, 0, z), (2.0, 1.05, 1.1), one, n=10, rings=6)
    m.ball((1.25, 0, z + 0.12), (1.5, 0.98, 0.92), GLASS, n=10, rings=6)
    m.box((-0.3, 0, z + 0.7), (2.0, 0.9, 0.65), one, top=(0.7, 0.7))
    m.rod((-0.8, 0, z + 0.3), (-6.2, 0, z + 0.75), 0.5, one, end=0.14, n=8)
    m.extrude(
        [(-6.6, z + 0.1), (-5.6, z + 0.6), (-6.2, z + 1.9), (-6.8, z + 1.9)], (-0.07, 0.07), two
    )
    m.box((-4.8, 0, z + 0.7), (0.6, 2.0, 0.08), two)
    t = d.between(0, 3)
    m.beam((-6.3, 0.2, z + 0.8 - 0.9), (-6.3, 0.2, z + 0.8 + 0.9), (0.05, 0.16), (50, 52, 56))
    m.beam((-7.2, 0.2, z + 0.8), (-5.4, 0.2, z + 0.8), (0.05, 0.16), (50, 52, 56))
    _rotor(m, (-0.3, 0, z + 1.85), d.between(4.8, 5.4), d.turn((4, 3, 2, 5)), t)
    for s in (-1, 1):
        m.panel("+y" if s > 0 else "-y", (-0.25, s * 1.0, z - 0.1), (0.9, 0.25), two)
        y = s * 1.05
        m.tube([(-1.4, y, 0.08), (1.9, y, 0.08), (2.3, y, 0.3)], 0.07, (60, 62, 66), n=5)
        for x in (-0.7, 1.2):
            m.beam((x, s * 0.6, z - 0.8), (x, y, 0.1), (0.09, 0.09), (60, 62, 66))


def attack_helicopter(m: Model, d: Draw) -> None:
    """Narrow, in army colours: two seats one above the other, stub wings with rockets, a gun."""
    paint = d.tint(d.turn(ARMY))
    dark: Colour = (int(paint[0] * 0.7), int(paint[1] * 0.7), int(paint[2] * 0.7))
    z = 1.9
    m.extrude(
        [
            (5.4, z - 0.5),
            (5.6, z),
            (4.2, z + 0.5),
            (1.4, z + 1.4),
            (-1.6, z + 1.4),
            (-2.4, z + 0.7),
            (-2.4, z - 0.4),
            (0, z - 0.9),
            (4, z - 0.9),
        ],
        (-0.6, 0.6),
        paint,
    )
    m.extrude(
        [
            (4.3, z + 0.42),
            (3.5, z + 0.95),
            (2.7, z + 0.98),
            (2.2, z + 1.5),
            (1.2, z + 1.65),
            (0.8, z + 1.3),
            (2.4, z + 0.6),
        ],
        (-0.63, 0.63),
        (50, 66, 70),
    )
    m.extrude(
        [(-2.2, z + 0.9), (-2.2, z - 0.1), (-8.4, z + 0.4), (-8.4, z + 0.75)], (-0.28, 0.28), paint
    )
    m.extrude(
        [(-8.9, z + 0.2), (-7.6, z + 0.5), (-8.5, z + 2.2), (-9.1, z + 2.2)], (-0.12, 0.12), paint
    )
    m.box((-8.0, 0, z + 0.5), (0.8, 3.0, 0.1), paint)
    m.beam((-8.7, 0.4, z + 0.7), (-8.7, 0.4, z + 2.7), (0.05, 0.2), (40, 42, 44))
    m.beam((-9.7, 0.4, z + 1.7), (-7.7, 0.4, z + 1.7), (0.05, 0.2), (40, 42, 44))
    for s in (-1, 1):
        m.rod((-2.2, s * 0.95, z + 0.9), (0.9, s * 0.95, z + 0.9), 0.42, dark, n=8)
        m.box((-0.3, s * 1.55, z - 0.1), (1.2, 2.1, 0.16), paint)
        m.rod((-1.2, s * 1.6, z - 0.45), (0.9, s * 1.6, z - 0.45), 0.32, dark, n=8)
        if d.style(2):
            for u in (-0.15, 0.15):
                for v in (-0.15, 0.15):
                    m.rod(
                        (-1.1, s * 2.4 + u, z - 0.4 + v),
                        (1.1, s * 2.4 + u, z - 0.4 + v),
                        0.11,
                        (210, 210, 200),
                        end=0.02,
                        n=5,
                    )
        else:
            m.rod((-1.2, s * 2.4, z - 0.45), (0.9, s * 2.4, z - 0.45), 0.32, dark, n=8)
    _rotor(m, (-0.4, 0, z + 2.1), d.between(6.2, 6.9), d.turn((4, 5, 2)), d.between(0, 3), 0.45)
    m.ball((5.3, 0, z - 0.2), (0.4, 0.4, 0.4), dark, n=6)
    m.rod((3.6, 0, z - 1.1), (5.6, 0, z - 1.2), 0.09, (30, 32, 30))
    m.box((3.6, 0, z - 1.2), (0.6, 0.4, 0.4), dark)
    gear(m, [(2.2, 0.9, z - 0.6), (2.2, -0.9, z - 0.6), (-8.2, 0, z + 0.4)], 0.38, dark)
