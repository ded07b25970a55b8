"""The interface that the harness asks of an FMU: names and SI units of inputs and outputs.

Repeated here on purpose: an FMU whose own table is wrong must not agree with itself.
"""

from __future__ import annotations

from collections.abc import Mapping

INPUTS: Mapping[str, str] = {"phase": "rad", "load": "N", "frequency_ratio": "1"}
"""Input name to unit."""

INPUT_STARTS: Mapping[str, float] = {"phase": 0.0, "load": 0.0, "frequency_ratio": 1.0}
"""Default value of each input."""

PARAMETERS: Mapping[str, str] = {
    "slider_mass": "kg",
    "resonator_mass": "kg",
    "resonator_frequency": "rad/s",
    "damping_ratio": "1",
    "normal_preload": "N",
    "normal_amplitude": "N",
    "base_amplitude": "m",
    "drive_frequency": "rad/s",
    "tangential_force": "N",
    "friction_coefficient": "1",
    "friction_faces": "1",
    "friction_law": "1",
    "bristle_stiffness": "1/m",
    "bristle_damping": "s/m",
    "fidelity": "1",
    "tolerance": "1",
    "initial_position": "m",
    "initial_velocity": "m/s",
    "initial_resonator_displacement": "m",
    "initial_resonator_velocity": "m/s",
    "initial_bristle_deflection": "m",
}
"""Parameter name to unit."""

INTEGERS = frozenset({"friction_faces", "friction_law", "fidelity"})
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
}
"""Output name to unit."""
