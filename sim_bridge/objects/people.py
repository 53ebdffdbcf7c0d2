"""People: grown-ups, boys and girls."""

from __future__ import annotations

from symboslam.sim_bridge.objects.draw import Draw
from symboslam.sim_bridge.objects.parts import Colour, Model

SKINS: tuple[Colour, ...] = (
    (236, 190, 160),
    (150, 100, 70),
    (214, 164, 124),
    (100, 66, 48),
    (244, 206, 180),
)
HAIRS: tuple[Colour, ...] = (
    (60, 40, 28),
    (24, 22, 22),
    (180, 140, 70),
    (120, 70, 40),
    (150, 150, 150),
)
SHIRTS: tuple[Colour, ...] = (
    (200, 50, 50),
    (50, 90, 170),
    (240, 240, 236),
    (60, 130, 80),
    (240, 180, 50),
    (90, 60, 120),
    (60, 64, 72),
)
TROUSERS: tuple[Colour, ...] = ((44, 56, 90), (60, 60, 64), (150, 126, 90), (30, 32, 36))


def _limbs(
    m: Model,
    d: Draw,
    *,
    hip: float,
    shoulder: float,
    wide: float,
    thick: float,
    sleeve: Colour,
    skin: Colour,
    short: bool,
    leg: Colour,
    sock: float,
) -> None:
    """Arms and legs in a pace; ``sock`` is how far down the legs are clothed, from the hip."""
    pace = d.between(-0.2, 0.2) * hip
    for s in (-1, 1):
        y = s * wide * 0.42
        foot = (s * pace, y, 0.06)
        knee = (foot[0] * (1 - sock), y, hip + (0.06 - hip) * sock)
        m.tube([(0, y, hip), knee], [thick * 1.15, thick * 0.9], leg)
        if sock < 1:
            m.rod(knee, foot, thick * 0.66, skin, end=thick * 0.55)
        m.box((foot[0] + thick * 0.5, y, 0), (thick * 3.0, thick * 1.5, 0.09), (40, 36, 36))
        reach = shoulder - hip
        swing = -s * pace * 0.8
        elbow = (swing * 0.4, s * (wide + thick * 0.9), shoulder - reach * 0.52)
        hand = (swing + thick * 0.6, s * (wide + thick * 0.8), shoulder - reach * 1.02)
        m.rod((0, s * wide, shoulder), elbow, thick * 0.85, sleeve, end=thick * 0.75)
        m.rod(elbow, hand, thick * 0.62, skin if short else sleeve, end=thick * 0.5)
        m.ball(hand, (thick * 0.7, thick * 0.6, thick * 0.8), skin, n=5, rings=3)


def _head(m: Model, z: float, r: float, skin: Colour) -> None:
    """A head on a neck with eyes and a nose; ``z`` is its middle."""
    m.rod((0, 0, z - r * 1.7), (0, 0, z - r * 0.5), r * 0.5, skin)
    m.ball((0, 0, z), (r, r * 0.86, r * 1.12), skin, n=8, rings=6)
    for s in (-1, 1):
        m.box((r * 0.86, s * r * 0.34, z + r * 0.08), (r * 0.12, r * 0.16, r * 0.16), (30, 30, 34))
    m.box((r * 1.0, 0, z - r * 0.22), (r * 0.25, r * 0.2, r * 0.25), skin)


def _hair(m: Model, z: float, r: float, colour: Colour) -> None:
    m.ball((-r * 0.2, 0, z + r * 0.34), (r * 0.98, r * 0.98, r * 0.95), colour, n=8, rings=4)


def person(m: Model, d: Draw) -> None:
    """A grown-up in trousers and a shirt or jacket, with a hat, a bag or a safety vest."""
    skin, hair = d.turn(SKINS), d.turn(HAIRS)
    top, leg = d.tint(d.turn(SHIRTS)), d.tint(d.turn(TROUSERS))
    hip, shoulder, wide = d.between(0.84, 0.92), d.between(1.38, 1.44), d.between(0.19, 0.23)
    style = d.style(4)
    if style == 2:
        top = d.turn([(250, 130, 30), (210, 230, 50)], 4)
    _limbs(
        m,
        d,
        hip=hip,
        shoulder=shoulder - 0.04,
        wide=wide,
        thick=0.08,
        sleeve=top,
        skin=skin,
        short=style == 1,
        leg=leg,
        sock=0.97,
    )
    m.box((0, 0, hip - 0.05), (0.2, wide * 1.75, 0.12), leg)
    m.box((0, 0, hip + 0.04), (0.2, wide * 1.5, shoulder - hip), top, top=(1.05, 1.35))
    if style == 2:  # safety vest
        for z in (hip + 0.18, shoulder - 0.2):
            for side, x in (("+x", 0.105), ("-x", -0.105)):
                m.panel(side, (x, 0, z), (wide * 1.6, 0.06), (240, 240, 236))
    elif style == 0:  # open jacket
        m.panel("+x", (0.105, 0, shoulder - 0.2), (0.1, 0.4), (240, 240, 236))
    if style == 3:
        m.box((-0.17, 0, hip + 0.1), (0.16, 0.3, 0.42), d.tint((70, 90, 60)))
    z = shoulder + 0.23
    _head(m, z, 0.11, skin)
    hat = d.style(3)
    if hat == 1 or style == 2:
        colour = (250, 210, 40) if style == 2 else d.tint((60, 60, 66))
        m.lathe(
            (0, 0, z + 0.05),
            [(0.16, 0), (0.16, 0.015), (0.115, 0.02), (0.09, 0.11), (0.02, 0.13)],
            colour,
        )
    else:
        _hair(m, z, 0.11, hair)
        if hat == 2:
            m.box((-0.08, 0, z - 0.2), (0.1, 0.2, 0.3), hair)


def boy(m: Model, d: Draw) -> None:
    """A boy in shorts and a T-shirt, with a cap or short hair; some with a ball or a satchel."""
    skin, hair = d.turn(SKINS), d.turn(HAIRS[:4])
    top = d.tint(
        d.turn([(50, 110, 200), (230, 60, 50), (70, 160, 80), (240, 190, 50), (240, 240, 236)])
    )
    shorts = d.tint(d.turn([(50, 60, 90), (120, 100, 70), (40, 42, 46), (60, 110, 80)]))
    hip, shoulder, wide = d.between(0.52, 0.6), d.between(0.92, 0.98), d.between(0.15, 0.17)
    _limbs(
        m,
        d,
        hip=hip,
        shoulder=shoulder - 0.03,
        wide=wide,
        thick=0.06,
        sleeve=top,
        skin=skin,
        short=True,
        leg=shorts,
        sock=d.between(0.45, 0.6),
    )
    m.box((0, 0, hip - 0.05), (0.17, wide * 1.9, 0.12), shorts)
    m.box((0, 0, hip + 0.05), (0.16, wide * 1.7, shoulder - hip - 0.03), top, top=(1.0, 1.2))
    if d.style(2):  # stripes
        for z in (0.35, 0.65):
            for side, x in (("+x", 0.08), ("-x", -0.08)):
                m.panel(
                    side, (x, 0, hip + z * (shoulder - hip)), (wide * 1.75, 0.05), (245, 245, 240)
                )
    z = shoulder + 0.2
    _head(m, z, 0.115, skin)
    if d.style(3) != 2:
        cap = d.turn([(220, 50, 40), (40, 80, 170), (50, 120, 70)])
        m.lathe((-0.01, 0, z + 0.035), [(0.12, 0), (0.11, 0.06), (0.05, 0.11)], cap)
        m.box((0.15, 0, z + 0.035), (0.14, 0.16, 0.02), cap)
    else:
        _hair(m, z, 0.115, hair)
    if d.style(3, 2) == 1:
        m.ball((0.28, 0.16, 0.11), (0.11, 0.11, 0.11), (240, 120, 40), n=8, rings=6)
    elif d.style(3, 2) == 2:
        m.box((-0.14, 0, hip + 0.08), (0.12, 0.24, 0.3), (200, 90, 40))


def girl(m: Model, d: Draw) -> None:
    """A girl in a dress or a skirt, with long hair, plaits or a pony tail and a bow."""
    skin, hair = d.turn(SKINS), d.turn(HAIRS[:4])
    dress = d.tint(
        d.turn([(230, 90, 140), (160, 80, 190), (250, 200, 70), (220, 60, 60), (90, 180, 200)])
    )
    bow = d.turn([(250, 80, 120), (250, 220, 80), (245, 245, 245)])
    hip, shoulder, wide = d.between(0.52, 0.58), d.between(0.9, 0.96), 0.14
    _limbs(
        m,
        d,
        hip=hip,
        shoulder=shoulder - 0.03,
        wide=wide,
        thick=0.05,
        sleeve=dress,
        skin=skin,
        short=True,
        leg=skin,
        sock=0.5,
    )
    hem = d.between(0.28, 0.4)
    skirt = dress if d.style(2) == 0 else d.tint((60, 70, 130))
    m.lathe((0, 0, hem), [(d.between(0.24, 0.3), 0), (0.115, hip + 0.14 - hem)], skirt, n=9)
    m.box((0, 0, hip + 0.1), (0.15, wide * 1.5, shoulder - hip - 0.08), dress, top=(1.0, 1.25))
    z = shoulder + 0.2
    _head(m, z, 0.115, skin)
    _hair(m, z + 0.01, 0.12, hair)
    style = d.style(3)
    if style == 0:  # long
        m.tube(
            [(-0.07, 0, z + 0.06), (-0.12, 0, z - 0.12), (-0.13, 0, z - 0.34)],
            [0.11, 0.13, 0.09],
            hair,
        )
    elif style == 1:  # plaits
        for s in (-1, 1):
            m.tube(
                [(-0.02, s * 0.1, z), (0.0, s * 0.17, z - 0.1), (0.02, s * 0.18, z - 0.34)],
                [0.04, 0.045, 0.025],
                hair,
            )
            m.ball((0.02, s * 0.18, z - 0.28), (0.045, 0.045, 0.03), bow, n=5, rings=3)
    else:  # pony tail
        m.tube(
            [(-0.1, 0, z + 0.12), (-0.24, 0, z + 0.06), (-0.25, 0, z - 0.26)],
            [0.04, 0.065, 0.02],
            hair,
        )
        m.ball((-0.14, 0, z + 0.12), (0.03, 0.06, 0.05), bow, n=5, rings=3)
    if style != 2:
        for s in (-1, 1):
            m.ball((0.0, s * 0.06, z + 0.16), (0.03, 0.06, 0.045), bow, n=5, rings=3)
