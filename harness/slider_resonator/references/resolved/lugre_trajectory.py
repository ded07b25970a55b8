"""The sampled motion of a slider on bristles, as the LuGre references return it."""

from __future__ import annotations

from dataclasses import dataclass

from slider_resonator.arrays import Array
from slider_resonator.references.resolved.trajectory import Trajectory


@dataclass(frozen=True)
class LugreTrajectory(Trajectory):
    """A ``Trajectory`` with ``bristle_deflection``, z of (8) in m, shape (n,).

    Bristles never stick: ``contact_mode`` is the sign of the velocity (2 while lifted), ``sticks``
    and ``stick_time`` are 0. ``reversals`` counts every change of sign of the velocity, those in
    flight too.
    """

    bristle_deflection: Array
