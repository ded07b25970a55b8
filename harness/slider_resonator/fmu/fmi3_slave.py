"""An FMU of FMI 3.0 behind the calls of FMI 2.0 that the harness makes.

Without event mode steps run through events, as in FMI 2.0. FMI 3.0 takes and checks the times of an
experiment when initialisation mode begins; FMI 2.0 does so before.
"""

from __future__ import annotations

from collections.abc import Sequence
from ctypes import byref, c_bool, c_double
from typing import Any

from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import fmi2Error, fmi2OK, fmi2Warning
from fmpy.fmi3 import FMU3Slave


class Fmi3Slave:
    """Like fmpy's FMU2Slave, as far as the harness uses that; `messages` collects the log.

    Functions that fail raise FMICallException with the name that FMI 3.0 gives them. Raises
    Exception, as fmpy does, where the FMU cannot be instantiated.
    """

    def __init__(self, slave: FMU3Slave, messages: list[str]) -> None:
        self._slave = slave
        self._messages = messages
        self._experiment: tuple[Any, ...] = (False, 0.0, 0.0, False, 0.0)
        # What a step answers: an event that needs handling, an end, an early return, and the time.
        self._answers = c_bool(), c_bool(), c_bool(), c_double()
        self._answered: tuple[Any, ...] = tuple(byref(answer) for answer in self._answers)
        slave.instantiate(loggingOn=True, logMessage=self._receive)

    def _receive(self, _: object, status: int, category: bytes, message: bytes) -> None:
        self._messages.append((message or b"").decode("utf-8", errors="replace").strip())

    @property
    def dll(self) -> Fmi3Slave:
        """Where the functions of FMI 2.0 are found."""
        return self

    @property
    def component(self) -> Any:
        """The instance."""
        return self._slave.component

    def _call(self, name: str, *arguments: Any) -> int:
        """Call a function of FMI 3.0; raises FMICallException with its name."""
        status = int(getattr(self._slave.dll, name)(self.component, *arguments))
        if status > fmi2Warning:
            raise FMICallException(function=name, status=status)
        return status

    def fmi2GetReal(self, _: Any, references: Any, size: int, values: Any) -> int:
        """See FMI 2.0."""
        return self._call("fmi3GetFloat64", references, size, values, size)

    def fmi2SetReal(self, _: Any, references: Any, size: int, values: Any) -> int:
        """See FMI 2.0."""
        return self._call("fmi3SetFloat64", references, size, values, size)

    def fmi2SetupExperiment(self, _: Any, *experiment: Any) -> int:
        """Keep the times (s) and the tolerance for initialisation mode."""
        self._experiment = experiment
        return int(fmi2OK)

    def fmi2EnterInitializationMode(self, _: Any) -> int:
        """See FMI 2.0."""
        return self._call("fmi3EnterInitializationMode", *self._experiment)

    def fmi2ExitInitializationMode(self, _: Any) -> int:
        """See FMI 2.0."""
        return self._call("fmi3ExitInitializationMode")

    def fmi2DoStep(self, _: Any, time: float, size: float, no_state_set: bool) -> int:
        """See FMI 2.0; an end before the end of the step is a failure, too."""
        status = self._call("fmi3DoStep", time, size, no_state_set, *self._answered)
        _event, ended, early, reached = self._answers
        if ended.value or early.value:
            self._messages.append(f"the step to {time + size!r} s ended at {reached.value!r} s")
            raise FMICallException(function="fmi3DoStep", status=fmi2Error)
        return status

    def fmi2Reset(self, _: Any) -> int:
        """See FMI 2.0."""
        return self._call("fmi3Reset")

    def fmi2Terminate(self, _: Any) -> int:
        """See FMI 2.0."""
        return self._call("fmi3Terminate")

    def fmi2GetFMUstate(self, _: Any, state: Any) -> int:
        """See FMI 2.0."""
        return self._call("fmi3GetFMUState", state)

    def fmi2SetFMUstate(self, _: Any, state: Any) -> int:
        """See FMI 2.0."""
        return self._call("fmi3SetFMUState", state)

    def fmi2FreeFMUstate(self, _: Any, state: Any) -> int:
        """See FMI 2.0."""
        return self._call("fmi3FreeFMUState", state)

    def getReal(self, references: Sequence[int]) -> list[float]:
        """See fmpy."""
        return list(self._slave.getFloat64(references))

    def setReal(self, references: Sequence[int], values: Sequence[float]) -> None:
        """See fmpy."""
        self._slave.setFloat64(references, values)

    def getInteger(self, references: Sequence[int]) -> list[int]:
        """See fmpy."""
        return list(self._slave.getInt32(references))

    def setInteger(self, references: Sequence[int], values: Sequence[int]) -> None:
        """See fmpy."""
        self._slave.setInt32(references, values)

    def getFMUstate(self) -> Any:
        """See fmpy."""
        return self._slave.getFMUState()

    def setFMUstate(self, state: Any) -> None:
        """See fmpy."""
        self._slave.setFMUState(state)

    def freeFMUstate(self, state: Any) -> None:
        """See fmpy."""
        self._slave.freeFMUState(state)

    def serializeFMUstate(self, state: Any) -> bytes:
        """See fmpy."""
        return bytes(self._slave.serializeFMUState(state))

    def deSerializeFMUstate(self, data: bytes) -> Any:
        """See fmpy."""
        return self._slave.deserializeFMUState(data)

    def terminate(self) -> None:
        """See fmpy."""
        self._slave.terminate()

    def freeInstance(self) -> None:
        """See fmpy."""
        self._slave.freeInstance()
