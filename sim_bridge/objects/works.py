"""Shops, halls and works: store, petrol station and pump, factory, warehouse, silo, substation."""

from __future__ import annotations

import numpy as np

from symboslam.sim_bridge.objects.buildings import CONCRETE, DARK_GLASS, GLASS, WHITE, windows
from symboslam.sim_bridge.objects.draw import Draw
from symboslam.sim_bridge.objects.parts import Colour, Model

BRANDS: tuple[tuple[Colour, Colour], ...] = (
    ((0, 120, 70), (240, 140, 30)),
    ((200, 30, 40), (250, 210, 60)),
    ((30, 80, 170), (240, 240, 240)),
    ((240, 200, 40), (200, 40, 40)),
    ((120, 40, 130), (240, 230, 90)),
    ((20, 140, 160), (245, 245, 245)),
)
STEEL: Colour = (150, 156, 162)


def convenience_store(m: Model, d: Draw) -> None:
    """One storey, a glass front with a door, a striped band in the colours of a chain."""
    one, two = d.turn(BRANDS)
    depth, width, high = d.between(8, 10), d.between(11, 15), d.between(3.6, 4.2)
    wall = d.tint(d.turn([(236, 232, 222), (205, 205, 205), (200, 160, 130)]))
    m.box((0, 0, 0), (depth, width, high), wall)
    front = depth / 2
    for s in (-1, 1):
        m.panel("+x", (front, s * width * 0.3, 1.5), (width * 0.34, 2.1), (150, 200, 220))
        m.panel(
            "+x", (front + 0.03, s * width * 0.3, 0.9), (width * 0.3, 0.5), d.tint((220, 160, 60))
        )
    m.panel("+x", (front, 0, 1.3), (2.2, 2.5), GLASS)
    m.panel("+x", (front + 0.03, 0, 1.3), (0.12, 2.5), WHITE)
    m.box((front, 0, 2.8), (1.6, width + 0.3, 1.3), WHITE)
    rows = [(0.65, one)] if d.style(2) else [(0.35, one), (0.95, two)]
    for z, colour in rows:
        m.panel("+x", (front + 0.8, 0, 2.8 + z), (width + 0.2, 0.4), colour)
        for side, y in (("+y", width / 2 + 0.15), ("-y", -width / 2 - 0.15)):
            m.panel(side, (front, y, 2.8 + z), (1.5, 0.4), colour)
    m.box((front + 0.4, d.pick((-1, 0, 1)) * width * 0.25, 4.1), (0.5, 4.2, 1.2), one)
    sign = d.pick((-1, 1)) * 0
    m.panel("+x", (front + 0.66, sign, 3.45), (3.2, 0.7), two)
    if d.style(2, 2):  # an awning
        for i in range(6):
            y = -width / 2 + (i + 0.5) * width / 6
            m.beam(
                (front + 0.2, y, 2.9),
                (front + 2.0, y, 2.4),
                (width / 6, 0.08),
                one if i % 2 else WHITE,
            )
    m.box((-1, 2, high), (2, 2.4, 0.9), STEEL)
    m.box((front + 0.5, width * 0.42, 0), (0.7, 1.2, 1.1), d.tint((150, 200, 230)))  # an ice chest
    m.panel("+y", (0, width / 2, 1.6), (1.1, 2.2), (110, 110, 110))


def gas_station(m: Model, d: Draw) -> None:
    """A canopy on posts over islands with pumps, a kiosk behind, a tall price sign."""
    one, two = d.turn(BRANDS)
    half = d.between(6.5, 8)
    if d.style(3) == 2:
        m.box((2, 0, 4.6), (9, 2 * half, 0.5), WHITE)
        m.box((2, 0, 5.1), (9.2, 2 * half + 0.2, 0.5), one)
    else:
        m.box((2, 0, 4.6), (9, 2 * half, 1.1), WHITE)
        for z, colour in ((5.3, one), (4.85, two)):
            m.panel("+x", (6.5, 0, z), (2 * half, 0.5 if colour == one else 0.25), colour)
            for side, y in (("+y", half), ("-y", -half)):
                m.panel(side, (2, y, z), (9, 0.5 if colour == one else 0.25), colour)
    for y in (-half * 0.55, half * 0.55):
        m.box((2, y, 0), (6, 1.3, 0.2), CONCRETE)
        m.box((2, y, 0.2), (0.5, 0.5, 4.4), WHITE)
        for x in (0.2, 3.8):
            m.box((x, y, 0.2), (0.7, 0.9, 1.7), one)
            m.box((x, y, 1.9), (0.75, 1.0, 0.35), two)
            m.panel("+x", (x + 0.35, y, 1.4), (0.6, 0.5), (20, 30, 30))
    m.box((-5.5, 0, 0), (4, 2 * half * 0.8, 3.4), d.tint((230, 226, 216)))
    m.panel("+x", (-3.5, 0, 1.5), (half * 1.3, 2), GLASS)
    m.box((-5.4, 0, 3.4), (4.4, 2 * half * 0.83, 0.6), one)
    m.box((6, half + 0.9, 0), (0.4, 1.6, 6.2), WHITE)
    for side, x in (("+x", 6.2), ("-x", 5.8)):
        m.panel(side, (x, half + 0.9, 5.2), (1.5, 1.7), one)
        for z in (3.8, 3.1, 2.4):
            m.panel(side, (x, half + 0.9, z), (1.3, 0.45), (30, 30, 34))
    m.panel("+x", (6.23, half + 0.9, 5.2), (0.8, 0.8), two)


def gas_station_pump(m: Model, d: Draw) -> None:
    """A fuel pump: cabinet, display, nozzles in their holsters, hoses, a lit head."""
    one, two = d.turn(BRANDS)
    body = d.tint(d.turn([WHITE, (210, 212, 214), one]))
    m.box((0, 0, 0), (0.7, 1.1, 0.12), CONCRETE)
    high = d.between(1.35, 1.6)
    wide = d.between(0.75, 0.9)
    m.box((0, 0, 0.12), (0.45, wide, high), body)
    m.box((0, 0, 0.12), (0.47, wide + 0.02, high * 0.35), one)
    head = 0.12 + high
    if d.style(3) == 2:
        m.rod((-0.2, 0, head + 0.22), (0.2, 0, head + 0.22), 0.26, two, n=10)
    else:
        m.box((0, 0, head), (0.5, wide + 0.12, d.between(0.22, 0.35)), two if d.style(2) else one)
    for side, s in (("+x", 1), ("-x", -1)):
        m.panel(side, (s * 0.225, 0, head - 0.3), (wide * 0.7, 0.32), (24, 36, 34))
        m.panel(side, (s * 0.245, 0, head - 0.26), (wide * 0.5, 0.1), (150, 220, 150))
        m.panel(side, (s * 0.245, 0, head - 0.37), (wide * 0.5, 0.07), (220, 220, 200))
        m.panel(side, (s * 0.225, 0, head - 0.62), (wide * 0.5, 0.14), two)
    for s in (-1, 1):
        y = s * (wide / 2)
        m.box((0, y + s * 0.05, 0.75), (0.16, 0.1, 0.3), (30, 30, 30))
        m.beam(
            (0.02, y + s * 0.1, 1.2),
            (0.12, y + s * 0.1, 0.92),
            (0.06, 0.07),
            (200, 40, 40) if s > 0 else (40, 140, 60),
        )
        m.tube(
            [
                (0, y + s * 0.03, head - 0.05),
                (0.1, y + s * 0.2, head - 0.25),
                (0.14, y + s * 0.2, 0.4),
                (0.08, y + s * 0.12, 0.3),
                (0.05, y + s * 0.1, 0.9),
            ],
            0.03,
            (20, 20, 20),
            n=4,
        )


def factory(m: Model, d: Draw) -> None:
    """A brick or sheet hall with a saw-tooth roof, tall chimneys with bands, pipes and a gate."""
    wall = d.tint(d.turn([(164, 90, 70), (150, 150, 146), (190, 176, 140), (120, 136, 150)]))
    depth, width, eaves = 18.0, d.between(26, 32), d.between(6, 7.5)
    m.box((0, 0, 0), (depth, width, eaves), wall)
    roof = d.tint((96, 98, 102))
    teeth = d.turn((4, 5, 3))
    step = width / teeth
    for i in range(teeth):
        y = -width / 2 + i * step
        if d.style(3) == 2:
            m.front(
                [(y, eaves), (y + step, eaves), (y + step / 2, eaves + 2.2)],
                (-depth / 2, depth / 2),
                roof,
            )
        else:
            m.front([(y, eaves), (y + step, eaves), (y, eaves + 3)], (-depth / 2, depth / 2), roof)
            m.panel("-y", (0, y, eaves + 1.4), (depth * 0.9, 1.9), (150, 190, 205))
    chimneys = d.turn((2, 1, 3))
    tall = d.between(17, 21)
    brick = d.tint(d.pick([(150, 80, 62), (190, 188, 184)]))
    for i in range(chimneys):
        x, y = -depth * 0.2, width * 0.5 - 3 - i * 4.5
        m.lathe((x, y, 0), [(1.5, 0), (1.0, tall - 3)], brick)
        m.lathe((x, y, tall - 3), [(1.05, 0), (1.0, 1.2)], (200, 50, 40))
        m.lathe((x, y, tall - 1.8), [(1.02, 0), (1.0, 1.8)], WHITE)
    front = depth / 2
    windows(
        m,
        "+x",
        front,
        (-width / 2, width / 2),
        [eaves * 0.72],
        8,
        (width / 8 * 0.7, 1.5),
        DARK_GLASS,
    )
    m.panel("+x", (front, -width * 0.25, 2), (5, 4), (80, 90, 100))
    m.panel("+x", (front, width * 0.15, 1.3), (1.3, 2.4), (60, 66, 76))
    windows(m, "+y", width / 2, (-depth / 2, depth / 2), [eaves * 0.6], 4, (2.6, 2), DARK_GLASS)
    tank = d.tint((186, 190, 194))
    for x in (front + 1.8,) if d.style(2) else (front + 1.8, front - 2.6):
        m.lathe((x, width / 2 + 2.2, 0), [(1.7, 0), (1.7, 6), (0.3, 7.2)], tank)
    m.tube(
        [
            (front + 1.8, width / 2 + 2.2, 5),
            (front + 1.8, width / 4, 5.0),
            (front - 1, width / 4, 5.0),
        ],
        0.35,
        tank,
    )


def warehouse(m: Model, d: Draw) -> None:
    """A wide, low sheet hall with a flat gable and a row of loading gates with bumpers."""
    wall = d.tint(
        d.turn(
            [(214, 216, 214), (120, 150, 180), (196, 186, 160), (150, 170, 150), (176, 176, 182)]
        )
    )
    trim = d.tint(d.turn([(40, 80, 150), (190, 50, 40), (60, 110, 70), (230, 140, 40)]))
    depth, width, eaves = d.between(20, 26), d.between(32, 38), d.between(6, 7)
    m.box((0, 0, 0), (depth, width, eaves), wall)
    over = 0.3
    if d.style(2):
        m.front(
            [(-width / 2 - over, eaves), (width / 2 + over, eaves), (0, eaves + 2.6)],
            (-depth / 2 - over, depth / 2 + over),
            d.tint((140, 144, 150)),
        )
    else:
        m.extrude(
            [(-depth / 2 - over, eaves), (depth / 2 + over, eaves), (0, eaves + 1.8)],
            (-width / 2 - over, width / 2 + over),
            d.tint((140, 144, 150)),
        )
    front = depth / 2
    m.panel("+x", (front, 0, eaves - 0.6), (width, 0.9), trim)
    for side, y in (("+y", width / 2), ("-y", -width / 2)):
        m.panel(side, (0, y, eaves - 0.6), (depth, 0.9), trim)
    gates = d.turn((5, 6, 4))
    step = width * 0.86 / gates
    gate = d.tint(d.pick([(240, 240, 240), (90, 96, 104), (200, 204, 208)]))
    for i in range(gates):
        y = -width * 0.43 + (i + 0.5) * step
        m.panel("+x", (front, y, 2.5), (step * 0.72, 3.8), (50, 54, 60))
        m.panel("+x", (front + 0.03, y, 2.6), (step * 0.56, 3.2), gate)
        m.panel("+x", (front + 0.06, y, 2.6), (step * 0.56, 0.12), (110, 110, 110))
        m.box((front + 0.9, y, 0), (1.8, step * 0.5, 0.9), CONCRETE)
        for s in (-1, 1):
            m.panel("+x", (front + 1.8, y + s * step * 0.22, 0.6), (0.3, 0.5), (240, 200, 40))
    m.panel("+x", (front, width * 0.465, 1.2), (1.2, 2.2), trim)
    for i in range(3):
        m.box(
            (-depth * 0.2, -width * 0.3 + i * width * 0.3, eaves + 1.0),
            (2, 2, 1.4),
            (170, 172, 176),
        )


def silo(m: Model, d: Draw) -> None:
    """Upright cylinders with a cone or a dome, hoops, a ladder; on legs with a hopper or not."""
    metal = d.tint(
        d.turn(
            [(196, 200, 204), (170, 176, 176), (222, 222, 216), (150, 166, 182), (186, 160, 140)]
        )
    )
    hoop = d.tint((130, 134, 138))
    count = d.turn((1, 2, 1))
    tall, r = d.between(11, 14), d.between(2.0, 2.6)
    cap = d.tint(d.turn([(170, 60, 50), (150, 154, 160), (110, 130, 150), (232, 232, 228)], 2))
    for i in range(count):
        y = (i - (count - 1) / 2) * 2 * r * 1.05
        base = 0.0
        if d.style(2, 2):
            base = 3.2
            m.lathe((0, y, 1.4), [(0.3, 0), (r, base - 1.4)], metal, n=12)
            for a in range(4):
                c, s = (
                    np.cos(a * np.pi / 2 + 0.8) * r * 0.93,
                    np.sin(a * np.pi / 2 + 0.8) * r * 0.93,
                )
                m.box((c, y + s, 0), (0.25, 0.25, base), hoop)
        m.lathe((0, y, base), [(r, 0), (r, tall - base)], metal, n=12)
        for z in np.linspace(base + 1, tall - 0.6, 5):
            m.lathe((0, y, z), [(r + 0.07, 0), (r + 0.07, 0.22)], hoop, n=12)
        if d.style(2):
            m.lathe(
                (0, y, tall), [(r + 0.1, 0), (r * 0.85, 1.1), (r * 0.5, 1.9), (0.1, 2.3)], cap, n=12
            )
        else:
            m.lathe((0, y, tall), [(r + 0.2, 0), (0.3, 2.2), (0.3, 2.7)], cap, n=12)
    x = r + 0.2
    y = -(count - 1) / 2 * 2 * r * 1.05
    for s in (-1, 1):
        m.box((x, y + s * 0.3, 0), (0.1, 0.1, tall), (60, 64, 70))
    for z in np.arange(1, tall, 1.4):
        m.panel("+x", (x + 0.05, y, z), (0.6, 0.16), (60, 64, 70))


def shipping_container(m: Model, d: Draw) -> None:
    """A ribbed steel box with corner posts and door bars at the front."""
    colour = d.tint(
        d.turn(
            [
                (176, 58, 40),
                (40, 90, 150),
                (60, 120, 80),
                (210, 130, 40),
                (130, 134, 138),
                (110, 50, 60),
            ]
        )
    )
    dark: Colour = tuple(int(c * 0.68) for c in colour)  # type: ignore[assignment]
    length, width, high = (6.06, 2.44, 2.59) if d.style(4) < 3 else (6.8, 2.44, 2.9)
    m.box((0, 0, 0.1), (length - 0.1, width - 0.1, high - 0.2), colour)
    ribs = d.turn((12, 9, 14))
    for i in range(ribs):
        x = -length / 2 + (i + 0.75) * length / (ribs + 0.5)
        for side, y in (("+y", width / 2 - 0.05), ("-y", -width / 2 + 0.05)):
            m.panel(side, (x, y, high / 2), (length / ribs * 0.38, high - 0.4), dark)
    a, b = length / 2 - 0.08, width / 2 - 0.08
    for x in (-a, a):
        for y in (-b, b):
            m.box((x, y, 0), (0.16, 0.16, high), dark)
    for z in (0.0, high - 0.16):
        for y in (-b, b):
            m.box((0, y, z), (length, 0.16, 0.16), dark)
        m.box((a, 0, z), (0.16, width, 0.16), dark)
    m.panel("+x", (length / 2 - 0.05, 0, high / 2), (0.07, high - 0.3), (30, 30, 30))
    for y in (-0.8, -0.35, 0.35, 0.8):
        m.box((length / 2 - 0.03, y, 0.15), (0.06, 0.06, high - 0.3), (214, 214, 210))
        m.panel("+x", (length / 2, y, 1.1), (0.3, 0.1), (214, 214, 210))
    m.panel("+x", (length / 2 - 0.04, 0.6, high * 0.78), (0.7, 0.3), WHITE)
    if d.style(2):
        for side, y in (("+y", width / 2 - 0.02), ("-y", -width / 2 + 0.02)):
            m.panel(side, (-length * 0.1, y, high * 0.65), (length * 0.4, 0.6), WHITE)


def power_substation(m: Model, d: Draw) -> None:
    """Transformers with cooling fins and insulators, gantries with wires, a fence, a warning."""
    m.box((0, 0, 0), (14, 18, 0.15), d.tint((156, 150, 140)))
    fence = (128, 134, 138)
    x: float
    y: float
    for x in np.linspace(-7, 7, 5):
        for y in (-9, 9):
            m.beam((x, y, 0), (x, y, 2.2), (0.12, 0.12), fence)
    for y in np.linspace(-4.5, 4.5, 3):
        m.beam((7, y, 0), (7, y, 2.2), (0.12, 0.12), fence)
    for z in (0.8, 1.5, 2.1):
        for y in (-9, 9):
            m.box((0, y, z), (14, 0.06, 0.06), fence)
        m.box((7, 0, z), (0.06, 18, 0.06), fence)
    paint = d.tint(d.turn([(120, 136, 130), (96, 120, 150), (170, 172, 166), (140, 130, 110)]))
    count = d.turn((2, 3, 1, 2))
    for y in np.linspace(-5.2, 5.2, count + 2)[1:-1]:
        m.box((1.2, y, 0.15), (2.6, 2.2, 2.4), paint)
        for i in range(4):
            m.box((2.7, y - 0.9 + i * 0.6, 0.4), (0.5, 0.2, 1.9), (90, 96, 98))
        for off in (-0.7, 0.0, 0.7):
            m.lathe((1.2, y + off, 2.5), [(0.2, 0), (0.14, 0.9), (0.05, 1.2)], (150, 90, 60), n=5)
        m.rod((0.2, y - 1, 3.1), (0.2, y + 1, 3.1), 0.4, paint, n=6)
        m.panel("+x", (2.5, y, 1.5), (0.5, 0.5), (245, 205, 40))
    steel, high = d.tint((150, 156, 160)), d.between(6.5, 8)
    for x in (-4.6, -1.6):
        for y in (-6.5, 0, 6.5):
            m.beam((x, y, 0), (x, y, high), (0.35, 0.35), steel)
            m.beam((x, y, high), (x, y, high + 1), (0.2, 0.2), steel)
        m.box((x, 0, high - 0.4), (0.35, 13.4, 0.4), steel)
        for y in (-4.6, -3, -1.6, 1.6, 3, 4.6):
            m.rod((x, y, high - 1.3), (x, y, high - 0.4), 0.16, (150, 90, 60), n=5)
    for y in (-4.6, -3, -1.6, 1.6, 3, 4.6):
        m.beam((-4.6, y, high - 1.3), (-1.6, y, high - 1.3), (0.07, 0.07), (40, 40, 40))
        m.beam((-1.6, y, high - 1.3), (1.2, y, 3.6), (0.07, 0.07), (40, 40, 40))
    m.box((7.05, 2, 0.9), (0.06, 1, 1.0), (245, 205, 40))
    m.panel("+x", (7.08, 2, 1.4), (0.3, 0.6), (20, 20, 20))
    if d.style(2):
        m.box((-4, -7, 0.15), (3, 3, 3), d.tint((206, 196, 176)))
        m.panel("+x", (-2.5, -7, 1.3), (1, 2.1), (90, 110, 100))
