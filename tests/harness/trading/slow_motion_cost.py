"""What leaps over periods cost against resolved motion of the same accuracy.

`python -m tests.harness.trading.slow_motion_cost dist/SliderResonator.fmu` prints two tables
for each device. Over run length: CPU times of whole runs, start and preparation included. Each
model has the loosest tolerance with which its mean velocity errs by no more than a millionth of the
peak all along the run. Times of both are taken in turn; their ratio is the median of these pairs.
And over the steps of one run, 1000 drive periods each: what a step costs with either.
"""

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
"""Largest error of the mean velocity, over its peak in the run."""
PAIRS = 5
DEFAULT_TOLERANCE = 1e-8
TOLERANCES = tuple(10.0 ** (-0.5 * halves) for halves in range(24, 7, -1))
PERIODS = 1000.0
"""Drive periods in a step whose cost is compared."""
STEPS = 60
SHOWN_STEPS = (1, 2, 5, 10, 15, 20, 30, 60)
INSTANCES = 25
"""Instances of which the fastest step counts."""
DRIVE_FREQUENCY = 3500.0
"""That of table 1 (rad/s)."""
AVERAGED: Mapping[str, float] = {"fidelity": 0, "averaging_order": 2}
LEAPING: Mapping[str, float] = {**AVERAGED, "tolerance": 1e-5}
RESOLVED: Mapping[str, float] = {"fidelity": 2}
FINEST: Mapping[str, float] = {"fidelity": 2, "tolerance": 1e-13}
DEVICES: Mapping[str, Mapping[str, float]] = {
    "table 1, 3500 rad/s": {},
    "table 1, 35 000 rad/s": {
        "drive_frequency": 35000.0,
        "resonator_frequency": 35000.0,
        "base_amplitude": 1e-5,
    },
    "table 1, LuGre, 1e4": {"friction_law": 1, "bristle_stiffness": 1e4},
    "table 1, LuGre, 1e5": {"friction_law": 1, "bristle_stiffness": 1e5},
    "table 1, LuGre, 1e7": {"friction_law": 1, "bristle_stiffness": 1e7},
}


@dataclass(frozen=True)
class Setting:
    """A `tolerance`, and the `error` of the mean velocity that it leaves, over the peak."""

    tolerance: float
    error: float


@dataclass(frozen=True)
class Cost:
    """Of runs of one `length` (s): settings of both models, and CPU times (s), medians.

    `again` is that of a second run in the same instance, `ratio` resolved over averaged, in pairs.
    """

    length: float
    averaged_by: Setting
    resolved_by: Setting
    averaged: float
    again: float
    resolved: float
    ratio: float
    ratio_again: float


def follow(
    instance: Instance, values: Mapping[str, float], length: float, step: float = STEP
) -> Record:
    """Return the record of a run with constant inputs from rest."""
    signals = {name: constant(0.0) for name in ("phase", "load")}
    signals["frequency_ratio"] = constant(1.0)
    plan = schedule(length, min(step, length), **signals)
    return run(instance, values, plan, outputs=("mean_velocity",))


def cpu(record: Record) -> float:
    """Return the CPU time (s) of a run with its start."""
    return record.start_cpu + record.step_cpu


def mean_velocities(fmu: Fmu, values: Mapping[str, float], length: float) -> Array:
    """Return the mean velocity (m/s) at each reading of a run, shape (n,)."""
    with instantiate(fmu) as instance:
        return follow(instance, values, length)["mean_velocity"]


def cheapest(fmu: Fmu, values: Mapping[str, float], length: float, exact: Array) -> Setting:
    """Find the loosest tolerance that leaves no more than MAX_ERROR, as all tighter ones do.

    Resolved motion under Coulomb friction needs none.
    """
    needed = values.get("friction_law") or values["fidelity"] == 0
    peak = float(np.max(np.abs(exact)))
    found = Setting(DEFAULT_TOLERANCE, np.inf)
    for tolerance in TOLERANCES if needed else (DEFAULT_TOLERANCE,):
        means = mean_velocities(fmu, {**values, "tolerance": tolerance}, length)
        error = float(np.max(np.abs(means - exact))) / peak
        if error > MAX_ERROR and found.error < np.inf:
            break
        found = Setting(tolerance, error)
    return found


def cost(fmu: Fmu, device: Mapping[str, float], length: float) -> Cost:
    """Measure runs of a device over a length (s)."""
    exact = mean_velocities(fmu, {**device, **FINEST}, length)
    averaged_by = cheapest(fmu, {**device, **AVERAGED}, length, exact)
    resolved_by = cheapest(fmu, {**device, **RESOLVED}, length, exact)
    averaged = {**device, **AVERAGED, "tolerance": averaged_by.tolerance}
    resolved = {**device, **RESOLVED, "tolerance": resolved_by.tolerance}
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
        averaged_by,
        resolved_by,
        one,
        two,
        three,
        median(full / first for first, _, full in times),
        median(full / second for _, second, full in times),
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
    """Print what steps cost, and the ratio of all steps."""
    full, leaps = (step_times(fmu, {**device, **model}) for model in (RESOLVED, LEAPING))
    print(f"  step of {PERIODS:.0f} periods  resolved      leaps  ratio")
    for step in SHOWN_STEPS:
        times = f"{1e6 * full[step - 1]:7.1f} us {1e6 * leaps[step - 1]:7.1f} us"
        print(f"  {step:20d} {times} {full[step - 1] / leaps[step - 1]:6.2f}")
    print(f"  ratio of all steps {full.sum() / leaps.sum():.2f}", flush=True)


def main(path: Path) -> None:
    """Print two tables for each device."""
    heading = "  length   averaged      again   resolved  ratio  again  errors           tolerances"
    with open_fmu(path) as fmu:
        for name, device in DEVICES.items():
            print(f"{name}\n{heading}")
            for length in LENGTHS:
                found = cost(fmu, device, length)
                columns = (found.averaged, found.again, found.resolved)
                shown = " ".join(f"{1e3 * value:7.2f} ms" for value in columns)
                by = (found.averaged_by, found.resolved_by)
                errors = " ".join(f"{setting.error:.1e}" for setting in by)
                tolerances = " ".join(f"{setting.tolerance:.1e}" for setting in by)
                ratios = f"{found.ratio:6.1f} {found.ratio_again:6.1f}"
                print(f"{found.length:6.1f} s {shown} {ratios}  {errors}  {tolerances}", flush=True)
            print_steps(fmu, device)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
