"""The sampled motion that every reference integrator returns, of either friction law."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from slider_resonator.arrays import Array


@dataclass(frozen=True)
class Trajectory:
    """Signals at ``time`` (arrays of shape (n,), SI units), event record and cost of a run.

    ``contact_mode`` is -1 slip backward, 0 stick, 1 slip forward, 2 lifted. ``friction_force`` is F
    as it acts in M X'' = -F - load + ... (in stick the force that holds the slider).
    ``reversals`` counts slips that start opposite to the slip before them, whether directly, after
    a stick or after a flight. ``event_times`` are the instants of every change of contact mode, s,
    and ``modes`` the contact modes at the first instant and from each of them on: one more.
    ``reversal_times`` (s) are those of the reversals, NaN where they are not located.

    ``bristle_deflection`` is z of (8) in m, 0 with Coulomb friction. Bristles never stick: with
    them ``contact_mode`` is the sign of the velocity (2 while lifted), and ``reversals`` counts
    every change of sign of the velocity, those in flight too.
    """

    time: Array
    position: Array
    velocity: Array
    resonator_displacement: Array
    resonator_velocity: Array
    normal_force: Array
    friction_force: Array
    bristle_deflection: Array
    contact_mode: NDArray[np.int64]
    reversals: int
    event_times: Array
    reversal_times: Array
    modes: NDArray[np.int64]
    steps: int
    evaluations: int
