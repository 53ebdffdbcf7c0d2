"""Animals, nose to +x: dog, cat, bird and kangaroo; and what all animals have."""

from __future__ import annotations

from symboslam.sim_bridge.objects.draw import Draw
from symboslam.sim_bridge.objects.parts import Colour, Model, Point

DARK: Colour = (36, 32, 30)


def legs(
    m: Model,
    xs: tuple[float, float],
    half: float,
    top: float,
    r: float,
    colour: Colour,
    hoof: Colour,
    *,
    step: float = 0.0,
    bend: float = 0.0,
) -> None:
    """Four legs from ``top`` to the ground; the hind ones bend back by ``bend``."""
    for x, back in zip(xs, (bend, 0.0), strict=True):
        for s in (-1, 1):
            stride = s * step * (1 if x < 0 else -1)
            knee = (x - back + stride * 0.4, s * half, top * 0.45)
            foot = (x + stride, s * half, r * 0.7)
            m.tube(
                [(x + back * 0.4, s * half, top), knee, foot],
                [r * 1.6, r * 0.9, r * 0.75],
                colour,
                n=5,
            )
            m.rod((foot[0], foot[1], 0), (foot[0], foot[1], r * 1.6), r * 0.95, hoof, n=5)


def ears(m: Model, at: Point, size: tuple[float, float, float], out: float, colour: Colour) -> None:
    """Two pointed ears."""
    x, y, z = at
    for s in (-1, 1):
        m.rod(
            (x, s * y, z),
            (x + size[0], s * (y + out), z + size[2]),
            size[1],
            colour,
            end=size[1] * 0.15,
            n=4,
        )


def eyes(m: Model, at: Point, r: float) -> None:
    """Two dark eyes."""
    for s in (-1, 1):
        m.ball((at[0], s * at[1], at[2]), (r, r, r), (20, 20, 20), n=4, rings=2)


def dog(m: Model, d: Draw) -> None:
    """A dog: muzzle with a dark nose, drooping or pricked ears, raised tail, collar."""
    coat = d.tint(
        d.turn(
            [
                (150, 100, 56),
                (60, 52, 46),
                (216, 190, 150),
                (190, 120, 60),
                (236, 232, 224),
                (110, 104, 100),
            ]
        )
    )
    spot = d.turn([(240, 236, 226), coat, (70, 50, 36), (30, 28, 28)])
    z, fat = d.between(0.42, 0.5), d.between(0.1, 0.14)
    m.tube(
        [(-0.34, 0, z), (-0.1, 0, z - 0.01), (0.2, 0, z - 0.02), (0.34, 0, z + 0.05)],
        [fat * 0.75, fat * 0.9, fat * 1.15, fat * 0.8],
        coat,
        n=8,
    )
    legs(m, (-0.28, 0.22), 0.075, z, 0.032, coat, spot, step=d.between(-0.07, 0.07), bend=0.05)
    m.tube([(0.26, 0, z + 0.02), (0.42, 0, z + 0.2)], [fat * 0.8, fat * 0.62], coat)
    head = z + 0.25
    m.ball((0.45, 0, head), (0.11, 0.09, 0.095), coat, n=8, rings=5)
    m.tube(
        [(0.48, 0, head - 0.03), (0.64, 0, head - 0.05)],
        [0.06, 0.042],
        spot if d.style(2) else coat,
    )
    m.ball((0.65, 0, head - 0.035), (0.026, 0.03, 0.024), (20, 20, 20), n=5, rings=3)
    eyes(m, (0.52, 0.055, head + 0.035), 0.018)
    if d.style(2):
        ears(m, (0.41, 0.05, head + 0.06), (-0.01, 0.035, 0.11), 0.02, coat)
    else:
        for s in (-1, 1):
            m.beam(
                (0.42, s * 0.08, head + 0.06),
                (0.43, s * 0.11, head - 0.1),
                (0.03, 0.08),
                DARK if sum(coat) > 400 else coat,
            )
    m.tube(
        [(-0.36, 0, z + 0.04), (-0.48, 0, z + 0.12), (-0.5 + d.between(-0.05, 0.08), 0, z + 0.28)],
        [0.035, 0.03, 0.012],
        coat,
        n=5,
    )
    m.rod(
        (0.345, 0, z + 0.085),
        (0.37, 0, z + 0.13),
        fat * 0.82,
        d.turn([(210, 40, 40), (40, 90, 190), (240, 190, 40)]),
    )
    if spot != coat:
        m.ball((-0.05, 0, z + 0.015), (0.13, fat * 0.97, fat * 0.98), spot, n=8, rings=4)


def cat(m: Model, d: Draw) -> None:
    """A cat: round head, pointed ears, whiskers, long tail held high; walking or sitting."""
    coat = d.tint(
        d.turn([(220, 140, 70), (60, 58, 60), (160, 156, 152), (236, 230, 220), (150, 116, 80)])
    )
    mark: Colour = (int(coat[0] * 0.68), int(coat[1] * 0.66), int(coat[2] * 0.64))
    belly = (244, 240, 232)
    if d.style(3) == 2:  # sits
        m.tube(
            [(-0.08, 0, 0.02), (-0.06, 0, 0.12), (0.02, 0, 0.26), (0.05, 0, 0.34)],
            [0.1, 0.12, 0.08, 0.055],
            coat,
            n=8,
        )
        for s in (-1, 1):
            m.rod((0.05, s * 0.035, 0.22), (0.09, s * 0.04, 0), 0.026, coat, end=0.022, n=5)
            m.ball((0.1, s * 0.04, 0.02), (0.035, 0.025, 0.02), belly, n=5, rings=3)
            m.ball((0.0, s * 0.08, 0.05), (0.09, 0.04, 0.06), coat, n=6, rings=3)
        m.tube(
            [(-0.16, 0, 0.03), (-0.25, 0.08, 0.04), (-0.16, 0.18, 0.04)],
            [0.03, 0.028, 0.02],
            mark,
            n=5,
        )
        x, z = 0.08, 0.41
    else:
        z0 = 0.23
        m.tube(
            [(-0.22, 0, z0), (-0.08, 0, z0 + 0.01), (0.08, 0, z0), (0.18, 0, z0 + 0.02)],
            [0.055, 0.075, 0.07, 0.05],
            coat,
            n=8,
        )
        legs(m, (-0.17, 0.13), 0.04, z0, 0.02, coat, belly, step=d.between(-0.05, 0.05), bend=0.03)
        m.tube(
            [
                (-0.23, 0, z0 + 0.02),
                (-0.33, 0, z0 + 0.08),
                (-0.36, 0, z0 + 0.22),
                (-0.3, 0, z0 + 0.3),
            ],
            [0.024, 0.022, 0.02, 0.014],
            mark,
            n=5,
        )
        for i in range(3):
            t = -0.13 + i * 0.1
            m.rod((t, 0, z0 + 0.008), (t + 0.035, 0, z0 + 0.008), 0.077, mark, n=8)
        x, z = 0.26, z0 + 0.11
    m.ball((x, 0, z), (0.08, 0.082, 0.072), coat, n=8, rings=5)
    m.ball((x + 0.06, 0, z - 0.022), (0.035, 0.045, 0.026), belly, n=6, rings=3)
    m.ball((x + 0.095, 0, z - 0.008), (0.01, 0.013, 0.009), (220, 120, 120), n=4, rings=2)
    for s in (-1, 1):
        m.rod(
            (x - 0.005, s * 0.045, z + 0.045), (x, s * 0.06, z + 0.12), 0.034, mark, end=0.003, n=4
        )
        m.ball(
            (x + 0.064, s * 0.033, z + 0.018), (0.014, 0.016, 0.018), (120, 190, 70), n=5, rings=3
        )
        for up in (-0.012, 0.008):
            m.beam(
                (x + 0.07, s * 0.035, z - 0.02),
                (x + 0.075, s * 0.12, z - 0.02 + up),
                (0.004, 0.004),
                (250, 250, 250),
            )


def bird(m: Model, d: Draw) -> None:
    """A standing bird: round body, beak, folded or raised wings, tail, two thin legs."""
    coat = d.tint(
        d.turn(
            [
                (120, 128, 140),
                (240, 240, 240),
                (40, 42, 48),
                (200, 60, 50),
                (60, 110, 180),
                (150, 110, 70),
            ]
        )
    )
    wing: Colour = (int(coat[0] * 0.65), int(coat[1] * 0.65), int(coat[2] * 0.68))
    breast = d.turn([(200, 206, 210), (248, 248, 246), (220, 130, 70), (240, 220, 120)])
    beak = d.turn([(240, 160, 30), (60, 56, 50), (220, 60, 40)])
    z = d.between(0.2, 0.26)
    m.tube(
        [(-0.2, 0, z - 0.02), (-0.08, 0, z), (0.06, 0, z + 0.03), (0.13, 0, z + 0.1)],
        [0.03, 0.09, 0.1, 0.06],
        coat,
        n=8,
    )
    m.ball((0.07, 0, z + 0.01), (0.085, 0.08, 0.085), breast, n=8, rings=4)
    hz = z + d.between(0.17, 0.22)
    m.rod((0.1, 0, z + 0.06), (0.15, 0, hz), 0.06, coat, end=0.045)
    m.ball((0.16, 0, hz), (0.07, 0.06, 0.062), coat, n=8, rings=5)
    m.rod(
        (0.21, 0, hz - 0.005),
        (0.21 + d.between(0.07, 0.13), 0, hz - 0.02),
        0.025,
        beak,
        end=0.004,
        n=4,
    )
    eyes(m, (0.19, 0.05, hz + 0.018), 0.014)
    m.plate(
        [(-0.16, 0.03), (-0.16, -0.03), (-0.38, -0.07), (-0.38, 0.07)], (z - 0.05, z - 0.03), wing
    )
    raised = d.style(3) == 1
    for s in (-1, 1):
        if raised:
            m.loft(
                [
                    [
                        (0.08, s * 0.06, z + 0.05),
                        (-0.1, s * 0.06, z + 0.05),
                        (-0.1, s * 0.07, z + 0.08),
                        (0.08, s * 0.07, z + 0.08),
                    ],
                    [
                        (0.04, s * 0.22, z + 0.2),
                        (-0.14, s * 0.22, z + 0.2),
                        (-0.14, s * 0.23, z + 0.22),
                        (0.04, s * 0.23, z + 0.22),
                    ],
                    [
                        (-0.08, s * 0.36, z + 0.25),
                        (-0.14, s * 0.36, z + 0.25),
                        (-0.14, s * 0.37, z + 0.26),
                        (-0.08, s * 0.37, z + 0.26),
                    ],
                ],
                wing,
            )
        else:
            m.tube(
                [
                    (0.1, s * 0.08, z + 0.05),
                    (-0.06, s * 0.09, z + 0.02),
                    (-0.26, s * 0.04, z - 0.05),
                ],
                [0.04, 0.05, 0.01],
                wing,
                n=6,
            )
        m.rod((0.0, s * 0.04, z - 0.06), (0.02, s * 0.045, 0.01), 0.011, beak, n=4)
        for toe in (-0.04, 0, 0.04):
            m.beam((0.02, s * 0.045, 0.008), (0.085, s * 0.045 + toe, 0.008), (0.016, 0.012), beak)
    if d.style(4) == 3:
        for i in range(3):
            m.beam(
                (0.14, 0, hz + 0.05),
                (0.08 - 0.03 * i, 0, hz + 0.15 - 0.02 * i),
                (0.012, 0.03),
                d.pick(((250, 210, 60), wing)),
            )


def kangaroo(m: Model, d: Draw) -> None:
    """A kangaroo upright on long hind feet: heavy tail, small arms, long ears; some with a joey."""
    coat = d.tint(d.turn([(168, 122, 84), (130, 112, 98), (186, 110, 70), (150, 132, 112)]))
    belly = (226, 208, 184)
    lean = d.between(0.16, 0.34)
    hip = (0.0, 0.0, 0.52)
    chest = (lean, 0.0, 1.02)
    m.tube(
        [(-0.12, 0, 0.42), hip, (lean * 0.55, 0, 0.82), chest, (lean + 0.1, 0, 1.18)],
        [0.14, 0.22, 0.17, 0.12, 0.08],
        coat,
        n=8,
    )
    m.tube(
        [(0.1, 0, 0.46), (lean * 0.55 + 0.09, 0, 0.8), (lean + 0.07, 0, 1.0)],
        [0.15, 0.11, 0.07],
        belly,
        n=7,
    )
    m.tube(
        [(-0.1, 0, 0.46), (-0.38, 0, 0.2), (-0.68, 0, 0.06), (-1.0, 0, 0.05)],
        [0.15, 0.1, 0.065, 0.025],
        coat,
        n=7,
    )
    for s in (-1, 1):
        y = s * 0.17
        m.tube([(0.0, y, 0.52), (0.24, y, 0.36), (-0.08, y, 0.1)], [0.15, 0.11, 0.045], coat, n=7)
        m.tube(
            [(-0.12, y, 0.05), (0.1, y, 0.045), (0.4, y, 0.03)],
            [0.05, 0.045, 0.025],
            (70, 54, 44),
            n=5,
        )
        m.tube(
            [
                (lean + 0.05, s * 0.11, 1.04),
                (lean + 0.14, s * 0.14, 0.86),
                (lean + 0.3, s * 0.1, 0.82),
            ],
            [0.045, 0.034, 0.024],
            coat,
            n=5,
        )
        m.ball((lean + 0.31, s * 0.1, 0.81), (0.035, 0.03, 0.03), (60, 46, 38), n=5, rings=3)
    hx, hz = lean + 0.17, 1.27
    m.ball((hx, 0, hz), (0.11, 0.085, 0.095), coat, n=8, rings=5)
    m.tube([(hx + 0.04, 0, hz - 0.01), (hx + 0.2, 0, hz - 0.06)], [0.07, 0.042], coat, n=6)
    m.ball((hx + 0.21, 0, hz - 0.05), (0.025, 0.03, 0.025), (30, 26, 26), n=5, rings=3)
    eyes(m, (hx + 0.07, 0.06, hz + 0.03), 0.02)
    for s in (-1, 1):
        m.tube(
            [
                (hx - 0.04, s * 0.05, hz + 0.07),
                (hx - 0.06, s * 0.09, hz + 0.18),
                (hx - 0.06, s * 0.1, hz + 0.27),
            ],
            [0.03, 0.045, 0.008],
            coat,
            n=5,
        )
    if d.style(3) == 2:  # a joey looks out
        m.ball((0.26, 0, 0.72), (0.07, 0.06, 0.07), coat, n=6, rings=4)
        m.rod((0.3, 0, 0.72), (0.38, 0, 0.7), 0.035, coat, end=0.02, n=5)
        ears(m, (0.24, 0.03, 0.77), (0.0, 0.02, 0.1), 0.02, coat)
