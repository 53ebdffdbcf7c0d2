"""What stands along streets and in parks: lights, signs, shelters, benches, hydrants."""

from __future__ import annotations

import numpy as np

from symboslam.sim_bridge.objects.draw import Draw
from symboslam.sim_bridge.objects.parts import Colour, Model, circle

POLE: Colour = (110, 114, 118)
WHITE: Colour = (245, 245, 245)
BLACK: Colour = (28, 30, 32)
# Strokes of letters on a grid of 3 by 5: x, y, width, height of each.
LETTERS: dict[str, list[tuple[float, float, float, float]]] = {
    "S": [(0, 4, 3, 1), (0, 2, 3, 1), (0, 0, 3, 1), (0, 3, 1, 1), (2, 1, 1, 1)],
    "T": [(0, 4, 3, 1), (1, 0, 1, 4)],
    "O": [(0, 4, 3, 1), (0, 0, 3, 1), (0, 1, 1, 3), (2, 1, 1, 3)],
    "P": [(0, 0, 1, 5), (1, 4, 2, 1), (1, 2, 2, 1), (2, 3, 1, 1)],
    "B": [
        (0, 0, 1, 5),
        (1, 4, 1.6, 1),
        (1, 2, 1.6, 1),
        (1, 0, 1.6, 1),
        (2.2, 3, 0.8, 1),
        (2.2, 1, 0.8, 1),
    ],
    "U": [(0, 0, 1, 5), (2, 0, 1, 5), (1, 0, 1, 1)],
}


def letters(
    m: Model,
    text: str,
    at: tuple[float, float, float],
    high: float,
    colour: Colour,
    side: str = "+x",
) -> None:
    """Capitals painted on a wall, the middle of the line at ``at``."""
    unit = high / 5
    total = (len(text) * 4 - 1) * unit
    sign = 1 if side == "+x" else -1
    for i, letter in enumerate(text):
        for x, y, w, h in LETTERS[letter]:
            u = -total / 2 + (i * 4 + x + w / 2) * unit
            m.panel(
                side,
                (at[0], at[1] + sign * u, at[2] + (y + h / 2 - 2.5) * unit),
                (w * unit, h * unit),
                colour,
            )


def traffic_light(m: Model, d: Draw) -> None:
    """Three lamps in a dark case with hoods, on a pole or under an arm."""
    case = d.tint(d.turn([(34, 36, 38), (60, 66, 40), (214, 176, 40), (44, 60, 52)]))
    pole = d.tint(d.turn([POLE, (60, 64, 66), (190, 190, 186)]))
    high = d.between(2.3, 2.6)
    lit = d.whole(0, 2)
    m.lathe((0, 0, 0), [(0.16, 0), (0.16, 0.3), (0.07, 0.35)], pole)
    m.rod((0, 0, 0.3), (0, 0, high + (0.9 if d.style(2) else 0.2)), 0.07, pole)
    backs = d.style(3) != 1
    heads = [(0.14, 0.0)] if d.style(3) != 2 else [(0.14, -0.24), (0.14, 0.24)]
    for x, y in heads:
        if backs:
            m.box(
                (x - 0.02, y, high - 0.08), (0.04, 0.56 if len(heads) == 1 else 0.44, 1.26), BLACK
            )
            m.box((x - 0.05, y, high - 0.1), (0.02, 0.6 if len(heads) == 1 else 0.46, 1.3), WHITE)
        m.box((x + 0.08, y, high), (0.2, 0.36, 1.1), case)
        for i, (on, off) in enumerate(
            zip(
                ((40, 230, 120), (255, 190, 30), (250, 40, 30)),
                ((30, 110, 70), (150, 110, 30), (130, 30, 26)),
                strict=True,
            )
        ):
            z = high + 0.2 + 0.35 * i
            m.rod(
                (x + 0.17, y, z),
                (x + 0.2, y, z),
                0.14,
                on if i == lit or len(heads) == 1 else off,
                n=8,
            )
            m.box((x + 0.25, y, z + 0.13), (0.16, 0.3, 0.03), case)
    if d.style(2, 2):
        m.box((0.12, 0, 1.0), (0.1, 0.14, 0.22), (230, 190, 40))  # the button for people on foot


def billboard(m: Model, d: Draw) -> None:
    """A large framed board on posts, with an advertisement of shapes and bars."""
    ground = d.turn(
        [
            (240, 210, 60),
            (60, 140, 200),
            (230, 80, 70),
            (250, 250, 245),
            (80, 170, 110),
            (60, 50, 90),
        ]
    )
    other = d.turn([(200, 40, 40), (250, 240, 200), (40, 60, 120), (240, 120, 40), (30, 90, 60)])
    steel = d.tint((90, 94, 98))
    wide, tall, low = d.between(5.5, 7), d.between(2.6, 3.2), d.between(2.4, 3.2)
    if d.style(3) == 1:
        m.rod((0, 0, 0), (0, 0, low + 0.3), 0.3, steel, n=8)
    else:
        for y in (-wide * 0.32, wide * 0.32) if d.style(3) else (-wide * 0.38, 0, wide * 0.38):
            m.box((0, y, 0), (0.25, 0.25, low + 0.2), steel)
            m.beam((-0.4, y, 0), (-0.1, y, low + 1), (0.14, 0.14), steel)
    m.box((0, 0, low), (0.3, wide, tall), steel)
    m.box((0.35, 0, low - 0.15), (0.5, wide, 0.08), steel)
    z = low + tall / 2
    m.panel("+x", (0.15, 0, z), (wide - 0.3, tall - 0.3), ground)
    side = d.pick((-1, 1))
    hub = (0.18, side * wide * 0.27, z)
    if d.style(2):
        ring = circle(12) * tall * 0.32
        fan = [(0, i, i + 1) for i in range(1, 11)]
        m.add(
            np.column_stack([np.full(12, hub[0]), hub[1] + ring[:, 0], hub[2] + ring[:, 1]]),
            fan,
            other,
        )
        ring = ring[::2] * 0.55
        m.add(
            np.column_stack([np.full(6, hub[0] + 0.03), hub[1] + ring[:, 0], hub[2] + ring[:, 1]]),
            fan[:4],
            WHITE,
        )
    else:  # a bottle
        m.panel("+x", hub, (tall * 0.28, tall * 0.5), other)
        m.panel("+x", (hub[0], hub[1], z + tall * 0.32), (tall * 0.1, tall * 0.16), other)
        m.panel("+x", (hub[0] + 0.03, hub[1], z), (tall * 0.28, tall * 0.16), WHITE)
    ink = (250, 250, 250) if sum(ground) < 420 else (40, 40, 50)
    for i, share in enumerate((0.42, 0.3, 0.38)):
        m.panel(
            "+x",
            (0.18, -side * wide * 0.2, z + tall * (0.25 - 0.22 * i)),
            (wide * share, tall * (0.14 if i else 0.2)),
            ink if i != 1 else other,
        )
    for y in (-wide * 0.3, 0, wide * 0.3):
        m.beam((0.15, y, low + tall), (0.7, y, low + tall + 0.25), (0.08, 0.08), steel)
        m.box((0.75, y, low + tall + 0.15), (0.25, 0.4, 0.12), (60, 62, 66))


def stop_sign(m: Model, d: Draw) -> None:
    """A red octagon with a white rim and STOP, on a post."""
    high, r = d.between(2.0, 2.3), d.between(0.36, 0.44)
    post = d.tint(d.turn([(150, 154, 158), (120, 90, 60), (70, 100, 80)]))
    if d.style(2):
        m.rod((0, 0, 0), (0, 0, high + 0.1), 0.04, post)
    else:
        m.box((0, 0, 0), (0.06, 0.08, high + 0.2), post)
    red = d.tint((196, 26, 30))
    for x, size, colour in ((0.04, r, WHITE), (0.055, r * 0.91, red)):
        ring = circle(8, start=np.pi / 8) * size
        m.front([(a, high + b) for a, b in ring], (x, x + 0.02), colour)
    letters(m, "STOP", (0.06, 0, high), r * 0.46, WHITE)
    if d.style(3) == 1:  # a plate below
        m.box((0.05, 0, high - r - 0.28), (0.02, r * 1.4, 0.22), WHITE)
        for s in (-1, 1):
            m.panel("+x", (0.065, s * r * 0.35, high - r - 0.17), (r * 0.5, 0.07), BLACK)
    elif d.style(3) == 2:
        m.lathe((0, 0, 0), [(0.16, 0), (0.16, 0.06), (0.06, 0.16)], (150, 150, 146))


def bus_stop(m: Model, d: Draw) -> None:
    """A shelter with glass, a seat and a roof, and a pole with a BUS sign."""
    frame = d.tint(
        d.turn([(70, 76, 82), (40, 90, 70), (180, 60, 50), (50, 80, 140), (200, 200, 196)])
    )
    badge = d.turn([(30, 90, 180), (230, 190, 40), (0, 120, 80), (200, 40, 50)])
    ink = BLACK if sum(badge) > 420 else WHITE
    half, glass = d.between(1.4, 1.8), (176, 206, 214)
    if d.style(3) == 2:
        m.extrude(
            [(-0.9, 2.2), (0.8, 2.5), (0.8, 2.62), (-0.9, 2.32)], (-half - 0.2, half + 0.2), frame
        )
    else:
        m.box((0, 0, 2.3), (1.7, 2 * half + 0.4, 0.16), frame)
        if d.style(3) == 1:
            m.extrude([(-0.8, 2.46), (0.8, 2.46), (0, 2.8)], (-half - 0.2, half + 0.2), frame)
    for y in (-half, half):
        m.box((-0.6, y, 0), (0.1, 0.1, 2.3), frame)
        if d.style(2):
            m.box((0.6, y, 0), (0.1, 0.1, 2.3), frame)
    for y in (-half / 2, half / 2):
        m.box((-0.6, y, 0.4), (0.05, half - 0.12, 1.7), glass)
    m.box((-0.05, -half, 0.4), (1.0, 0.05, 1.7), d.turn([glass, (230, 120, 60), (90, 160, 200)]))
    m.box((-0.3, 0, 0.42), (0.42, 2 * half - 0.6, 0.07), d.tint((150, 100, 60)))
    for y in (-half + 0.5, half - 0.5):
        m.box((-0.35, y, 0), (0.3, 0.07, 0.42), frame)
    y = half + 0.75
    m.rod((0.5, y, 0), (0.5, y, 2.9), 0.05, POLE)
    m.box((0.52, y, 2.0), (0.08, 0.85, 0.9), badge)
    for side, x in (("+x", 0.56), ("-x", 0.48)):
        letters(m, "BUS", (x, y, 2.55), 0.3, ink, side)
        m.panel(side, (x, y, 2.2), (0.6, 0.2), ink)
    m.box((0.52, y, 1.1), (0.06, 0.4, 0.6), WHITE)


def fire_hydrant(m: Model, d: Draw) -> None:
    """A barrel with a bonnet, a nut on top and a capped outlet to each side and to the front."""
    paint = d.tint(
        d.turn([(206, 36, 30), (240, 190, 30), (206, 36, 30), (220, 90, 30), (60, 90, 170)])
    )
    cap = d.tint(d.turn([(240, 240, 236), paint, (240, 200, 40), (150, 154, 158)]))
    r, tall = d.between(0.11, 0.14), d.between(0.5, 0.62)
    m.lathe(
        (0, 0, 0),
        [
            (r * 1.6, 0),
            (r * 1.6, 0.06),
            (r, 0.08),
            (r, tall),
            (r * 1.3, tall),
            (r * 1.3, tall + 0.06),
        ],
        paint,
        n=10,
    )
    m.lathe(
        (0, 0, tall + 0.06),
        [(r * 1.15, 0), (r * 0.95, 0.08), (r * 0.5, 0.14), (0.04, 0.16), (0.04, 0.22)],
        cap if d.style(2) else paint,
        n=10,
    )
    z = tall * 0.7
    for s in (-1, 1):
        m.rod((0, 0, z), (0, s * (r + 0.1), z), 0.065, paint, n=8)
        m.rod((0, s * (r + 0.08), z), (0, s * (r + 0.15), z), 0.08, cap, n=6)
    m.rod((0, 0, z - 0.06), (r + 0.08, 0, z - 0.06), 0.085, paint, n=8)
    m.rod((r + 0.06, 0, z - 0.06), (r + 0.13, 0, z - 0.06), 0.1, cap, n=6)
    if d.style(3) == 1:
        m.lathe((0, 0, 0.16), [(r * 1.05, 0), (r * 1.05, 0.08)], WHITE, n=10)


def bench(m: Model, d: Draw) -> None:
    """A park bench: slats for the seat and the back, legs and arm rests."""
    wood = d.tint(
        d.turn([(150, 98, 56), (120, 76, 44), (184, 140, 92), (70, 110, 76), (150, 50, 44)])
    )
    iron = d.tint(d.turn([(40, 42, 44), (110, 114, 118), (176, 174, 168)]))
    half, slats = d.between(0.75, 1.0), d.turn((3, 4, 2))
    for i in range(slats):
        step = 0.46 / slats
        m.box((-0.2 + (i + 0.5) * step, 0, 0.42), (step * 0.75, 2 * half, 0.05), wood)
    rows = d.turn((2, 3))
    for i in range(rows):
        z = 0.55 + i * 0.36 / rows
        m.box((-0.26 - 0.05 * i, 0, z), (0.04, 2 * half, 0.24 / rows + 0.02), wood)
    for y in (-half * 0.86, half * 0.86):
        if d.style(3) == 2:
            m.box((0, y, 0), (0.42, 0.16, 0.42), iron)
        else:
            m.beam((0.22, y, 0), (0.2, y, 0.42), (0.06, 0.06), iron)
            m.beam((-0.26, y, 0), (-0.2, y, 0.42), (0.06, 0.06), iron)
            m.box((0, y, 0.38), (0.46, 0.06, 0.05), iron)
        m.beam((-0.22, y, 0.4), (-0.36, y, 0.92), (0.06, 0.05), iron)
        if d.style(2):
            m.box((0, y, 0.64), (0.5, 0.07, 0.04), iron)
            m.box((0.2, y, 0.42), (0.05, 0.05, 0.24), iron)


def table(m: Model, d: Draw) -> None:
    """A table with four legs, a round one on a foot, or a trestle."""
    wood = d.tint(
        d.turn([(170, 118, 70), (130, 84, 50), (225, 222, 214), (196, 158, 110), (90, 64, 46)])
    )
    leg = d.tint(d.turn([(120, 78, 46), (60, 62, 66), wood]))
    half, deep, high = d.between(0.65, 0.95), d.between(0.36, 0.48), 0.72
    style = d.style(4)
    if style == 1:  # round, with a foot
        r = d.between(0.5, 0.6)
        m.lathe((0, 0, high), [(r, 0), (r, 0.05)], wood, n=14)
        m.lathe((0, 0, 0), [(0.32, 0), (0.3, 0.04), (0.06, 0.1), (0.05, high)], leg)
        return
    m.box((0, 0, high), (2 * deep, 2 * half, 0.05), wood)
    m.box((0, 0, high - 0.1), (2 * deep - 0.16, 2 * half - 0.16, 0.1), leg)
    if style == 3:  # trestles
        for y in (-half * 0.75, half * 0.75):
            for s in (-1, 1):
                m.beam((s * deep * 0.95, y, 0), (s * deep * 0.2, y, high), (0.07, 0.06), leg)
            m.box((0, y, 0.25), (deep * 1.2, 0.05, 0.05), leg)
        m.box((0, 0, 0.28), (0.05, 1.5 * half, 0.06), leg)
        return
    thick = d.between(0.05, 0.09)
    for x in (-deep + 0.08, deep - 0.08):
        for y in (-half + 0.08, half - 0.08):
            if style == 2:
                m.rod(
                    (x * 1.05, y * 1.05, 0),
                    (x * 0.85, y * 0.9, high),
                    thick * 0.35,
                    leg,
                    end=thick * 0.6,
                )
            else:
                m.box((x, y, 0), (thick, thick, high), leg)
