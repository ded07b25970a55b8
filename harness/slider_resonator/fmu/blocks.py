"""Calls of FMI functions through ctypes, and fixed sets of variables that they read and write."""

from collections.abc import Sequence
from ctypes import c_double
from functools import partial
from typing import Any

from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave, fmi2Integer, fmi2ValueReference, fmi2Warning

from slider_resonator.fmu.fmi3_slave import Fmi3Slave

WARNED = "warned"
"""Attribute of a slave: the last call that was answered with a warning."""


def call(slave: FMU2Slave | Fmi3Slave, name: str, *arguments: Any) -> None:
    """Call an FMI function through ctypes, without fmpy's overhead; raises FMICallException.

    Arguments are converted to the types that fmpy has declared for the function. The name of the
    last call that was answered with a warning is kept as `WARNED` of the slave.
    """
    status = getattr(slave.dll, name)(slave.component, *arguments)
    if status > fmi2Warning:
        raise FMICallException(function=name, status=status)
    if status == fmi2Warning:
        setattr(slave, WARNED, name)


class Block:
    """A fixed set of Real variables, read and written many times without allocation."""

    def __init__(self, slave: FMU2Slave | Fmi3Slave, references: Sequence[int]) -> None:
        size = len(references)
        self._values = (c_double * size)()
        variables = (fmi2ValueReference * size)(*references), size
        self._get = partial(call, slave, "fmi2GetReal", *variables, self._values)
        self._set = partial(call, slave, "fmi2SetReal", *variables, self._values)
        first = (fmi2Integer * size)(*[1] * size), self._values
        self._set_rates = partial(call, slave, "fmi2SetRealInputDerivatives", *variables, *first)

    def read(self) -> list[float]:
        """Return the current values."""
        self._get()
        return self._values[:]

    def write(self, values: Sequence[float]) -> None:
        """Set the variables."""
        self._values[:] = list(values)
        self._set()

    def write_rates(self, rates: Sequence[float]) -> None:
        """Set the first derivatives of the variables, which are inputs."""
        self._values[:] = list(rates)
        self._set_rates()
