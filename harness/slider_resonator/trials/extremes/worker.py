"""A process of its own for the FMU, so that a hang or a crash costs one cell and not the run."""

from __future__ import annotations

import multiprocessing
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from multiprocessing.connection import Connection
from pathlib import Path

from slider_resonator.errors import FmuError, HarnessError
from slider_resonator.fmu.drive import instantiate
from slider_resonator.fmu.opening import open_fmu
from slider_resonator.trials.extremes.cell import Cell
from slider_resonator.trials.extremes.observe import Observation, observe

START_LIMIT = 120.0
"""Time, s, for a process to open the FMU."""


class Broken(Exception):
    """A cell that hung or ended the process; the message says which."""


class Worker:
    """Observes cells in a process that is replaced when it hangs or dies."""

    def __init__(self, fmu: Path, limit: float) -> None:
        self._fmu = fmu
        self._limit = limit
        self._start()

    def observe(self, cell: Cell) -> Observation:
        """Run a cell. Raises Broken, and FmuError when the FMU cannot be run at all."""
        try:
            self._pipe.send(cell)
            if not self._pipe.poll(self._limit):
                self._replace()
                raise Broken(f"hung: no answer within {self._limit:g} s")
            answer = self._pipe.recv()
        except (EOFError, OSError) as error:
            self._process.join(START_LIMIT)
            code = self._process.exitcode
            self._replace()
            raise Broken(f"crashed: the process ended with {code}") from error
        if isinstance(answer, Exception):
            raise answer
        seen: Observation = answer
        return seen

    def end(self) -> None:
        """End the process."""
        with suppress(OSError):
            self._pipe.close()
        self._process.kill()
        self._process.join()

    def _replace(self) -> None:
        self.end()
        self._start()

    def _start(self) -> None:
        context = multiprocessing.get_context("spawn")
        self._pipe, theirs = context.Pipe()
        self._process = context.Process(target=_serve, args=(self._fmu, theirs), daemon=True)
        self._process.start()
        theirs.close()
        try:
            ready = self._pipe.recv() if self._pipe.poll(START_LIMIT) else None
        except (EOFError, OSError):
            ready = None
        if isinstance(ready, Exception):
            self.end()
            raise ready
        if ready is None:
            self.end()
            raise FmuError(f"{self._fmu}: its process does not start")


@contextmanager
def working(fmu: Path, limit: float) -> Iterator[Worker]:
    """Yield a worker for an FMU, with a time limit (s) for a cell; FmuError if it is unusable."""
    worker = Worker(fmu, limit)
    try:
        yield worker
    finally:
        worker.end()


def _serve(path: Path, pipe: Connection) -> None:
    """Answer cells with observations until the pipe closes."""
    try:
        with open_fmu(path) as fmu, instantiate(fmu) as instance:
            pipe.send("ready")
            while True:
                cell: Cell = pipe.recv()
                pipe.send(observe(instance, cell))
    except EOFError:
        return
    except HarnessError as error:
        with suppress(OSError):
            pipe.send(error)
