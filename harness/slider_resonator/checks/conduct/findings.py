"""What is found wrong with the conduct of an FMU, and other values to try it with."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import TypeVar

from fmpy.fmi1 import FMICallException

from slider_resonator.arrays import is_same
from slider_resonator.device.interface import VARIABLES
from slider_resonator.errors import Refusal
from slider_resonator.fmu.instance import Instance

SMOOTH = (
    *("position", "velocity", "mean_velocity", "resonator_displacement", "resonator_velocity"),
    *("normal_force", "friction_force", "reversals", "last_event_time"),
)
"""Outputs that show whether a call moves anything; predictions would cost too much."""
Answer = TypeVar("Answer")
UNKNOWN = 0x7FFFFFFF
"""The value reference of no variable."""


CHOSEN = ("fidelity", "friction_law", "averaging_order")
"""Variables that choose a model."""


def other_value(name: str, value: float | None = None) -> float:
    """Return another value that the variable can have, of the same order of magnitude.

    It differs from the start where no value is given.
    """
    variable = VARIABLES[name]
    value = variable.start or 0.0 if value is None else value
    if variable.kind == "Integer":
        low, high = variable.minimum or 0.0, variable.maximum or 0.0
        return low if value != low else high
    if variable.maximum is not None:
        return 0.5 * (value + variable.maximum)
    return value + 0.37 * (abs(value) or variable.nominal or 1.0)


def values_to_vary(instance: Instance) -> list[str]:
    """Return the variables that can be set and choose no model."""
    settable = [name for name, v in VARIABLES.items() if v.causality != "output"]
    return [n for n in settable if n in instance.fmu.variables and n not in CHOSEN]


def outputs_after(instance: Instance, size: float, count: int = 1) -> dict[str, float]:
    """Return all outputs after some steps of a size (s)."""
    for _ in range(count):
        instance.step_by(size)
    return instance.outputs()


def unequal(instance: Instance, values: Mapping[str, float], when: str) -> Iterator[str]:
    """Yield which variables do not have these values."""
    for name, found in instance.read(list(values)).items():
        if not is_same(found, values[name]):
            yield f"{name} is {found!r} {when}, must be {values[name]!r}"


def accepted(instance: Instance, what: str, faults: Iterable[str]) -> Iterator[str]:
    """Yield the faults that are found by calls, and one more where a call is refused."""
    try:
        with instance.explained():
            yield from faults
    except Refusal as error:
        yield f"{what} is refused: {error}"


def is_refused(call: Callable[..., object], *arguments: object) -> bool:
    """Make a call of FMI; return whether it fails."""
    return answer_of(lambda: (call(*arguments),)) is None


def answer_of(call: Callable[..., Answer], *arguments: object) -> Answer | None:
    """Make a call of FMI; return what it answers, None where it fails."""
    try:
        return call(*arguments)
    except FMICallException:
        return None
