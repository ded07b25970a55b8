"""Steady velocity and blocking force of the located-events reference, by the same shooting."""

from __future__ import annotations

from dataclasses import replace
from math import ceil, pi

import numpy as np

from harness.bracketing import bracketed_state
from harness.common_period import common_period
from harness.newton import Vector
from harness.references.device import Device
from harness.references.held_inputs import HeldInputs
from harness.references.located_events import advance, simulate
from harness.shooting import FixedPoint, NoFixedPoint, blocking_point, fixed_point

WARM_UP = 20
SAMPLES = 16
TOLERANCE = 1e-9
"""Wanted accuracy in units of the scale: the integrator's own 1e-12 per period, amplified by the
thousand periods that the slow velocity remembers."""


def reference_steady_velocity(
    device: Device, phase: float, load: float, ratio: float, guess: float = 0.0
) -> float | None:
    """Return the mean velocity (m/s) of the steady motion, None where none is found.

    `phase` in rad, `load` in N; `guess` (m/s) is where the search begins.
    """
    shot = _Shot(device, phase, ratio)
    if shot.count is None:
        return None
    state, scale, mean = shot.warm_up(guess, load)
    state[0] += guess - mean

    def loaded(start: Vector) -> tuple[Vector, float]:
        return shot.period_map(start, load)

    found = fixed_point(loaded, state, scale, load=load, tolerance=TOLERANCE)
    if isinstance(found, NoFixedPoint):
        between = bracketed_state(loaded, state, scale)
        if between is not None:
            found = fixed_point(loaded, between, scale, load=load, tolerance=TOLERANCE)
    return found.displacement / shot.period if isinstance(found, FixedPoint) else None


def reference_blocking_force(
    device: Device, phase: float, ratio: float, guess: float = 0.0
) -> float | None:
    """Return the load (N) that makes the mean velocity zero, None where none is found."""
    shot = _Shot(device, phase, ratio)
    if shot.count is None:
        return None
    state, scale, mean = shot.warm_up(0.0, guess)
    state[0] -= mean
    # Without preload the load varies alone and friction is of the order of its amplitude.
    normal = device.normal_preload + device.normal_amplitude
    friction = device.friction_faces * device.friction_coefficient * normal
    found = blocking_point(
        shot.period_map,
        state,
        guess,
        scale,
        load_scale=friction,
        displacement_scale=float(scale[0]) * shot.period,
        tolerance=TOLERANCE,
    )
    return found.load if isinstance(found, FixedPoint) else None


class _Shot:
    """The period map of the reference; `count` drive periods are one common period.

    The state is (velocity, resonator displacement, resonator velocity); at fidelity 1, where the
    resonator's force is given, only the velocity.
    """

    def __init__(self, device: Device, phase: float, ratio: float) -> None:
        self.device = device
        self.phase = phase
        self.ratio = ratio
        self.drive_period = 2.0 * pi / device.drive_frequency
        self.count = common_period(ratio)
        self.period = (self.count or 0) * self.drive_period

    def period_map(self, state: Vector, load: float) -> tuple[Vector, float]:
        inputs = HeldInputs(0.0, self.period, self.phase, load, self.ratio)
        full = np.zeros(3)
        full[: len(state)] = state
        end, displacement = advance(self.device, inputs, (full[0], full[1], full[2]))
        return np.array(end[: len(state)]), displacement

    def warm_up(self, velocity: float, load: float) -> tuple[Vector, Vector, float]:
        """Return state, typical sizes, and mean velocity at the end of some periods from rest."""
        count = ceil(WARM_UP / (self.count or 1)) * (self.count or 1)
        stop = count * self.drive_period
        device = replace(
            self.device,
            initial_position=0.0,
            initial_velocity=velocity,
            initial_resonator_displacement=0.0,
            initial_resonator_velocity=0.0,
        )
        times = np.linspace((count - 1) * self.drive_period, stop, SAMPLES + 1)
        inputs = HeldInputs(0.0, stop, self.phase, load, self.ratio)
        run = simulate(device, [inputs], times)
        states = np.column_stack([run.velocity, run.resonator_displacement, run.resonator_velocity])
        sizes = np.abs(states).max(axis=0)
        floor = 1e-6 * max(float(sizes[2]), float(sizes[0]), 1e-3)
        scale = np.maximum(sizes, [floor, floor * self.drive_period, floor])
        mean = (run.position[-1] - run.position[0]) / self.drive_period
        size = 1 if self.device.fidelity == 1 else 3
        return states[-1, :size], scale[:size], float(mean)
