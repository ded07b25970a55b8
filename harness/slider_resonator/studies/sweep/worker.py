"""The work of a sweep: points in, rows out, by an isolated FMU for each thread."""

from __future__ import annotations

import threading
import time
from collections.abc import Sequence
from functools import partial
from pathlib import Path

from slider_resonator.errors import FmuError, HarnessError
from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.isolation.process import FmuDied, IsolatedFmu
from slider_resonator.studies.sweep.measures import Cell, Task, measure

TIME_LIMIT = 600.0
"""Time limit of a chunk, s; a chunk is sized to take a fraction of a second."""

Point = tuple[int, tuple[float, ...]]
"""Number of a point and its values."""
Row = tuple[int, list[Cell], str | None]
"""Number of a point, the cells of its measures, and its error if it failed."""
Rows = tuple[list[Row], float]
"""Rows of a chunk and the seconds that they took."""


class ChunkRunner:
    """Computes chunks of points; every thread that asks has a process of its own for the FMU."""

    def __init__(self, fmu: Path) -> None:
        self.fmu = fmu
        self._own = threading.local()
        self._processes: list[IsolatedFmu] = []

    def run(self, task: Task, points: Sequence[Point]) -> Rows:
        """Return the rows of the points; a point that fails has a row with its error.

        Raises FmuDied when the FMU ended its process; the next chunk gets a new one.
        """
        try:
            isolated = self._isolated()
        except FmuDied:
            raise
        except FmuError as error:
            text = _text(error, self.fmu)
            return [failed_row(task, number, text) for number, _ in points], 0.0
        try:
            rows: Rows = isolated.run(partial(measure_points, task=task, points=points))
        except BaseException:
            isolated.kill()
            self._processes = [one for one in self._processes if one is not isolated]
            raise
        return rows

    def end(self) -> None:
        """End all processes, also in the middle of a chunk."""
        processes, self._processes = self._processes, []
        for isolated in processes:
            isolated.kill()

    def _isolated(self) -> IsolatedFmu:
        isolated: IsolatedFmu | None = getattr(self._own, "isolated", None)
        if isolated is None or isolated not in self._processes:
            isolated = self._own.isolated = IsolatedFmu(self.fmu, TIME_LIMIT)
            self._processes.append(isolated)
        return isolated


def measure_points(instance: Instance, task: Task, points: Sequence[Point]) -> Rows:
    """Return the rows of the points, in the process of the FMU.

    After a point that fails the instance is recreated, whatever state the failure left it in.
    """
    began = time.perf_counter()
    rows = [_row(instance, task, number, values) for number, values in points]
    return rows, time.perf_counter() - began


def failed_row(task: Task, number: int, error: str) -> Row:
    """Return the row of a point without results."""
    results = len(task.columns) - len(task.names) - 2
    return number, [None] * results, error


def _row(instance: Instance, task: Task, number: int, values: tuple[float, ...]) -> Row:
    try:
        return number, measure(instance, task, values), None
    except Exception as error:  # any error is the result of this point
        instance.recreate()
        return failed_row(task, number, _text(error, instance.fmu.path))


def _text(error: Exception, fmu: Path) -> str:
    """Return a message without the folder of the FMU in this process."""
    text = str(error).replace(str(fmu), fmu.name)
    return text if isinstance(error, HarnessError) else f"{type(error).__name__}: {text}"
