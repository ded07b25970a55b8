"""Hands the points of a sweep to processes of the FMU, and keeps what they return."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import closing
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from slider_resonator.errors import HarnessError
from slider_resonator.fmu.isolation.process import FmuDied
from slider_resonator.fmu.isolation.tasks import Processes, run_all_tasks
from slider_resonator.sweeping.measures import (
    SEARCHED,
    Point,
    Row,
    Task,
    failed_row,
    measure_points,
)

BATCH = 100
"""Points of a task, at most, where none needs a run: they take less time than to hand them over."""
BATCHES_PER_JOB = 4
ATTEMPTS = 3
"""Processes that may die at a point before it counts as the cause."""

Keep = Callable[[Sequence[Row]], None]
"""Called with rows as they come, in any order."""


@dataclass(frozen=True)
class Workers:
    """Processes of an FMU for a sweep: `jobs` of them, by `processes` where they are elsewhere.

    `time_limit` (s) is that of a point.
    """

    fmu: Path
    time_limit: float
    jobs: int
    processes: Callable[[], Processes | None] = lambda: None


def run_points(workers: Workers, task: Task, points: Sequence[Point], keep: Keep) -> None:
    """Compute all points.

    The points of a batch that fails are measured again, one by one. A point that exceeds a limit,
    or at which processes keep dying, has an error as its row. Raises FmuError when the FMU cannot
    be used.
    """
    size, left = 1, list(points)
    if all(name in SEARCHED for name in task.measures):
        size = max(1, min(BATCH, len(left) // (BATCHES_PER_JOB * workers.jobs)))
    for attempt in range(ATTEMPTS):
        batches = [tuple(left[first : first + size]) for first in range(0, len(left), size)]
        tasks = [(batch, partial(measure_points, task=task, points=batch)) for batch in batches]
        left, size = [], 1
        finished = run_all_tasks(
            workers.fmu,
            tasks,
            workers.time_limit,
            outcomes=(HarnessError,),
            jobs=workers.jobs,
            processes=workers.processes(),
        )
        with closing(finished) as outcomes:
            for batch, rows, error in outcomes:
                died = isinstance(error, FmuDied) and not error.over_limit
                if error is None:
                    keep(rows)
                elif attempt < ATTEMPTS - 1 and (died or len(batch) > 1):
                    left += batch
                else:
                    keep([failed_row(task, number, str(error)) for number, _ in batch])
