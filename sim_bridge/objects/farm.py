"""Animals of the farm, nose to +x: horse, cow, bull and sheep."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from symboslam.sim_bridge.objects.animals import DARK, ears, eyes, legs
from symboslam.sim_bridge.objects.draw import Draw
from symboslam.sim_bridge.objects.parts import Colour, Model


def horse(m: Model, d: Draw) -> None:
    """A horse: long legs and neck, mane, long head, flowing tail; some saddled."""
    coat = d.tint(
        d.turn([(132, 78, 42), (60, 44, 36), (206, 196, 184), (170, 112, 60), (96, 60, 40)])
    )
    mane = d.turn([(30, 24, 22), (90, 84, 80), (230, 216, 180)])
    z, fat = d.between(1.1, 1.18), d.between(0.24, 0.29)
    m.tube(
        [
            (-0.8, 0, z + 0.02),
            (-0.5, 0, z + 0.05),
            (0, 0, z - 0.02),
            (0.5, 0, z),
            (0.75, 0, z + 0.08),
        ],
        [fat * 0.6, fat * 1.05, fat, fat * 1.05, fat * 0.7],
        coat,
        n=8,
        squash=1.12,
    )
    legs(
        m,
        (-0.62, 0.52),
        0.15,
        z - 0.05,
        0.065,
        coat,
        d.pick((DARK, (236, 232, 224))),
        step=d.between(-0.22, 0.22),
        bend=0.1,
    )
    lift = d.between(-0.12, 0.14)
    top = (1.08, 0, z + 0.68 + lift)
    m.tube(
        [(0.55, 0, z + 0.02), (0.85, 0, z + 0.36), top], [fat * 0.9, fat * 0.62, 0.115], coat, n=8
    )
    m.tube(
        [
            (top[0] - 0.06, 0, top[2] + 0.05),
            (top[0] + 0.2, 0, top[2] - 0.06),
            (top[0] + 0.5, 0, top[2] - 0.3),
        ],
        [0.11, 0.12, 0.075],
        coat,
        n=7,
    )
    m.ball(
        (top[0] + 0.5, 0, top[2] - 0.31),
        (0.07, 0.065, 0.07),
        mane if d.style(2) else coat,
        n=6,
        rings=3,
    )
    eyes(m, (top[0] + 0.12, 0.105, top[2] + 0.0), 0.028)
    ears(m, (top[0] - 0.04, 0.05, top[2] + 0.1), (0.03, 0.035, 0.15), 0.02, coat)
    m.tube(
        [
            (0.5, 0, z + 0.26),
            (0.76, 0, z + 0.5),
            (top[0] - 0.12, 0, top[2] + 0.1),
            (top[0] + 0.08, 0, top[2] + 0.06),
        ],
        [0.05, 0.085, 0.08, 0.03],
        mane,
        n=5,
    )
    m.tube([(-0.86, 0, z + 0.12), (-1.05, 0, z), (-1.1, 0, z - 0.55)], [0.06, 0.1, 0.04], mane, n=6)
    if d.style(3) == 1:
        m.rod(
            (-0.18, 0, z + 0.0),
            (0.2, 0, z + 0.0),
            fat * 1.13,
            d.pick(((150, 40, 40), (40, 60, 110))),
            n=8,
        )
        m.box((0, 0, z + fat * 1.1), (0.42, 0.24, 0.1), (80, 46, 26), top=(0.7, 0.8))
    elif d.style(3) == 2:
        m.panel("+x", (top[0] + 0.3, 0, top[2] - 0.02), (0.06, 0.1), (245, 245, 240))


def _bovine(
    m: Model,
    coat: Colour,
    hoof: Colour,
    muzzle: Colour,
    *,
    z: float,
    fat: float,
    hump: float,
    low: float,
) -> tuple[float, float]:
    """Body, legs, neck, head and tail; gives (x, z) of the head's middle."""
    m.tube(
        [
            (-0.85, 0, z + 0.06),
            (-0.6, 0, z + 0.04),
            (0, 0, z - 0.03),
            (0.45, 0, z + hump * 0.4),
            (0.75, 0, z + hump * 0.3),
        ],
        [fat * 0.7, fat * 0.98, fat * 1.04, fat * (1 + hump), fat * 0.75],
        coat,
        n=9,
        squash=1.1,
    )
    legs(m, (-0.62, 0.5), 0.19, z - 0.05, 0.075, coat, hoof, bend=0.06)
    hx, hz = 1.08, z + 0.28 - low
    m.tube(
        [(0.6, 0, z + 0.1 + hump * 0.5), (hx - 0.05, 0, hz + 0.05)],
        [fat * (0.72 + hump), 0.16],
        coat,
        n=8,
    )
    m.tube(
        [(hx - 0.1, 0, hz + 0.06), (hx + 0.1, 0, hz), (hx + 0.34, 0, hz - 0.16)],
        [0.15, 0.155, 0.1],
        coat,
        n=7,
    )
    m.ball((hx + 0.35, 0, hz - 0.17), (0.09, 0.115, 0.095), muzzle, n=7, rings=4)
    eyes(m, (hx + 0.1, 0.135, hz + 0.05), 0.03)
    m.tube(
        [(-0.96, 0, z + 0.22), (-1.06, 0, z), (-1.06, 0, z - 0.5)], [0.035, 0.025, 0.02], coat, n=4
    )
    m.ball((-1.06, 0, z - 0.55), (0.05, 0.05, 0.12), DARK, n=5, rings=3)
    for s in (-1, 1):
        m.beam(
            (hx - 0.05, s * 0.13, hz + 0.1),
            (hx - 0.1, s * 0.34, hz + 0.08),
            (0.04, 0.1),
            coat,
            end=(0.02, 0.03),
        )
    return hx, hz


def cattle(m: Model, d: Draw) -> None:
    """A cow: patches, a pale muzzle, an udder, small horns or none."""
    coat = d.tint(
        d.turn([(238, 236, 230), (176, 110, 66), (236, 232, 224), (110, 70, 50), (214, 180, 130)])
    )
    patch = d.turn([(36, 34, 34), (244, 240, 232), (140, 76, 44), (240, 236, 228), (120, 80, 50)])
    z, fat = d.between(0.86, 0.92), d.between(0.34, 0.38)
    hx, hz = _bovine(
        m, coat, DARK, (236, 180, 170), z=z, fat=fat, hump=0.0, low=d.between(0.0, 0.15)
    )
    for s in (-1, 1):
        for x, up in ((-0.52, 0.12), (-0.02, 0.02), (0.42, 0.1)):
            size = d.between(0.16, 0.26)
            place = (x + d.between(-0.06, 0.06), s * fat * 0.55, z + up + d.between(-0.06, 0.06))
            m.ball(place, (size, fat * 0.52, size * d.between(0.8, 1.2)), patch, n=6, rings=3)
    m.ball((-0.35, 0, z - fat * 1.02), (0.18, 0.15, 0.14), (240, 170, 170), n=6, rings=3)
    for s in (-1, 1):
        m.rod(
            (-0.3, s * 0.07, z - fat - 0.1),
            (-0.3, s * 0.07, z - fat - 0.2),
            0.022,
            (230, 150, 150),
            n=4,
        )
        if d.style(2):
            m.rod(
                (hx - 0.08, s * 0.1, hz + 0.18),
                (hx - 0.06, s * 0.18, hz + 0.3),
                0.03,
                (220, 210, 190),
                end=0.008,
                n=4,
            )
    if d.style(3):
        m.box((hx - 0.1, 0.34, hz), (0.02, 0.03, 0.1), (250, 200, 40))
    m.panel("+x", (hx + 0.12, 0, hz + 0.15), (0.1, 0.14), patch)


def bull(m: Model, d: Draw) -> None:
    """A bull: massive shoulders, lowered head, long curved horns, a ring in the nose."""
    coat = d.tint(d.turn([(104, 60, 38), (64, 52, 46), (130, 80, 50), (84, 62, 54), (52, 48, 50)]))
    z, fat = d.between(0.94, 1.02), d.between(0.38, 0.42)
    hump = d.between(0.2, 0.34)
    hx, hz = _bovine(
        m, coat, (24, 22, 22), (70, 58, 54), z=z, fat=fat, hump=hump, low=d.between(0.12, 0.34)
    )
    reach = d.between(0.32, 0.5)
    horn = d.turn([(232, 222, 196), (240, 236, 224), (200, 186, 150)])
    for s in (-1, 1):
        m.tube(
            [
                (hx - 0.02, s * 0.1, hz + 0.15),
                (hx + 0.02, s * (0.1 + reach * 0.75), hz + 0.18),
                (hx + 0.16, s * (0.1 + reach), hz + 0.46),
            ],
            [0.065, 0.055, 0.012],
            horn,
            n=6,
        )
    n = 6
    ring = [
        (hx + 0.42, 0.07 * np.sin(t), hz - 0.27 + 0.07 * np.cos(t))
        for t in np.arange(n + 1) * 2 * np.pi / n
    ]
    for a, b in pairwise(ring):
        m.beam(a, b, (0.025, 0.025), (240, 200, 70))
    if d.style(2):
        m.ball((hx - 0.02, 0, hz + 0.17), (0.13, 0.14, 0.09), (130, 84, 50), n=6, rings=3)
    m.ball((0.4, 0, z + fat * 0.9 + hump * 0.3), (0.4, 0.25, 0.22), coat, n=7, rings=4)


def sheep(m: Model, d: Draw) -> None:
    """A sheep: a woolly ball on thin legs with a bare, often dark face; a ram has curled horns."""
    wool = d.tint(d.turn([(240, 236, 224), (226, 216, 196), (250, 248, 244), (120, 100, 84)]))
    face = d.turn([(44, 40, 40), (230, 206, 176), (60, 46, 38), (236, 226, 214), (34, 32, 32)])
    z, fat = d.between(0.56, 0.62), d.between(0.25, 0.29)
    m.ball((-0.05, 0, z), (0.46, fat, fat), wool, n=8, rings=5)
    for i in range(7):
        x = -0.4 + i * 0.12
        a = i * 2.4
        m.ball(
            (x, np.sin(a) * fat * 0.6, z + 0.08 + abs(np.cos(a)) * fat * 0.5),
            (0.16, 0.16, 0.15),
            wool,
            n=6,
            rings=3,
        )
    legs(m, (-0.32, 0.22), 0.12, z - 0.1, 0.032, face, (30, 28, 28))
    hx, hz = 0.55, z + d.between(0.14, 0.24)
    m.ball((0.38, 0, z + 0.12), (0.16, 0.14, 0.18), wool, n=7, rings=4)
    m.tube(
        [(hx - 0.1, 0, hz + 0.04), (hx + 0.02, 0, hz), (hx + 0.18, 0, hz - 0.12)],
        [0.08, 0.09, 0.055],
        face,
        n=7,
    )
    m.ball((hx - 0.05, 0, hz + 0.09), (0.1, 0.1, 0.07), wool, n=6, rings=3)
    eyes(m, (hx + 0.06, 0.075, hz + 0.02), 0.018)
    for s in (-1, 1):
        m.beam(
            (hx - 0.03, s * 0.07, hz + 0.05),
            (hx - 0.06, s * 0.22, hz + 0.0),
            (0.03, 0.07),
            face,
            end=(0.02, 0.03),
        )
        if d.style(3) == 2:
            m.tube(
                [
                    (hx - 0.02, s * 0.07, hz + 0.09),
                    (hx - 0.14, s * 0.15, hz + 0.07),
                    (hx - 0.1, s * 0.2, hz - 0.07),
                    (hx + 0.04, s * 0.2, hz - 0.04),
                ],
                [0.045, 0.042, 0.034, 0.012],
                (190, 170, 130),
                n=5,
            )
    m.ball((-0.52, 0, z + 0.05), (0.06, 0.06, 0.1), wool, n=5, rings=3)
