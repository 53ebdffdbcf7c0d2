"""Still: things of classes that move, but that stand where they stood: their tracks are one.

A parked car is seen on every visit. Such tracks are nothing to go by and take no part in the joint
graph; afterwards those of one class at one place are put together, so that one car counts once.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from scipy.spatial import cKDTree

from symboslam.engine.slam.association import FITS
from symboslam.engine.slam.joint import JointGraph, Piece
from symboslam.engine.slam.scale import together


def put_together(graph: JointGraph, pieces: Sequence[Piece], first: int, sigma: float) -> None:
    """Label tracks so that those that are of one thing have one label; give labels a place.

    Two are one if they are of one class, were not seen beside each other, and lie within three
    standard deviations. A person where another one stood counts as the same.

    Args:
        graph: solved; is told where the labels are.
        pieces: tracks of things that move.
        first: labels from here on are free.
        sigma: metres by which a place may be off, beside what the sightings say.
    """
    if not pieces:
        return
    found = [piece.where(graph.members[piece.member].poses) for piece in pieces]
    xy = np.array([where for where, _ in found])
    variance = np.array([variance for _, variance in found])
    feature = [int(piece.track.evidence.argmax()) for piece in pieces]
    reach = math.sqrt(FITS * (2 * variance.max() + sigma**2))
    near = cKDTree(xy).query_ball_point(xy, reach, return_sorted=True)
    of: dict[int, int] = {}
    for head in sorted(range(len(pieces)), key=lambda n: (-len(pieces[n].track.sightings), n)):
        if head in of:
            continue
        of[head] = first
        times = set(pieces[head].times)
        square = ((xy[near[head]] - xy[head]) ** 2).sum(1)
        for n, away in zip(near[head], square.tolist(), strict=True):
            if n in of or feature[n] != feature[head]:
                continue
            fits = away <= FITS * (variance[n] + variance[head] + sigma**2)
            if fits and not together(times, pieces[n].times):
                of[n] = first
                times |= pieces[n].times
        graph.xy[first] = xy[head]
        first += 1
    for n, piece in enumerate(pieces):
        piece.label = of[n]
