"""Hands the points of a sweep to processes of the FMU, and keeps what they return."""

from collections.abc import Callable, Sequence
from functools import partial

from slider_resonator.errors import HarnessError
from slider_resonator.fmu.isolation.process import FmuDied
from slider_resonator.fmu.isolation.tasks import Processes, run_all_tasks
from slider_resonator.sweeping.measures import (
    SEARCHED,
    Point,
    Proved,
    Row,
    Task,
    failed_row,
    measure_point,
    prove_points,
    proved_row,
)

BATCH = 200
"""Points whose predictions are proved in one task."""
ATTEMPTS = 3
"""Processes that may die at a point before it counts as the cause."""

Keep = Callable[[Sequence[Row]], None]
"""Called with rows as they come, in any order."""


def run_points(processes: Processes, task: Task, points: Sequence[Point], keep: Keep) -> None:
    """Compute all points.

    What the FMU predicts is proved in batches; what remains is measured point by point. A point
    that exceeds a limit, or at which processes keep dying, has an error as its row. Raises FmuError
    when the FMU cannot be used.
    """
    left: list[tuple[Point, Proved]] = []
    unproved = list(points)
    if any(name in SEARCHED for name in task.measures):
        for _ in range(ATTEMPTS):
            more, unproved = _prove(processes, task, unproved, keep)
            left += more
    left += [(point, {}) for point in unproved]
    for attempt in range(ATTEMPTS):
        left = _measure(processes, task, left, keep, is_last=attempt == ATTEMPTS - 1)


def _prove(
    processes: Processes, task: Task, points: Sequence[Point], keep: Keep
) -> tuple[list[tuple[Point, Proved]], list[Point]]:
    """Keep the rows of batches; return what is proved of points without, and those of lost batches.

    A batch is lost where its process ends, which need not be its fault.
    """
    batches = [tuple(points[first : first + BATCH]) for first in range(0, len(points), BATCH)]
    tasks = [(batch, partial(prove_points, task=task, points=batch)) for batch in batches]
    left: list[tuple[Point, Proved]] = []
    lost: list[Point] = []
    for batch, outcome in run_all_tasks(processes, tasks, outcomes=(HarnessError,)):
        error = outcome.error
        if isinstance(error, FmuDied) and not error.over_limit:
            lost += batch
            continue
        proofs = outcome.value if error is None else [{}] * len(batch)
        done = []
        for point, proved in zip(batch, proofs, strict=True):
            row = proved_row(task, point, proved)
            if row is None:
                left.append((point, proved))
            else:
                done.append(row)
        keep(done)
    return left, lost


def _measure(
    processes: Processes,
    task: Task,
    points: Sequence[tuple[Point, Proved]],
    keep: Keep,
    *,
    is_last: bool,
) -> list[tuple[Point, Proved]]:
    """Keep the row of each point, and return those at which a process died, unless `is_last`."""
    measure = partial(measure_point, task=task)
    tasks = [(one, partial(measure, point=one[0], proved=one[1])) for one in points]
    died: list[tuple[Point, Proved]] = []
    for one, outcome in run_all_tasks(processes, tasks, outcomes=(HarnessError,)):
        error = outcome.error
        if isinstance(error, FmuDied) and not error.over_limit and not is_last:
            died.append(one)
        else:
            keep([outcome.value if error is None else failed_row(task, one[0][0], str(error))])
    return died
