"""Checking that a model description has the interface that the harness needs."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence, Set
from math import isfinite

from fmpy.model_description import (
    DefaultExperiment,
    ModelDescription,
    ModelVariable,
    Unit,
    Unknown,
)

from slider_resonator.device.interface import FIRST, INPUTS, VARIABLES, Variable
from slider_resonator.fmu.units import unit_problems

INITIAL: Mapping[str, str] = {"input": "exact", "parameter": "exact", "output": "calculated"}
"""What `initial` may say where it says anything, by causality."""

INPUTS_AT_START: Mapping[str, Set[str]] = {
    "position": frozenset(),
    "velocity": frozenset(),
    "normal_force": frozenset({"phase"}),
    "reversals": frozenset(),
    "last_event_time": frozenset(),
    "blocking_force": frozenset({"phase", "frequency_ratio"}),
}
"""Inputs on which some outputs may depend at the start; any other makes a false algebraic loop."""


def interface_problems(description: ModelDescription) -> list[str]:
    """Return every deviation from names, causalities, types and units.

    Order, value references and other variables are free; variables added after the first version of
    the interface may be missing. If the description defines a unit, it must have the dimension and
    the factor of its name.
    """
    found = {variable.name: variable for variable in description.modelVariables}
    problems: list[str] = []
    for name, variable in VARIABLES.items():
        if name in found:
            problems += _departures(found[name], variable)
        elif variable.since == FIRST:
            problems.append(f"{variable.causality} {name} is missing")
    for unit in dict.fromkeys(variable.unit for variable in VARIABLES.values()):
        problems += unit_problems(unit, description.unitDefinitions)
    return problems


def description_faults(description: ModelDescription) -> list[str]:
    """Return every deviation from starts, bounds, nominal values, variabilities, dependencies.

    All of these must be there, with a description of each variable, but for the dependencies of an
    output: without them it depends on all inputs. The default experiment must be there and one that
    can be run, and no other tool must be needed.
    """
    faults = [*_experiment_faults(description.defaultExperiment)]
    units = {unit.name: {shown.name for shown in unit.displayUnits} for unit in _units(description)}
    for found in description.modelVariables:
        if found.name in VARIABLES:
            faults += _other_values(found, VARIABLES[found.name])
            faults += _undefined_display(found, units)
    declared = {unknown.variable.name: unknown.dependencies for unknown in description.outputs}
    for name, variable in VARIABLES.items():
        if variable.causality != "output" or all(
            v.name != name for v in description.modelVariables
        ):
            continue
        if name not in declared:
            faults.append(f"{name} is not among the outputs of ModelStructure")
        elif declared[name] is not None and variable.depends_on is not None:
            dependencies = {other.name for other in declared[name]}
            for missing in sorted(set(variable.depends_on) - dependencies):
                faults.append(f"{name} is declared independent of {missing}, which acts on it")
            for other in sorted(dependencies - set(variable.depends_on)):
                faults.append(f"{name} is declared to depend on {other}, which does not act on it")
    for unknown in description.outputs:
        faults += _linear_faults(unknown)
    for unknown in description.initialUnknowns:
        faults += _loop_faults(unknown)
    if description.coSimulation.needsExecutionTool:
        faults.append("needsExecutionTool is true, must be false: hosts refuse the FMU")
    return faults


def _experiment_faults(experiment: DefaultExperiment | None) -> Iterator[str]:
    """Find what a host that takes its settings from the description cannot run."""
    if experiment is None or experiment.stopTime is None:
        missing = "" if experiment is None else "stopTime of "
        yield f"{missing}the default experiment is missing"
        return
    given = {
        "startTime": experiment.startTime,
        "stopTime": experiment.stopTime,
        "stepSize": experiment.stepSize,
        "tolerance": experiment.tolerance,
    }
    values = {name: float(text) for name, text in given.items() if text is not None}
    for name, value in values.items():
        if not isfinite(value) or (name in ("stepSize", "tolerance") and not value > 0.0):
            yield f"{name} of the default experiment is {value!r}"
            return
    start, stop = values.get("startTime", 0.0), values["stopTime"]
    if not stop > start:
        yield f"the default experiment ends at {stop!r} s, must be after its start at {start!r} s"
    elif values.get("stepSize", 0.0) > stop - start:
        step = values["stepSize"]
        yield f"stepSize of the default experiment is {step!r} s, longer than all of it"


def _linear_faults(unknown: Unknown) -> Iterator[str]:
    """Find claims that an output is linear in an input: friction and contact make none so."""
    if unknown.variable.name not in VARIABLES:
        return
    inputs, kinds = unknown.dependencies or (), unknown.dependenciesKind or ()
    for other, kind in zip(inputs, kinds, strict=False):
        if kind != "dependent":
            name = unknown.variable.name
            yield f"{name} is declared {kind} in {other.name}, must be dependent"


def _loop_faults(unknown: Unknown) -> Iterator[str]:
    """Find inputs on which an output is declared to depend at the start, and does not."""
    name = unknown.variable.name
    if name in INPUTS_AT_START:
        declared = {other.name for other in unknown.dependencies or ()} & set(INPUTS)
        for other in sorted(declared - INPUTS_AT_START[name]):
            yield f"{name} is declared to depend on {other} at the start, which does not act on it"


def _units(description: ModelDescription) -> Sequence[Unit]:
    return description.unitDefinitions or ()


def _undefined_display(found: ModelVariable, units: Mapping[str, Set[str]]) -> Iterator[str]:
    unit, shown = _attribute(found, "unit"), _attribute(found, "displayUnit")
    if unit is not None and shown is not None and shown not in units.get(unit, {shown}):
        yield f"displayUnit of {found.name} is {shown}, which {unit} does not define"


def _departures(found: ModelVariable, variable: Variable) -> Iterator[str]:
    name = found.name
    if found.causality != variable.causality:
        yield f"{name} is {found.causality}, must be {variable.causality}"
    if found.type != variable.kind:
        yield f"{name} is of type {found.type}, must be {variable.kind}"
    unit = _attribute(found, "unit") or "1"
    if unit != variable.unit:
        yield f"{name} has unit {unit}, must be {variable.unit}"


def _other_values(found: ModelVariable, variable: Variable) -> Iterator[str]:
    name = found.name
    if found.variability != variable.variability:
        yield f"{name} is {found.variability}, must be {variable.variability}"
    if not found.description:
        yield f"{name} has no description"
    initial = INITIAL[variable.causality]
    if found.initial not in (None, initial):
        yield f"initial of {name} is {found.initial}, must be {initial}"
    attributes = {
        "start": variable.start,
        "min": variable.minimum,
        "max": variable.maximum,
        "nominal": variable.nominal,
    }
    for attribute, needed in attributes.items():
        text = _attribute(found, attribute)
        given = None if text is None else float(text)
        either = needed is None and attribute == "nominal"
        if given != needed and not either:
            given_text = "none" if given is None else repr(given)
            needed_text = "none" if needed is None else repr(float(needed))
            yield f"{attribute} of {name} is {given_text}, must be {needed_text}"


def _attribute(variable: ModelVariable, name: str) -> str | None:
    """Return an attribute of a variable, that of its type where it has none."""
    own = getattr(variable, name)
    if own is None and variable.declaredType is not None:
        own = getattr(variable.declaredType, name, None)
    return None if own is None else str(own)
