"""Values that differ from given ones, within the bounds of the interface."""

from __future__ import annotations

from collections.abc import Sequence

from slider_resonator.device.interface import INPUTS, VARIABLES

SHARE = 0.37
"""Change of a value in units of its nominal one."""


def other_value(name: str, value: float) -> float:
    """Return another value that the variable can have, of the same order of magnitude."""
    variable = VARIABLES[name]
    if variable.kind == "Integer":
        low, high = variable.minimum or 0.0, variable.maximum or 0.0
        return low if value != low else high
    if variable.maximum is not None:
        return 0.5 * (value + variable.maximum)
    return value + SHARE * (abs(value) or variable.nominal or 1.0)


def other_inputs(values: Sequence[float]) -> list[float]:
    """Return other values of the inputs, in the order of the interface."""
    return [other_value(name, value) for name, value in zip(INPUTS, values, strict=True)]
