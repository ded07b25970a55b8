"""Workers on this machine: threads, each with a process for the FMU."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path

from slider_resonator.errors import FmuError
from slider_resonator.sweeping.measures import Task
from slider_resonator.sweeping.worker import ChunkRunner, Point, Rows


def available_cores() -> int:
    """Return how many cores this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


class LocalWorkers:
    """`count` processes; one that dies is replaced for the next chunk of its thread."""

    losses: tuple[type[BaseException], ...] = (FmuError,)
    attempts = 3

    def __init__(self, task: Task, fmu: Path, count: int, time_limit: float) -> None:
        self.task = task
        self.count = count
        self._runner = ChunkRunner(fmu.resolve(), time_limit)
        self._threads = ThreadPoolExecutor(count)

    def submit(self, points: Sequence[Point]) -> Future[Rows]:
        """Begin to compute a chunk."""
        return self._threads.submit(self._runner.run, self.task, points)

    def replace_lost(self) -> None:
        """Do nothing: a process is replaced when it is needed."""

    def end(self) -> None:
        """End the processes, also in the middle of a chunk."""
        self._threads.shutdown(wait=False, cancel_futures=True)
        self._runner.end()
        self._threads.shutdown()
        self._runner.end()  # what a thread had just started


@contextmanager
def local_workers(task: Task, fmu: Path, count: int, time_limit: float) -> Iterator[LocalWorkers]:
    """Yield `count` processes for the length of the block; `time_limit` (s) is that of a point."""
    workers = LocalWorkers(task, fmu, count, time_limit)
    try:
        yield workers
    finally:
        workers.end()
