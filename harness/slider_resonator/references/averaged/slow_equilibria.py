"""Equilibria of the slow motion: velocities at which averaged friction balances a load."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import scipy

_SAMPLES = 65


def stable_velocity(friction: Callable[[float], float], strength: float, load: float) -> float:
    """Return the slow velocity within +-``strength`` that balances a load and is stable.

    ``friction`` is the averaged friction at a slow velocity, constant from +-strength on, ``load``
    in its unit. LuGre friction is not monotonic, so that a load above that of full sliding may be
    balanced, and at more than one velocity: the one farthest in the direction in which the slider
    leaves rest without load is returned. Raises ValueError if there is none.
    """
    turns = np.linspace(0.0, math.pi, _SAMPLES)

    def excess(turn: float) -> float:
        return friction(strength * math.cos(turn)) + load

    values = [excess(float(turn)) for turn in turns]
    found: list[float] = []
    for left, right, above, below in zip(turns, turns[1:], values, values[1:], strict=False):
        if above > 0.0 >= below:  # friction grows with velocity: a departure decays
            root = scipy.optimize.brentq(excess, left, right, xtol=1e-14, rtol=1e-13)
            found.append(strength * math.cos(root))
    if not found:
        raise ValueError(
            f"load = {load!r} is balanced at no velocity: friction lies between "
            f"{min(values) - load!r} and {max(values) - load!r}, a greater load runs away"
        )
    return max(found) if friction(0.0) <= 0.0 else min(found)
