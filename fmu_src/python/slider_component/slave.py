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
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

from pythonfmu import Fmi2Slave

from . import refusal_texts as texts
from .component import Component
from .snapshot import from_bytes, to_bytes
from .values import Refusal
from .variables import VARIABLES

R = TypeVar("R")


def _call(answer: Callable[..., R]) -> Callable[..., R]:
    """A function of FMI that the component answers; after a refusal the instance stays usable."""

    def call(slave: "SliderResonatorPy", *arguments: Any) -> R:
        try:
            return answer(slave.component, *arguments)
        except Exception as error:
            slave.outlive(error)
            raise

    return call


def _get(kind: str, convert: Callable[[float], R]) -> Callable[..., list[R]]:
    """The function that returns values of one type, by value reference."""
    return _call(
        lambda component, references: list(map(convert, component.get(*_names(kind, references))))
    )


def _set(kind: str) -> Callable[..., None]:
    """The function that sets values of one type: all of them or, if one is refused, none."""
    return _call(
        lambda component, references, values: component.set(
            dict(zip(_names(kind, references), values, strict=True))
        )
    )


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
        self.component = Component()

    def outlive(self, error: Exception) -> None:
        """Report a refusal to stderr and keep pythonfmu from freeing this instance over it."""
        if sys.stderr is not None:
            print(f"{type(self).__name__} '{self.instance_name}': {error}", file=sys.stderr)
        for owned in (type(self), self, self.log_queue):
            ctypes.pythonapi.Py_IncRef(ctypes.py_object(owned))

    setup_experiment = _call(Component.setup_experiment)
    enter_initialization_mode = _call(Component.enter_initialization)
    exit_initialization_mode = _call(Component.exit_initialization)
    terminate = _call(Component.terminate)
    do_step = _call(Component.step)
    get_real, set_real = _get("Real", float), _set("Real")
    get_integer, set_integer = _get("Integer", int), _set("Integer")
    # There are no variables of these types: all references are refused.
    get_boolean, set_boolean = _get("Boolean", bool), _set("Boolean")
    get_string, set_string = _get("String", str), _set("String")
    _get_fmu_state = _call(Component.snapshot)
    _set_fmu_state = _call(Component.restore)
    _fmu_state_to_bytes = staticmethod(to_bytes)
    _fmu_state_from_bytes = staticmethod(from_bytes)


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
    binary = unpacked / "binaries" / "linux64" / f"{SliderResonatorPy.__name__}.so"

    def release_interpreter() -> None:
        # Only if the host still has it loaded: keeping it loaded costs 0.3 MB per unpacked FMU.
        with contextlib.suppress(OSError):
            ctypes.CDLL(str(binary), mode=os.RTLD_NOLOAD | os.RTLD_NOW).finalizePythonInterpreter()

    atexit.register(release_interpreter)


def _names(kind: str, references: list[int]) -> list[str]:
    """The names of variables by value reference. Raises Refusal for one of another type."""
    found = []
    last = len(VARIABLES) - 1
    for reference in references:
        if not 0 <= reference <= last:
            raise Refusal(texts.UNKNOWN_REFERENCE, reference=reference, first=0, last=last)
        name, own = VARIABLES[reference].name, VARIABLES[reference].type
        if own != kind:
            raise Refusal(texts.WRONG_TYPE, name=name, reference=reference, own=own, requested=kind)
        found.append(name)
    return found
