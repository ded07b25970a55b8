"""Checking that a model description has the interface that the harness needs, with its units."""

import re
from collections.abc import Iterator, Mapping, Sequence, Set
from math import isclose, isfinite, pi
from pathlib import Path

from fmpy.model_description import (
    BaseUnit,
    DefaultExperiment,
    ModelDescription,
    ModelVariable,
    Unit,
)

from slider_resonator.device.device import DEVIATIONS
from slider_resonator.device.interface import INPUTS, VARIABLES
from slider_resonator.device.variable import FIRST, Variable

DIMENSIONS: Mapping[str, str] = {
    "1": "1",
    "rad": "1",
    "rad/s": "s^-1",
    "kg": "kg",
    "m": "m",
    "m/s": "m s^-1",
    "s": "s",
    "N": "kg m s^-2",
    "1/m": "m^-1",
    "s/m": "s m^-1",
    "W": "kg m^2 s^-3",
}
"""Unit of the interface in SI base units; to the SI a radian is 1."""

_PREFIXES = {"n": 1e9, "u": 1e6, "µ": 1e6, "m": 1e3, "c": 1e2, "d": 1e1, "k": 1e-3, "M": 1e-6}
_DISPLAYED: Mapping[str, Mapping[str, float]] = {
    "1": {"%": 100.0, "ppm": 1e6},
    "rad": {"deg": 180.0 / pi, "°": 180.0 / pi},
    "rad/s": {"Hz": 0.5 / pi, "kHz": 0.5e-3 / pi, "deg/s": 180.0 / pi, "rpm": 30.0 / pi},
    "kg": {"g": 1e3, "mg": 1e6, "t": 1e-3},
}
"""Unit to names that it may be displayed in, with the factor; prefixes come on top of these."""


def unit_problems(unit: str, definitions: Sequence[Unit]) -> Iterator[str]:
    """Yield the errors in the definitions of a unit of the interface; none without a definition.

    Its base unit must have the exponents that the name stands for, factor 1 and offset 0, because
    the values of variables are taken as they are; display units must have the factor that goes
    with their names, as far as these are known. The exponent of rad is free.
    """
    for definition in (one for one in definitions if one.name == unit):
        if (base := definition.baseUnit) is not None:
            for what, given, needed in (
                ("as", _dimension(base), DIMENSIONS[unit]),
                ("with factor", base.factor, 1),
                ("with offset", base.offset, 0),
            ):
                if given != needed:
                    yield f"unit {unit} is defined {what} {given}, must be {needed}"
        for display in definition.displayUnits:
            if (factor := _factor(unit, str(display.name))) is None:
                continue
            where = f"display unit {display.name} of unit {unit} is defined with"
            if not isclose(display.factor, factor, rel_tol=1e-5):  # it may be rounded
                yield f"{where} factor {display.factor!r}, must be {factor:.9g}"
            if display.offset != 0.0:
                yield f"{where} offset {display.offset!r}, must be 0"


def _factor(unit: str, display: str) -> float | None:
    """Return the factor from `unit` to a display unit, None for unknown names."""
    if display == unit:
        return 1.0
    if unit in ("m", "m/s", "s", "N", "W") and display[1:] == unit:
        return _PREFIXES.get(display[0])
    return _DISPLAYED.get(unit, {}).get(display)


def _dimension(base: BaseUnit) -> str:
    """Return the exponents of a unit as text, such as "kg m s^-2", those above 0 first."""
    exponents = [(name, getattr(base, name)) for name in ("kg", "m", "s", "A", "K", "mol", "cd")]
    ordered = sorted(exponents, key=lambda one: one[1] < 0)
    parts = [name if power == 1 else f"{name}^{power}" for name, power in ordered if power]
    return " ".join(parts) or "1"


INPUTS_AT_START: Mapping[str, Set[str]] = {
    **dict.fromkeys(("position", "reversals", "last_event_time"), frozenset()),
    "velocity": {*DEVIATIONS},
    "normal_force": {"phase"},
    "blocking_force": {"phase", "frequency_ratio", *DEVIATIONS},
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
        if name not in found:
            if variable.since == FIRST:
                problems.append(f"{variable.causality} {name} is missing")
            continue
        own = found[name]
        if own.causality != variable.causality:
            problems.append(f"{name} is {own.causality}, must be {variable.causality}")
        if own.type != variable.kind:
            problems.append(f"{name} is of type {own.type}, must be {variable.kind}")
        if (unit := _attribute(own, "unit") or "1") != variable.unit:
            problems.append(f"{name} has unit {unit}, must be {variable.unit}")
    for unit in dict.fromkeys(variable.unit for variable in VARIABLES.values()):
        problems += unit_problems(unit, description.unitDefinitions)
    return problems


def description_faults(description: ModelDescription) -> list[str]:
    """Return every deviation from starts, bounds, nominal values, variabilities, dependencies.

    Nominal values and the bounds of an output may be left out, and so may its dependencies: it then
    depends on all inputs. The default experiment must be one that can be run, and no other tool
    must be needed.
    """
    faults = [*_experiment_faults(description.defaultExperiment)]
    units = {
        unit.name: {shown.name for shown in unit.displayUnits}
        for unit in description.unitDefinitions or ()
    }
    for found in description.modelVariables:
        if found.name in VARIABLES:
            faults += _other_values(found, VARIABLES[found.name])
            unit, shown = _attribute(found, "unit"), _attribute(found, "displayUnit")
            if shown is not None and shown not in units.get(unit, {shown}):
                wrong = f"displayUnit of {found.name} is {shown}, which {unit} does not define"
                faults.append(wrong)
    declared = {unknown.variable.name: unknown.dependencies for unknown in description.outputs}
    names = {variable.name for variable in description.modelVariables}
    for name, variable in VARIABLES.items():
        if variable.causality != "output" or name not in names:
            continue
        if name not in declared:
            faults.append(f"{name} is not among the outputs of ModelStructure")
        elif declared[name] is not None and variable.depends_on is not None:
            dependencies = {other.name for other in declared[name]}
            for missing in sorted(names & set(variable.depends_on) - dependencies):
                faults.append(f"{name} is declared independent of {missing}, which acts on it")
            for other in sorted(dependencies - set(variable.depends_on)):
                faults.append(f"{name} is declared to depend on {other}, which does not act on it")
    for unknown in description.outputs:
        name, kinds = unknown.variable.name, unknown.dependenciesKind or ()
        for other, kind in zip(unknown.dependencies or (), kinds, strict=False):
            if kind != "dependent" and name in VARIABLES:  # friction and contact are not linear
                faults.append(f"{name} is declared {kind} in {other.name}, must be dependent")
    for unknown in description.initialUnknowns:
        name = unknown.variable.name
        at_start = {other.name for other in unknown.dependencies or ()} & {*INPUTS, *DEVIATIONS}
        wrong = "at the start, which does not act on it"
        for other in sorted(at_start - INPUTS_AT_START.get(name, at_start)):
            faults.append(f"{name} is declared to depend on {other} {wrong}")
    if description.coSimulation.needsExecutionTool:
        faults.append("needsExecutionTool is true, must be false: hosts refuse the FMU")
    return faults


MAGIC = {
    ".dll": (b"MZ",),
    ".so": (b"\x7fELF",),
    ".dylib": (b"\xcf\xfa\xed\xfe", b"\xca\xfe\xba\xbe"),
}
"""What binaries begin with, by the end of their names."""


def archive_faults(folder: Path, description: ModelDescription) -> Iterator[str]:
    """Find binaries that are not of their platform, and source files that are missing or unlisted.

    Headers of FMI come with the host.
    """
    for binary in folder.glob(f"binaries/*/{description.coSimulation.modelIdentifier}.*"):
        begins = MAGIC.get(binary.suffix)
        if begins and not binary.read_bytes().startswith(begins):
            yield f"{binary.relative_to(folder)} is no binary of its platform"
    sources = folder / "sources"
    sets = [one for build in description.buildConfigurations for one in build.sourceFileSets]
    # An FMU without any sources can be run all the same.
    listed = [name for one in sets for name in one.sourceFiles if sources.is_dir()]
    searched = [sources / name for one in sets for name in ("", *one.includeDirectories)]
    present = [path for path in sources.rglob("*") if path.suffix in (".c", ".h")]
    needed = {sources / name: "which is listed" for name in listed}
    for path in present:
        text = path.read_text(encoding="utf-8", errors="replace")
        for name in re.findall(r'^\s*#\s*include\s+"(?!fmi)([^"]+)"', text, re.MULTILINE):
            places = [(base / name).resolve() for base in (path.parent, *searched)]
            found = next((place for place in places if place.is_file()), places[0])
            needed[found] = f"which {path.name} includes"
    yield from (f"{p.name}, {why}, is missing" for p, why in needed.items() if not p.is_file())
    if listed:
        unlisted = {path.resolve() for path in present if path.suffix == ".c"} - {*needed}
        yield from (f"{path.name} is not among the source files" for path in unlisted)


def _experiment_faults(experiment: DefaultExperiment | None) -> Iterator[str]:
    """Find what a host that takes its settings from the description cannot run."""
    if experiment is None:
        return
    values = {
        name: float(text)
        for name in ("startTime", "stopTime", "stepSize", "tolerance")
        if (text := getattr(experiment, name)) is not None
    }
    for name, value in values.items():
        if not isfinite(value) or (name in ("stepSize", "tolerance") and not value > 0.0):
            yield f"{name} of the default experiment is {value!r}"
            return
    start, stop = values.get("startTime", 0.0), values.get("stopTime")
    step = values.get("stepSize", 0.0)
    if stop is not None and not stop > start:
        yield f"the default experiment ends at {stop!r} s, must be after its start at {start!r} s"
    elif stop is not None and step > stop - start:
        yield f"stepSize of the default experiment is {step!r} s, longer than all of it"


def _other_values(found: ModelVariable, variable: Variable) -> Iterator[str]:
    name = found.name
    if found.variability != variable.variability:
        yield f"{name} is {found.variability}, must be {variable.variability}"
    initial = "calculated" if variable.causality == "output" else "exact"
    if found.initial not in (None, initial):
        yield f"initial of {name} is {found.initial}, must be {initial}"
    names = {"start": "start", "min": "minimum", "max": "maximum", "nominal": "nominal"}
    for attribute, own_name in names.items():
        needed = getattr(variable, own_name)
        text = _attribute(found, attribute)
        given = None if text is None else float(text)
        is_free = attribute == "nominal" and needed is None
        may_be_left_out = attribute == "nominal" or variable.causality == "output"
        if given != needed and not is_free and not (may_be_left_out and given is None):
            said = ["none" if one is None else repr(float(one)) for one in (given, needed)]
            yield f"{attribute} of {name} is {said[0]}, must be {said[1]}"


def _attribute(variable: ModelVariable, name: str) -> str | None:
    """Return an attribute of a variable, that of its type where it has none."""
    own = getattr(variable, name)
    if own is None and variable.declaredType is not None:
        own = getattr(variable.declaredType, name, None)
    return None if own is None else str(own)
