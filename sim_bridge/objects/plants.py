"""Trees and plants."""

from __future__ import annotations

import numpy as np

from symboslam.sim_bridge.objects.draw import Draw
from symboslam.sim_bridge.objects.parts import Colour, Model

BARK: Colour = (104, 74, 48)
GREENS: tuple[Colour, ...] = (
    (58, 120, 46),
    (84, 140, 54),
    (44, 96, 50),
    (110, 140, 60),
    (70, 110, 70),
)


def tree(m: Model, d: Draw) -> None:
    """A trunk with a crown: broadleaf, conifer, gum, poplar or palm."""
    green = d.tint(d.turn(GREENS))
    dark: Colour = (int(green[0] * 0.78), int(green[1] * 0.78), int(green[2] * 0.78))
    style = d.style(5)
    if style in (0, 2):  # broadleaf: some clumps on a trunk
        trunk = d.between(2.0, 2.8)
        m.rod((0, 0, 0), (0, 0, trunk + 1.5), 0.3, BARK, end=0.18)
        m.ball((0, 0, trunk + 3.2), (2.2, 2.2, 2.4), green)
        start = d.between(0, 2)
        for i in range(4):
            a = start + i * np.pi / 2 + d.between(-0.3, 0.3)
            r = d.between(1.2, 1.7)
            x, y = 1.4 * np.cos(a), 1.4 * np.sin(a)
            m.ball(
                (x, y, trunk + d.between(1.8, 3.2)), (r, r, r * 0.9), dark if i % 2 else green, n=7
            )
    elif style == 1:  # conifer
        tiers = d.whole(3, 5)
        m.rod((0, 0, 0), (0, 0, 2), 0.3, BARK)
        for i in range(tiers):
            r = 2.3 * (1 - i / (tiers + 0.6))
            z = 1.3 + i * 6.5 / tiers
            m.lathe(
                (0, 0, z),
                [(r * 0.8, 0), (r, 0.15), (0.05, 9.5 / tiers)],
                dark if i % 2 else (40, 90, 56),
                n=9,
            )
    elif style == 3:  # gum tree: a pale forked trunk, flat clumps high up
        bark = d.tint((206, 192, 172))
        m.rod((0, 0, 0), (0.1, 0, 3), 0.3, bark, end=0.22)
        for i in range(4):
            a = i * np.pi / 2 + d.between(0, 0.8)
            x, y, z = 1.7 * np.cos(a), 1.7 * np.sin(a), d.between(6, 7.5)
            m.rod((0.1, 0, 2.9), (x, y, z), 0.17, bark, end=0.08, n=5)
            m.ball((x, y, z + 0.4), (1.5, 1.5, 0.9), green if i % 2 else (104, 132, 84), n=7)
        m.ball((0, 0, 8), (1.5, 1.5, 1), green, n=7)
    else:  # poplar or palm
        if d.style(2, 5):
            m.tube([(0, 0, 0), (0.2, 0, 4), (0.6, 0, 8)], [0.35, 0.25, 0.2], (140, 112, 80))
            for i in range(9):
                a = i * 2 * np.pi / 9
                c, s = np.cos(a), np.sin(a)
                m.beam(
                    (0.6, 0, 8), (0.6 + 1.5 * c, 1.5 * s, 8.7), (0.4, 0.1), green, end=(0.8, 0.08)
                )
                m.beam(
                    (0.6 + 1.5 * c, 1.5 * s, 8.7),
                    (0.6 + 2.7 * c, 2.7 * s, 7.4),
                    (0.8, 0.08),
                    dark,
                    end=(0.1, 0.05),
                )
        else:
            m.rod((0, 0, 0), (0, 0, 2), 0.3, BARK)
            m.lathe(
                (0, 0, 1), [(0.4, 0), (1.6, 1.6), (1.8, 3.6), (1.1, 6.4), (0.1, 8.4)], green, n=9
            )


def _leaf(
    m: Model,
    at: tuple[float, float, float],
    angle: float,
    reach: float,
    rise: float,
    width: float,
    colour: Colour,
) -> None:
    """A pointed leaf that bends outward."""
    c, s = np.cos(angle), np.sin(angle)
    x, y, z = at
    side = np.array((-s, c, 0)) * width / 2
    mid = np.array((x + reach * 0.55 * c, y + reach * 0.55 * s, z + rise))
    tip = np.array((x + reach * c, y + reach * s, z + rise * 0.75))
    root = np.array(at)
    faces = [(0, 1, 2), (1, 3, 2), (0, 2, 1), (1, 2, 3)]
    m.add([root, mid - side, mid + side, tip], faces, colour)


def plant(m: Model, d: Draw) -> None:
    """A tub with long leaves, a flowering shrub, a tussock of grass or a cactus-like succulent."""
    green = d.tint(d.turn(GREENS))
    light: Colour = (min(255, green[0] + 40), min(255, green[1] + 40), green[2] + 20)
    flower = d.turn(
        [(230, 60, 90), (250, 210, 60), (190, 90, 200), (245, 245, 240), (240, 120, 40)]
    )
    style = d.style(4)
    base = 0.0
    if style in (0, 2):
        pot = d.tint(d.turn([(184, 92, 58), (90, 94, 100), (210, 200, 180), (60, 90, 130)], 2))
        base = d.between(0.34, 0.45)
        m.lathe((0, 0, 0), [(0.2, 0), (0.3, base - 0.08), (0.34, base - 0.08), (0.34, base)], pot)
        m.lathe((0, 0, base - 0.02), [(0.28, 0), (0.28, 0.03)], (70, 50, 36))
    if style == 0:  # long leaves in a tub
        for i in range(16):
            a = i * 2.4
            _leaf(
                m,
                (0, 0, base),
                a,
                0.25 + 0.02 * i,
                d.between(0.45, 0.7),
                0.14,
                light if i % 2 else green,
            )
    elif style == 1:  # flowering shrub
        for i in range(4):
            a = i * np.pi / 2 + 0.5
            m.ball(
                (0.24 * np.cos(a), 0.24 * np.sin(a), 0.32),
                (0.32, 0.32, 0.32),
                green if i % 2 else light,
                n=7,
            )
        m.ball((0, 0, 0.62), (0.34, 0.34, 0.32), green, n=7)
        for i in range(14):
            a, z = i * 2.4, 0.3 + 0.045 * i
            r = 0.56 - 0.03 * i
            m.ball((r * np.cos(a), r * np.sin(a), z), (0.06, 0.06, 0.06), flower, n=4, rings=2)
    elif style == 2:  # a bush with flowers on stems in a tub
        m.ball((0, 0, base + 0.14), (0.36, 0.36, 0.2), green)
        for i in range(9):
            a = i * 2.4
            x, y, z = 0.3 * np.cos(a), 0.3 * np.sin(a), base + d.between(0.4, 0.6)
            m.rod((x * 0.3, y * 0.3, base), (x, y, z), 0.015, green, n=3)
            m.ball((x, y, z), (0.09, 0.09, 0.06), flower, n=5, rings=2)
            _leaf(m, (x * 0.3, y * 0.3, base + 0.1), a + 0.5, 0.4, 0.25, 0.12, light)
    else:  # tussock or agave
        wide = d.pick((0.08, 0.16))
        for i in range(26):
            a = i * 2.4
            _leaf(
                m,
                (0.05 * np.cos(a), 0.05 * np.sin(a), 0),
                a,
                0.12 + 0.017 * i,
                d.between(0.75, 0.95) - 0.022 * i,
                wide,
                light if i % 3 else green,
            )
