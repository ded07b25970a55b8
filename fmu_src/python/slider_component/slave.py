"""The FMI shell: pythonfmu's slave around the component.

pythonfmu turns an exception into fmi2Fatal, and a False from do_step into fmi2Discard, on which
hosts end a run early without an error. So refusals are raised. pythonfmu then releases one
reference each to class, instance and message list that it never took, which would free the instance
while the host uses it: `outlive` takes these references beforehand.
"""

import atexit
import contextlib
import ctypes
import functools
import os
import sys
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any, ParamSpec, TypeVar

from pythonfmu import Fmi2Slave

from . import refusal_texts
from .component import Component
from .snapshot import from_bytes, to_bytes
from .values import Refusal
from .variables import VARIABLES

P = ParamSpec("P")
R = TypeVar("R")


def _refusing(method: Callable[P, R]) -> Callable[P, R]:
    """Return a method of the slave that reports refusals to stderr and stays usable after them."""

    @functools.wraps(method)
    def call(*args: P.args, **kwargs: P.kwargs) -> R:
        try:
            return method(*args, **kwargs)
        except Exception as error:
            slave = args[0]
            if isinstance(slave, SliderResonatorPy):
                slave.outlive(error)
            raise

    return call


class SliderResonatorPy(Fmi2Slave):  # type: ignore[misc]
    """Slider with an embedded resonator on a friction surface (fig. 6, eqs 26-27)."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        if "logger" in kwargs:
            # In a host pythonfmu leaves the resources of this instance on sys.path.
            with contextlib.suppress(ValueError):
                sys.path.remove(kwargs["resources"])
            if sys.platform == "linux":
                _release_interpreter_at_exit(Path(kwargs["resources"]).parent)
        self._component = Component()

    def outlive(self, error: Exception) -> None:
        """Report a refusal and keep pythonfmu from freeing this instance over it."""
        if sys.stderr is not None:
            print(f"{type(self).__name__} '{self.instance_name}': {error}", file=sys.stderr)
        for owned in (type(self), self, self.log_queue):
            ctypes.pythonapi.Py_IncRef(ctypes.py_object(owned))

    @_refusing
    def setup_experiment(
        self, start_time: float, stop_time: float | None, tolerance: float | None
    ) -> None:
        """fmi2SetupExperiment."""
        self._component.setup_experiment(start_time, stop_time, tolerance)

    @_refusing
    def enter_initialization_mode(self) -> None:
        """fmi2EnterInitializationMode."""
        self._component.enter_initialization()

    @_refusing
    def exit_initialization_mode(self) -> None:
        """fmi2ExitInitializationMode."""
        self._component.exit_initialization()

    @_refusing
    def terminate(self) -> None:
        """fmi2Terminate."""
        self._component.terminate()

    @_refusing
    def do_step(self, current_time: float, step_size: float) -> bool:
        """fmi2DoStep: the whole step or a refusal."""
        self._component.step(current_time, step_size)
        return True

    @_refusing
    def get_real(self, vrs: list[int]) -> list[float]:
        """fmi2GetReal."""
        return self._get("Real", vrs)

    @_refusing
    def get_integer(self, vrs: list[int]) -> list[int]:
        """fmi2GetInteger."""
        return list(map(int, self._get("Integer", vrs)))

    @_refusing
    def get_boolean(self, vrs: list[int]) -> list[bool]:
        """fmi2GetBoolean: there are no such variables."""
        return list(map(bool, self._get("Boolean", vrs)))

    @_refusing
    def get_string(self, vrs: list[int]) -> list[str]:
        """fmi2GetString: there are no such variables."""
        return list(map(str, self._get("String", vrs)))

    @_refusing
    def set_real(self, vrs: list[int], values: list[float]) -> None:
        """fmi2SetReal: all values or, if one is refused, none."""
        self._set("Real", vrs, values)

    @_refusing
    def set_integer(self, vrs: list[int], values: list[int]) -> None:
        """fmi2SetInteger: all values or, if one is refused, none."""
        self._set("Integer", vrs, values)

    @_refusing
    def set_boolean(self, vrs: list[int], values: list[bool]) -> None:
        """fmi2SetBoolean: there are no such variables."""
        self._set("Boolean", vrs, values)

    @_refusing
    def set_string(self, vrs: list[int], values: list[str]) -> None:
        """fmi2SetString: there are no such variables."""
        self._set("String", vrs, values)

    def _get(self, kind: str, references: list[int]) -> list[float]:
        return self._component.get(*_names(kind, references))

    def _set(self, kind: str, references: list[int], values: Iterable[object]) -> None:
        self._component.set(dict(zip(_names(kind, references), values, strict=True)))

    @_refusing
    def _get_fmu_state(self) -> dict[str, Any]:
        return self._component.snapshot()

    @_refusing
    def _set_fmu_state(self, state: dict[str, Any]) -> None:
        self._component.restore(state)

    @staticmethod
    def _fmu_state_to_bytes(state: dict[str, Any]) -> bytes:
        return to_bytes(state)

    @staticmethod
    def _fmu_state_from_bytes(state: bytes) -> dict[str, Any]:
        return from_bytes(state)


def keep_alive(namespace: dict[str, Any]) -> None:
    """Keep the namespace of the loaded script alive; call it once per evaluation of the script.

    For each instance pythonfmu evaluates the script in the namespace of its module, and then
    releases a reference to that namespace which it never took.
    """
    ctypes.pythonapi.Py_IncRef(ctypes.py_object(namespace))


@functools.cache
def _release_interpreter_at_exit(unpacked: Path) -> None:
    """Make the binary of an unpacked FMU release the interpreter before the process ends.

    By itself the binary releases it while static objects are destroyed, and uses one of these that
    is already gone.
    """
    atexit.register(
        _release_interpreter, unpacked / "binaries" / "linux64" / f"{SliderResonatorPy.__name__}.so"
    )


def _release_interpreter(binary: Path) -> None:
    # Only if the host still has it loaded: keeping it loaded costs 0.3 MB per unpacked FMU.
    with contextlib.suppress(OSError):
        ctypes.CDLL(str(binary), mode=os.RTLD_NOLOAD | os.RTLD_NOW).finalizePythonInterpreter()


def _names(kind: str, references: list[int]) -> list[str]:
    """The names of variables by value reference. Raises Refusal for one of another type."""
    found = []
    for reference in references:
        if not 0 <= reference < len(VARIABLES):
            last = len(VARIABLES) - 1
            raise Refusal(refusal_texts.UNKNOWN_REFERENCE, reference=reference, first=0, last=last)
        variable = VARIABLES[reference]
        if variable.type != kind:
            types = {"own": variable.type, "requested": kind}
            raise Refusal(
                refusal_texts.WRONG_TYPE, name=variable.name, reference=reference, **types
            )
        found.append(variable.name)
    return found
