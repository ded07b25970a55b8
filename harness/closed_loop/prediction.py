"""How far averaged motion may be off: it does not see what happens within a drive period."""

from __future__ import annotations

from math import tau

from harness.references.device import Device


def averaged_error(device: Device) -> float:
    """Return the velocity (m/s) that full sliding friction takes from the slider in a drive period.

    The averaged equation (4) leaves out what the slow velocity does within a period, which is of
    this size: of order 1 over the drive frequency.
    """
    mass = device.slider_mass + device.resonator_mass
    friction = device.friction_faces * device.friction_coefficient * device.normal_preload
    return friction / mass * tau / device.drive_frequency
