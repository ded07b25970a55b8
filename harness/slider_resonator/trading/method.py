"""The measured methods: those that follow a motion, and those that find an answer without."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from time import process_time
from typing import TypeVar

from slider_resonator.trading.solution import Solution

Result = TypeVar("Result")


@dataclass(frozen=True)
class Label:
    """Identity of a method, with the fields of `Row`."""

    kind: str
    family: str
    name: str
    friction_law: int
    fidelity: int | None = None
    step: float | None = None
    tolerance: float | None = None
    averaging_order: int | None = None


@dataclass(frozen=True)
class Method:
    """A method to follow a motion.

    `run` follows it over a number of drive periods; `seconds` does so without the readings and
    returns the CPU time (s), without initialisation. A run has at least `min_periods`; a method
    that `cannot_stick` does not cover sticking. `missing` gives the reason for each quantity that
    the method does not compute. `clock` is the CPU time (s) that the method has taken so far, with
    or without other work.
    """

    label: Label
    run: Callable[[int], Solution]
    seconds: Callable[[int], float]
    min_periods: int = 1
    cannot_stick: bool = False
    missing: Mapping[str, str] = field(default_factory=dict)
    clock: Callable[[], float] = process_time


@dataclass(frozen=True)
class SteadyAnswer:
    """An answer, None with a `reason` where there is none, and the drive periods simulated."""

    value: float | None
    reason: str
    periods: int


@dataclass(frozen=True)
class SteadyMethod:
    """A method to find a steady velocity (m/s) or a blocking force (N), named by `quantity`.

    `find` takes its budget of CPU time (s) and raises RuntimeError where that is exceeded. `clock`
    is the CPU time (s) that the method has taken so far, with or without other work.
    """

    label: Label
    quantity: str
    find: Callable[[float], SteadyAnswer]
    clock: Callable[[], float] = process_time


def timed(work: Callable[[], Result], clock: Callable[[], float]) -> tuple[float, Result]:
    """Return the CPU time (s) that some work takes, by its clock, and the result."""
    began = clock()
    result = work()
    return clock() - began, result
