"""Many tasks on an isolated FMU, in processes that are replaced after crashes or missed limits."""

import os
from collections import deque
from collections.abc import Callable, Generator, Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor, wait
from contextlib import AbstractContextManager
from pathlib import Path
from threading import Event
from typing import Protocol, TypeVar

from slider_resonator.errors import FmuError, HarnessError
from slider_resonator.fmu.isolation.process import FmuDied, IsolatedFmu, Outcome, Task


def available_cores() -> int:
    """Return how many cores this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


class Processes(Protocol):
    """Processes that run tasks, here or elsewhere: `count` of them."""

    count: int

    def submit(self, task: Task) -> Future[Outcome]:
        """Begin to run a task, or queue it."""

    def outcome(self, future: Future[Outcome]) -> Outcome:
        """Wait for the outcome of a task; FmuError where the FMU cannot be opened for it."""


class LocalProcesses(AbstractContextManager["LocalProcesses"]):
    """Up to `count` processes on this machine, one for each thread that runs tasks.

    Use it in a `with` block, at whose end the FMU is freed in each process, with FmuDied where that
    fails, or call `end`.
    """

    def __init__(self, fmu: Path | None, time_limit: float, count: int = 1) -> None:
        self.count = count
        self._fmu = fmu
        self._time_limit = time_limit
        self._idle: list[IsolatedFmu] = []
        self._stop = Event()
        self._threads = ThreadPoolExecutor(count)

    def __exit__(self, kind: object, error: BaseException | None, trace: object) -> None:
        """End all processes, at once after an error."""
        try:
            if error is None:
                self._threads.shutdown()
                while self._idle:
                    self._idle.pop().close()
        finally:
            self.end()

    def submit(self, task: Task) -> Future[Outcome]:
        """Begin to run a task, or queue it."""
        return self._threads.submit(self.run, task)

    def outcome(self, future: Future[Outcome]) -> Outcome:
        """Wait for the outcome of a task; raises as `run` does."""
        return future.result()

    def run(self, task: Task) -> Outcome:
        """Run a task; after an error its process is ended: the FMU may be in any state.

        Raises FmuError where the FMU cannot be opened.
        """
        try:
            process = self._idle.pop()
        except IndexError:
            process = IsolatedFmu(self._fmu, self._time_limit, self._stop)
        try:
            value = process.run(task)
        except BaseException as error:
            process.kill()
            if not isinstance(error, HarnessError):
                raise
            return Outcome(error=error)
        self._idle.append(process)
        return Outcome(value)

    def end(self) -> None:
        """End all processes, also in the middle of a task."""
        self._stop.set()
        self._threads.shutdown(cancel_futures=True)
        while self._idle:
            self._idle.pop().kill()


MAX_CRASHES = 3
"""Crashes after which no more tasks are run."""
QUEUED = 4
"""Tasks submitted for each process, so that none waits for a long one of another."""

Item = TypeVar("Item")


def run_tasks(
    fmu: Path,
    tasks: Sequence[tuple[Item, Task]],
    time_limit: float,
    *,
    name: Callable[[Item], str],
    jobs: int = 1,
) -> Generator[tuple[Item | None, Outcome], None, None]:
    """Run a task for each item in up to `jobs` processes; yield item and outcome, in this order.

    After a crash or an exceeded limit the other items of that `name` are left out. All remaining
    items are left out after an exceeded limit of time, memory or processes, and after `MAX_CRASHES`
    crashes. An outcome without an item has an error of the FMU as a whole.
    """
    crashed, finished = set[str](), set[str]()
    try:
        with LocalProcesses(fmu, time_limit, jobs) as processes:
            for item, outcome in run_all_tasks(processes, tasks, lambda one: name(one) in crashed):
                yield item, outcome
                finished.add(name(item))
                if not isinstance(outcome.error, FmuDied):
                    continue
                crashed.add(name(item))
                if len(crashed) >= MAX_CRASHES or outcome.error.over_limit:
                    processes.end()
                    names = dict.fromkeys(name(one) for one, _ in tasks)
                    if not_run := [one for one in names if one not in finished]:
                        ended = ", ".join(sorted(crashed))
                        why = f"given up after crashes or exceeded limits in {ended}"
                        raise FmuError(f"{why}; not run: {', '.join(not_run)}")
                    return
    except FmuError as error:
        yield None, Outcome(error=error)


def run_all_tasks(
    processes: Processes,
    tasks: Sequence[tuple[Item, Task]],
    is_left_out: Callable[[Item], bool] = lambda item: False,
) -> Iterator[tuple[Item, Outcome]]:
    """Run a task for each item, however many crash; yield item and outcome, in this order.

    A deque of `tasks` is emptied, and may get more of them while outcomes are taken. Items that are
    left out by then are not run. Raises FmuError when the FMU cannot be opened: the first task
    shows it; from then on there are `QUEUED` tasks for each process.
    """
    waiting = tasks if isinstance(tasks, deque) else deque(tasks)
    submitted: deque[tuple[Item, Task, Future[Outcome]]] = deque()
    count, has_opened = processes.count, False
    while True:
        while waiting and len(submitted) < (QUEUED * count if has_opened else 1):
            item, task = waiting.popleft()
            if not is_left_out(item):
                submitted.append((item, task, processes.submit(task)))
        if not submitted:
            return
        item, task, future = submitted.popleft()
        if is_left_out(item):
            future.cancel()
            continue
        try:
            outcome = processes.outcome(future)
        except FmuError:
            if not has_opened:
                raise
            # It may open in fewer processes only, as with one licence.
            count = 1
            wait(other for _, _, other in submitted)
            outcome = processes.outcome(processes.submit(task))
        yield item, outcome
        has_opened = True
