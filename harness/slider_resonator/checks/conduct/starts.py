"""What the variables of an FMU are before a run, and whether they keep what is set."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import partial

from slider_resonator.checks.conduct.findings import is_refused, other_value, unequal
from slider_resonator.checks.fmu_side import FmuSide
from slider_resonator.device.interface import INPUTS, VARIABLES
from slider_resonator.fmu.instance import Instance

PHASE = 1.3
"""A phase (rad) that acts on the normal force at the start."""


def start_faults(fmu: FmuSide) -> list[str]:
    """Read every parameter and input new, when set, in a run and after a reset.

    Outputs that are read before initialization ends are those at its end. An FMU need not give
    values before initialization mode.
    """
    instance = fmu.instance
    instance.renew()
    early = no_faults if is_refused(partial(instance.value, "load")) else unequal
    starts = {
        name: variable.start
        for name, variable in VARIABLES.items()
        if variable.start is not None and name in instance.fmu.variables
    }
    others = {name: other_value(name, start) for name, start in starts.items()}
    # A device of bristles and the averaged motion must start with any of these values.
    others |= {"fidelity": 2.0, "friction_law": 0.0}
    faults: list[str] = []
    with instance.explained():
        faults += early(instance, starts, "at first")
        instance.set_up()
        for name, value in others.items():
            instance.set({name: value})
        faults += early(instance, others, "after it was set")
        faults += _in_one_call(instance, others)
        first = _one_by_one(instance, instance.fmu.outputs)
        instance.begin()
        faults += unequal(instance, others, "in a run")
        faults += unequal(instance, first, "after initialization, as it was read in it")
        instance.step_by(1e-3)
        faults += unequal(instance, others, "after a step")
        instance.set_up()
        faults += early(instance, starts, "after a reset")
        instance.set(others)
        instance.call("fmi2EnterInitializationMode")
        instance.set({name: others[name] for name in INPUTS})
        instance.call("fmi2Reset")
        faults += early(instance, starts, "after a reset in initialization mode")
        faults += _set_in_initialization(instance)
    return faults


def _set_in_initialization(instance: Instance) -> Iterator[str]:
    """Read outputs before and after an input is set in initialization mode."""
    instance.set_up()
    instance.call("fmi2EnterInitializationMode")
    instance.read(instance.fmu.outputs)
    instance.set({"phase": PHASE})
    found = instance.read(instance.fmu.outputs)
    instance.begin()
    yield from unequal(instance, found, "after initialization, as it was read in it under a phase")
    instance.set_up()
    instance.set({"phase": PHASE})
    instance.call("fmi2EnterInitializationMode")
    yield from unequal(instance, found, "in initialization mode, where the phase was set before")
    instance.begin()


def no_faults(*_: object) -> Sequence[str]:
    """Return none, where nothing can be read."""
    return ()


def _in_one_call(instance: Instance, others: Mapping[str, float]) -> Iterator[str]:
    """Set all Integers in one call, the last first, and read them so in initialization mode."""
    variables = instance.fmu.variables
    integers = [name for name in others if variables[name].type == "Integer"][::-1]
    references = [variables[name].valueReference for name in integers]
    instance.slave.setInteger(references, [int(others[name]) for name in integers])
    instance.call("fmi2EnterInitializationMode")
    for name, found in zip(integers, instance.slave.getInteger(references), strict=True):
        if found != others[name]:
            yield f"{name} is {found!r} among others in one call, must be {others[name]!r}"
    yield from unequal(instance, others, "after it was set with others")


def _one_by_one(instance: Instance, names: Iterable[str]) -> dict[str, float]:
    """Read variables, Integers first: no Real may be needed to bring them up to date."""
    variables = instance.fmu.variables
    ordered = sorted(names, key=lambda name: (variables[name].type, name))
    return {name: instance.read([name])[name] for name in ordered}
