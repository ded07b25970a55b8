"""What is measured: ways to follow a motion, and ways to an answer without following one."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from time import process_time

from slider_resonator.studies.trade.motion import Motion


@dataclass(frozen=True)
class Label:
    """Who a method is, as `Row` has it."""

    kind: str
    family: str
    name: str
    friction_law: int
    fidelity: int | None = None
    step: float | None = None
    tolerance: float | None = None


@dataclass(frozen=True)
class Method:
    """A way to follow a motion.

    `run` follows it over so many drive periods; `seconds` does the same without what only the
    comparison needs and returns the CPU time (s) of that, without getting started. A run has at
    least `least_periods`; one that `sticks_not` covers no sticking. `missing` says of quantities
    why there is none.
    """

    label: Label
    run: Callable[[int], Motion]
    seconds: Callable[[int], float]
    least_periods: int = 1
    sticks_not: bool = False
    missing: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Found:
    """An answer, None where none was found for a `reason`, and the drive periods it took."""

    value: float | None
    reason: str
    periods: int


@dataclass(frozen=True)
class Answer:
    """A way to a steady velocity (m/s) or a blocking force (N), named by `quantity`.

    `find` gives up, with a RuntimeError, when it has taken so much CPU time (s).
    """

    label: Label
    quantity: str
    find: Callable[[float], Found]


def cpu_seconds(work: Callable[[], object]) -> float:
    """Return the CPU time (s) that some work takes."""
    began = process_time()
    work()
    return process_time() - began
