"""Driving an FMU through fmpy: instances, steps, and whole runs."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, contextmanager, suppress
from ctypes import c_double
from dataclasses import dataclass
from functools import partial
from itertools import count
from types import TracebackType
from typing import Any

import numpy as np
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave, fmi2ValueReference, fmi2Warning
from fmpy.model_description import ModelVariable
from numpy.typing import NDArray

from slider_resonator.device.interface import INPUTS, OUTPUTS
from slider_resonator.device.schedule import Schedule
from slider_resonator.device.values import check_integer
from slider_resonator.errors import FmuError, Refusal
from slider_resonator.fmu import fmu_log
from slider_resonator.fmu.opening import Fmu
from slider_resonator.names import unknown_name

EQUAL = 1e-6
"""Relative difference up to which two communication steps are of one size."""

_numbers = count(1)


@dataclass(frozen=True)
class Record:
    """What an FMU did at the communication points `times` (s), shape (n,).

    `outputs` maps names to arrays (n,); `inputs` (n, 3) are phase, load, frequency_ratio as held
    from each point on. `wall_time` (s) covers initialisation and stepping, `start_cpu` and
    `step_cpu` (s) are the CPU times of each.
    """

    times: NDArray[np.float64]
    inputs: NDArray[np.float64]
    outputs: Mapping[str, NDArray[np.float64]]
    wall_time: float
    start_cpu: float
    step_cpu: float

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        """Return one output over the run, shape (n,)."""
        return self.outputs[name]

    def final(self, name: str) -> float:
        """Return the last value of an output."""
        return float(self.outputs[name][-1])


def call(slave: FMU2Slave, name: str, *arguments: Any) -> None:
    """Call a function of an instance; FMICallException as fmpy, whose own way costs more than it.

    Arguments are converted by the types that fmpy has given the functions of the library.
    """
    status = getattr(slave.dll, name)(slave.component, *arguments)
    if status > fmi2Warning:
        raise FMICallException(function=name, status=status)


class Block:
    """A fixed set of Real variables that is read or written many times without allocation."""

    def __init__(self, slave: FMU2Slave, references: Sequence[int]) -> None:
        size = len(references)
        self.values = (c_double * size)()
        arguments = (fmi2ValueReference * size)(*references), size, self.values
        self._get = partial(call, slave, "fmi2GetReal", *arguments)
        self._set = partial(call, slave, "fmi2SetReal", *arguments)

    def read(self) -> list[float]:
        """Return the present values."""
        self._get()
        return self.values[:]

    def write(self, values: Sequence[float]) -> None:
        """Set the variables."""
        self.values[:] = list(values)
        self._set()


class _Explained:
    """A block in which a failed FMI call becomes a Refusal that says what the FMU logged."""

    def __init__(self, instance: Instance) -> None:
        self.instance = instance

    def __enter__(self) -> None:
        del self.instance.messages[:]

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if isinstance(error, FMICallException):
            instance = self.instance
            logged = "; ".join(dict.fromkeys(instance.messages))
            said = logged or f"{error} The FMU logged no reason."
            where = f"{instance.fmu.path.name} at t = {instance.time:.9g} s"
            raise Refusal(f"{where}: {said}") from error


@dataclass(frozen=True)
class _Plan:
    """How a set of variables is read and written: Integers one by one, Reals in one call."""

    integers: Mapping[str, int]
    reals: Sequence[str]
    block: Block


class Instance:
    """One instance of an FMU, reused through fmi2Reset by every `start`.

    `start` raises Refusal with the FMU's own words when a call fails; the other methods, which are
    called a million times over, do so inside an `explained` block.
    """

    def __init__(self, fmu: Fmu, slave: FMU2Slave, messages: list[str]) -> None:
        self.fmu = fmu
        self.slave = slave
        self.messages = messages
        self.time = 0.0
        self._used = False
        self._initialised = False
        self._explained = _Explained(self)
        self._settable: dict[tuple[str, ...], _Plan] = {}
        self._readable: dict[tuple[str, ...], _Plan] = {}
        self._inputs = self.block(list(INPUTS))

    def block(self, names: Sequence[str]) -> Block:
        """Return a block of Real variables of the FMU; FmuError for an unknown name."""
        return Block(self.slave, [self._variable(name).valueReference for name in names])

    def start(
        self,
        values: Mapping[str, float],
        stop_time: float | None = None,
        *,
        start_time: float = 0.0,
    ) -> None:
        """Initialise with the given parameters and inputs, all others at their start.

        Raises FmuError for an unknown name and Refusal for a value that the FMU does not take.
        """
        self.time = start_time
        with self.explained():
            if self._used:
                call(self.slave, "fmi2Reset")
            self._used = True
            self._initialised = False
            stop = (False, 0.0) if stop_time is None else (True, stop_time)
            call(self.slave, "fmi2SetupExperiment", False, 0.0, start_time, *stop)
            self._set(values)
            call(self.slave, "fmi2EnterInitializationMode")
            call(self.slave, "fmi2ExitInitializationMode")
            self._initialised = True

    def check_steps(self, times: NDArray[np.float64]) -> None:
        """Raise FmuError where the FMU takes equal steps only and those to `times` (s) differ."""
        steps = np.diff(times, prepend=self.time)
        if self.fmu.takes_equal_steps_only and np.ptp(steps) > EQUAL * np.max(steps):
            raise FmuError(
                f"{self.fmu.path.name} says canHandleVariableCommunicationStepSize = false, but "
                f"this needs steps from {np.min(steps):.6g} s to {np.max(steps):.6g} s; allowed is "
                "one size for the whole run"
            )

    def set_inputs(self, values: Sequence[float]) -> None:
        """Set phase (rad), load (N), frequency_ratio."""
        self._inputs.write(values)

    def step_to(self, target: float) -> None:
        """Advance to `target` (s)."""
        self.step_by(target - self.time)

    def step_by(self, size: float) -> None:
        """Advance by `size` (s)."""
        call(self.slave, "fmi2DoStep", self.time, size, True)
        self.time += size

    def value(self, name: str) -> float:
        """Return the present value of any variable; FmuError for an unknown name."""
        return self.read([name])[name]

    def read(self, names: Sequence[str]) -> dict[str, float]:
        """Return the present values of variables; FmuError for an unknown name."""
        plan = self._plan(self._readable, names, self._variable)
        found = dict(zip(plan.reals, plan.block.read(), strict=True))
        for name, reference in plan.integers.items():
            found[name] = float(self.slave.getInteger([reference])[0])
        return found

    def end(self) -> None:
        """Terminate, where the FMU is in a state that allows it, and free the instance."""
        if self._initialised:
            with suppress(FMICallException):  # nothing is lost: the instance is freed at once
                self.slave.terminate()
        self.slave.freeInstance()

    def _variable(self, name: str) -> ModelVariable:
        if name not in self.fmu.variables:
            raise FmuError(unknown_name("variable", name, self.fmu.variables))
        return self.fmu.variables[name]

    def _set(self, values: Mapping[str, float]) -> None:
        """Set Integers one by one and all Reals in one call, each of which costs a drive period."""
        plan = self._plan(self._settable, values, self.fmu.settable)
        for name, reference in plan.integers.items():
            try:
                check_integer(name, values[name])
            except ValueError as error:
                raise FmuError(str(error)) from error
            self.slave.setInteger([reference], [int(values[name])])
        plan.block.write([values[name] for name in plan.reals])

    def _plan(
        self,
        plans: dict[tuple[str, ...], _Plan],
        wanted: Iterable[str],
        find: Callable[[str], ModelVariable],
    ) -> _Plan:
        """Return how variables are read or written, made at the first use of these names."""
        names = tuple(wanted)
        plan = plans.get(names)
        if plan is None:
            found = {name: find(name) for name in names}
            integers = {n: v.valueReference for n, v in found.items() if v.type == "Integer"}
            reals = [name for name in names if name not in integers]
            plan = plans[names] = _Plan(integers, reals, self.block(reals))
        return plan

    def explained(self) -> AbstractContextManager[None]:
        """Turn a failed FMI call into a Refusal that carries what the FMU logged meanwhile."""
        return self._explained


@contextmanager
def instantiate(fmu: Fmu) -> Iterator[Instance]:
    """Instantiate an FMU for the length of the block; FmuError when it cannot be."""
    name = f"harness{next(_numbers)}"
    messages, callbacks = fmu_log.collect(name)
    try:
        try:
            slave = FMU2Slave(
                instanceName=name,
                guid=fmu.description.guid,
                modelIdentifier=fmu.identifier,
                unzipDirectory=str(fmu.folder),
            )
            slave.instantiate(callbacks=callbacks, loggingOn=True)
        except Exception as error:  # fmpy raises bare Exception for all that goes wrong here
            said = "; ".join([str(error), *messages])
            raise FmuError(f"{fmu.path}: cannot be instantiated: {said}") from error
        instance = Instance(fmu, slave, messages)
        try:
            yield instance
        finally:
            instance.end()
    finally:
        fmu_log.forget(name)


def run(
    instance: Instance,
    parameters: Mapping[str, float],
    schedule: Schedule,
    *,
    outputs: Sequence[str] = tuple(OUTPUTS),
    progress: Callable[[float], None] = lambda share: None,
) -> Record:
    """Run the schedule from the given parameters and return the outputs at all its points.

    `progress` is told now and then which share of the points is done. Raises FmuError and Refusal
    as `Instance.start` and `Instance.check_steps` do.
    """
    times = schedule.times
    inputs = schedule.sampled()
    held = inputs.tolist()
    values = np.empty((len(times), len(outputs)))
    began, began_cpu = time.perf_counter(), time.process_time()
    first = dict(zip(INPUTS, held[0], strict=True))
    instance.start({**parameters, **first}, stop_time=float(times[-1]))
    start_cpu = time.process_time() - began_cpu
    instance.check_steps(times[1:])
    block = instance.block(outputs)
    stepping_cpu = time.process_time()
    report_every = max(1, len(times) // 100)
    with instance.explained():
        values[0] = block.read()
        for index, target in enumerate(times[1:].tolist(), start=1):
            if index > 1 and held[index - 1] != held[index - 2]:
                instance.set_inputs(held[index - 1])
            instance.step_to(target)
            values[index] = block.read()
            if index % report_every == 0:
                progress(index / (len(times) - 1))
    step_cpu = time.process_time() - stepping_cpu
    wall_time = time.perf_counter() - began
    columns = {name: values[:, i].copy() for i, name in enumerate(outputs)}
    return Record(times, inputs, columns, wall_time, start_cpu, step_cpu)
