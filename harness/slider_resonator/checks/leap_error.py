"""How far motion that leaps over periods may be off the resolved motion of the full device.

Compared are the velocity and position of slider and resonator as one mass, X' + r Y' and X + r Y:
what is left of a transient of the resonator does not move them.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from slider_resonator.arrays import Array
from slider_resonator.checks.natural_scale import largest_fast_velocity
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs

CENTRE_VELOCITY, CENTRE = "centre velocity", "centre"
MARGIN = 10.0
"""Largest error of the slow velocity, over `tolerance` times the fast velocity."""


def allowed_by_leaps(
    device: Device, held: Sequence[HeldInputs], duration: float
) -> Mapping[str, float]:
    """Return the allowed error of both signals, in m/s and m, after a run of `duration` (s)."""
    velocity = MARGIN * device.tolerance * largest_fast_velocity(device, held)
    return {CENTRE_VELOCITY: velocity, CENTRE: velocity * duration}


def centre_signals(device: Device, signals: Mapping[str, Array]) -> dict[str, Array]:
    """Return velocity (m/s) and position (m) of slider and resonator as one mass, shape (n,)."""
    share = device.mass_ratio
    return {
        CENTRE_VELOCITY: signals["velocity"] + share * signals["resonator_velocity"],
        CENTRE: signals["position"] + share * signals["resonator_displacement"],
    }
