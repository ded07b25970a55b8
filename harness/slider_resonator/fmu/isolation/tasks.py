"""Many tasks on an isolated FMU, whose process is replaced after a crash or an exceeded limit."""

from __future__ import annotations

from collections.abc import Callable, Generator, Sequence
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from time import monotonic
from typing import Any, Generic, TypeVar

from slider_resonator.errors import FmuError, HarnessError
from slider_resonator.fmu.isolation.process import FmuDied, IsolatedFmu, Task
from slider_resonator.fmu.isolation.tasks_ahead import TasksAhead

MAX_CRASHES = 3
"""Crashes after which no more tasks are run."""
ALONE = 2.0
"""Time (s) in which one process must have failed in no task before others start; short runs end
sooner."""

Item = TypeVar("Item")


@dataclass(frozen=True)
class Finished(Generic[Item]):
    """The `result` of the task of an item, or the `error` in its place.

    Without an item the error is about the FMU as a whole.
    """

    item: Item | None
    result: Any = None
    error: HarnessError | None = None


def run_tasks(
    fmu: Path,
    tasks: Sequence[tuple[Item, Task]],
    time_limit: float,
    *,
    name: Callable[[Item], str],
    meanwhile: Callable[[Item], None] = lambda item: None,
    max_crashes: int | None = MAX_CRASHES,
    jobs: int = 1,
) -> Generator[Finished[Item], None, None]:
    """Run a task for each item, and yield each outcome, in this order.

    `meanwhile` is called for an item while the FMU works on it, or has. An FMU that shows no fault
    gets up to `jobs` processes; the outcomes are those of one that runs the tasks in turn, for an
    FMU in which each run is independent of those before. After a crash or an exceeded limit
    the other items of that `name` are left out. All remaining items are left out after an exceeded
    limit of time, memory or processes, after `max_crashes` crashes, and after crashes that took
    `time_limit` (s) together; with None for `max_crashes` the run always goes on.
    """
    process: IsolatedFmu | None = None
    crashed: set[str] = set()
    crashes, wasted = 0, 0.0
    ahead = TasksAhead(fmu, [task for _, task in tasks], time_limit, jobs - 1)
    start = monotonic()
    try:
        for index, (item, task) in enumerate(tasks):
            done = ahead.result(index)
            if name(item) in crashed:
                continue
            if done is not None:
                meanwhile(item)
                yield Finished(item, done.value)
                continue
            if process is None:
                try:
                    process = IsolatedFmu(fmu, time_limit)
                except FmuError as error:
                    yield Finished(None, error=error)
                    return
            began = monotonic()
            try:
                process.submit(task)
                meanwhile(item)
                result = process.result()
            except HarnessError as error:
                ahead.stop()
                process.kill()
                process = None
                if isinstance(error, FmuDied):
                    crashed.add(name(item))
                    crashes += 1
                    wasted += time_limit if error.over_limit else monotonic() - began
                yield Finished(item, error=error)
            else:
                if monotonic() - start >= ALONE:
                    ahead.start()
                yield Finished(item, result)
            if max_crashes is not None and (crashes >= max_crashes or wasted >= time_limit):
                rest = [name(other) for other, _ in tasks[index + 1 :]]
                left_out = [one for one in dict.fromkeys(rest) if one not in crashed]
                if left_out:
                    yield Finished(None, error=_gave_up(crashes, left_out))
                return
        if process is not None:
            try:
                process.close()
            except FmuDied as error:
                yield Finished(None, error=error)
    finally:
        ahead.end()
        if process is not None:
            process.kill()


def run_all_tasks(
    fmu: Path,
    tasks: Sequence[tuple[Item, Task]],
    time_limit: float,
    *,
    name: Callable[[Item], str],
    meanwhile: Callable[[Item], None],
    outcomes: tuple[type[HarnessError], ...],
) -> Generator[tuple[Item, Any, HarnessError | None], None, None]:
    """Run a task for each item, however many crash, and yield item, result and error of each.

    Errors that are among the `outcomes` of a task are yielded, others raised: FmuError when the FMU
    cannot be run at all.
    """
    finished = run_tasks(fmu, tasks, time_limit, name=name, meanwhile=meanwhile, max_crashes=None)
    with closing(finished):
        for one in finished:
            if one.item is None:
                raise one.error or FmuError(f"{fmu}: cannot be run")
            if one.error is not None and not isinstance(one.error, outcomes):
                raise one.error
            yield one.item, one.result, one.error


def _gave_up(crashes: int, names: Sequence[str]) -> FmuError:
    many = "1 crash or exceeded limit"
    if crashes > 1:
        many = f"{crashes} crashes or exceeded limits"
    return FmuError(f"given up after {many}; not run: {', '.join(names)}")
