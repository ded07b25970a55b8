"""The keys of [device]: what each parameter means, and the JSON schema of the table."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from slider_resonator.device.interface import PARAMETERS, VARIABLES

HAS_UNIT = "[A-DF-Za-df-zµμ°%]"
"""A character that a text has which is a number with a unit, and one without does not have."""
NUMBER_OR_TEXT: Mapping[str, Any] = {
    "type": ["number", "string"],
    "pattern": rf"^\s*[-+.\d].*{HAS_UNIT}",
}
"""The JSON schema of a number that may be a text with a unit."""

PARAMETER_MEANINGS: Mapping[str, str] = {
    "slider_mass": "mass of the slider, M",
    "resonator_mass": "mass of the resonator, m",
    "resonator_frequency": "angular natural frequency of the resonator on a fixed slider",
    "damping_ratio": "damping ratio of the resonator on a fixed slider",
    "normal_preload": "mean normal load of a face, N0",
    "normal_amplitude": "amplitude of the normal load of a face; above the mean the contact lifts",
    "base_amplitude": "amplitude of the base excitation, A",
    "drive_frequency": "angular frequency of the drive, w",
    "tangential_force": "amplitude of the direct drive of the slider",
    "friction_coefficient": "friction coefficient, mu",
    "friction_faces": "faces with friction: 2 for a clamped slider, 1 for one on a surface",
    "friction_law": "0 Coulomb, 1 LuGre",
    "bristle_stiffness": "LuGre: bristle stiffness per unit normal load",
    "bristle_damping": "LuGre: bristle damping per unit normal load",
    "fidelity": "0 slow motion, 1 slider with the resonator's steady force, 2 full device",
    "tolerance": "error of LuGre friction; error of leaps in the slow velocity over the fast one",
    "initial_position": "position at the start",
    "initial_velocity": "velocity at the start",
    "initial_resonator_displacement": "displacement of the resonator against the slider",
    "initial_resonator_velocity": "velocity of the resonator against the slider",
    "initial_bristle_deflection": "LuGre: bristle deflection at the start",
    "averaging_order": "fidelity 0: 1 averages, 2 leaps over periods; predictions alike",
}
"""The meaning of each parameter, in the order of the interface."""


def device_schema() -> dict[str, Any]:
    """Return what the JSON schema of a table of parameters has beyond that of a mapping."""
    return {
        "properties": {name: _property(name, PARAMETER_MEANINGS[name]) for name in PARAMETERS},
        "additionalProperties": False,
    }


def _property(name: str, meaning: str) -> dict[str, Any]:
    variable = VARIABLES[name]
    bounds = {"minimum": variable.minimum, "maximum": variable.maximum}
    is_integer = variable.kind == "Integer"
    return {
        **({"type": "integer"} if is_integer else NUMBER_OR_TEXT),
        "description": meaning,
        "unit": variable.unit,
        "default": variable.start,
        **{bound: value for bound, value in bounds.items() if value is not None},
    }
