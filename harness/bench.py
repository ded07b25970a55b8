"""What accuracy costs: the FMU and the references side by side, on the table 1 device from rest.

All run in one process, one after the other, several times over; the referee tells their errors.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from math import pi
from pathlib import Path
from statistics import median
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from harness.drive import Instance, instantiate, run
from harness.errors import HarnessError
from harness.fmu import open_fmu
from harness.measures.deviation import peak
from harness.references import located_events, paper_method, taylor
from harness.references.device import Device
from harness.references.held_inputs import HeldInputs
from harness.references.trajectory import Trajectory
from harness.schedule import schedule

Array = NDArray[np.float64]

DEVICE = Device()
PERIOD = 2.0 * pi / DEVICE.drive_frequency
FMU_PERIODS = 1000
REFEREE_PERIODS = 200
LOCATED_PERIODS = 20
PAPER_PERIODS = 5
PAPER_TOLERANCES = (1e-6, 1e-8, 1e-10)
"""Absolute tolerances, in fractions of a typical velocity and displacement: the cost of stepping
over a jump hangs on them far more than on the relative tolerance."""
STEPS = (1, 10, 100)
"""Communication steps of the FMU in drive periods."""
COMPARED = 10
"""The step, in drive periods, whose cost the others are compared with."""


@dataclass(frozen=True)
class Cost:
    """One way to run the device: medians over the repeats.

    `microseconds` per drive period, `fastest` and `slowest` the extremes over the repeats; errors
    are largest differences from the referee over the peak of the referee's signal, None for the
    referee itself; counts are for the whole run, None where the method does not tell.
    """

    method: str
    periods: int
    microseconds: float
    fastest: float
    slowest: float
    position_error: float | None
    velocity_error: float | None
    reversals: int
    steps: int
    evaluations: int | None


@dataclass(frozen=True)
class Ratio:
    """How many times as long a method takes, and how many times as wrong its velocity is."""

    method: str
    time: float
    velocity_error: float | None


@dataclass(frozen=True)
class Benchmark:
    """All costs, and ratios of the references to the FMU in steps of ten drive periods."""

    repeats: int
    costs: tuple[Cost, ...]
    ratios: tuple[Ratio, ...]


@dataclass(frozen=True)
class _Outcome:
    """Samples and counts of one run."""

    times: Array
    position: Array
    velocity: Array
    reversals: int
    steps: int
    evaluations: int | None


def bench(
    fmu_path: Path, repeats: int, progress: Callable[[str, float], None] = lambda name, share: None
) -> Benchmark:
    """Run everything `repeats` times and return medians; HarnessError without the referee."""
    with open_fmu(fmu_path) as fmu, instantiate(fmu) as instance:
        methods = _methods(instance)
        try:
            referee = methods["Taylor with located events"][1]()  # compiles on its first call
        except ModuleNotFoundError as error:
            raise HarnessError(str(error)) from error
        seconds: dict[str, list[float]] = {name: [] for name in methods}
        outcomes: dict[str, _Outcome] = {}
        for repeat in range(repeats):  # in turn, so that a busy moment hits all methods alike
            for index, (name, (_, method)) in enumerate(methods.items()):
                progress(name, (repeat + index / len(methods)) / repeats)
                began = perf_counter()
                outcomes[name] = method()
                seconds[name].append(perf_counter() - began)
        costs = [
            _cost(name, periods, seconds[name], outcomes[name], referee)
            for name, (periods, _) in methods.items()
        ]
    progress("", 1.0)
    ours = next(cost for cost in costs if cost.method == _fmu_name(COMPARED))
    ratios = tuple(
        Ratio(
            cost.method,
            cost.microseconds / ours.microseconds,
            _ratio(cost.velocity_error, ours.velocity_error),
        )
        for cost in costs
        if not cost.method.startswith("FMU")
    )
    return Benchmark(repeats, tuple(costs), ratios)


def _methods(instance: Instance) -> dict[str, tuple[int, Callable[[], _Outcome]]]:
    """Return periods and run of each method by name."""
    methods: dict[str, tuple[int, Callable[[], _Outcome]]] = {}
    for step in STEPS:
        methods[_fmu_name(step)] = (FMU_PERIODS, partial(_fmu, instance, step))
    references: Sequence[tuple[str, int, Callable[..., Trajectory]]] = (
        ("Taylor with located events", REFEREE_PERIODS, taylor.simulate),
        ("DOP853 with located events", LOCATED_PERIODS, located_events.simulate),
        *(
            (_paper_name(atol), PAPER_PERIODS, partial(paper_method.simulate, atol=atol))
            for atol in PAPER_TOLERANCES
        ),
    )
    for name, periods, simulate in references:
        methods[name] = (periods, partial(_reference, simulate, periods))
    return methods


def _paper_name(atol: float) -> str:
    return f"DOP853 on sgn, rtol 1e-6, atol {atol:.0e}"


def _fmu_name(step: int) -> str:
    return f"FMU, steps of {step} period{'s' if step > 1 else ''}"


def _fmu(instance: Instance, step: int) -> _Outcome:
    record = run(
        instance,
        {},
        schedule(FMU_PERIODS * PERIOD, step * PERIOD),
        outputs=("position", "velocity", "reversals"),
    )
    reversals = round(record.final("reversals"))
    steps = len(record.times) - 1
    return _Outcome(record.times, record["position"], record["velocity"], reversals, steps, None)


def _reference(simulate: Callable[..., Trajectory], periods: int) -> _Outcome:
    times = np.asarray(PERIOD * np.arange(periods + 1), dtype=np.float64)
    run = simulate(DEVICE, [HeldInputs(0.0, float(times[-1]))], times)
    return _Outcome(times, run.position, run.velocity, run.reversals, run.steps, run.evaluations)


def _cost(
    name: str, periods: int, seconds: Sequence[float], outcome: _Outcome, referee: _Outcome
) -> Cost:
    is_referee = name.startswith("Taylor")
    return Cost(
        method=name,
        periods=periods,
        microseconds=1e6 * median(seconds) / periods,
        fastest=1e6 * min(seconds) / periods,
        slowest=1e6 * max(seconds) / periods,
        position_error=None if is_referee else _error(outcome, referee, "position"),
        velocity_error=None if is_referee else _error(outcome, referee, "velocity"),
        reversals=outcome.reversals,
        steps=outcome.steps,
        evaluations=outcome.evaluations,
    )


def _error(outcome: _Outcome, referee: _Outcome, name: str) -> float:
    """Return the largest difference at the common times, over the peak of the referee there."""
    count = int(np.searchsorted(outcome.times, referee.times[-1] * (1.0 + 1e-9), side="right"))
    at = np.rint(outcome.times[:count] / PERIOD).astype(int)
    signal, reference = getattr(outcome, name)[:count], getattr(referee, name)
    return peak(signal - reference[at]) / peak(reference[: at[-1] + 1])


def _ratio(above: float | None, below: float | None) -> float | None:
    return above / below if above is not None and below else None
