"""Resonator, contact and forces of averaged motion, dimensional, for both friction laws.

The resonator vibrates steadily, (32); the normal load is the instantaneous one; friction is the
mean over the fast motion at the present slow velocity.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs, with_steady_phase
from slider_resonator.references.averaged.averaged_motion import (
    AveragedMotion,
    slow_ratio,
)
from slider_resonator.references.averaged.device_average import full_friction, mean_friction
from slider_resonator.references.equivalent_force import EquivalentForce, equivalent_force
from slider_resonator.references.phase import advanced

_LIFTED = 2


@dataclass(frozen=True)
class AveragedOutputs:
    """Outputs of averaged motion: arrays of shape (n,), SI units.

    ``friction_force`` is the mean friction of all faces. ``contact_mode`` is 2 in flight, else the
    sign of the velocity with the fast motion.
    """

    resonator_displacement: Array
    resonator_velocity: Array
    normal_force: Array
    friction_force: Array
    contact_mode: NDArray[np.int64]


def averaged_outputs(
    device: Device, held: Sequence[HeldInputs], motion: AveragedMotion
) -> AveragedOutputs:
    """Return the outputs that go with an averaged motion under the same held inputs.

    A sample on a boundary between inputs belongs to the inputs before it. The resonator swings
    steadily from the first instant on, whatever its initial values. Raises ValueError as
    `equivalent_force` does.
    """
    pieces = np.searchsorted([inputs.stop for inputs in held], motion.time, side="left")
    rows = np.empty((len(motion.time), 5))
    theta = psi = 0.0
    for index, inputs in enumerate(with_steady_phase(held, device)):
        here = pieces == index
        tuned = inputs.tuned_device(device)
        frequency = tuned.drive_frequency
        turned = frequency * (motion.time[here] - inputs.start)
        ratios = inputs.frequency_ratio + inputs.ratio_rate * (motion.time[here] - inputs.start)
        middle = 0.5 * (inputs.frequency_ratio + ratios)
        at = theta + turned, psi + inputs.phase + middle * turned, ratios
        rows[here] = _rows(tuned, inputs, at, motion.velocity[here], motion.mean_velocity[here])
        span = frequency * (inputs.stop - inputs.start)
        theta = advanced(theta, span)
        psi = advanced(psi, inputs.turned(inputs.stop - inputs.start, frequency))
    displacement, rate, normal, friction, mode = rows.T
    return AveragedOutputs(displacement, rate, normal, friction, mode.astype(np.int64))


def _rows(
    device: Device,
    inputs: HeldInputs,
    phases: tuple[Array, Array, Array],
    velocity: Array,
    slow: Array,
) -> Array:
    """Return the outputs as columns under one of the held inputs, shape (n, 5).

    ``phases`` are the angles of drive and normal load (rad) and the frequency ratio.
    """
    force = equivalent_force(device)
    theta, chi, ratios = phases
    angle = theta - force.resonator_angle
    displacement = force.resonator_amplitude * np.sin(angle)
    rate = device.drive_frequency * force.resonator_amplitude * np.cos(angle)
    normal = np.maximum(0.0, device.normal_preload + device.normal_amplitude * np.sin(chi))
    friction = [
        _friction(device, force, inputs, (float(t), float(c), float(r)), float(v))
        for t, c, r, v in zip(theta, chi, ratios, slow, strict=True)
    ]
    mode = np.where(normal > 0.0, np.sign(velocity), float(_LIFTED))
    return np.column_stack([displacement, rate, normal, friction, mode])


def _friction(
    device: Device,
    force: EquivalentForce,
    inputs: HeldInputs,
    phases: tuple[float, float, float],
    slow: float,
) -> float:
    """Return the mean friction (N) at a slow velocity (m/s); phases as for `_rows`."""
    theta, chi, ratio = phases
    if force.velocity_amplitude == 0.0:
        full = full_friction(device, chi, ratio)
        return float(np.clip(-inputs.load, -full, full) if slow == 0.0 else np.sign(slow) * full)
    _, near = slow_ratio(device, ratio)
    return mean_friction(device, force, slow, chi - near * theta, near)
