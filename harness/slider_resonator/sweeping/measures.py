"""The measures of a sweep at its points, in the process of the FMU: points in, rows out."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from math import tau
from typing import Annotated, Any

import numpy as np
from pydantic import Field, model_validator

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.interface import ALL_OUTPUTS, INPUT_STARTS, INPUTS, INTEGERS
from slider_resonator.device.schedule import schedule
from slider_resonator.device.signal import constant
from slider_resonator.errors import HarnessError, unknown_name
from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.run import run
from slider_resonator.scenes.key_table import KeyTable
from slider_resonator.steady.proved_predictions import proved_predictions
from slider_resonator.steady.searches import SEARCHES

Cell = float | str | None
"""An entry of the table; None where there is none."""

STATUS: Mapping[str, str] = {"steady_velocity": "steady", "blocking_force": "blocked"}
"""The status of measures that are proved; those of `SEARCHES` have one in the table, too."""


def _mean(values: Array) -> float:
    """Return the mean over time by the trapezoidal rule."""
    return float(np.trapezoid(values) / (len(values) - 1))


STATISTICS: Mapping[str, Callable[[Array], float]] = {
    "mean": _mean,
    "rms": lambda values: _mean(values**2) ** 0.5,
    "minimum": lambda values: float(np.min(values)),
    "maximum": lambda values: float(np.max(values)),
    "peak_to_peak": lambda values: float(np.ptp(values)),
    "last": lambda values: float(values[-1]),
}
"""Statistics of an output over a run, written OUTPUT.STATISTIC, in the unit of the output."""


Counted = Annotated[int, Field(strict=True, ge=1)]


class Run(KeyTable):
    """A run from the initial state; statistics leave out the first `skip_periods`."""

    drive_periods: Counted = 100
    steps_per_period: Counted = 16
    skip_periods: Annotated[int, Field(strict=True, ge=0)] = 0

    @model_validator(mode="after")
    def _some_left(self) -> "Run":
        if self.skip_periods >= self.drive_periods:
            raise ValueError(
                f"skip_periods = {self.skip_periods}: must be a whole number below "
                f"drive_periods = {self.drive_periods}"
            )
        return self


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
            if measure in SEARCHES:
                results.append((f"{measure}_status", str))
        varied = ((name, int if name in INTEGERS else float) for name in self.names)
        return (("point", int), *varied, *results, ("error", str))


def check_measure(name: object) -> None:
    """Raise ValueError unless this is the name of a measure."""
    if not isinstance(name, str):
        raise ValueError(f"measure {name!r}: must be a name in quotes")
    output, dot, statistic = name.partition(".")
    if dot and output not in ALL_OUTPUTS:
        raise ValueError(f"measure {name!r}: {unknown_name('output', output, ALL_OUTPUTS)}")
    if dot and statistic not in STATISTICS:
        raise ValueError(f"measure {name!r}: {unknown_name('statistic', statistic, STATISTICS)}")
    if not dot and name not in SEARCHES:
        raise ValueError(unknown_name("measure", name, [*SEARCHES, "OUTPUT.STATISTIC"]))


def unit(measure: str) -> str:
    """Return the unit of a measure."""
    return ALL_OUTPUTS[measure.partition(".")[0]]


def _statistics(instance: Instance, task: Task, values: Mapping[str, float]) -> Mapping[str, float]:
    """Return the statistics among the measures, all from one run."""
    chosen = [name for name in task.measures if name not in SEARCHES]
    if not chosen:
        return {}
    outputs = list(dict.fromkeys(name.partition(".")[0] for name in chosen))
    parameters = {name: value for name, value in values.items() if name not in INPUTS}
    inputs = {name: constant(values.get(name, start)) for name, start in INPUT_STARTS.items()}
    period = tau / Device.from_mapping(parameters).drive_frequency
    plan = schedule(task.run.drive_periods * period, period / task.run.steps_per_period, **inputs)
    record = run(instance, parameters, plan, outputs=outputs)
    first = task.run.skip_periods * task.run.steps_per_period
    results = {}
    for name in chosen:
        output, _, statistic = name.partition(".")
        results[name] = STATISTICS[statistic](record[output][first:])
    return results


Point = tuple[int, tuple[float, ...]]
"""Number of a point and its values."""
Row = tuple[int, list[Cell], str | None]
"""Number of a point, the cells of its measures, and its error if it failed."""
Proved = Mapping[str, float]
"""Measure to its value, of those that need no search."""
Columns = Mapping[str, list[Any]]
"""Column of the table to its entries, one a point; None where there is none."""


def prove_points(instance: Instance, task: Task, points: Sequence[Point]) -> list[Row | Proved]:
    """Return the row of each point of which all is proved, else what is proved of it.

    In the process of the FMU.
    """
    values = [task.values(point) for _, point in points]
    proved: list[dict[str, float]] = [{} for _ in points]
    for name in STATUS:
        if name in task.measures:
            found = proved_predictions(instance, name, values, task.max_denominator)
            for own, value in zip(proved, found, strict=True):
                if value is not None:
                    own[name] = value
    return [
        measure_point(instance, task, point, own) if own.keys() >= {*task.measures} else own
        for point, own in zip(points, proved, strict=True)
    ]


def measure_point(instance: Instance, task: Task, point: Point, proved: Proved) -> Row:
    """Return the row of a point, in the process of the FMU; what is `proved` is not searched.

    It depends on nothing but its arguments: neither the order of the points nor the worker shows in
    the result. After a point that fails the instance is recreated, whatever state the failure left
    it in.
    """
    number, place = point
    values = task.values(place)
    cells: list[Cell] = []
    try:
        statistics = _statistics(instance, task, values)
        for name in task.measures:
            if name in proved:
                cells += [proved[name], STATUS[name]]
            elif name in SEARCHES:
                found = SEARCHES[name](instance, values, max_denominator=task.max_denominator)
                cells += [getattr(found, name), found.status]
            else:
                cells.append(statistics[name])
        return number, cells, None
    except Exception as error:  # any error is the result of this point
        instance.recreate()
        fmu = instance.fmu.path
        text = str(error).replace(str(fmu), fmu.name)  # not where this process has unpacked it
        is_known = isinstance(error, HarnessError)
        return failed_row(task, number, text if is_known else f"{type(error).__name__}: {text}")


def failed_row(task: Task, number: int, error: str) -> Row:
    """Return the row of a point without results."""
    results = len(task.columns) - len(task.names) - 2
    return number, [None] * results, error
