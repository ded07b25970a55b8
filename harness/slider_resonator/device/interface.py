"""The interface that the harness requires of an FMU: names and SI units of inputs and outputs.

Repeated here on purpose: an FMU whose own table is wrong must not agree with itself.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields

from slider_resonator.device.device import Device

INPUTS: Mapping[str, str] = {"phase": "rad", "load": "N", "frequency_ratio": "1"}
"""Input name to unit."""

INPUT_STARTS: Mapping[str, float] = {"phase": 0.0, "load": 0.0, "frequency_ratio": 1.0}
"""Default value of each input."""

PARAMETERS: Mapping[str, str] = {f.name: f.metadata["unit"] for f in fields(Device)}
"""Parameter name to unit."""

INTEGERS = frozenset(f.name for f in fields(Device) if f.type == "int")
"""Parameters that are Integers; all others, and all inputs, are Real."""

OUTPUTS: Mapping[str, str] = {
    "position": "m",
    "velocity": "m/s",
    "mean_velocity": "m/s",
    "resonator_displacement": "m",
    "resonator_velocity": "m/s",
    "normal_force": "N",
    "friction_force": "N",
    "contact_mode": "1",
    "reversals": "1",
    "stick_fraction": "1",
    "last_event_time": "s",
    "steady_velocity": "m/s",
    "blocking_force": "N",
    "prediction_valid": "1",
}
"""Output name to unit."""
