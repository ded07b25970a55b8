"""Several instances in a process: in threads, freed in their runs, or thousands."""

import time
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from functools import partial
from itertools import repeat
from threading import stack_size

from fmpy.fmi1 import FMICallException

from slider_resonator.checks.conduct.replays import Replay
from slider_resonator.device.schedule import schedule
from slider_resonator.device.signal import constant
from slider_resonator.errors import FmuError
from slider_resonator.fmu.instance import Instance, instantiate

INSTANCES = 4
"""How many instances there are at a time, beside that of the scene."""
STEPS, STEP = 200, 7e-4
"""Steps (s) of each."""
STACK = 1 << 20
"""Bytes of the stack of a thread, as on Windows."""
RESETS, MADE = 3000, 500
"""How often an instance is reset, and how many are made after it: a sweep makes as many."""
PATIENCE = 5.0
"""Seconds for each."""


def crowd_faults(instance: Instance) -> Iterator[str]:
    """Compare each of several instances with the same run alone, to the last bit.

    Each has its own load and is stepped in a thread of its own; all are freed in their runs.
    Nothing is tried where a process can have only one.
    """
    if instance.fmu.offers.canBeInstantiatedOnlyOncePerProcess:
        return
    courses = [
        schedule(STEPS * STEP, (STEP,), {}, False, load=constant(0.01 * number))
        for number in range(INSTANCES)
    ]
    alone = [Replay(instance, {}, course).rows for course in courses]
    with ExitStack() as stack:
        try:
            others = [stack.enter_context(instantiate(instance.fmu)) for _ in courses]
        except FmuError as error:
            yield f"an instance beside {INSTANCES} others is refused: {error}"
            return
        stack.callback(stack_size, stack_size(STACK))  # of threads of hosts that save memory
        with ThreadPoolExecutor(INSTANCES) as pool:
            together = [one.rows for one in pool.map(Replay, others, repeat({}), courses)]
            if together != alone:
                yield "instances that step in threads have other outputs than alone"
        for other in others:
            other.end(terminates=False)
    if Replay(instance, {}, courses[0]).rows != alone[0]:
        yield "an instance has other outputs after others are freed in the middle of their runs"


def life_faults(instance: Instance) -> Iterator[str]:
    """Reset an instance, and make and free others, more often than a small table would allow.

    As often as that goes in a while: an FMU may be slow.
    """
    attempts: list[tuple[str, Callable[[], object], int]]
    attempts = [("resets of an instance", partial(instance.call, "fmi2Reset"), RESETS)]
    if not instance.fmu.offers.canBeInstantiatedOnlyOncePerProcess:
        attempts.append(("instances beside another", lambda: Instance(instance.fmu).end(), MADE))
    for what, attempt, count in attempts:
        began, done = time.monotonic(), 0
        try:
            while done < count and time.monotonic() < began + PATIENCE:
                attempt()
                done += 1
        except (FMICallException, FmuError) as error:
            yield f"no more than {done} {what} are possible: {error}"
