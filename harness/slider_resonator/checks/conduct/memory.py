"""Memory that an FMU takes and does not give back, where the C library counts it, as glibc does."""

import ctypes
import gc
from collections.abc import Callable, Iterator
from functools import partial

from slider_resonator.checks.conduct.findings import is_refused
from slider_resonator.fmu.instance import Instance, SavedState

CYCLES = 16
"""How often something is made and freed while memory is counted, after as many times before."""
OF_INSTANCE, OF_STATE = 1024.0, 512.0
"""Bytes that each may leave: a sweep makes ten thousands of instances, a search by trial and return
millions of states. The host itself leaves some."""
STEPS, STEP = 20, 1.1e-3
"""Steps (s) of a run."""


class _Counts(ctypes.Structure):
    """The result of mallinfo2, of which `hblkhd` is the fifth and `uordblks` the eighth count."""

    _fields_ = [("counts", ctypes.c_size_t * 10)]


def instance_leaks(instance: Instance) -> Iterator[str]:
    """Make, run, reset and run instances, and free them; a step of each is refused.

    An instance that is the only one of a process is reset alone.
    """
    once = instance.fmu.offers.canBeInstantiatedOnlyOncePerProcess

    def use() -> None:
        with instance.explained():
            if not once:
                instance.end(terminates=False)
            instance.start({})
            instance.step_by(STEP)
            is_refused(partial(instance.call, "fmi2DoStep", instance.time, -STEP, True))
            instance.start({})
            for _ in range(STEPS):
                instance.step_by(STEP)

    yield from _leaks("instance", use, OF_INSTANCE)


def state_leaks(instance: Instance) -> Iterator[str]:
    """Save states, set them, also in serialised form, and free them, with an instance in use."""
    serialises = instance.fmu.offers.canSerializeFMUstate

    def use() -> None:
        state = SavedState.of(instance)
        state.restore()
        if serialises:
            state.transfer(instance)
        state.free()

    yield from _leaks("state", use, OF_STATE)


def _leaks(what: str, use: Callable[[], None], allowed: float) -> Iterator[str]:
    counts: list[int] = []
    for _ in range(2):
        for _ in range(CYCLES):
            use()
        gc.collect()
        counts += _in_use()
    left = (counts[-1] - counts[0]) / CYCLES if counts else 0.0
    if left > allowed:
        yield f"each {what} that is made and freed leaves {left:.0f} bytes behind"


def _in_use() -> list[int]:
    """Return the bytes that are allocated, nothing where the C library does not tell."""
    try:
        count = ctypes.CDLL(None).mallinfo2
    except (AttributeError, OSError, TypeError):
        return []
    count.restype = _Counts
    *_, mapped, _, _, used, _, _ = count().counts
    return [used + mapped]
