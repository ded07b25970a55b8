"""What second-order averages cost against resolved motion of the same accuracy and first order.

`python -m tests.harness.studies.trade.slow_motion_cost dist/SliderResonator.fmu` prints two tables
for each device. Over run length: CPU times of whole runs, start and preparation included, and what
each errs by in the final mean velocity. Times of both are taken in turn; their ratio is the median
of these pairs. And over the steps of one run, 1000 drive periods each: what a step costs with
averages of either order. The first one is the preparation.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from time import perf_counter

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.schedule import schedule
from slider_resonator.device.signal import constant
from slider_resonator.fmu.instance import Instance, instantiate
from slider_resonator.fmu.opening import Fmu, open_fmu
from slider_resonator.fmu.record import Record
from slider_resonator.fmu.run import run

LENGTHS = (0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0)
"""Seconds."""
STEP = 2.0
"""Communication step (s): about 1000 drive periods at 3500 rad/s."""
MAX_ERROR = 1e-6
"""Largest relative error of the mean velocity."""
PAIRS = 5
TOLERANCES = tuple(10.0**-digits for digits in range(4, 13))
PERIODS = 1000.0
"""Drive periods in a step whose cost is compared with that of first order."""
STEPS = 60
SHOWN_STEPS = (1, 2, 5, 10, 15, 20, 30, 60)
INSTANCES = 25
"""Instances of which the fastest step counts."""
DRIVE_FREQUENCY = 3500.0
"""That of table 1 (rad/s)."""
AVERAGED: Mapping[str, float] = {"fidelity": 0, "averaging_order": 2}
FIRST_ORDER: Mapping[str, float] = {"fidelity": 0, "averaging_order": 1}
RESOLVED: Mapping[str, float] = {"fidelity": 2}
FINEST: Mapping[str, float] = {"fidelity": 2, "tolerance": 1e-13}
DEVICES: Mapping[str, Mapping[str, float]] = {
    "table 1, 3500 rad/s": {},
    "table 1, 35 000 rad/s": {
        "drive_frequency": 35000.0,
        "resonator_frequency": 35000.0,
        "base_amplitude": 1e-5,
    },
    "table 1, LuGre": {"friction_law": 1},
}


@dataclass(frozen=True)
class Cost:
    """Of runs of one `length` (s): CPU times (s), medians, and relative errors.

    `again` is that of a second run in the same instance, `ratio` resolved over averaged, in pairs.
    """

    length: float
    averaged: float
    again: float
    resolved: float
    ratio: float
    ratio_again: float
    averaged_error: float
    resolved_error: float


def follow(instance: Instance, values: Mapping[str, float], length: float) -> Record:
    """Return the record of a run with constant inputs from rest."""
    signals = {name: constant(0.0) for name in ("phase", "load")}
    signals["frequency_ratio"] = constant(1.0)
    plan = schedule(length, min(STEP, length), **signals)
    return run(instance, values, plan, outputs=("mean_velocity",))


def cpu(record: Record) -> float:
    """Return the CPU time (s) of a run with its start."""
    return record.start_cpu + record.step_cpu


def cost(fmu: Fmu, device: Mapping[str, float], length: float) -> Cost:
    """Measure runs of a device over a length (s)."""
    with instantiate(fmu) as instance:
        exact = follow(instance, {**device, **FINEST}, length).final("mean_velocity")
        tolerance = 1e-8
        for tolerance in TOLERANCES if device.get("friction_law") else ():
            rough = follow(instance, {**device, **RESOLVED, "tolerance": tolerance}, length)
            if abs(rough.final("mean_velocity") / exact - 1.0) <= MAX_ERROR:
                break
    resolved = {**device, **RESOLVED, "tolerance": tolerance}
    averaged = {**device, **AVERAGED}
    times: list[tuple[float, float, float]] = []
    for _ in range(PAIRS):
        with instantiate(fmu) as instance:
            first = follow(instance, averaged, length)
            second = follow(instance, averaged, length)
        with instantiate(fmu) as instance:
            full = follow(instance, resolved, length)
        times.append((cpu(first), cpu(second), cpu(full)))
    one, two, three = (median(column) for column in zip(*times, strict=True))
    return Cost(
        length,
        one,
        two,
        three,
        median(full / first for first, _, full in times),
        median(full / second for _, second, full in times),
        abs(first.final("mean_velocity") / exact - 1.0),
        abs(full.final("mean_velocity") / exact - 1.0),
    )


def elapsed(action: Callable[[], object]) -> float:
    """Return how long (s) an action takes."""
    began = perf_counter()
    action()
    return perf_counter() - began


def step_times(fmu: Fmu, values: Mapping[str, float]) -> Array:
    """Return what steps of PERIODS drive periods take (s), shape (STEPS,).

    The time of a call that does nothing is taken off.
    """
    size = PERIODS * math.tau / values.get("drive_frequency", DRIVE_FREQUENCY)
    times = np.full(STEPS, np.inf)
    for _ in range(INSTANCES):
        with instantiate(fmu) as instance:
            instance.start(values)
            nothing = instance.block([])
            taken = [elapsed(lambda: instance.step_by(size)) for _ in range(STEPS)]
            idle = min(elapsed(nothing.read) for _ in range(STEPS))
        times = np.minimum(times, np.array(taken) - idle)
    return times


def print_steps(fmu: Fmu, device: Mapping[str, float]) -> None:
    """Print what steps cost with averages of either order, and the largest ratio."""
    first, second = (step_times(fmu, {**device, **order}) for order in (FIRST_ORDER, AVERAGED))
    ratios = second / first
    print(f"  step of {PERIODS:.0f} periods   order 1    order 2  ratio")
    for step in SHOWN_STEPS:
        times = f"{1e6 * first[step - 1]:7.1f} us {1e6 * second[step - 1]:7.1f} us"
        print(f"  {step:20d} {times} {ratios[step - 1]:6.2f}")
    print(f"  largest ratio after the first step {ratios[1:].max():.2f}", flush=True)


def main(path: Path) -> None:
    """Print two tables for each device."""
    with open_fmu(path) as fmu:
        for name, device in DEVICES.items():
            print(f"{name}\n  length   averaged      again   resolved  ratio  again  errors")
            for length in LENGTHS:
                found = cost(fmu, device, length)
                columns = (found.averaged, found.again, found.resolved)
                shown = " ".join(f"{1e3 * value:7.2f} ms" for value in columns)
                errors = f"{found.averaged_error:.0e} {found.resolved_error:.0e}"
                ratios = f"{found.ratio:6.1f} {found.ratio_again:6.1f}"
                print(f"{found.length:6.1f} s {shown} {ratios}  {errors}", flush=True)
            print_steps(fmu, device)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
