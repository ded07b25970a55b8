"""Calls of FMI functions with any arguments, past the care that fmpy takes."""

import ctypes
from collections.abc import Sequence

from fmpy.fmi1 import FMICallException

from tests.fmu.host import AnyInstance

OK, WARNING, DISCARD, ERROR = range(4)


def call(instance: AnyInstance, function: str, *arguments: object) -> int:
    """The status of `function(instance, *arguments)`; integers are passed as size_t."""
    passed = [ctypes.c_size_t(a) if isinstance(a, int) else a for a in arguments]
    foreign = instance.slave.dll[function]
    foreign.restype = ctypes.c_int
    return int(foreign(ctypes.c_void_p(instance.slave.component), *passed))


def check(status: int) -> None:
    """Raise what fmpy raises for a status that is not OK."""
    if status != OK:
        raise FMICallException(function="", status=status)


def references(values: Sequence[int]) -> ctypes.Array[ctypes.c_uint]:
    """Value references as C has them."""
    return (ctypes.c_uint * len(values))(*values)


def reals(values: Sequence[float]) -> ctypes.Array[ctypes.c_double]:
    """Real values as C has them."""
    return (ctypes.c_double * len(values))(*values)
