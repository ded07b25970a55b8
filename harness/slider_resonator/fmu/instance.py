"""Driving an instance of an FMU through fmpy, and saving its state."""

import errno
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, chdir, contextmanager, suppress
from ctypes import c_double
from dataclasses import dataclass
from functools import cache, partial
from itertools import count
from threading import Lock
from typing import Any

import numpy as np
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave, fmi2Integer, fmi2ValueReference, fmi2Warning
from fmpy.fmi3 import FMU3Slave
from fmpy.model_description import ModelVariable

from slider_resonator.arrays import Array
from slider_resonator.device.interface import INPUTS
from slider_resonator.errors import FmuError, Refusal
from slider_resonator.fmu import fmu_log
from slider_resonator.fmu.fmi3_slave import Fmi3Slave
from slider_resonator.fmu.limits import MAX_WRITTEN
from slider_resonator.fmu.opening import Fmu

LARGEST_INTEGER = 2**31 - 1
"""FMI 2.0 passes Integers as C ints, which would silently lose the upper bits of more."""

_numbers = count(1)
_loading = Lock()
"""Held while fmpy loads a library: in its folder, where the process stays if that fails."""


def load(fmu: Fmu, name: str) -> FMU2Slave | FMU3Slave:
    """Load the library of an FMU for an instance; raises a bare Exception, as fmpy does."""
    slave = FMU3Slave if fmu.version == "3.0" else FMU2Slave
    with _loading, chdir("."):
        return slave(
            instanceName=name,
            guid=fmu.description.guid,
            modelIdentifier=fmu.offers.modelIdentifier,
            unzipDirectory=str(fmu.folder),
        )


class Block:
    """A fixed set of Real variables, read and written many times without allocation."""

    def __init__(self, instance: "Instance", names: Sequence[str]) -> None:
        size, references = len(names), map(instance.fmu.reference, names)
        self._values = (c_double * size)()
        variables = (fmi2ValueReference * size)(*references), size
        self._get = partial(instance.call, "fmi2GetReal", *variables, self._values)
        self._set = partial(instance.call, "fmi2SetReal", *variables, self._values)
        first = (fmi2Integer * size)(*[1] * size), self._values
        self._set_rates = partial(instance.call, "fmi2SetRealInputDerivatives", *variables, *first)

    def read(self) -> list[float]:
        """Return the current values."""
        self._get()
        return self._values[:]

    def write(self, values: Sequence[float]) -> None:
        """Set the variables."""
        self._values[:] = list(values)
        self._set()

    def write_rates(self, rates: Sequence[float]) -> None:
        """Set the first derivatives of inputs, of an FMU with `canInterpolateInputs`."""
        self._values[:] = list(rates)
        self._set_rates()


_Plan = tuple[Mapping[str, int], Sequence[str], Block]
"""How variables are read and written: Integers one by one by reference, the Reals in one call."""


class Instance:
    """One instance of an FMU, reused through fmi2Reset by every `start`.

    Raises FmuError when the FMU cannot be instantiated. `start` raises Refusal with the message of
    the FMU when a call fails; the other methods, which are called millions of times, do so inside
    an `explained` block. Must be freed with `end`. `inputs` are phase (rad), load (N) and
    frequency_ratio; `warned` is the name of the last call that was answered with a warning.
    """

    slave: FMU2Slave | Fmi3Slave

    def __init__(self, fmu: Fmu) -> None:
        self.fmu = fmu
        self._create()

    def recreate(self) -> None:
        """Free the instance and create a new one, for instance after a failure.

        Blocks of the old one must not be used again. Raises FmuError as at first.
        """
        self.end()
        self._create()

    def renew(self) -> None:
        """Create a new instance, unless a process can have only one."""
        if not self.fmu.offers.canBeInstantiatedOnlyOncePerProcess:
            self.recreate()

    def _create(self) -> None:
        self._name = f"harness{next(_numbers)}"
        self.messages, callbacks = fmu_log.collect(self._name)
        try:
            slave = load(self.fmu, self._name)
            if isinstance(slave, FMU3Slave):
                self.slave = Fmi3Slave(slave, self.messages)
            else:
                self.slave = slave
                self.slave.instantiate(callbacks=callbacks, loggingOn=True)
        except Exception as error:  # fmpy raises bare Exception for every error here
            reason = fmu_log.in_one_line([str(error), *self.messages])
            fmu_log.forget(self._name)
            raise FmuError(f"{self.fmu.path}: cannot be instantiated: {reason}") from error
        self._exists = True
        self.warned = ""
        self.time = 0.0
        self._used = False
        self._initialised = False
        self._block = cache(partial(Block, self))
        self._settable = cache(partial(self._plan, self.fmu.settable))
        self._readable = cache(partial(self._plan, self.fmu.variable))
        self.inputs = self.block(list(INPUTS))

    def call(self, name: str, *arguments: Any) -> None:
        """Call a function of FMI 2.0 by its name, without fmpy's overhead; raises FMICallException.

        Arguments are converted to the types that fmpy has declared for the function.
        """
        status = getattr(self.slave.dll, name)(self.slave.component, *arguments)
        if status > fmi2Warning:
            raise FMICallException(function=name, status=status)
        if status == fmi2Warning:
            self.warned = name

    def block(self, names: Sequence[str]) -> Block:
        """Return a block of Real variables of the FMU; FmuError for an unknown name."""
        return self._block(tuple(names))

    def start(self, values: Mapping[str, float], **span: float) -> None:
        """Initialise with the given parameters and inputs, all others at their start.

        `span` is that of `set_up`.
        Raises FmuError for an unknown name, NotApplicable for a variable that the FMU may lack and
        Refusal for a value that it does not take.
        """
        with self.explained():
            self.initialise(values, **span)
            self.begin()

    def initialise(self, values: Mapping[str, float], **span: float) -> None:
        """Set up an experiment, set values and enter initialisation mode."""
        self.set_up(**span)
        self.set(values)
        self.call("fmi2EnterInitializationMode")

    def set_up(self, *, start_time: float = 0.0, stop_time: float | None = None) -> None:
        """Reset the instance, where it was used before, and set up an experiment (s).

        One that could not be created again after a failure is created now; FmuError as at first.
        """
        if not self._exists:
            self._create()
        self.time = start_time
        if self._used:
            self.call("fmi2Reset")
        self._used = True
        self._initialised = False
        stop = (False, 0.0) if stop_time is None else (True, stop_time)
        self.call("fmi2SetupExperiment", False, 0.0, start_time, *stop)

    def begin(self) -> None:
        """Leave initialisation mode."""
        self.call("fmi2ExitInitializationMode")
        self._initialised = True

    def set(self, values: Mapping[str, float]) -> None:
        """Set parameters and inputs; raises FmuError and NotApplicable as `start` does.

        Integers are set one by one and all Reals in one call, each of which costs a drive period.
        """
        values = self.fmu.settings(values)
        integers, reals, block = self._settable(tuple(values))
        for name, reference in integers.items():
            if values[name] % 1 != 0 or abs(values[name]) > LARGEST_INTEGER:
                must = f"must be an integer up to {LARGEST_INTEGER}"
                raise FmuError(f"{name} = {values[name]!r}: {must}")
            self.slave.setInteger([reference], [int(values[name])])
        block.write([values[name] for name in reals])

    def terminate(self) -> None:
        """End a run."""
        self.call("fmi2Terminate")
        self._initialised = False

    def resume(self, content: bytes, time: float) -> None:
        """Go on from a serialised state of a run at a time (s)."""
        handle = self.slave.deSerializeFMUstate(content)
        try:
            self.slave.setFMUstate(handle)
        finally:
            self.slave.freeFMUstate(handle)
        self.time = time
        self._used = self._initialised = True

    def check_steps(self, times: Array) -> None:
        """Raise FmuError for an FMU that takes equal steps only, if those to `times` (s) differ."""
        if not self.fmu.takes_equal_steps_only:
            return
        steps = np.diff(times, prepend=self.time)
        if np.ptp(steps) > 1e-6 * np.max(steps):
            raise FmuError(
                f"{self.fmu.path.name} has canHandleVariableCommunicationStepSize = false, but "
                f"this needs steps from {np.min(steps):.6g} s to {np.max(steps):.6g} s; must be "
                "one size for the whole run"
            )

    def step_to(self, target: float) -> None:
        """Advance to `target` (s)."""
        self.step_by(target - self.time)

    def step_by(self, size: float) -> None:
        """Advance by `size` (s)."""
        self.call("fmi2DoStep", self.time, size, True)
        self.time += size

    def value(self, name: str) -> float:
        """Return the current value of any variable; FmuError for an unknown name."""
        return self.read([name])[name]

    def read(self, names: Sequence[str]) -> dict[str, float]:
        """Return the current values of variables; FmuError for an unknown name."""
        integers, reals, block = self._readable(tuple(names))
        found = dict(zip(reals, block.read(), strict=True))
        for name, reference in integers.items():
            found[name] = float(self.slave.getInteger([reference])[0])
        return found

    def outputs(self) -> dict[str, float]:
        """Return the current values of all outputs."""
        return self.read(self.fmu.outputs)

    def end(self, *, terminates: bool = True) -> None:
        """Terminate, where the FMU is in a state that allows it, and free the instance, once."""
        if not self._exists:  # as after a failure to create it again
            return
        self._exists = False
        if self._initialised and terminates:
            with suppress(FMICallException):  # nothing is lost: the instance is freed at once
                self.slave.terminate()
        self.slave.freeInstance()
        fmu_log.forget(self._name)

    def _plan(self, find: Callable[[str], ModelVariable], names: tuple[str, ...]) -> _Plan:
        """Return how variables are read or written; made once for each set of names."""
        found = {name: find(name) for name in names}
        integers = {n: v.valueReference for n, v in found.items() if v.type == "Integer"}
        reals = [name for name in names if name not in integers]
        return integers, reals, self.block(reals)

    @contextmanager
    def explained(self) -> Iterator[None]:
        """Turn a failed FMI call in the block into a Refusal with the log of the FMU.

        A Python FMU in this process can also fail by an exception that it leaves set: ctypes raises
        SystemError then.
        """
        del self.messages[:]
        try:
            yield
        except (FMICallException, SystemError) as error:
            reason = fmu_log.in_one_line(self.messages) or f"{error} The FMU logged no reason."
            if isinstance(error, SystemError):
                reason = f"the FMU left a Python exception behind: {error.__cause__!r}"
            if os.strerror(errno.EFBIG) in reason:
                reason += f"; it may write or print at most {MAX_WRITTEN >> 20} MiB"
            where = f"{self.fmu.path.name} at t = {self.time:.9g} s"
            raise Refusal(f"{where}: {reason}") from error


@contextmanager
def instantiate(fmu: Fmu) -> Iterator[Instance]:
    """Instantiate an FMU for the length of the block; FmuError when it cannot be."""
    instance = Instance(fmu)
    try:
        yield instance
    finally:
        instance.end()


@dataclass(frozen=True)
class SavedState(AbstractContextManager["SavedState"]):
    """A state of an instance at a time (s).

    It must be freed before the instance is: with `free`, or by the end of a `with` block.
    """

    instance: Instance
    time: float
    handle: Any

    @classmethod
    def of(cls, instance: Instance) -> "SavedState":
        """Save the present state; NotApplicable where the FMU does not offer that."""
        instance.fmu.require("canGetAndSetFMUstate")
        return cls(instance, instance.time, instance.slave.getFMUstate())

    def restore(self) -> None:
        """Bring the instance back into this state."""
        self.instance.slave.setFMUstate(self.handle)
        self.instance.time = self.time

    def serialised(self) -> bytes:
        """Return the state as bytes; NotApplicable where the FMU does not offer that."""
        self.instance.fmu.require("canSerializeFMUstate")
        return bytes(self.instance.slave.serializeFMUstate(self.handle))

    def transfer(self, other: Instance) -> None:
        """Bring another instance into this state, in serialised form; raises as `serialised`."""
        other.resume(self.serialised(), self.time)

    def __exit__(self, *_: object) -> None:
        """Free the state."""
        self.free()

    def free(self) -> None:
        """Free the memory of the state."""
        self.instance.slave.freeFMUstate(self.handle)
