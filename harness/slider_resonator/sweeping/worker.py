"""The work of a sweep: points in, rows out, by an isolated FMU for each thread."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator, Sequence
from functools import partial
from pathlib import Path

from slider_resonator.errors import FmuError, HarnessError
from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.isolation.process import FmuDied, IsolatedFmu
from slider_resonator.sweeping.measures import Cell, Task, measure

TIME_LIMIT = 120.0
"""Default time limit of a point, s."""

Point = tuple[int, tuple[float, ...]]
"""Number of a point and its values."""
Row = tuple[int, list[Cell], str | None]
"""Number of a point, the cells of its measures, and its error if it failed."""
Rows = tuple[list[Row], float]
"""Rows of a chunk and the seconds that they took."""


class ChunkRunner:
    """Computes chunks of points; every thread that asks has a process of its own for the FMU."""

    def __init__(self, fmu: Path, time_limit: float = TIME_LIMIT) -> None:
        self.fmu = fmu
        self.time_limit = time_limit
        self._own = threading.local()
        self._processes: list[IsolatedFmu] = []

    def run(self, task: Task, points: Sequence[Point]) -> Rows:
        """Return the rows of the points; a point that fails has a row with its error.

        So has one that exceeds a limit of time, memory or processes. Raises FmuDied when the FMU
        ended its process otherwise; the next chunk gets a new one.
        """
        rows: list[Row] = []
        seconds = 0.0
        while len(rows) < len(points):
            left = points[len(rows) :]
            try:
                isolated = self._isolated()
            except FmuDied:
                raise
            except FmuError as error:
                text = _text(error, self.fmu)
                return [*rows, *(failed_row(task, number, text) for number, _ in left)], seconds
            try:
                for row, taken in self._results(isolated, task, left):
                    rows.append(row)
                    seconds += taken
            except FmuDied as error:
                if not error.over_limit:
                    raise
                rows.append(failed_row(task, points[len(rows)][0], str(error)))
                seconds += self.time_limit
        return rows, seconds

    def _results(
        self, isolated: IsolatedFmu, task: Task, points: Sequence[Point]
    ) -> Iterator[tuple[Row, float]]:
        """Yield the row of each point and the seconds that it took; end the process on an error."""
        try:
            for point in points:
                isolated.submit(partial(measure_point, task=task, point=point))
            for _ in points:
                yield isolated.result()
        except BaseException:
            isolated.kill()
            self._processes = [one for one in self._processes if one is not isolated]
            raise

    def end(self) -> None:
        """End all processes, also in the middle of a chunk."""
        processes, self._processes = self._processes, []
        for isolated in processes:
            isolated.kill()

    def _isolated(self) -> IsolatedFmu:
        isolated: IsolatedFmu | None = getattr(self._own, "isolated", None)
        if isolated is None or isolated not in self._processes:
            isolated = self._own.isolated = IsolatedFmu(self.fmu, self.time_limit)
            self._processes.append(isolated)
        return isolated


def measure_point(instance: Instance, task: Task, point: Point) -> tuple[Row, float]:
    """Return the row of a point and the seconds that it took, in the process of the FMU.

    After a point that fails the instance is recreated, whatever state the failure left it in.
    """
    began = time.perf_counter()
    row = _row(instance, task, *point)
    return row, time.perf_counter() - began


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
