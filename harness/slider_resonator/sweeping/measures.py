"""The measures of a sweep at a point: steady motion, and statistics of a run."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import tau

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.interface import INPUT_STARTS, INPUTS, INTEGERS, OUTPUTS
from slider_resonator.device.schedule import schedule
from slider_resonator.device.signal import constant
from slider_resonator.errors import unknown_name
from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.run import run
from slider_resonator.steady.blocking_force import find_blocking
from slider_resonator.steady.steady_velocity import find_steady
from slider_resonator.sweeping.axes import AxisError

Cell = float | str | None
"""An entry of the table; None where there is none."""

SEARCHED: Mapping[str, str] = {"steady_velocity": "m/s", "blocking_force": "N"}
"""Measures that are predicted and proved, or searched, with units; each has a status, too."""
STATUS: Mapping[str, str] = {"steady_velocity": "steady", "blocking_force": "blocked"}
"""The status of those that are proved."""


def _mean(values: Array) -> float:
    """Return the mean over time by the trapezoidal rule."""
    return float((values.sum() - 0.5 * (values[0] + values[-1])) / (len(values) - 1))


STATISTICS: Mapping[str, Callable[[Array], float]] = {
    "mean": _mean,
    "rms": lambda values: _mean(values**2) ** 0.5,
    "minimum": lambda values: float(np.min(values)),
    "maximum": lambda values: float(np.max(values)),
    "peak_to_peak": lambda values: float(np.ptp(values)),
    "last": lambda values: float(values[-1]),
}
"""Statistics of an output over a run, written OUTPUT.STATISTIC, in the unit of the output."""


@dataclass(frozen=True)
class Run:
    """A run from the initial state; statistics leave out the first `skip_periods`."""

    drive_periods: int
    steps_per_period: int
    skip_periods: int


@dataclass(frozen=True)
class Task:
    """The work at every point: varied variables, fixed values and measures."""

    names: tuple[str, ...]
    fixed: tuple[tuple[str, float], ...]
    measures: tuple[str, ...]
    max_denominator: int
    run: Run

    def values(self, point: tuple[float, ...]) -> dict[str, float]:
        """Return the parameters and inputs of a point by name."""
        return {**dict(self.fixed), **dict(zip(self.names, point, strict=True))}

    @property
    def columns(self) -> tuple[tuple[str, type], ...]:
        """Name and type of the table's columns."""
        results: list[tuple[str, type]] = []
        for measure in self.measures:
            results.append((measure, float))
            if measure in SEARCHED:
                results.append((f"{measure}_status", str))
        varied = ((name, int if name in INTEGERS else float) for name in self.names)
        return (("point", int), *varied, *results, ("error", str))


def check_measure(name: object) -> None:
    """Raise AxisError unless this is the name of a measure."""
    if not isinstance(name, str):
        raise AxisError(f"measure {name!r}: must be a name in quotes")
    output, dot, statistic = name.partition(".")
    if dot and output not in OUTPUTS:
        raise AxisError(f"measure {name!r}: {unknown_name('output', output, OUTPUTS)}")
    if dot and statistic not in STATISTICS:
        raise AxisError(f"measure {name!r}: {unknown_name('statistic', statistic, STATISTICS)}")
    if not dot and name not in SEARCHED:
        raise AxisError(unknown_name("measure", name, [*SEARCHED, "OUTPUT.STATISTIC"]))


def unit(measure: str) -> str:
    """Return the unit of a measure."""
    return SEARCHED.get(measure) or OUTPUTS[measure.partition(".")[0]]


def measure(
    instance: Instance, task: Task, point: tuple[float, ...], proved: Mapping[str, float]
) -> list[Cell]:
    """Return the cells of the measures at a point, in the order of the columns.

    What is `proved` is not searched. Depends on nothing but its arguments: not on the points
    before, so that neither the order of the points nor the worker shows in the result. Raises what
    the FMU and the search raise.
    """
    values = task.values(point)
    statistics = _statistics(instance, task, values)
    cells: list[Cell] = []
    for name in task.measures:
        if name in proved:
            cells += [proved[name], STATUS[name]]
        elif name in SEARCHED:
            find = find_steady if name == "steady_velocity" else find_blocking
            found = find(instance, values, max_denominator=task.max_denominator)
            cells += [getattr(found, name), found.status]
        else:
            cells.append(statistics[name])
    return cells


def _statistics(instance: Instance, task: Task, values: Mapping[str, float]) -> Mapping[str, float]:
    """Return the statistics among the measures, all from one run."""
    chosen = [name for name in task.measures if name not in SEARCHED]
    if not chosen:
        return {}
    outputs = list(dict.fromkeys(name.partition(".")[0] for name in chosen))
    parameters = {name: value for name, value in values.items() if name not in INPUTS}
    inputs = {name: constant(values.get(name, start)) for name, start in INPUT_STARTS.items()}
    instance.start(values)
    period = tau / instance.value("drive_frequency")
    plan = schedule(task.run.drive_periods * period, period / task.run.steps_per_period, **inputs)
    record = run(instance, parameters, plan, outputs=outputs)
    first = task.run.skip_periods * task.run.steps_per_period
    results = {}
    for name in chosen:
        output, _, statistic = name.partition(".")
        results[name] = STATISTICS[statistic](record[output][first:])
    return results
