"""The natural scale of a quantity in a device, below a share of which a reference is near zero."""

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from math import pi
from operator import attrgetter

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.equivalent_force import equivalent_force

NEAR_ZERO = 0.01
"""Share of the natural scale that a reference counts as at least, unless a scene gives an absolute
tolerance."""


def _amplitude(device: Device, name: str) -> float:
    """Return an amplitude of the steady vibration without friction, (32)-(34), 0 without one."""
    try:
        return float(getattr(equivalent_force(device), name))
    except ValueError:
        return 0.0


fast_velocity = partial(_amplitude, name="velocity_amplitude")
"""Amplitude v_q of the fast velocity (m/s) of a device, 0 without vibration."""


def largest_fast_velocity(device: Device, held: Sequence[HeldInputs]) -> float:
    """Return the largest v_q (m/s) of a run that tunes the device."""
    return max(fast_velocity(device.tuned(inputs.tuned)) for inputs in held)


def _velocity(device: Device) -> float:
    """Return v_q (m/s), or without vibration what friction changes the velocity by in a radian."""
    change = device.max_friction / (device.total_mass * device.drive_frequency)
    return fast_velocity(device) or change


def _ripple(device: Device) -> float:
    return _amplitude(device, "ripple_amplitude") or _velocity(device) / device.drive_frequency


_resonator = partial(_amplitude, name="resonator_amplitude")
_SCALES: Mapping[str, Callable[[Device], float]] = {
    **dict.fromkeys(
        (
            *("steady_velocity", "predicted_velocity", "predicted_velocity_in_run", "velocity"),
            *("mean_velocity", "mean_velocity_in_run", "last_step_velocity"),
        ),
        _velocity,
    ),
    **dict.fromkeys(
        (
            *("blocking_force", "predicted_blocking_force", "predicted_blocking_force_in_run"),
            "friction_force",
        ),
        attrgetter("max_friction"),
    ),
    "normal_force": attrgetter("max_normal_force"),
    **dict.fromkeys(("position", "slow_displacement", "ripple_amplitude"), _ripple),
    "resonator_displacement": _resonator,
    "resonator_velocity": lambda device: _resonator(device) * device.drive_frequency,
    **dict.fromkeys(("stick_fraction", "stick_fraction_in_run"), lambda device: 1.0),
    "friction_power": lambda device: device.max_friction * fast_velocity(device),
    "last_event_time": lambda device: 2.0 * pi / device.drive_frequency,
}


def smallest_reference(quantity: str, device: Device) -> float:
    """Return the minimum size of a reference, in the quantity's unit.

    It is `NEAR_ZERO` times the amplitude of the fast velocity v_q for velocities, or without
    vibration what friction changes the velocity by in a radian of the drive; the force of full
    friction for forces, the amplitude of the fast motion for displacements, and so on; 0 for
    quantities that have no scale of their own.
    """
    scale = _SCALES.get(quantity)
    return NEAR_ZERO * scale(device) if scale else 0.0
