"""The dimensional equations of motion with LuGre friction (8) on every face."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.references.resolved.equations import Equations, equations_of


@dataclass(frozen=True)
class LugreEquations:
    """The equations apart from friction, and the bristle in units of its largest deflection.

    With the stretch ``w = s0 z / mu``, 1 in steady sliding, v the velocity, s its sign and N the
    normal force::

        w' = path_rate (v - |v| w)
        F = faces mu N (w + path_damping |v| (s - w))
    """

    equations: Equations
    path_rate: float
    path_damping: float

    @property
    def max_deflection(self) -> float:
        """Deflection in m of the bristle in steady sliding, mu / s0."""
        return 1.0 / self.path_rate

    def friction_force(self, velocity: Array, stretch: Array, angle: Array) -> Array:
        """Return the friction force in N at velocities (m/s), stretches and angles of N (rad)."""
        force: Array = np.maximum(0.0, self.equations.friction_limit(angle)) * (
            stretch + self.path_damping * (velocity - np.abs(velocity) * stretch)
        )
        return force


def lugre_equations_of(device: Device) -> LugreEquations:
    """Return the equations of motion of a device with LuGre friction, whatever its friction_law.

    Raises ValueError for a friction_coefficient or bristle_stiffness that is not above 0 and
    finite, a bristle_damping below 0, and what ``equations_of`` does not cover.
    """
    for name in ("friction_coefficient", "bristle_stiffness"):
        value = getattr(device, name)
        if not 0.0 < value < math.inf:
            raise ValueError(f"{name} = {value!r} must be greater than 0 for LuGre friction")
    if not 0.0 <= device.bristle_damping < math.inf:
        raise ValueError(f"bristle_damping = {device.bristle_damping!r} s/m must be at least 0")
    return LugreEquations(
        equations=equations_of(replace(device, friction_law=0)),
        path_rate=device.bristle_stiffness / device.friction_coefficient,
        path_damping=device.bristle_damping / device.friction_coefficient,
    )
