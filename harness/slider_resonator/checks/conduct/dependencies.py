"""What acts on an output at once, against the dependencies that the FMU declares."""

from collections.abc import Iterable, Mapping, Sequence

from fmpy.model_description import Unknown

from slider_resonator.checks.conduct.findings import other_value, outputs_after
from slider_resonator.checks.fmu_side import FmuSide
from slider_resonator.device.device import DEVIATIONS
from slider_resonator.device.interface import INPUTS, SETTABLE, VARIABLES
from slider_resonator.fmu.instance import Instance

SITUATIONS: Sequence[Mapping[str, float]] = (
    {},
    {"initial_velocity": 0.3, "load": 0.1, "frequency_ratio": 3.0, "phase": 0.5},
    {"fidelity": 1.0, "load": 0.03, "phase": 1.0},
    {"fidelity": 0.0, "phase": 1.0},
    {"fidelity": 0.0, "averaging_order": 1.0, "phase": 1.0},
    {"load": 0.25},
    {"friction_law": 1.0, "initial_velocity": 0.2, "phase": 0.2},
    {"base_amplitude": 1e-8, "load": 0.02},  # at rest
    {"normal_preload": 0.5, "initial_velocity": 0.1, "phase": 2.0},  # with flight
)
"""Devices and inputs in which variables are changed, one by one."""
CHOSEN = ("fidelity", "friction_law", "averaging_order")
"""Variables with a situation for each of their values."""
STEPS = 4
STEP = 1.37e-4
"""Steps (s) of a run after each of which an input is changed."""


def dependency_faults(fmu: FmuSide) -> list[str]:
    """Change each variable at the start, and each input in a run, and see which outputs follow.

    An input in a run is set back after each step.
    """
    instance, description = fmu.instance, fmu.instance.fmu.description
    at_start = _declared(description.initialUnknowns)
    in_run = _declared(description.outputs)
    faults: list[str] = []
    names = [name for name in SETTABLE if name in instance.fmu.variables]
    for values in SITUATIONS:
        situation = {n: value for n, value in values.items() if n in instance.fmu.variables}
        present = {name: situation.get(name, VARIABLES[name].start or 0.0) for name in names}
        instance.start(situation)
        with instance.explained():
            before = instance.outputs()
        for name in names:
            if name not in CHOSEN:
                instance.start({**situation, name: other_value(name, present[name])})
                faults += _undeclared(instance, name, before, at_start, "at the start")
        instance.start(situation)
        with instance.explained():
            instance.outputs()
            for _ in range(STEPS):
                before = outputs_after(instance, STEP)
                for name in (*INPUTS, *DEVIATIONS):
                    if name in names:
                        instance.set({name: other_value(name, present[name])})
                        faults += _undeclared(instance, name, before, in_run, "in a run")
                        instance.set({name: present[name]})
    return list(dict.fromkeys(faults))


def _declared(unknowns: Iterable[Unknown]) -> dict[str, set[str] | None]:
    """Return the dependencies of each unknown by name, None for all."""
    return {
        u.variable.name: None if u.dependencies is None else {v.name for v in u.dependencies}
        for u in unknowns
    }


def _undeclared(
    instance: Instance,
    name: str,
    before: Mapping[str, float],
    declared: Mapping[str, set[str] | None],
    when: str,
) -> list[str]:
    """Return the outputs that have changed with a variable on which they should not depend.

    Only these are read: predictions, which depend on nearly all, take long.
    """
    independent = [
        output
        for output in before
        if (found := declared.get(output, set())) is not None and name not in found
    ]
    with instance.explained():
        after = instance.read(independent)
    return [
        f"{name} acts on {output} {when} without being declared"
        for output in independent
        if after[output] != before[output]
    ]
