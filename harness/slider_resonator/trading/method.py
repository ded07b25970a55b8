"""The measured methods: those that follow a motion, and those that find an answer without."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from slider_resonator.steady.searches import SEARCHES, SteadyAnswer
from slider_resonator.trading.result import Row
from slider_resonator.trading.solution import Solution

STEADY = tuple(SEARCHES)
"""What is found without following a motion."""


@dataclass(frozen=True)
class Method:
    """A method to follow a motion, and the row that it fills.

    `run` follows it over a number of drive periods and returns its CPU time (s), too; `seconds`
    does so without the readings and returns the CPU time (s), without initialisation. A run has at
    least `min_periods`; a method that `cannot_stick` does not cover sticking. `missing` gives the
    reason for each quantity that the method does not compute.
    """

    row: Row
    run: Callable[[int], tuple[float, Solution]]
    seconds: Callable[[int], float]
    min_periods: int = 1
    cannot_stick: bool = False
    missing: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class SteadyMethod:
    """A method to find a steady velocity (m/s) or a blocking force (N), the answer of its `row`.

    `find` takes its budget of CPU time (s) and raises RuntimeError where that is exceeded.
    """

    row: Row
    find: Callable[[float], SteadyAnswer]
