"""The calls that the harness makes of an FMU, in each version of FMI, through fmpy.

Calls go through ctypes, without fmpy's overhead: fmpy has declared the types of arguments.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from ctypes import byref, c_bool, c_double
from functools import partial
from typing import Any, Protocol

from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave, fmi2ValueReference, fmi2Warning
from fmpy.fmi3 import FMU3Slave, fmi3ValueReference

from slider_resonator.fmu import fmu_log
from slider_resonator.fmu.opening import Fmu

Calls = tuple[Callable[[], None], Callable[[], None]]
"""Read into a buffer, and write from it."""


class Binding(Protocol):
    """An instance in one version of FMI; calls raise FMICallException when they fail.

    `messages` are the texts that the FMU logged.
    """

    messages: list[str]

    def block(self, references: Sequence[int], values: Any) -> Calls:
        """Return the calls that read and write real variables through `values`, an array of C."""

    def initialise(
        self, start_time: float, stop_time: float | None, set_values: Callable[[], None]
    ) -> None:
        """Begin an experiment (s) with the values that `set_values` sets."""

    def reset(self) -> None:
        """Return to the state after instantiation."""

    def step(self, time: float, size: float) -> None:
        """Advance from `time` by `size` (s)."""

    def integer(self, reference: int) -> int:
        """Return the value of an integer variable."""

    def set_integer(self, reference: int, value: int) -> None:
        """Set an integer variable."""

    def state(self) -> bytes:
        """Return the serialised state."""

    def set_state(self, data: bytes) -> None:
        """Restore a serialised state."""

    def terminate(self) -> None:
        """End the simulation."""

    def free(self) -> None:
        """Free the instance and the library."""


def bind(fmu: Fmu, name: str) -> Binding:
    """Instantiate an FMU under a name. Raises Exception, as fmpy does, where that fails."""
    return (Fmi3Binding if fmu.version == "3.0" else Fmi2Binding)(fmu, name)


def _call(slave: FMU2Slave | FMU3Slave, name: str, *arguments: Any) -> None:
    status = getattr(slave.dll, name)(slave.component, *arguments)
    if status > fmi2Warning:  # the same number in each version
        raise FMICallException(function=name, status=status)


class Fmi2Binding:
    """FMI 2.0."""

    def __init__(self, fmu: Fmu, name: str) -> None:
        self._name = name
        self.messages, callbacks = fmu_log.collect(name)
        try:
            self.slave = FMU2Slave(
                instanceName=name,
                guid=fmu.description.guid,
                modelIdentifier=fmu.identifier,
                unzipDirectory=str(fmu.folder),
            )
            self.slave.instantiate(callbacks=callbacks, loggingOn=True)
        except Exception as error:
            fmu_log.forget(name)
            raise RuntimeError("; ".join([str(error), *self.messages])) from error

    def block(self, references: Sequence[int], values: Any) -> Calls:
        """See Binding."""
        size = len(references)
        arguments = (fmi2ValueReference * size)(*references), size, values
        return (
            partial(_call, self.slave, "fmi2GetReal", *arguments),
            partial(_call, self.slave, "fmi2SetReal", *arguments),
        )

    def initialise(
        self, start_time: float, stop_time: float | None, set_values: Callable[[], None]
    ) -> None:
        """See Binding."""
        stop = (False, 0.0) if stop_time is None else (True, stop_time)
        _call(self.slave, "fmi2SetupExperiment", False, 0.0, start_time, *stop)
        set_values()
        _call(self.slave, "fmi2EnterInitializationMode")
        _call(self.slave, "fmi2ExitInitializationMode")

    def reset(self) -> None:
        """See Binding."""
        _call(self.slave, "fmi2Reset")

    def step(self, time: float, size: float) -> None:
        """See Binding."""
        _call(self.slave, "fmi2DoStep", time, size, True)

    def integer(self, reference: int) -> int:
        """See Binding."""
        return int(self.slave.getInteger([reference])[0])

    def set_integer(self, reference: int, value: int) -> None:
        """See Binding."""
        self.slave.setInteger([reference], [value])

    def state(self) -> bytes:
        """See Binding."""
        state = self.slave.getFMUstate()
        try:
            return bytes(self.slave.serializeFMUstate(state))
        finally:
            self.slave.freeFMUstate(state)

    def set_state(self, data: bytes) -> None:
        """See Binding."""
        state = self.slave.deSerializeFMUstate(data)
        try:
            self.slave.setFMUstate(state)
        finally:
            self.slave.freeFMUstate(state)

    def terminate(self) -> None:
        """See Binding."""
        self.slave.terminate()

    def free(self) -> None:
        """See Binding."""
        self.slave.freeInstance()
        fmu_log.forget(self._name)


class Fmi3Binding:
    """FMI 3.0, without event mode: steps run through, as in FMI 2.0."""

    def __init__(self, fmu: Fmu, name: str) -> None:
        self.messages: list[str] = []
        try:
            self.slave = FMU3Slave(
                instanceName=name,
                guid=fmu.description.guid,
                modelIdentifier=fmu.identifier,
                unzipDirectory=str(fmu.folder),
            )
            self.slave.instantiate(loggingOn=True, logMessage=self._receive)
        except Exception as error:
            raise RuntimeError("; ".join([str(error), *self.messages])) from error
        # What a step answers: that an event needs handling, an end, an early return, and the time.
        self._answers = c_bool(), c_bool(), c_bool(), c_double()
        self._answered = tuple(byref(answer) for answer in self._answers)

    def _receive(self, _: object, status: int, category: bytes, message: bytes) -> None:
        self.messages.append(message.decode("utf-8", errors="replace").strip())

    def block(self, references: Sequence[int], values: Any) -> Calls:
        """See Binding."""
        size = len(references)
        arguments = (fmi3ValueReference * size)(*references), size, values, size
        return (
            partial(_call, self.slave, "fmi3GetFloat64", *arguments),
            partial(_call, self.slave, "fmi3SetFloat64", *arguments),
        )

    def initialise(
        self, start_time: float, stop_time: float | None, set_values: Callable[[], None]
    ) -> None:
        """See Binding."""
        set_values()
        self.slave.enterInitializationMode(startTime=start_time, stopTime=stop_time)
        self.slave.exitInitializationMode()

    def reset(self) -> None:
        """See Binding."""
        self.slave.reset()

    def step(self, time: float, size: float) -> None:
        """See Binding; an early end that was not allowed is a failure, too."""
        _call(self.slave, "fmi3DoStep", time, size, True, *self._answered)
        _, ended, early, reached = self._answers
        if ended.value or early.value:
            self.messages.append(f"the step to {time + size!r} s ended at {reached.value!r} s")
            raise FMICallException(function="fmi3DoStep", status=fmi2Warning)

    def integer(self, reference: int) -> int:
        """See Binding."""
        return int(self.slave.getInt32([reference])[0])

    def set_integer(self, reference: int, value: int) -> None:
        """See Binding."""
        self.slave.setInt32([reference], [value])

    def state(self) -> bytes:
        """See Binding."""
        state = self.slave.getFMUState()
        try:
            return bytes(self.slave.serializeFMUState(state))
        finally:
            self.slave.freeFMUState(state)

    def set_state(self, data: bytes) -> None:
        """See Binding."""
        state = self.slave.deserializeFMUState(data)
        try:
            self.slave.setFMUState(state)
        finally:
            self.slave.freeFMUState(state)

    def terminate(self) -> None:
        """See Binding."""
        self.slave.terminate()

    def free(self) -> None:
        """See Binding."""
        self.slave.freeInstance()
