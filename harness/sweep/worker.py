"""The work of one process of a sweep: points in, rows out, instances kept from chunk to chunk."""

from __future__ import annotations

import os
import signal
import tempfile
import threading
import time
from collections.abc import Sequence
from contextlib import ExitStack, suppress
from multiprocessing import parent_process
from pathlib import Path

from harness.drive import Instance, instantiate
from harness.errors import HarnessError
from harness.fmu import open_fmu
from harness.sweep.measures import Cell, Task, measure

Point = tuple[int, tuple[float, ...]]
"""Number of a point and its values."""
Row = tuple[int, list[Cell], str | None]
"""Number of a point, the cells of its measures, and its error if it failed."""

_files: dict[str, Path] = {}
_open: list[ExitStack] = []
_own = threading.local()


def register(digest: str, fmu: Path) -> None:
    """Tell this process where the FMU with this digest is."""
    _files[digest] = fmu


def enter(digest: str, fmu: str, folder: str) -> None:
    """Prepare a process of the local pool; `folder` takes what it unpacks, its owner removes it."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the owner decides what an interruption means
    tempfile.tempdir = folder
    register(digest, Path(fmu))
    threading.Thread(target=_end_with_owner, daemon=True).start()


def run_chunk(task: Task, digest: str, points: Sequence[Point]) -> tuple[list[Row], float]:
    """Return the rows of the points, and the seconds that they took.

    A point that fails has a row with its error; the instance is then made anew, whatever state
    the failure left it in.
    """
    began = time.perf_counter()
    rows = [_row(task, digest, number, values) for number, values in points]
    return rows, time.perf_counter() - began


def close() -> None:
    """Free the instances of this process and what was unpacked for them."""
    while _open:
        _open.pop().close()
    _own.__dict__.clear()


def failed_row(task: Task, number: int, error: str) -> Row:
    """Return the row of a point without results."""
    results = len(task.columns) - len(task.names) - 2
    return number, [None] * results, error


def _row(task: Task, digest: str, number: int, values: tuple[float, ...]) -> Row:
    try:
        return number, measure(_instance(digest), task, values), None
    except Exception as error:  # whatever goes wrong is the result of this point
        _forget_instance()
        path = _files.get(digest, Path())
        text = str(error).replace(str(path), path.name)  # it differs from process to process
        if not isinstance(error, HarnessError):
            text = f"{type(error).__name__}: {text}"
        return failed_row(task, number, text)


def _instance(digest: str) -> Instance:
    """Return the instance of this thread."""
    if getattr(_own, "digest", None) != digest:
        _forget_instance()
        if digest not in _files:
            raise HarnessError("this worker has not been given the FMU")
        with ExitStack() as stack:
            fmu = stack.enter_context(open_fmu(_files[digest]))
            _own.instance = stack.enter_context(instantiate(fmu))
            _own.stack = stack.pop_all()
        _own.digest = digest
        _open.append(_own.stack)
    instance: Instance = _own.instance
    return instance


def _forget_instance() -> None:
    stack: ExitStack | None = getattr(_own, "stack", None)
    _own.__dict__.clear()
    if stack is not None:
        with suppress(ValueError):
            _open.remove(stack)
        stack.close()


def _end_with_owner() -> None:
    """End this process when its owner is gone, however that ended: nobody wants its rows."""
    owner = parent_process()
    if owner is not None:
        owner.join()
        os._exit(1)
