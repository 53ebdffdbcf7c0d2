"""Missile, bomb and rifle, as they lie or stand in a store."""

from __future__ import annotations

import numpy as np

from symboslam.sim_bridge.objects.draw import Draw
from symboslam.sim_bridge.objects.parts import Model


def missile(m: Model, d: Draw) -> None:
    """A slender rocket upright on a stand: pointed nose, bands, fins at the foot and half way."""
    hull = d.tint(d.turn([(236, 236, 232), (150, 160, 120), (206, 206, 200), (120, 130, 140)]))
    mark = d.turn([(200, 36, 36), (40, 42, 46), (230, 180, 40), (40, 80, 150)])
    r, tall = d.between(0.3, 0.42), d.between(5.2, 6.2)
    base = 0.5
    m.box((0, 0, 0), (1.3, 1.3, 0.15), (110, 112, 116))
    for a in range(4):
        c, s = np.cos(a * np.pi / 2 + 0.78), np.sin(a * np.pi / 2 + 0.78)
        m.beam(
            (0.6 * c, 0.6 * s, 0.1), (0.25 * c, 0.25 * s, base + 0.3), (0.08, 0.08), (80, 82, 86)
        )
    m.lathe((0, 0, base - 0.2), [(r * 0.8, 0), (r * 0.55, 0.2)], (50, 48, 46), n=10)
    m.lathe((0, 0, base), [(r, 0), (r, tall * 0.78)], hull, n=10)
    nose = tall * (0.22 if d.style(2) else 0.3)
    m.lathe((0, 0, base + tall * 0.78), [(r, 0), (r * 0.72, nose * 0.5), (0.02, nose)], mark, n=10)
    for z in (0.14, 0.5, 0.72):
        m.lathe((0, 0, base + tall * z), [(r + 0.012, 0), (r + 0.012, 0.16)], mark, n=10)
    reach = d.between(0.35, 0.5)
    for s in (-1, 1):
        fin = [
            (s * r * 0.8, base),
            (s * (r + reach), base - 0.1),
            (s * (r + reach), base + 0.35),
            (s * r * 0.8, base + 1.2),
        ]
        m.extrude(fin, (-0.03, 0.03), mark)
        m.front(fin, (-0.03, 0.03), mark)
        if d.style(3):
            z = base + tall * (0.45 if d.style(3) == 1 else 0.6)
            wing = [(s * r * 0.8, z), (s * (r + reach * 0.7), z), (s * r * 0.8, z + 0.7)]
            m.extrude(wing, (-0.025, 0.025), hull)
            m.front(wing, (-0.025, 0.025), hull)


def bomb(m: Model, d: Draw) -> None:
    """An air bomb on a cradle: a drop-shaped body, a coloured band, four tail fins in a ring."""
    hull = d.tint(
        d.turn([(84, 94, 62), (110, 114, 110), (60, 66, 60), (150, 140, 100), (70, 80, 96)])
    )
    band = d.turn([(240, 200, 40), (200, 40, 40), (236, 236, 230)])
    z, fat = 0.52, d.between(0.24, 0.32)
    blunt = d.style(2)
    shape = [(-1.0, 0.1), (-0.6, fat * 0.75), (-0.1, fat), (0.45, fat)]
    shape += (
        [(0.8, fat * 0.85), (0.98, fat * 0.45), (1.04, 0.05)]
        if blunt
        else [(0.8, fat * 0.65), (1.12, 0.03)]
    )
    m.tube([(x, 0, z) for x, _ in shape], [r for _, r in shape], hull, n=12)
    for x in (0.5, 0.36) if d.style(3) else (0.45,):
        m.rod((x, 0, z), (x + 0.07, 0, z), fat + 0.008, band, n=12)
    if blunt:
        m.rod((1.03, 0, z), (1.16, 0, z), 0.04, (170, 172, 176))
    span = fat * d.between(1.05, 1.3)
    for s in (-1, 1):
        for u, v in ((s, s), (s, -s)):
            a = span * 0.8
            m.beam((-1.22, 0.05 * u, z + 0.05 * v), (-1.22, a * u, z + a * v), (0.03, 0.44), hull)
            m.add(
                [
                    (-0.55, 0.1 * u, z + 0.1 * v),
                    (-1.2, 0.05 * u, z + 0.05 * v),
                    (-1.42, a * u, z + a * v),
                    (-1.0, a * u, z + a * v),
                ],
                [(0, 1, 2), (0, 2, 3), (0, 2, 1), (0, 3, 2)],
                hull,
            )
        a = span * 0.8
        m.box((-1.25, s * a, z - a), (0.3, 0.03, 2 * a), band if d.style(2, 2) else hull)
        m.box((-1.25, 0, z + s * a - 0.015), (0.3, 2 * a, 0.03), band if d.style(2, 2) else hull)
    wood = d.tint((150, 110, 66))
    for x in (-0.4, 0.5):
        m.box((x, 0, 0.1), (0.12, 0.55, 0.3), wood)
        m.box((x, 0, 0), (0.16, 0.75, 0.1), wood)
    for y in (-0.3, 0.3):
        m.box((0.05, y, 0.02), (1.3, 0.08, 0.08), wood)


def rifle(m: Model, d: Draw) -> None:
    """A rifle on its bipod: stock, grip, trigger guard, magazine, barrel, sight or telescope."""
    metal = d.tint((52, 54, 58), 8)
    wood = d.tint(d.turn([(126, 78, 44), (56, 58, 60), (92, 98, 64), (160, 130, 84)]))
    z = 0.26
    style = d.style(3)
    m.extrude(
        [
            (-0.52, z - 0.12),
            (-0.52, z + 0.02),
            (-0.2, z + 0.03),
            (-0.1, z + 0.02),
            (-0.12, z - 0.03),
            (-0.22, z - 0.03),
        ],
        (-0.02, 0.02),
        wood,
    )
    m.box((0.03, 0, z - 0.03), (0.3, 0.045, 0.075), metal)
    m.box((0.29, 0, z - 0.025), (0.26, 0.05, 0.055), wood)
    m.rod((0.15, 0, z + 0.012), (0.58, 0, z + 0.012), 0.013, metal)
    m.rod((0.54, 0, z + 0.012), (0.6, 0, z + 0.012), 0.02, metal)
    m.extrude(
        [(-0.1, z - 0.02), (-0.03, z - 0.02), (-0.07, z - 0.14), (-0.13, z - 0.13)],
        (-0.018, 0.018),
        wood,
    )
    if style == 1:  # a curved magazine
        m.extrude(
            [
                (0.05, z - 0.02),
                (0.12, z - 0.02),
                (0.15, z - 0.11),
                (0.19, z - 0.17),
                (0.13, z - 0.19),
                (0.08, z - 0.12),
            ],
            (-0.018, 0.018),
            metal,
        )
    elif style == 0:
        m.box((0.09, 0, z - 0.15), (0.065, 0.036, 0.14), metal, shift=-0.01)
    else:
        m.box((0.06, 0, z - 0.07), (0.1, 0.03, 0.05), metal)
        m.rod((-0.02, -0.02, z + 0.02), (-0.04, -0.07, z + 0.02), 0.01, metal)
    m.box((0.0, 0, z - 0.075), (0.07, 0.012, 0.012), metal)
    if d.style(2):  # a telescope
        m.rod((-0.08, 0, z + 0.085), (0.16, 0, z + 0.085), 0.018, metal, n=8)
        m.rod((0.14, 0, z + 0.085), (0.2, 0, z + 0.085), 0.027, metal, n=8)
        for x in (-0.03, 0.1):
            m.box((x, 0, z + 0.03), (0.02, 0.02, 0.05), metal)
    else:
        m.box((0.52, 0, z + 0.015), (0.02, 0.012, 0.055), metal)
        m.box((0.0, 0, z + 0.04), (0.18, 0.02, 0.03), metal)
    for s in (-1, 1):
        m.beam((0.4, 0, z - 0.01), (0.44, s * 0.11, 0), (0.014, 0.014), metal)
    m.beam((-0.5, 0, z - 0.1), (-0.5, 0, 0), (0.016, 0.016), metal)
