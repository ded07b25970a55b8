"""An FMU of FMI 3.0 behind the calls of FMI 2.0 that the harness makes.

Without event mode steps run through events, as in FMI 2.0. FMI 3.0 takes and checks the times of an
experiment when initialisation mode begins; FMI 2.0 does so before.
"""

from ctypes import byref, c_bool, c_double
from typing import Any

from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import fmi2Error, fmi2OK, fmi2Warning
from fmpy.fmi3 import FMU3Slave

from slider_resonator.fmu.fmu_log import keep

_RENAMED = {
    "fmi2": "fmi3",
    "Instantiate": "InstantiateCoSimulation",
    "Real": "Float64",
    "Integer": "Int32",
    "FMUstate": "FMUState",
    "deSerialize": "deserialize",
}
"""Parts of names of FMI 2.0, and of fmpy for it, with those of FMI 3.0."""


def in_fmi_3(name: str) -> str:
    """Return what FMI 3.0 calls a function or a method of fmpy."""
    for old, new in _RENAMED.items():
        name = name.replace(old, new)
    return name


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
        slave.instantiate(loggingOn=True, logMessage=lambda *log: keep(messages, log[-1]))
        self.component = slave.component
        self.dll = self  # where the functions of FMI 2.0 are found

    def _call(self, name: str, *arguments: Any) -> int:
        """Call a function of FMI 3.0; raises FMICallException with its name."""
        status = int(getattr(self._slave.dll, name)(self.component, *arguments))
        if status > fmi2Warning:
            raise FMICallException(function=name, status=status)
        return status

    def __getattr__(self, name: str) -> Any:
        """Return what FMI 3.0 only calls otherwise."""
        if name.startswith("fmi2"):
            return lambda _, *arguments: self._call(in_fmi_3(name), *arguments)
        return getattr(self._slave, in_fmi_3(name))

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

    def fmi2DoStep(self, _: Any, time: float, size: float, no_state_set: bool) -> int:
        """See FMI 2.0; an end before the end of the step is a failure, too."""
        status = self._call("fmi3DoStep", time, size, no_state_set, *self._answered)
        _event, ended, early, reached = self._answers
        if ended.value or early.value:
            self._messages.append(f"the step to {time + size!r} s ended at {reached.value!r} s")
            raise FMICallException(function="fmi3DoStep", status=fmi2Error)
        return status
