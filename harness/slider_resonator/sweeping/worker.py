"""The work of a sweep in the process of the FMU: points in, rows out."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from slider_resonator.errors import HarnessError
from slider_resonator.fmu.instance import Instance
from slider_resonator.steady.proved_predictions import QUANTITIES, proved_predictions
from slider_resonator.sweeping.measures import STATUS, Cell, Task, measure

Point = tuple[int, tuple[float, ...]]
"""Number of a point and its values."""
Row = tuple[int, list[Cell], str | None]
"""Number of a point, the cells of its measures, and its error if it failed."""
Proved = Mapping[str, float]
"""Measure to its value, of those that need no search."""


FEW = 10
"""Points left of a batch that are searched with it: another process would take longer to start."""


def prove_points(instance: Instance, task: Task, points: Sequence[Point]) -> Sequence[Row | Proved]:
    """Return a row for each point that is proved, for others what is proved.

    Where few are left and need no run, they are searched, too.
    """
    done: list[Row | Proved] = [
        _proved_row(task, point, proved) or proved
        for point, proved in zip(points, _proved(instance, task, points), strict=True)
    ]
    left = [index for index, one in enumerate(done) if not isinstance(one, tuple)]
    if len(left) <= FEW and all(name in QUANTITIES for name in task.measures):
        for index in left:
            done[index] = measure_point(instance, task, points[index], {})
    return done


def _proved(instance: Instance, task: Task, points: Sequence[Point]) -> Sequence[Proved]:
    values = [task.values(point) for _, point in points]
    proved: list[dict[str, float]] = [{} for _ in points]
    for name in QUANTITIES:
        if name in task.measures:
            found = proved_predictions(instance, name, values, task.max_denominator)
            for own, value in zip(proved, found, strict=True):
                if value is not None:
                    own[name] = value
    return proved


def measure_point(instance: Instance, task: Task, point: Point, proved: Proved) -> Row:
    """Return the row of a point, in the process of the FMU.

    After a point that fails the instance is recreated, whatever state the failure left it in.
    """
    number, values = point
    try:
        return number, measure(instance, task, values, proved), None
    except Exception as error:  # any error is the result of this point
        instance.recreate()
        return failed_row(task, number, _text(error, instance.fmu.path))


def _proved_row(task: Task, point: Point, proved: Proved) -> Row | None:
    """Return the row of a point of which all is proved, None where some is to be measured."""
    try:
        found = [(proved[name], STATUS[name]) for name in task.measures]
    except KeyError:
        return None
    return point[0], [cell for pair in found for cell in pair], None


def failed_row(task: Task, number: int, error: str) -> Row:
    """Return the row of a point without results."""
    results = len(task.columns) - len(task.names) - 2
    return number, [None] * results, error


def _text(error: Exception, fmu: Path) -> str:
    """Return a message without the folder of the FMU in this process."""
    text = str(error).replace(str(fmu), fmu.name)
    return text if isinstance(error, HarnessError) else f"{type(error).__name__}: {text}"
