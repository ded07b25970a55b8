"""What the variables of an FMU are, whether they keep what is set, and on what they act at once."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import product

from fmpy.model_description import Unknown

from slider_resonator.checks.conduct.findings import (
    CHOSEN,
    is_refused,
    other_value,
    outputs_after,
    unequal,
)
from slider_resonator.checks.fmu_side import FmuSide
from slider_resonator.device.device import DEVIATIONS
from slider_resonator.device.interface import (
    HELD,
    INPUTS,
    INTEGERS,
    PARAMETERS,
    SETTABLE,
    VARIABLES,
)
from slider_resonator.fmu.instance import Instance

STEP = 3e-3
"""Size of a step, s."""
PHASE = 1.3
"""A phase (rad) that acts on the normal force at the start."""


def start_faults(fmu: FmuSide) -> Iterator[str]:
    """Read every parameter and input new, when set, in a run and after a reset.

    Outputs that are read before initialization ends are those at its end. An FMU need not give
    values before initialization mode.
    """
    instance = fmu.instance
    instance.renew()
    early = (lambda *_: iter(())) if is_refused(instance.value, "load") else unequal
    starts = {
        name: variable.start
        for name, variable in VARIABLES.items()
        if variable.start is not None and name in instance.fmu.variables
    }
    others = {name: other_value(name) for name in starts}
    # A device of bristles and the averaged motion must start with any of these values.
    others |= {"fidelity": 2.0, "friction_law": 0.0}
    yield from early(instance, starts, "at first")
    instance.set_up()
    for name, value in others.items():
        instance.set({name: value})
    yield from early(instance, others, "after it was set")
    instance.call("fmi2EnterInitializationMode")
    yield from unequal(instance, others, "in initialization mode")
    # Integers first: no Real may be needed to bring them up to date.
    types = {name: instance.fmu.variables[name].type for name in instance.fmu.outputs}
    ordered = sorted(types, key=lambda name: (types[name], name))
    first = {name: instance.value(name) for name in ordered}
    instance.begin()
    yield from unequal(instance, others, "in a run")
    yield from unequal(instance, first, "after initialization, as it was read in it")
    instance.step_by(1e-3)
    yield from unequal(instance, others, "after a step")
    changed = {name: starts[name] for name in (*INPUTS, *HELD) if name in starts}
    instance.set(changed)
    yield from unequal(instance, changed, "after it was set in a run")
    instance.set_up()
    yield from early(instance, starts, "after a reset")
    instance.set(others)
    instance.call("fmi2EnterInitializationMode")
    instance.set({name: others[name] for name in INPUTS})
    instance.call("fmi2Reset")
    yield from early(instance, starts, "after a reset in initialization mode")
    yield from _set_in_initialization(instance, others)
    yield from _integer_faults(instance)


def _set_in_initialization(instance: Instance, others: Mapping[str, float]) -> Iterator[str]:
    """Set an input between readings in initialization mode, and then everything in it.

    What is set there must act as if it was set before.
    """
    instance.initialise({})
    instance.outputs()
    instance.set({"phase": PHASE})
    found = instance.outputs()
    instance.begin()
    yield from unequal(instance, found, "after initialization, as it was read in it under a phase")
    instance.initialise({"phase": PHASE})
    yield from unequal(instance, found, "in initialization mode, where the phase was set before")
    instance.begin()
    for law in (0.0, 1.0):
        values = {**others, "friction_law": law}
        instance.start(values)
        expected = outputs_after(instance, STEP)
        instance.initialise({})
        instance.set(values)
        instance.begin()
        instance.step_by(STEP)
        when = f"where all was set in initialization mode, with friction_law = {law:g}"
        yield from unequal(instance, expected, when)


def _integer_faults(instance: Instance) -> Iterator[str]:
    """Set and read all Integers in one call each, in two orders, at their ends in turn."""
    names = [name for name in PARAMETERS if name in INTEGERS and name in instance.fmu.variables]
    for ordered, begin in product((names, names[::-1]), range(2)):
        references = [instance.fmu.reference(name) for name in ordered]
        ends = [(VARIABLES[name].minimum, VARIABLES[name].maximum) for name in ordered]
        values = [int(pair[(begin + place) % 2] or 0) for place, pair in enumerate(ends)]
        instance.set_up()
        instance.slave.setInteger(references, values)
        instance.call("fmi2EnterInitializationMode")
        at_once = list(instance.slave.getInteger(references))
        one_by_one = [instance.slave.getInteger([one])[0] for one in references]
        if not values == at_once == one_by_one:
            yield f"Integers set to {values} are read as {at_once}, one by one as {one_by_one}"


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
"""Devices and inputs in which variables are changed, one by one; there is one for each model."""


def dependency_faults(fmu: FmuSide) -> Iterable[str]:
    """Change each variable at the start, and each input in a run, and see which outputs follow.

    An input in a run is set back after each of four short steps.
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
        before = instance.outputs()
        for name in names:
            if name not in CHOSEN:
                instance.start({**situation, name: other_value(name, present[name])})
                faults += _undeclared(instance, name, before, at_start, "at the start")
        instance.start(situation)
        instance.outputs()
        for _ in range(4):
            before = outputs_after(instance, 1.37e-4)
            for name in (*INPUTS, *DEVIATIONS):
                if name in names:
                    instance.set({name: other_value(name, present[name])})
                    faults += _undeclared(instance, name, before, in_run, "in a run")
                    instance.set({name: present[name]})
    return dict.fromkeys(faults)


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
) -> Iterator[str]:
    """Yield the outputs that have changed with a variable on which they should not depend.

    Only these are read: predictions, which depend on nearly all, take long.
    """
    independent = [
        output
        for output in before
        if (found := declared.get(output, set())) is not None and name not in found
    ]
    for output, value in instance.read(independent).items():
        if value != before[output]:
            yield f"{name} acts on {output} {when} without being declared"
