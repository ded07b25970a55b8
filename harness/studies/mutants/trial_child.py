"""A trial within its own process, which ends with it."""

from __future__ import annotations

import os
import pickle
import resource
import signal
import sys
import traceback
from collections.abc import Callable
from typing import NoReturn

from slider_resonator.checks.fmu_side import FmuSide
from slider_resonator.errors import FmuError, HarnessError, NotApplicable
from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.opening import Fmu
from studies.mutants.attempt import Attempt, Attempted, Bench
from studies.mutants.reach import Place, forget_noted, noted_places
from studies.mutants.trial import (
    Rejection,
    judge,
    observe,
    observe_expected,
)

MIN_CPU_TIME = 3.0
SLOWER = 20.0
"""CPU time (s) that a point may take in any case, and that it may take over the original's."""
MAX_MEMORY = 2**31
"""Maximum data (bytes) of the process."""


def run_in_child(
    bench: Bench, attempt: Attempt, fmu: Fmu, answer: int, at_work: Callable[[int], None]
) -> NoReturn:
    """Run an attempt, write the pickled `Attempted`, or an exception, to `answer`, and exit.

    `at_work` is called with each point before it begins.
    """
    found: Attempted | Exception
    try:
        os.setpgid(0, 0)
        resource.setrlimit(resource.RLIMIT_DATA, (MAX_MEMORY, MAX_MEMORY))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        sys.dont_write_bytecode = True
        found = _attempted(bench, attempt, fmu, at_work)
    except BaseException:  # of the harness: the caller raises it
        found = RuntimeError(f"a trial failed:\n{traceback.format_exc()}")
    with os.fdopen(answer, "wb") as file:
        pickle.dump(found, file)
    os._exit(0)


def _attempted(
    bench: Bench, attempt: Attempt, fmu: Fmu, at_work: Callable[[int], None]
) -> Attempted:
    executed: dict[int, frozenset[Place]] = {}
    _limit_cpu_time(bench.time_limit)
    try:
        instance = Instance(fmu)
    except FmuError as error:
        return Attempted(Rejection("", "", str(error)))
    for number in attempt.points:
        point = bench.points[number]
        at_work(number)
        _limit_cpu_time(min(bench.time_limit, MIN_CPU_TIME + SLOWER * bench.costs[number]))
        if attempt.noting:
            forget_noted()
        measure = observe if point.outputs else observe_expected
        try:
            rejection = judge(point, measure(FmuSide(instance, point.scene)))
        except NotApplicable:
            instance.recreate()
            continue
        except HarnessError as error:
            return Attempted(Rejection(point.name, "", str(error)), number, executed)
        if rejection is not None:
            return Attempted(rejection, number, executed)
        if attempt.noting:
            executed[number] = noted_places()
    instance.end()
    return Attempted(None, None, executed)


def _limit_cpu_time(seconds: float) -> None:
    """End this process by SIGPROF after some seconds of CPU time, also within native code."""
    signal.setitimer(signal.ITIMER_PROF, seconds)
