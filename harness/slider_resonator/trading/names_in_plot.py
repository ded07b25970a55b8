"""Names of curves in a plot, put where nothing else is drawn."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise, product

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.transforms import Bbox

from slider_resonator.arrays import Array

OFFSETS = ((0, 7), (0, -15), (8, -4), (0, 17), (0, -25), (8, 10), (8, -18), (0, 27), (0, -35))
"""Offsets [pt] of a name from a point of its curve, the best first."""
CLEARANCE = 2.0
"""Distance [px] that names keep from each other and from what is drawn."""


@dataclass(frozen=True)
class Name:
    """A name for a curve: it stands near one of the points (data coordinates), the best first."""

    text: str
    colour: str
    points: Sequence[tuple[float, float]]


def place_names(axes: Axes, names: Sequence[Name], fontsize: float) -> None:
    """Add names to a plot whose layout is final, each where it covers least."""
    drawn = _drawn_places(axes)
    for name in names:
        best = (np.inf, name.points[0], OFFSETS[0])
        text = axes.annotate(name.text, *best[1:], textcoords="offset points", fontsize=fontsize)
        text.set_color(name.colour)
        for point, offset in product(name.points, OFFSETS):
            text.xy, text.xyann = point, offset
            box = text.get_window_extent().padded(CLEARANCE)
            outside = 4 - axes.bbox.count_contains(box.corners())
            covered = box.count_contains(drawn) + outside * len(drawn)
            if covered < best[0]:
                best = (covered, point, offset)
        _, text.xy, text.xyann = best
        drawn = np.vstack([drawn, _filled(text.get_window_extent())])


def _drawn_places(axes: Axes) -> Array:
    """Return places [px] all over the lines, bars and markers of a plot, shape (n, 2)."""
    places = [np.empty((0, 2))]
    for line in axes.lines:
        path = line.get_transform().transform(line.get_xydata())
        places += [_along(*ends) for ends in pairwise(path)]
        if line.get_marker() not in ("None", None, ""):
            reach = 0.5 * line.get_markersize() * axes.figure.dpi / 72.0
            places += [_filled(Bbox([at - reach, at + reach])) for at in path]
    for bars in axes.collections:
        if isinstance(bars, LineCollection):
            places += [
                _along(*bars.get_transform().transform(ends)) for ends in bars.get_segments()
            ]
    return np.vstack(places)


def _along(begin: Array, end: Array) -> Array:
    """Return places from one to the other, CLEARANCE apart at most, shape (n, 2)."""
    return np.linspace(begin, end, 2 + int(np.hypot(*(end - begin)) / CLEARANCE))


def _filled(box: Bbox) -> Array:
    """Return places all over a box, shape (n, 2)."""
    left, bottom, right, top = box.extents
    columns = _along(np.array([left, bottom]), np.array([right, bottom]))
    return np.vstack([_along(foot, np.array([foot[0], top])) for foot in columns])
