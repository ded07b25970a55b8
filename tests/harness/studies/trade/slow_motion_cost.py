"""What second-order averages cost against resolved motion of the same accuracy, over run length.

`python -m tests.harness.studies.trade.slow_motion_cost dist/SliderResonator.fmu` prints a table for
each device: CPU times of whole runs, start and preparation included, and what each errs by in the
final mean velocity. Times of both are taken in turn; their ratio is the median of these pairs.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from statistics import median

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
AVERAGED: Mapping[str, float] = {"fidelity": 0, "averaging_order": 2}
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


def main(path: Path) -> None:
    """Print a table for each device."""
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


if __name__ == "__main__":
    main(Path(sys.argv[1]))
