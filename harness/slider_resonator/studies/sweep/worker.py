"""The work of one process of a sweep: points in, rows out, instances kept from chunk to chunk."""

from __future__ import annotations

import os
import signal
import tempfile
import threading
import time
from collections.abc import Sequence
from contextlib import ExitStack, suppress
from dataclasses import dataclass
from multiprocessing import parent_process
from pathlib import Path

from slider_resonator.errors import HarnessError
from slider_resonator.fmu.instance import Instance, instantiate
from slider_resonator.fmu.opening import open_fmu
from slider_resonator.studies.sweep.measures import Cell, Task, measure

Point = tuple[int, tuple[float, ...]]
"""Number of a point and its values."""
Row = tuple[int, list[Cell], str | None]
"""Number of a point, the cells of its measures, and its error if it failed."""


@dataclass(frozen=True, eq=False)
class _Opened:
    """The instance of a thread; `stack` frees it, which waits for the `lock` of a point at work."""

    digest: str
    instance: Instance
    stack: ExitStack
    lock: threading.Lock


_files: dict[str, Path] = {}
_open: list[_Opened] = []
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
    """Free the instances of all threads and what was unpacked for them."""
    while _open:
        opened = _open.pop()
        with opened.lock:
            opened.stack.close()


def failed_row(task: Task, number: int, error: str) -> Row:
    """Return the row of a point without results."""
    results = len(task.columns) - len(task.names) - 2
    return number, [None] * results, error


def _row(task: Task, digest: str, number: int, values: tuple[float, ...]) -> Row:
    try:
        opened = _opened(digest)
        with opened.lock:
            if opened not in _open:
                raise HarnessError("this worker has been closed")
            return number, measure(opened.instance, task, values), None
    except Exception as error:  # whatever goes wrong is the result of this point
        _forget_instance()
        path = _files.get(digest, Path())
        text = str(error).replace(str(path), path.name)  # it differs from process to process
        if not isinstance(error, HarnessError):
            text = f"{type(error).__name__}: {text}"
        return failed_row(task, number, text)


def _opened(digest: str) -> _Opened:
    """Return the instance of this thread, which another thread may have closed meanwhile."""
    opened: _Opened | None = getattr(_own, "opened", None)
    if opened is not None and opened.digest == digest and opened in _open:
        return opened
    _forget_instance()
    if digest not in _files:
        raise HarnessError("this worker has not been given the FMU")
    with ExitStack() as stack:
        fmu = stack.enter_context(open_fmu(_files[digest]))
        instance = stack.enter_context(instantiate(fmu))
        opened = _Opened(digest, instance, stack.pop_all(), threading.Lock())
    _own.opened = opened
    _open.append(opened)
    return opened


def _forget_instance() -> None:
    opened: _Opened | None = getattr(_own, "opened", None)
    _own.__dict__.clear()
    if opened is not None:
        with suppress(ValueError):
            _open.remove(opened)
        with opened.lock:
            opened.stack.close()


def _end_with_owner() -> None:
    """End this process when its owner is gone, however that ended: nobody wants its rows."""
    owner = parent_process()
    if owner is not None:
        owner.join()
        os._exit(1)
