"""What stands beside a map picture: environments with their shares, certainty, landmark classes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symboslam.engine.environment_map import EnvironmentMap

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

INK = "#2b2b2b"
UNKNOWN = "#e4e4e4"
PALEST = 0.28
"""Opacity of a segment whose environments are all equally probable; certain ones have 1."""
DOTS = (
    ("#101010", "o"),
    ("#0d5c2b", "^"),
    ("#0b3d91", "s"),
    ("#8c1515", "D"),
    ("#5b1a8b", "v"),
    ("#8a4b00", "P"),
    ("#006d77", "X"),
    ("#a3135f", "p"),
)
"""Colour and shape of the most frequent classes: dark, to stand out on all environments."""


@dataclass(frozen=True)
class Dots:
    """How some landmarks are drawn.

    Attributes:
        label: words for the legend.
        count: how many there are.
        features: positions of their classes in the knowledge.
        colour: of the dots.
        marker: their shape.
        size: times the size of the others.
    """

    label: str
    count: int
    features: NDArray[np.int32]
    colour: str
    marker: str
    size: float = 1.0


def dot_classes(m: EnvironmentMap) -> list[Dots]:
    """The most frequent classes of landmarks, and the others as one."""
    features, counts = np.unique(m.landmarks.feature, return_counts=True)
    order = np.argsort(-counts, kind="stable")
    features, counts = features[order], counts[order]
    found = [
        Dots(m.knowledge.features[f].label, int(n), np.array([f], np.int32), colour, marker)
        for f, n, (colour, marker) in zip(features, counts, DOTS, strict=False)
    ]
    rest = features[len(DOTS) :]
    if len(rest):
        label = f"{len(rest)} other classes"
        found.append(Dots(label, int(counts[len(DOTS) :].sum()), rest, "#4a4a4a", "o", 0.8))
    return found


def draw_panel(figure: Figure, m: EnvironmentMap) -> None:
    """Draw the legend at the right of the map."""
    axes = figure.add_axes((0.745, 0.065, 0.235, 0.835))
    axes.set_xlim(0, 1)
    axes.set_ylim(1, 0)  # from the top down
    axes.set_axis_off()
    below = _environments(axes, m, 0.012)
    below = _certainty(axes, m, below + 0.03)
    _landmarks(axes, m, below + 0.035)


def _heading(axes: Axes, text: str, y: float) -> float:
    axes.text(0, y, text, size=14, weight="bold", color=INK, va="center")
    return y + 0.038


def _row(axes: Axes, y: float, label: str, value: str, indent: float = 0.12) -> None:
    short = label if len(label) <= 26 else label[:25] + "…"
    shown = short.encode("utf-8", "replace").decode()
    axes.text(indent, y, shown, size=12, color=INK, va="center", parse_math=False)
    axes.text(1, y, value, size=12, color=INK, va="center", ha="right")


def _environments(axes: Axes, m: EnvironmentMap, y: float) -> float:
    """A swatch for each environment, the largest share of the area first."""
    from matplotlib.patches import Rectangle

    y = _heading(axes, "Environment, share of the area", y)
    shares = m.shares() if len(m) else {}
    rows = [(e.label, e.colour, shares.get(e.name, 0.0)) for e in m.environments]
    rows.sort(key=lambda row: -row[2])
    rows.append(("unknown", UNKNOWN, shares.get(None, 0.0)))
    for label, colour, share in rows:
        swatch = Rectangle((0, y - 0.011), 0.085, 0.022, facecolor=colour, edgecolor="#5a5a5a")
        axes.add_patch(swatch)
        _row(axes, y, label, f"{share:.1%}" if 0 < share < 0.995 else f"{share:.0%}")
        y += 0.034
    return y


def _certainty(axes: Axes, m: EnvironmentMap, y: float) -> float:
    """How the fullness of a colour is to be read."""
    y = _heading(axes, "Certainty", y)
    ramp = np.linspace(PALEST, 1.0, 64)[None, :]
    image = np.zeros((1, 64, 4))
    image[..., :3], image[..., 3] = 0.25, ramp
    axes.imshow(image, extent=(0, 1, y + 0.008, y - 0.012), aspect="auto", interpolation="bilinear")
    y += 0.024
    axes.text(0, y, f"P = 1/{len(m.environments)}", size=11, color="#555", va="center")
    axes.text(1, y, "P = 1", size=11, color="#555", va="center", ha="right")
    return y + 0.02


def _landmarks(axes: Axes, m: EnvironmentMap, y: float) -> None:
    """The classes of landmarks with their numbers."""
    y = _heading(axes, "Landmarks", y)
    for dots in dot_classes(m):
        axes.plot([0.042], [y], dots.marker, color=dots.colour, markersize=7, clip_on=False)
        _row(axes, y, dots.label, f"{dots.count:,}")
        y += 0.032
    if not len(m.landmarks):
        axes.text(0, y, "none", size=12, color=INK, va="center")
