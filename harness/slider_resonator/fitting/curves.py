"""The curves on which steady measurements lie, as a picture shows them."""

from collections.abc import Sequence
from dataclasses import replace
from math import nan

import numpy as np

from slider_resonator.device.interface import INTEGERS, VARIABLES
from slider_resonator.device.values import with_unit
from slider_resonator.fitting.measurements import Point

MAX_CURVES = 8
"""Number of settings of a second variable up to which each has a colour."""
POINTS = 200
"""Points between those measured of a quantity: predictions take 30 ms, 300 ms with bristles."""


def set_value(point: Point, name: str) -> float:
    """Return what a variable was set to, in SI units."""
    return point.values.get(name, VARIABLES[name].start or 0.0)


def abscissa_and_curves(points: Sequence[Point]) -> tuple[str, dict[str, list[int]]]:
    """Return the variable with most values among the points, "" if none varies, and the curves.

    Points with the same values of all that varies beside it are a curve: their indices, by a name
    that has these values. It is empty for a single curve, and where all points of too many are one.
    """
    names = dict.fromkeys(name for point in points for name in point.values)
    counts = {name: len({set_value(point, name) for point in points}) for name in names}
    first, *others = sorted((n for n in names if counts[n] > 1), key=lambda n: -counts[n]) or [""]
    curves: dict[str, list[int]] = {}
    for i, point in enumerate(points):
        name = ", ".join(f"{other} {with_unit(other, set_value(point, other))}" for other in others)
        curves.setdefault(name, []).append(i)
    return first, curves if len(curves) <= MAX_CURVES else {"": list(range(len(points)))}


def points_between(points: Sequence[Point]) -> list[Point]:
    """Return points along the curves of each quantity, from the first to the last measured one.

    There are none where the abscissa is an integer, or the curves are too many.
    """
    found = []
    for quantity in dict.fromkeys(point.quantity for point in points):
        own = [point for point in points if point.quantity == quantity]
        first, curves = abscissa_and_curves(own)
        for indices in curves.values():
            at = [set_value(own[i], first) for i in indices] if first else []
            others = [{**own[i].values, first: nan} for i in indices]
            if first in INTEGERS or len({*at}) < 2 or any(one != others[0] for one in others):
                continue
            found += [
                replace(own[indices[0]], values={**others[0], first: value})
                for value in np.linspace(min(at), max(at), POINTS // len(curves)).tolist()
            ]
    return found
