"""Motion of second order from any start: resolved until the resonator's own swing has decayed.

From initial values, or a change that shakes the resonator, motion has a fast part that belongs to
no held orbit. It is resolved first; the slow motion then takes over momentum and centre.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, fields, replace

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs, check_contiguous, check_times
from slider_resonator.references.averaged.slow_motion_second_order import (
    simulate_slow_motion,
    slow_start,
)
from slider_resonator.references.phase import advanced
from slider_resonator.references.resolved import located_events, lugre_scipy

SWING_LEFT = 1e-9
"""Share of the resonator's transient that remains when the slow motion takes over."""


@dataclass(frozen=True)
class MotionFromStart:
    """Motion at ``time``: arrays of shape (n,), SI units, all with the fast motion."""

    time: Array
    position: Array
    velocity: Array
    resonator_displacement: Array
    resonator_velocity: Array


def turns_resolved(device: Device) -> int:
    """Return the number of drive turns in which the resonator's transient decays to `SWING_LEFT`.

    It swings on a free slider: ``(1 - r) Y'' + 2 xi wn Y' + wn^2 Y = 0``. Raises ValueError without
    damping.
    """
    if device.resonator_mass == 0.0:
        return 1
    natural, share = device.resonator_frequency, 1.0 - device.mass_ratio
    roots = np.roots([share, 2.0 * device.damping_ratio * natural, natural**2])
    decay = -float(roots.real.max()) * 2.0 * math.pi / device.drive_frequency
    if not decay > 0.0:
        raise ValueError(
            f"damping_ratio = {device.damping_ratio!r}: the resonator's swing does not decay"
        )
    return math.ceil(-math.log(SWING_LEFT) / decay)


def simulate_from_start(
    device: Device, held: Sequence[HeldInputs], times: Array
) -> MotionFromStart:
    """Return the motion of second order under held inputs from 0 s on at ``times`` (shape (n,), s).

    Raises ValueError without damping, for tuned parameters, inputs that do not begin at 0 s, and as
    `simulate_slow_motion` does; RuntimeError as it does.
    """
    check_contiguous(held, rates=("phase_rate", "load_rate"))
    check_times(times, held)
    if held[0].start != 0.0:
        raise ValueError(f"held inputs begin at {held[0].start!r} s; must begin at 0 s")
    if any(inputs.tuned_device(device) is not device for inputs in held):
        raise ValueError("tuned parameters: held orbits are those of one device")
    full = replace(device, fidelity=2)
    taken = min(turns_resolved(full) * 2.0 * math.pi / full.drive_frequency, held[-1].stop)
    early = [replace(h, stop=min(h.stop, taken)) for h in held if h.start < taken]
    late = [
        replace(h.later(max(0.0, taken - h.start)), start=max(h.start, taken))
        for h in held
        if h.stop > taken
    ]
    simulate = lugre_scipy.simulate_lugre if full.friction_law else located_events.simulate
    first = times[times <= taken]
    resolved = simulate(full, early, np.append(first, taken))
    names = [column.name for column in fields(MotionFromStart)][1:]
    before = np.array([getattr(resolved, name) for name in names])
    if not late:
        return MotionFromStart(times, *before[:, :-1])
    turned = [full.drive_frequency * (inputs.stop - inputs.start) for inputs in early]
    theta = psi = 0.0
    for angle, inputs in zip(turned, early, strict=True):
        theta = advanced(theta, angle)
        psi = advanced(psi, inputs.frequency_ratio * angle)
    position, velocity, displacement, rate = before[:, -1].tolist()
    start = slow_start(full, (position, velocity, displacement, rate), theta, psi)
    slow = simulate_slow_motion(full, late, times[len(first) :], start=start)
    after = np.array([getattr(slow, name) for name in names])
    return MotionFromStart(times, *np.hstack([before[:, :-1], after]))
