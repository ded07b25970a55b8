"""Resonator, contact and forces of averaged motion, dimensional, for both friction laws.

The resonator swings as (32) says, the normal load is what it is at each instant, and friction is
its mean over the fast motion at the present slow velocity.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.averaged.averaged_motion import (
    MAX_DETUNING,
    AveragedMotion,
    full_friction,
    mean_friction,
)
from slider_resonator.references.averaged.vibrating_contact import turns_until_repeat
from slider_resonator.references.closed_forms import equivalent_force

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
    force, times = equivalent_force(device), motion.time
    rate = device.drive_frequency
    pieces = np.searchsorted([inputs.stop for inputs in held], times, side="left")
    starts = np.array([inputs.start for inputs in held])
    ratios = np.array([inputs.frequency_ratio for inputs in held])
    turned = np.append(0.0, np.cumsum(ratios[:-1] * np.diff(starts)))
    theta = rate * (times - held[0].start)
    psi = rate * (turned[pieces] + ratios[pieces] * (times - starts[pieces]))
    chi = psi + np.array([inputs.phase for inputs in held])[pieces]
    angle = theta - force.resonator_angle
    displacement = force.resonator_amplitude * np.sin(angle)
    velocity = rate * force.resonator_amplitude * np.cos(angle)
    normal = np.maximum(0.0, device.normal_preload + device.normal_amplitude * np.sin(chi))
    friction = np.empty_like(times)
    for index, (ratio, slow) in enumerate(zip(ratios[pieces], motion.mean_velocity, strict=True)):
        if force.velocity_amplitude == 0.0:
            full, load = full_friction(device, float(chi[index]), ratio), held[pieces[index]].load
            friction[index] = np.clip(-load, -full, full) if slow == 0.0 else np.sign(slow) * full
            continue
        turns = turns_until_repeat(device.amplitude_ratio, ratio, MAX_DETUNING)
        near = round(turns * ratio) / turns if turns else ratio
        lead = float(chi[index] - near * theta[index])
        friction[index] = mean_friction(device, force, slow, lead, near)
    mode = np.where(normal > 0.0, np.sign(motion.velocity), float(_LIFTED)).astype(np.int64)
    return AveragedOutputs(displacement, velocity, normal, friction, mode)
