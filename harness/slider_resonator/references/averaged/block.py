"""A block without vibration: dry friction of constant size against a constant load."""

from __future__ import annotations

import math

import numpy as np

from slider_resonator.arrays import Array


def slide_of_block(
    velocity: float, friction: float, load: float, mass: float, times: Array
) -> tuple[Array, Array]:
    """Return how far a block has moved (m) and its velocity (m/s) at ``times``, shape (n,), s.

    ``velocity`` (m/s) is that at time 0; ``friction`` (N) holds a block at rest against a smaller
    ``load`` (N), which pulls backward; ``mass`` is in kg.
    """
    moved, speed = np.zeros_like(times), np.zeros_like(times)
    deceleration = (math.copysign(friction, velocity) + load) / mass if velocity else 0.0
    stops = velocity / deceleration if deceleration * velocity > 0.0 else math.inf
    if not velocity:
        stops = 0.0
    first = np.minimum(times, stops)
    moved += velocity * first - 0.5 * deceleration * first**2
    speed += np.where(times < stops, velocity - deceleration * first, 0.0)
    if abs(load) > friction:
        dragged = -math.copysign(abs(load) - friction, load) / mass
        rest = np.maximum(times - stops, 0.0)
        moved += 0.5 * dragged * rest**2
        speed += dragged * rest
    return moved, speed
