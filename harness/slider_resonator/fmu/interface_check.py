"""Checking that a model description has the interface that the harness needs."""

from __future__ import annotations

from collections.abc import Iterator

from fmpy.model_description import ModelDescription, ModelVariable

from slider_resonator.device.interface import INPUTS, INTEGERS, OUTPUTS, PARAMETERS
from slider_resonator.fmu.units import unit_problems

INTEGER_TYPES = ("Integer", "Int32")
"""FMI 2.0's and FMI 3.0's."""

REAL_TYPES = ("Real", "Float64")


def interface_problems(description: ModelDescription) -> list[str]:
    """Return every deviation from names, causalities, types and units.

    Order, value references and other variables are free. A unit of the interface must be what its
    name says where the description defines it.
    """
    variables = {variable.name: variable for variable in description.modelVariables}
    problems: list[str] = []
    for causality, expected in (("input", INPUTS), ("parameter", PARAMETERS), ("output", OUTPUTS)):
        for name, unit in expected.items():
            if name not in variables:
                problems.append(f"{causality} {name} is missing")
            else:
                problems += _departures(variables[name], causality, unit)
    units = dict.fromkeys([*INPUTS.values(), *PARAMETERS.values(), *OUTPUTS.values()])
    for unit in units:
        problems += unit_problems(unit, description.unitDefinitions)
    return problems


def _departures(variable: ModelVariable, causality: str, unit: str) -> Iterator[str]:
    name = variable.name
    if variable.causality != causality:
        yield f"{name} is {variable.causality}, must be {causality}"
    kinds = INTEGER_TYPES if name in INTEGERS else REAL_TYPES
    if variable.type not in kinds:
        yield f"{name} is of type {variable.type}, must be {' or '.join(kinds)}"
    found = _unit(variable)
    if found != unit:
        yield f"{name} has unit {found}, must be {unit}"


def _unit(variable: ModelVariable) -> str:
    """Return the unit of a variable, "1" where it has none."""
    declared = variable.declaredType.unit if variable.declaredType else None
    return str(variable.unit or declared or "1")
