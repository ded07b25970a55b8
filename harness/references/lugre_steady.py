"""Steady motion on bristles by shooting: the fixed point of the referee's map over a drive period.

The state of the map is that of the slider and its bristles, and in fidelity 2 of the resonator.
Only integer frequency ratios repeat with the drive.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import root

from harness.references.closed_forms import equivalent_force
from harness.references.device import Device
from harness.references.held_inputs import HeldInputs
from harness.references.lugre_taylor import simulate_lugre

Array = NDArray[np.float64]

_WARM_UP = 30
_CLOSED = 1e-9
"""A motion repeats when what changes over a period is below this share of its sizes."""


def steady_velocity(
    device: Device, phase: float, load: float = 0.0, ratio: int = 1, guess: float = 0.0
) -> float:
    """Return the mean velocity in m/s of the steady motion that a search from ``guess`` ends at.

    ``phase`` in rad, ``load`` in N. Raises ValueError as `equivalent_force` and `simulate_lugre`
    do, RuntimeError where no steady motion is found.
    """
    shot = _Shot(device, phase, ratio)

    def change(unknowns: Array) -> Array:
        end, _ = shot.period(unknowns, load)
        return end - unknowns

    found = _solve(change, shot.warm_up(guess, load), f"load = {load!r} N")
    return shot.period(found, load)[1] * shot.fast_velocity


def blocking_force(device: Device, phase: float, ratio: int = 1, guess: float = 0.0) -> float:
    """Return the load in N under which the mean velocity of the steady motion is zero.

    ``phase`` in rad, ``guess`` in N. Raises as `steady_velocity` does.
    """
    shot = _Shot(device, phase, ratio)
    scale = device.friction_faces * device.friction_coefficient * device.normal_preload

    def change(unknowns: Array) -> Array:
        end, moved = shot.period(unknowns[:-1], float(unknowns[-1]) * scale)
        return np.append(end - unknowns[:-1], moved)

    start = np.append(shot.warm_up(0.0, guess), guess / scale)
    return float(_solve(change, start, "a load that stops the motion")[-1]) * scale


@dataclass(frozen=True)
class _Shot:
    """The map of a device over a drive period, in units of the fast motion and greatest bend."""

    device: Device
    phase: float
    ratio: int

    @property
    def fast_velocity(self) -> float:
        return equivalent_force(self.device).velocity_amplitude

    @property
    def scales(self) -> Array:
        """Sizes of velocity, bristle deflection and, in fidelity 2, resonator motion; SI units."""
        force = equivalent_force(self.device)
        bend = self.device.friction_coefficient / self.device.bristle_stiffness
        resonator = abs(force.resonator_amplitude) + force.ripple_amplitude
        sizes = [force.velocity_amplitude, bend, resonator, resonator * self.device.drive_frequency]
        return np.array(sizes[: 2 if self.device.fidelity == 1 else 4])

    def period(self, start: Array, load: float, count: int = 1) -> tuple[Array, float]:
        """Return the state after drive periods, and the mean velocity over the fast velocity."""
        velocity, bend, *resonator = (start * self.scales).tolist()
        displacement, rate = resonator or (0.0, 0.0)
        device = replace(
            self.device,
            initial_position=0.0,
            initial_velocity=velocity,
            initial_bristle_deflection=bend,
            initial_resonator_displacement=displacement,
            initial_resonator_velocity=rate,
        )
        duration = count * 2.0 * math.pi / device.drive_frequency
        inputs = HeldInputs(0.0, duration, self.phase, load, float(self.ratio))
        end = simulate_lugre(device, [inputs], np.array([duration]))
        state = np.array(
            [
                end.velocity[0],
                end.bristle_deflection[0],
                end.resonator_displacement[0],
                end.resonator_velocity[0],
            ]
        )
        mean = float(end.position[0]) / duration / self.fast_velocity
        return state[: len(start)] / self.scales, mean

    def warm_up(self, velocity: float, load: float) -> Array:
        """Return the state after some periods from the steady fast motion at a slow velocity."""
        force = equivalent_force(self.device)
        state = np.zeros(len(self.scales))
        state[0] = velocity - force.velocity_amplitude * math.cos(force.angle)
        state[2:] = np.array(
            [
                -force.resonator_amplitude * math.sin(force.resonator_angle),
                force.resonator_amplitude
                * self.device.drive_frequency
                * math.cos(force.resonator_angle),
            ]
        )[: len(state) - 2]
        return self.period(state / self.scales, load, _WARM_UP)[0]


def _solve(change: Callable[[Array], Array], start: Array, what: str) -> Array:
    found = root(change, start, tol=1e-13, options={"eps": 1e-7})
    left = float(np.abs(found.fun).max())
    if not left <= _CLOSED:
        raise RuntimeError(
            f"no steady motion found for {what}: {left:.1e} of it changes over a period, "
            f"allowed is {_CLOSED:.0e}"
        )
    return np.asarray(found.x)
