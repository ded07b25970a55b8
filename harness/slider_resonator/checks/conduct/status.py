"""What an FMU says of its own status after a step."""

from __future__ import annotations

from collections.abc import Iterator
from ctypes import byref, c_double, c_int

from fmpy.fmi2 import fmi2LastSuccessfulTime, fmi2OK, fmi2Terminated

from slider_resonator.fmu.fmi3_slave import Fmi3Slave
from slider_resonator.fmu.instance import Instance

RESOLUTION = 1e-9
"""Share of the time (s) up to which two times are the same."""


def status_faults(instance: Instance) -> Iterator[str]:
    """Yield what is wrong with the answers to status calls after a good step.

    An FMU need not answer them, and FMI 3.0 does not have them.
    """
    slave = instance.slave
    if isinstance(slave, Fmi3Slave):
        return
    dll, component = slave.dll, slave.component
    reached, ended = c_double(), c_int()
    if dll.fmi2GetRealStatus(component, fmi2LastSuccessfulTime, byref(reached)) == fmi2OK:
        apart = abs(reached.value - instance.time)
        if not apart <= RESOLUTION * max(1.0, abs(instance.time)):
            yield (
                f"the last successful time is {reached.value!r} s after a step to "
                f"{instance.time!r} s"
            )
    asked = dll.fmi2GetBooleanStatus(component, fmi2Terminated, byref(ended))
    if asked == fmi2OK and ended.value:
        yield "the FMU wants to end the run after a good step"
