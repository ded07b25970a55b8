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
from slider_resonator.references.averaged.averaged_motion import AveragedMotion, slow_ratio
from slider_resonator.references.averaged.device_average import full_friction, mean_friction
from slider_resonator.references.equivalent_force import EquivalentForce, equivalent_force
from slider_resonator.references.phase import advanced
from slider_resonator.references.resolved.contact import LIFTED


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
        force, frequency = equivalent_force(tuned), tuned.drive_frequency
        past = motion.time[here] - inputs.start
        angle = theta + frequency * past
        ratios = inputs.frequency_ratio + inputs.ratio_rate * past
        turned = 0.5 * (inputs.frequency_ratio + ratios) * frequency * past
        load_angle = psi + inputs.phase + turned
        normal = tuned.normal_preload + tuned.normal_amplitude * np.sin(load_angle)
        sampled = np.column_stack([angle, load_angle, ratios, motion.mean_velocity[here]])
        swing = angle - force.resonator_angle
        rows[here] = np.column_stack(
            [
                force.resonator_amplitude * np.sin(swing),
                frequency * force.resonator_amplitude * np.cos(swing),
                np.maximum(0.0, normal),
                [_friction(tuned, force, inputs.load, *one) for one in sampled.tolist()],
                np.where(normal > 0.0, np.sign(motion.velocity[here]), float(LIFTED)),
            ]
        )
        span = frequency * (inputs.stop - inputs.start)
        theta = advanced(theta, span)
        psi = advanced(psi, inputs.turned(inputs.stop - inputs.start, frequency))
    displacement, rate, normal, friction, mode = rows.T
    return AveragedOutputs(displacement, rate, normal, friction, mode.astype(np.int64))


def _friction(
    device: Device,
    force: EquivalentForce,
    load: float,
    angle: float,
    load_angle: float,
    ratio: float,
    slow: float,
) -> float:
    """Return the mean friction (N) at a slow velocity (m/s).

    The angles (rad) are those of drive and normal load.
    """
    if force.velocity_amplitude == 0.0:
        full = full_friction(device, load_angle, ratio)
        return float(np.clip(-load, -full, full) if slow == 0.0 else np.sign(slow) * full)
    _, near = slow_ratio(device, ratio)
    return mean_friction(device, force, slow, load_angle - near * angle, near)
