"""The processes that run the tasks of an FMU."""

from __future__ import annotations

import os
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from threading import Event
from time import monotonic
from typing import Any, Protocol

from slider_resonator.errors import FmuError, HarnessError
from slider_resonator.fmu.isolation.process import FmuDied, IsolatedFmu, Task


def available_cores() -> int:
    """Return how many cores this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


@dataclass(frozen=True)
class Outcome:
    """The `value` of a task or the `error` in its place, and the `seconds` that it took.

    `is_open` is False where the FMU could not be opened for the task.
    """

    value: Any = None
    error: HarnessError | None = None
    seconds: float = 0.0
    is_open: bool = True


class Processes(Protocol):
    """Processes, here or elsewhere, that run tasks."""

    def submit(self, task: Task) -> Future[Outcome]:
        """Begin to run a task, or queue it."""

    def outcome(self, future: Future[Outcome]) -> Outcome:
        """Wait for the outcome of a task; HarnessError where no more can be run."""

    def close(self) -> FmuDied | None:
        """Free the FMU in each process and end them; return the first error thereby."""

    def end(self) -> None:
        """End all processes, also in the middle of a task."""


class Runner:
    """Runs tasks on an FMU; each thread that asks has a process for as long as its task takes."""

    def __init__(self, fmu: Path, time_limit: float) -> None:
        self._fmu = fmu
        self._time_limit = time_limit
        self._idle: list[IsolatedFmu] = []
        self._stop = Event()

    def run(self, task: Task) -> Outcome:
        """Run a task. After an error its process is ended: the FMU may be in any state."""
        began = monotonic()
        try:
            process = self._idle.pop()
        except IndexError:
            try:
                process = IsolatedFmu(self._fmu, self._time_limit, self._stop)
            except FmuError as error:
                return Outcome(error=error, seconds=monotonic() - began, is_open=False)
        began = monotonic()
        try:
            value = process.run(task)
        except BaseException as error:
            process.kill()
            if not isinstance(error, HarnessError):
                raise
            return Outcome(error=error, seconds=monotonic() - began)
        self._idle.append(process)
        return Outcome(value, seconds=monotonic() - began)

    def close(self) -> FmuDied | None:
        """Free the FMU in each idle process and end it; return the first error thereby."""
        first = None
        while self._idle:
            try:
                self._idle.pop().close()
            except FmuDied as error:
                first = first or error
        return first

    def stop(self) -> None:
        """Give up the tasks at work."""
        self._stop.set()

    def end(self) -> None:
        """End the idle processes."""
        while self._idle:
            self._idle.pop().kill()


class LocalProcesses:
    """Up to `count` processes on this machine, one for each thread that runs tasks."""

    def __init__(self, fmu: Path, time_limit: float, count: int) -> None:
        self._runner = Runner(fmu, time_limit)
        self._threads = ThreadPoolExecutor(count)

    def submit(self, task: Task) -> Future[Outcome]:
        """Begin to run a task, or queue it."""
        return self._threads.submit(self._runner.run, task)

    def outcome(self, future: Future[Outcome]) -> Outcome:
        """Wait for the outcome of a task."""
        return future.result()

    def close(self) -> FmuDied | None:
        """Free the FMU in each process and end them; return the first error thereby."""
        self._threads.shutdown()
        return self._runner.close()

    def end(self) -> None:
        """End all processes, also in the middle of a task."""
        self._runner.stop()
        self._threads.shutdown(cancel_futures=True)
        self._runner.end()
