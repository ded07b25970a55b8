"""Several instances in a process: in turn, in threads, and freed in the middle of their runs."""

from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack

from slider_resonator.errors import FmuError
from slider_resonator.fmu.instance import Instance, instantiate

INSTANCES = 4
"""How many instances there are at a time, beside that of the scene."""
STEPS, STEP = 200, 7e-4
"""Steps (s) of each."""


def crowd_faults(instance: Instance) -> Iterator[str]:
    """Compare each of several instances with the same run alone, to the last bit.

    Each has its own load. They are stepped in turn, then each in a thread of its own, and freed
    while they run. Nothing is tried where a process can have only one.
    """
    if instance.fmu.offers.canBeInstantiatedOnlyOncePerProcess:
        return
    loads = [0.01 * number for number in range(INSTANCES)]
    alone = [_rows(instance, load) for load in loads]
    with ExitStack() as stack:
        try:
            others = [stack.enter_context(instantiate(instance.fmu)) for _ in loads]
        except FmuError as error:
            yield f"an instance beside {INSTANCES} others is refused: {error}"
            return
        for other, load in zip(others, loads, strict=True):
            with other.explained():
                other.start({"load": load})
        in_turn: list[list[float]] = [[] for _ in others]
        for _ in range(STEPS):
            for other, row in zip(others, in_turn, strict=True):
                with other.explained():
                    other.step_by(STEP)
                row[:] = other.read(other.fmu.outputs).values()
        if in_turn != alone:
            yield "instances that step in turn have other outputs than alone"
        with ThreadPoolExecutor(INSTANCES) as pool:
            if list(pool.map(_rows, others, loads)) != alone:
                yield "instances that step in threads have other outputs than alone"
        for other in others:
            other.end(terminates=False)
    if _rows(instance, loads[0]) != alone[0]:
        yield "an instance has other outputs after others are freed in the middle of their runs"


def _rows(instance: Instance, load: float) -> list[float]:
    """Return the outputs after all steps under a load."""
    with instance.explained():
        instance.start({"load": load})
        for _ in range(STEPS):
            instance.step_by(STEP)
        return list(instance.read(instance.fmu.outputs).values())
