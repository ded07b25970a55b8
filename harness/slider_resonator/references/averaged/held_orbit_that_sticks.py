"""Held orbits of every kind, sticking and flight included, from the resolved motion by shooting.

The state repeats after a period of the orbit, and the displacement in a period is V times the
period: four equations for the velocity of the slider, the resonator's two states and the load. The
resolved motion is that of `located_events`, or any other with the same arguments.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.averaged.held_orbit import (
    HeldOrbit,
    NoSlidingOrbitError,
    held_orbit,
)
from slider_resonator.references.averaged.hold import Hold
from slider_resonator.references.resolved import located_events
from slider_resonator.references.resolved.contact import STICK
from slider_resonator.references.resolved.trajectory import Trajectory

Simulate = Callable[[Device, Sequence[HeldInputs], Array], Trajectory]

_STEP = 1e-6
"""Step of the differences of the period map, over the scale of a state."""

_CONVERGED = 1e-12
_MAX_ITERATIONS = 40


def any_held_orbit(
    hold: Hold, neighbour: HeldOrbit | None = None, simulate: Simulate = located_events.simulate
) -> HeldOrbit:
    """Return the orbit of a hold, by iteration where the slider slides, else by shooting.

    Raises RuntimeError where neither finds it; under LuGre friction there is no shooting.
    """
    try:
        return held_orbit(hold, neighbour)
    except NoSlidingOrbitError:
        if hold.device.friction_law:
            return held_orbit(hold)
        guess = -neighbour.mean_friction if neighbour else 0.0
        return held_orbit_by_shooting(hold, guess, simulate)


def held_orbit_by_shooting(
    hold: Hold, load: float, simulate: Simulate = located_events.simulate
) -> HeldOrbit:
    """Return the orbit of a hold under Coulomb friction, from a first guess of its load in N.

    Newton's method with finite differences, damped where a whole step does not contract. Raises
    RuntimeError when it does not converge.
    """
    device = hold.device
    force = hold.vibration
    speed, reach = force.velocity_amplitude, force.velocity_amplitude / device.drive_frequency
    full = device.friction_faces * device.friction_coefficient * device.normal_preload
    scales = np.array([speed, reach, speed, full])
    displacement, swing = hold.forced_resonator(np.zeros(1))
    start = hold.velocity + hold.forced_velocity(np.zeros(1))
    unknowns = np.concatenate([start, displacement, swing, [load]]) / scales

    def imbalance(values: Array) -> Array:
        ends = _run(hold, values * scales, np.array([hold.period]), simulate)
        period = hold.period / device.drive_frequency
        way = ends.position[0] / period - hold.velocity
        state = np.array([ends.velocity[0], *_resonator(ends)[:, 0]])
        return np.append(state / scales[:3] - values[:3], way / speed)

    left = imbalance(unknowns)
    for iteration in range(1, _MAX_ITERATIONS + 1):
        slopes = np.column_stack(
            [(imbalance(unknowns + step) - left) / _STEP for step in _STEP * np.eye(4)]
        )
        step = -np.linalg.lstsq(slopes, left, rcond=1e-12)[0]
        share = 1.0
        while True:
            trial = unknowns + share * step
            after = imbalance(trial)
            if np.abs(after).max() < np.abs(left).max() or share < 1e-3:
                break
            share *= 0.5
        stalled = np.abs(after).max() >= np.abs(left).max()
        if not stalled:
            unknowns, left = trial, after
        if np.abs(left).max() <= _CONVERGED or (stalled and np.abs(left).max() <= 1e-9):
            return _orbit(hold, unknowns * scales, simulate, iteration)
        if stalled:
            break
    raise RuntimeError(
        f"the orbit at {hold.velocity!r} m/s with lead {hold.lead!r} rad is missed by "
        f"{float(np.abs(left).max())!r} of v_q"
    )


def _run(hold: Hold, values: Array, angles: Array, simulate: Simulate) -> Trajectory:
    velocity, displacement, swing, load = values.tolist()
    device = replace(
        hold.device,
        fidelity=2,
        initial_position=0.0,
        initial_velocity=velocity,
        initial_resonator_displacement=displacement,
        initial_resonator_velocity=swing,
    )
    stop = hold.period / device.drive_frequency
    inputs = HeldInputs(0.0, stop, hold.lead, load, hold.ratio)
    return simulate(device, [inputs], np.minimum(angles / device.drive_frequency, stop))


def _resonator(motion: Trajectory) -> Array:
    return np.stack([motion.resonator_displacement, motion.resonator_velocity])


def _orbit(hold: Hold, values: Array, simulate: Simulate, iteration: int) -> HeldOrbit:
    ends = _run(hold, values, np.empty(0), simulate)
    breaks = ends.event_times * hold.device.drive_frequency
    panels = hold.panels(breaks[breaks < hold.period - 1e-12], 0.0)
    motion = _run(hold, values, panels.nodes.ravel(), simulate)
    shape = panels.nodes.shape
    load = float(values[3])
    sliding = motion.contact_mode != STICK
    turned = np.flatnonzero(np.diff(np.sign(motion.velocity[sliding])))
    displacement, swing = _resonator(motion)
    return HeldOrbit(
        hold=hold,
        panels=panels,
        slider_velocity=motion.velocity.reshape(shape),
        resonator_displacement=displacement.reshape(shape),
        resonator_velocity=swing.reshape(shape),
        friction=motion.friction_force.reshape(shape),
        mean_friction=-load,
        reversals=panels.nodes.ravel()[sliding][turned],
        iterations=iteration,
        shot=True,
    )
