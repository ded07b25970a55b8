"""Results of tasks that further processes of an FMU have computed ahead of their turn."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import Future
from pathlib import Path
from threading import Event, Lock, Thread

from slider_resonator.errors import FmuError
from slider_resonator.fmu.isolation.messages import Result
from slider_resonator.fmu.isolation.process import IsolatedFmu, Task


class TasksAhead:
    """Runs tasks from the last one backwards, each on one of `processes`, for a caller that runs
    them from the first one forwards.

    Only results count. A process in which a task fails ends for good, and the caller runs that task
    in its turn: whatever the FMU does wrong is seen and counted there, as without these processes.
    """

    def __init__(self, fmu: Path, tasks: Sequence[Task], time_limit: float, processes: int) -> None:
        self._fmu = fmu
        self._tasks = tasks
        self._time_limit = time_limit
        self._lock = Lock()
        self._first = 0  # that the caller has not come to
        self._taken: dict[int, Future[Result | None]] = {}
        self._stopped = Event()
        self._threads = [Thread(target=self._run) for _ in range(processes)]

    def start(self) -> None:
        """Start the processes, unless they have been started or stopped."""
        if not self._stopped.is_set():
            for thread in self._threads:
                if thread.ident is None:
                    thread.start()

    def stop(self) -> None:
        """Take no more tasks, and soon give up those at work; the results so far stay."""
        self._stopped.set()

    def end(self) -> None:
        """Stop, and wait until the processes have ended."""
        self.stop()
        for thread in self._threads:
            if thread.ident is not None:
                thread.join()

    def result(self, index: int) -> Result | None:
        """Return the result of the caller's next task, None where the caller has to run it.

        Waits for a task that is at work.
        """
        with self._lock:
            self._first = index + 1
            future = self._taken.get(index)
        return None if future is None else future.result()

    def _take(self) -> int | None:
        """Return the last task that nobody has run, None where the caller has come to it."""
        with self._lock:
            index = min(self._taken, default=len(self._tasks)) - 1
            if self._stopped.is_set() or index < self._first:
                return None
            self._taken[index] = Future()
            return index

    def _run(self) -> None:
        try:
            process = IsolatedFmu(self._fmu, self._time_limit, self._stopped)
        except FmuError:
            return
        try:
            while (index := self._take()) is not None:
                result = None
                try:
                    result = Result(process.run(self._tasks[index]))
                except Exception:
                    return
                finally:
                    self._taken[index].set_result(result)
        finally:
            process.kill()
