"""The process that forks trials.

`python -m studies.mutants.trial_server FILE` loads the `Bench` pickled in FILE, and
all that a trial needs, once. Then it forks a process for each pickled `Attempt` that it reads from
its standard input and writes the `Attempted`, or an exception, to its standard output. Python, its
modules and the references take longer to load than most scenes take to run. SIGTERM ends it, and
the attempt at work.
"""

from __future__ import annotations

import gc
import mmap
import os
import pickle
import select
import signal
import sys
import time
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

from slider_resonator.fmu.opening import Fmu, open_fmu
from slider_resonator.output.temporary import temporary_folder
from studies.mutants.attempt import Attempt, Attempted, Bench
from studies.mutants.trial import Rejection
from studies.mutants.trial_child import run_in_child
from studies.mutants.variant_folder import VariantFolder

PATIENCE = 10.0
"""Wall time that a point may take over the limit of its CPU time: the machine may be busy."""
_POLL = 0.5
"""Interval (s) at which the wall time of a trial is looked at."""


def main() -> None:
    """Serve attempts until there are no more."""
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))
    requests, answers = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    nothing = os.open(os.devnull, os.O_RDWR)
    for stream in (0, 1, 2):
        os.dup2(nothing, stream)
    with Path(sys.argv[1]).open("rb") as file:
        bench: Bench = pickle.load(file)
    with open_fmu(bench.fmu) as fmu, temporary_folder() as where:
        variant = VariantFolder(fmu.folder)
        os.chdir(where)
        gc.freeze()  # what is loaded stays shared with the forked processes
        while True:
            try:
                attempt: Attempt = pickle.load(requests)
            except EOFError:
                return
            with variant.having(attempt.changed):
                found = forked(bench, attempt, fmu)
            pickle.dump(found, answers)
            answers.flush()


def forked(bench: Bench, attempt: Attempt, fmu: Fmu) -> Attempted | Exception:
    """Run an attempt in a forked process and return its answer, or how it ended without one."""
    at_work = _SharedPoint()
    answer, writable = os.pipe()
    child = os.fork()
    if child == 0:
        signal.signal(signal.SIGTERM, signal.SIG_DFL)
        os.close(answer)
        run_in_child(bench, attempt, fmu, writable, at_work.set)
    os.close(writable)
    try:
        content = _received(answer, at_work, PATIENCE * bench.time_limit)
    finally:
        with suppress(ProcessLookupError):  # the group, with all that the FMU has started
            os.killpg(child, signal.SIGKILL)
        with suppress(ProcessLookupError):
            os.kill(child, signal.SIGKILL)
    _, status, usage = os.wait4(child, 0)
    cpu_time = usage.ru_utime + usage.ru_stime
    if content:
        found: Attempted | Exception = pickle.loads(content)
        return replace(found, cpu_time=cpu_time) if isinstance(found, Attempted) else found
    number = at_work.get()
    where = "" if number is None else bench.points[number].name
    reason = "no answer within the time limit" if content is None else _ending(status)
    return Attempted(Rejection(where, "", reason), number, {}, cpu_time)


class _SharedPoint:
    """The number of a point, which a forked process sets and its parent reads."""

    def __init__(self) -> None:
        self._memory = mmap.mmap(-1, 8)

    def set(self, number: int) -> None:
        self._memory[:] = (number + 1).to_bytes(8, "little")

    def get(self) -> int | None:
        number = int.from_bytes(self._memory[:], "little")
        return number - 1 if number else None


def _received(answer: int, at_work: _SharedPoint, time_limit: float) -> bytes | None:
    """Return what a child sends before it ends; None when a point takes too long."""
    parts: list[bytes] = []
    point, began = at_work.get(), time.monotonic()
    with os.fdopen(answer, "rb", buffering=0) as file:
        while True:
            if select.select([file], [], [], _POLL)[0]:
                part = file.read(2**20)
                if not part:
                    return b"".join(parts)
                parts.append(part)
            elif at_work.get() != point:
                point, began = at_work.get(), time.monotonic()
            elif time.monotonic() - began > time_limit:
                return None


def _ending(status: int) -> str:
    code = os.waitstatus_to_exitcode(status)
    if code == -signal.SIGPROF:
        return "no answer within the limit of CPU time"
    return f"the FMU crashed: {signal.Signals(-code).name if code < 0 else f'exit code {code}'}"


if __name__ == "__main__":
    main()
