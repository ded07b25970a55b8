"""Tasks that the tests run in the process of an FMU, which imports this module."""

import os
import signal
import time
from collections.abc import Callable
from ctypes import POINTER, c_bool, c_double, cast

from slider_resonator.fmu.fmi3_slave import Fmi3Slave
from slider_resonator.fmu.instance import Instance
from slider_resonator.output.progress import Progress


def position_after(instance: Instance, time: float) -> float:
    instance.start({})
    instance.step_to(time)
    return instance.value("position")


def refused(instance: Instance) -> None:
    instance.start({"friction_faces": 7})


def fail(instance: Instance) -> None:
    raise KeyError("a mistake")


def unpicklable(instance: Instance) -> Callable[[], None]:
    return lambda: None


def in_thirds(instance: Instance, progress: Progress) -> str:
    for third in range(3):
        progress(f"third {third}", third / 3)
    return "done"


def abort(instance: Instance) -> None:
    os.abort()


def crash_in_step_of_fmi_3(instance: Instance) -> None:
    """Have the FMU answer into memory that is nobody's."""
    assert isinstance(instance.slave, Fmi3Slave)
    instance.start({})
    nowhere = [cast(8, POINTER(kind)) for kind in (c_bool, c_bool, c_bool, c_double)]
    instance.slave._answered = tuple(nowhere)
    instance.step_to(0.01)


def stop(instance: Instance) -> None:
    """Stop all threads of the process, its own time limit too."""
    os.kill(os.getpid(), signal.SIGSTOP)


def hang(instance: Instance) -> None:
    time.sleep(600.0)


def disturb(instance: Instance) -> str:
    """Print, and read what there is to read."""
    os.write(1, b"printed")
    return os.read(0, 100).decode()


def print_much(instance: Instance) -> None:
    """Print more than a file may have."""
    for _ in range(80):
        os.write(1, bytes(2**20))


def own_process(instance: Instance) -> int:
    """Return the number of the process, after long enough for others to work meanwhile."""
    time.sleep(0.2)
    return os.getpid()
