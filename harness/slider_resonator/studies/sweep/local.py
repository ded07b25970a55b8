"""A pool of processes on this machine."""

from __future__ import annotations

import multiprocessing
import os
import tempfile
from collections.abc import Iterator, Sequence
from concurrent.futures import Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from pathlib import Path

from slider_resonator.studies.sweep.measures import Task
from slider_resonator.studies.sweep.running import Rows
from slider_resonator.studies.sweep.worker import Point, enter, run_chunk


def available_cores() -> int:
    """Return how many cores this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


class LocalWorkers:
    """Worker processes that are replaced when one of them dies."""

    losses: tuple[type[BaseException], ...] = (BrokenProcessPool,)
    attempts = 3

    def __init__(self, task: Task, digest: str, fmu: Path, count: int, folder: str) -> None:
        self.task = task
        self.digest = digest
        self.arguments = (digest, str(fmu.resolve()), folder)
        self.count = count
        self._pool = self._new_pool()

    def submit(self, points: Sequence[Point]) -> Future[Rows]:
        """Begin to compute a chunk."""
        return self._pool.submit(run_chunk, self.task, self.digest, points)

    def replace_lost(self) -> None:
        """Start new processes."""
        self.end()
        self._pool = self._new_pool()

    def end(self) -> None:
        """End the processes after what they are at."""
        self._pool.shutdown(cancel_futures=True)

    def _new_pool(self) -> ProcessPoolExecutor:
        # Not forked: a process that has threads, as those of a pool and of numpy, must not be.
        context = multiprocessing.get_context("spawn")
        return ProcessPoolExecutor(self.count, context, enter, self.arguments)


@contextmanager
def local_workers(task: Task, digest: str, fmu: Path, count: int) -> Iterator[LocalWorkers]:
    """Yield `count` processes for the length of the block."""
    with tempfile.TemporaryDirectory(
        prefix="slider-resonator-sweep-", ignore_cleanup_errors=True
    ) as folder:
        workers = LocalWorkers(task, digest, fmu, count, folder)
        try:
            yield workers
        finally:
            workers.end()
