"""Buildings where people live, work and meet: houses, flats, offices, towers, halls with domes."""

from __future__ import annotations

import numpy as np

from symboslam.sim_bridge.objects.draw import Draw
from symboslam.sim_bridge.objects.parts import Colour, Model

GLASS: Colour = (70, 100, 130)
DARK_GLASS: Colour = (45, 60, 78)
WHITE: Colour = (240, 240, 235)
CONCRETE: Colour = (176, 174, 168)
WALLS: tuple[Colour, ...] = (
    (225, 205, 165), (178, 92, 70), (240, 236, 222), (205, 170, 130), (160, 176, 186),
    (214, 160, 120), (190, 200, 160),
)  # fmt: skip
ROOFS: tuple[Colour, ...] = ((150, 62, 44), (92, 84, 84), (118, 74, 52), (70, 78, 92))


def windows(
    m: Model, side: str, wall: float, span: tuple[float, float], heights: list[float],
    columns: int, size: tuple[float, float], colour: Colour,
) -> None:  # fmt: skip
    """Rows of windows on a wall: one for each height (their middles), evenly over ``span``."""
    step = (span[1] - span[0]) / columns
    for z in heights:
        for i in range(columns):
            u = span[0] + (i + 0.5) * step
            at = (wall, u, z) if side[1] == "x" else (u, wall, z)
            m.panel(side, at, size, colour)


def house(m: Model, d: Draw) -> None:
    """Walls, a pitched or hipped roof, a chimney, a door and windows."""
    depth, width = d.between(7, 9), d.between(9, 13)
    storeys = d.turn((1, 2, 1))
    eaves = 2.9 * storeys
    wall, roof = d.tint(d.turn(WALLS)), d.tint(d.turn(ROOFS))
    rise, over = d.between(2.2, 3.4), 0.45
    m.box((0, 0, 0), (depth, width, eaves), wall)
    a, b = depth / 2 + over, width / 2 + over
    if d.style(3) == 2:  # hipped
        m.box((0, 0, eaves), (2 * a, 2 * b, rise * 0.9), roof, top=(0.04, 0.4))
    elif d.style(2, 2):  # the gable to the street
        m.front([(-b, eaves), (b, eaves), (0, eaves + rise)], (-a, a - 0.35), roof)
        m.front(
            [(-b + 0.5, eaves), (b - 0.5, eaves), (0, eaves + rise - 0.3)], (a - 0.6, a - 0.3), wall
        )
        m.panel("+x", (a - 0.3, 0, eaves + rise * 0.35), (1, 0.9), GLASS)
    else:
        m.extrude([(-a, eaves), (a, eaves), (0, eaves + rise)], (-b + 0.3, b - 0.3), roof)
        for s in (-1, 1):
            m.extrude([(-a + 0.6, eaves), (a - 0.6, eaves), (0, eaves + rise - 0.4)],
                      (s * (b - 0.28), s * (b - 0.5)), wall)  # fmt: skip
    m.box((-depth * 0.18, width * 0.24, eaves + 0.3), (0.8, 0.8, rise + 0.7), (128, 70, 58))
    front = depth / 2
    door = d.tint(d.pick([(110, 60, 30), (40, 80, 60), (140, 30, 30), (50, 60, 100)]))
    m.panel("+x", (front, 0, 1.1), (1.2, 2.2), door)
    m.box((front + 0.5, 0, 0), (1.0, 1.8, 0.2), CONCRETE)
    heights = [1.6 + 2.9 * i for i in range(storeys)]
    for s in (-1, 1):
        u = sorted((s * 1.2, s * (width / 2 - 0.4)))
        windows(m, "+x", front, (u[0], u[1]), heights, 1, (1.9, 1.5), WHITE)
        windows(m, "+x", front + 0.03, (u[0], u[1]), heights, 1, (1.6, 1.2), GLASS)
    for side, at in (("+y", width / 2), ("-y", -width / 2)):
        windows(m, side, at, (-depth / 2, depth / 2), heights, 2, (1.3, 1.2), GLASS)
    windows(m, "-x", -front, (-width / 2, width / 2), heights, 3, (1.3, 1.2), GLASS)
    if d.style(2, 3):  # a porch on posts
        m.box((front + 0.9, 0, 2.5), (2.0, 3.0, 0.2), roof)
        for s in (-1, 1):
            m.box((front + 1.7, s * 1.3, 0), (0.15, 0.15, 2.5), WHITE)
    elif d.style(2, 2):  # a garage beside it
        m.box((0.6, width / 2 + 1.6, 0), (depth * 0.7, 3.2, 2.6), wall)
        m.box((0.6, width / 2 + 1.6, 2.6), (depth * 0.74, 3.5, 0.25), roof)
        m.panel("+x", (0.6 + depth * 0.35, width / 2 + 1.6, 1.1), (2.5, 2.1), WHITE)


def building(m: Model, d: Draw) -> None:
    """A public building: masonry, a portico of columns under a pediment, steps, a low roof."""
    depth, width, high = d.between(10, 13), d.between(16, 20), d.between(7.5, 9)
    stone = d.tint(d.turn([(214, 200, 168), (196, 190, 180), (190, 130, 100), (226, 220, 206)]))
    trim = d.tint((238, 232, 218), 8)
    roof = d.tint(d.turn([(96, 110, 104), (90, 86, 84), (120, 80, 62)]))
    m.box((0, 0, 0), (depth, width, high), stone)
    m.box((0, 0, high), (depth + 0.6, width + 0.6, 0.5), trim)
    if d.style(3) == 1:
        m.box((0, 0, high + 0.5), (3.2, 3.2, 2.4), stone)
        m.ball((0, 0, high + 2.9), (1.7, 1.7, 1.5), roof, rings=4)
    else:
        m.box((0, 0, high + 0.5), (depth, width, 1.6), roof, top=(0.3, 0.7))
    front, half = depth / 2, d.between(3.2, 4.6)
    steps = 3
    for i in range(steps):
        m.box((front + 1.1, 0, 0.25 * i), (3.4 - 0.5 * i, 2 * half + 1.6 - 0.5 * i, 0.25), CONCRETE)
    count = d.turn([4, 6, 4, 5])
    for y in np.linspace(-half + 0.3, half - 0.3, count):
        m.rod((front + 1.6, y, 0.75), (front + 1.6, y, high - 0.6), 0.3, trim)
    m.box((front + 1.0, 0, high - 0.6), (2.2, 2 * half + 0.6, 0.6), trim)
    m.front(
        [(-half - 0.5, high), (half + 0.5, high), (0, high + half * 0.42)],
        (front, front + 2.2),
        trim,
    )
    m.panel("+x", (front, 0, 2.2), (1.9, 2.9), (96, 58, 34))
    rows = [2.2, 5.6]
    for s in (-1, 1):
        u = sorted((s * half, s * (width / 2 - 0.3)))
        windows(m, "+x", front, (u[0], u[1]), rows, 2, (1.2, 1.9), DARK_GLASS)
    for side, at in (("+y", width / 2), ("-y", -width / 2)):
        windows(m, side, at, (-depth / 2, depth / 2), rows, 3, (1.2, 1.9), DARK_GLASS)
    windows(m, "-x", -front, (-width / 2, width / 2), rows, 5, (1.2, 1.9), DARK_GLASS)


def office_building(m: Model, d: Draw) -> None:
    """Bands of glass between bands of concrete, an entrance under a canopy, plant on the roof."""
    depth, width = d.between(14, 20), d.between(22, 28)
    floors = d.whole(5, 7)
    storey = 3.6
    band = d.tint(
        d.turn(
            [(205, 205, 200), (150, 150, 150), (196, 178, 150), (120, 130, 145), (222, 226, 228)]
        )
    )
    glass = d.tint(d.turn([(60, 100, 140), (50, 90, 100), (40, 60, 80), (90, 130, 150)]))
    m.box((0, 0, 0), (depth, width, storey), DARK_GLASS)
    for i in range(1, floors):
        m.box((0, 0, storey * i), (depth + 0.4, width + 0.4, storey * 0.42), band)
        m.box((0, 0, storey * (i + 0.42)), (depth, width, storey * 0.58), glass)
    high = storey * floors
    m.box((0, 0, high), (depth + 0.4, width + 0.4, 1.0), band)
    if d.style(3):  # a stair tower
        m.box((0, d.pick((-1, 1)) * width * 0.42, 0), (depth + 1.6, width * 0.16, high + 2.4), band)
    for _ in range(2):
        m.box((d.between(-3, 3), d.between(-6, 6), high + 1), (3, 4, 1.6), (140, 142, 146))
    m.box((depth / 2 + 1.2, 0, 3.1), (2.8, 6, 0.35), d.tint((60, 64, 70)))
    for s in (-1, 1):
        m.box((depth / 2 + 2.3, s * 2.6, 0), (0.2, 0.2, 3.1), (60, 64, 70))
    m.panel("+x", (depth / 2, 0, 1.4), (3.2, 2.8), (190, 215, 225))
    if d.style(2):  # upright fins on the front
        for y in np.linspace(-width / 2 + 0.5, width / 2 - 0.5, 7):
            m.box((depth / 2 + 0.3, y, storey), (0.3, 0.25, high - storey), band)


def apartment(m: Model, d: Draw) -> None:
    """A block of flats: rows of balconies and windows, an entrance, a roof of its own colour."""
    depth, width = d.between(11, 14), d.between(20, 26)
    floors = d.turn((4, 5, 6, 5))
    storey, bays = 2.9, d.turn((4, 5, 3))
    wall = d.tint(
        d.turn([(206, 140, 104), (226, 214, 184), (240, 236, 228), (176, 96, 78), (214, 190, 120)])
    )
    rail = d.tint(d.turn([(240, 240, 236), (96, 120, 140), (120, 150, 110), (150, 90, 70)]))
    high = storey * floors
    m.box((0, 0, 0), (depth, width, high), wall)
    if d.style(2):
        m.extrude([(-depth / 2 - 0.4, high), (depth / 2 + 0.4, high), (0, high + 2.6)],
                  (-width / 2 - 0.3, width / 2 + 0.3), d.tint(d.turn(ROOFS)))  # fmt: skip
    else:
        m.box((0, 0, high), (depth + 0.5, width + 0.5, 0.5), d.tint(CONCRETE))
        m.box((0, 0, high + 0.5), (3, 4, 2), wall)
    front, step = depth / 2, width / bays
    for i in range(floors):
        z = storey * i
        for j in range(bays):
            y = -width / 2 + (j + 0.5) * step
            if i == 0 and j == bays // 2:
                continue
            m.panel("+x", (front, y - step * 0.2, z + 1.2), (step * 0.34, 2.1), DARK_GLASS)
            m.panel("+x", (front, y + step * 0.22, z + 1.5), (step * 0.3, 1.3), GLASS)
            if i:
                m.box((front + 0.65, y - step * 0.1, z - 0.1), (1.3, step * 0.62, 1.1), rail)
    m.panel("+x", (front, -width / 2 + (bays // 2 + 0.5) * step, 1.2), (2, 2.4), (110, 70, 50))
    m.box((front + 0.8, -width / 2 + (bays // 2 + 0.5) * step, 2.5), (1.6, 3, 0.2), CONCRETE)
    heights = [storey * i + 1.5 for i in range(floors)]
    for side, at in (("+y", width / 2), ("-y", -width / 2)):
        windows(m, side, at, (-depth / 2, depth / 2), heights, 2, (1.4, 1.3), GLASS)


def skyscraper(m: Model, d: Draw) -> None:
    """A very tall tower in steps, with upright strips and bands of windows and a top of its own."""
    frame = d.tint(
        d.turn([(170, 176, 184), (200, 190, 170), (90, 100, 116), (150, 120, 100), (214, 218, 222)])
    )
    glass = d.tint(d.turn([(56, 96, 140), (40, 70, 90), (96, 140, 170), (50, 60, 80)]))
    style = d.style(4)
    steps = [(1.0, 0.55), (0.78, 0.28), (0.52, 0.17)] if style in (0, 2) else [(1.0, 1.0)]
    side, total, base = 26.0, d.between(95, 115), 0.0
    wide = d.between(0.75, 1.0)
    for share, part in steps:
        a, b, h = side * share, side * share * wide, total * part
        taper = (0.72, 0.72) if style == 3 else (1.0, 1.0)
        m.box((0, 0, base), (a, b, h), glass, top=taper)
        bands = max(3, round(14 * part))
        for i in range(bands):
            z = base + h * (i + 0.15) / bands
            t = 1 - (1 - taper[0]) * (z - base) / h
            m.box((0, 0, z), (a * t + 0.5, b * t + 0.5, h / bands * 0.3), frame)
        if style != 3:
            for s in (-0.5, 0.5):
                for u in (-0.17, 0.17):
                    m.box((s * a, u * b, base), (0.9, 1.1, h), frame)
                    m.box((u * a, s * b, base), (1.1, 0.9, h), frame)
                for u in (-0.5, 0.5):
                    m.box((s * a, u * b, base), (1.3, 1.3, h), frame)
        base += h
    if style in (0, 3):
        m.rod((0, 0, base), (0, 0, base + 16), 0.9, (150, 154, 160), end=0.2)
    elif style == 1:
        m.box((0, 0, base), (side * 0.7, side * wide * 0.7, 5), frame)
    else:
        m.box((0, 0, base), (side * 0.5, side * wide * 0.5, 9), frame, top=(0.05, 0.05))
    m.box((0, 0, 0), (side * 1.15, side * wide * 1.15, 6), frame)
    m.panel("+x", (side * 1.15 / 2, 0, 2.2), (8, 4.2), (200, 220, 230))


def rotunda(m: Model, d: Draw) -> None:
    """A round hall with a ring of columns and a dome with a lantern."""
    stone = d.tint(d.turn([(226, 218, 200), (200, 196, 190), (214, 190, 160), (240, 238, 232)]))
    dome = d.tint(
        d.turn([(104, 150, 130), (140, 140, 146), (176, 96, 70), (190, 160, 80), (90, 110, 140)])
    )
    r, high = 8.0, d.between(6, 8)
    n = d.turn((10, 12, 8))
    m.lathe((0, 0, 0), [(10, 0), (10, 0.5), (9.4, 0.5), (9.4, 1)], (180, 176, 168), n=12)
    m.lathe((0, 0, 1), [(r - 1.6, 0), (r - 1.6, high)], d.tint((150, 128, 106)), n=12)
    for i in range(n):
        a = (i + 0.5) * 2 * np.pi / n
        x, y = (r - 0.2) * np.cos(a), (r - 0.2) * np.sin(a)
        m.rod((x, y, 1), (x, y, 1 + high), 0.42, stone, n=5)
    m.lathe(
        (0, 0, 1 + high),
        [(r + 0.5, 0), (r + 0.5, 1.1), (r - 0.8, 1.1), (r - 0.8, 2.2)],
        stone,
        n=12,
    )
    steep = d.between(0.6, 0.95)
    profile = [((r - 0.8) * np.cos(a), steep * r * 0.9 * np.sin(a)) for a in np.linspace(0, 1.4, 5)]
    m.lathe((0, 0, 3.2 + high), profile, dome, n=12)
    top = 3.2 + high + steep * r * 0.87
    m.lathe((0, 0, top), [(1.1, 0), (1.1, 1.2), (0.1, 2.3)], stone, n=6)
    m.panel("+x", (r - 1.6, 0, 2.9), (2.2, 3.6), (90, 56, 36))
    m.box((10, 0, 0), (2.4, 5, 0.5), (180, 176, 168))


def tower(m: Model, d: Draw) -> None:
    """An observation tower with a pod, a lattice mast, a clock tower or a water tower."""
    style = d.style(4)
    if style == 0:  # observation tower
        grey = d.tint((196, 196, 194))
        z = d.between(26, 32)
        m.lathe((0, 0, 0), [(3.2, 0), (1.8, 8), (1.2, z)], grey)
        m.lathe((0, 0, z), [(1.2, -2), (4.8, 0), (4.8, 0.8)], grey, n=10)
        m.lathe((0, 0, z + 0.8), [(4.6, 0), (5.0, 2)], GLASS, n=10)
        m.lathe(
            (0, 0, z + 2.8),
            [(5.2, 0), (4.6, 1.0), (1.2, 2.4)],
            d.tint(d.pick([(190, 40, 40), (220, 220, 220), (60, 80, 120)])),
            n=10,
        )
        m.rod((0, 0, z + 5), (0, 0, z + 15), 0.5, (220, 60, 50), end=0.1)
    elif style == 1:  # lattice mast in red and white
        z = 0.0
        legs = 4.6
        for i in range(5):
            colour = (206, 52, 40) if i % 2 == 0 else WHITE
            top = legs * 0.7
            for a, b in ((1, 1), (1, -1), (-1, -1), (-1, 1)):
                m.beam((a * legs, b * legs, z), (a * top, b * top, z + 8), (0.5, 0.5), colour)
                c, e = (-b, a)
                m.beam((a * legs, b * legs, z), (c * top, e * top, z + 8), (0.3, 0.3), colour)
            z, legs = z + 8, top
        m.rod((0, 0, z), (0, 0, z + 5), 0.3, (206, 52, 40))
        m.box((0, 0, z - 8), (4, 4, 0.6), (120, 120, 124))
    elif style == 2:  # clock tower
        brick = d.tint(d.turn([(176, 100, 76), (206, 186, 150), (150, 150, 150)], 4))
        z = d.between(26, 32)
        m.box((0, 0, 0), (8, 8, z), brick, top=(0.9, 0.9))
        m.box((0, 0, z), (8.4, 8.4, 7), d.tint((222, 210, 184)))
        m.box((0, 0, z + 7), (9, 9, 9), d.tint(d.pick(ROOFS)), top=(0.03, 0.03))
        for side, at in (
            ("+x", (4.2, 0, z + 3.5)),
            ("-x", (-4.2, 0, z + 3.5)),
            ("+y", (0, 4.2, z + 3.5)),
            ("-y", (0, -4.2, z + 3.5)),
        ):
            n = (1 if side[0] == "+" else -1) * 0.3
            end = (at[0] + n, at[1], at[2]) if side[1] == "x" else (at[0], at[1] + n, at[2])
            m.rod(at, end, 2.6, WHITE, n=10)
            m.panel(side, (end[0], end[1], z + 4.3), (0.4, 1.8), (20, 20, 20))
            m.panel(side, (end[0], end[1], z + 3.5), (1.6, 0.4), (20, 20, 20))
        for i in range(3):
            m.panel("+x", (3.9, 0, 6 + i * 7), (1.2, 3), DARK_GLASS)
        m.panel("+x", (4.0, 0, 1.6), (2.2, 3.2), (90, 56, 36))
    else:  # water tower
        paint = d.tint(d.turn([(200, 210, 216), (120, 170, 190), (190, 190, 160)], 4))
        z = d.between(22, 28)
        for a in range(6):
            x, y = np.cos(a * np.pi / 3), np.sin(a * np.pi / 3)
            m.rod((4.6 * x, 4.6 * y, 0), (3.6 * x, 3.6 * y, z + 1), 0.35, paint, n=5)
            u, v = np.cos((a + 1) * np.pi / 3), np.sin((a + 1) * np.pi / 3)
            m.beam((4.1 * x, 4.1 * y, z / 2), (4.1 * u, 4.1 * v, z / 2), (0.3, 0.3), paint)
        m.rod((0, 0, 0), (0, 0, z), 0.7, paint)
        m.lathe((0, 0, z), [(1, -2.5), (5, 0), (5, 6), (3.4, 8), (0.2, 9)], paint, n=12)
        m.lathe((0, 0, z + 2.4), [(5.1, 0), (5.1, 1.4)], d.tint((60, 90, 150)), n=12)
