"""The sampled motion that every reference integrator returns."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Trajectory:
    """Signals at ``time`` (arrays of shape (n,), SI units), event record and cost of a run.

    ``contact_mode`` is -1 slip backward, 0 stick, 1 slip forward, 2 lifted. ``friction_force`` is F
    as it acts in M X'' = -F - load + ... (in stick the force that holds the slider).
    ``reversals`` counts slips that start opposite to the slip before them, whether directly, after
    a stick or after a flight; ``sticks`` counts stick phases that begin after the first instant.
    ``event_times`` are the instants of every change of contact mode, s; ``stick_time`` is in s.
    """

    time: NDArray[np.float64]
    position: NDArray[np.float64]
    velocity: NDArray[np.float64]
    resonator_displacement: NDArray[np.float64]
    resonator_velocity: NDArray[np.float64]
    normal_force: NDArray[np.float64]
    friction_force: NDArray[np.float64]
    contact_mode: NDArray[np.int64]
    reversals: int
    sticks: int
    stick_time: float
    event_times: NDArray[np.float64]
    steps: int
    evaluations: int
