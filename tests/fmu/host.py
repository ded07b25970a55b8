"""A small host on top of fmpy: one instance, addressed by names, with its log collected."""

from __future__ import annotations

import ctypes
import math
from collections.abc import Callable, Collection, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

import pytest
from fmpy import calloc, extract, free, read_model_description
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import (
    FMU2Slave,
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
    fmi2Error,
    fmi2Fatal,
)
from fmpy.model_description import ModelDescription

from fmu_src.python.slider_component.variables import VARIABLES

OUTPUTS = tuple(v.name for v in VARIABLES if v.causality == "output")


@dataclass(frozen=True)
class Unpacked:
    folder: Path
    description: ModelDescription

    @property
    def status_of_refusals(self) -> int:
        """pythonfmu cannot say fmi2Error."""
        return int(fmi2Fatal if self.description.modelName == "SliderResonatorPy" else fmi2Error)

    @property
    def arguments(self) -> dict[str, str]:
        """What fmpy asks for."""
        return {
            "guid": self.description.guid,
            "modelIdentifier": self.description.coSimulation.modelIdentifier,
            "unzipDirectory": str(self.folder),
            "instanceName": "slider",
        }


def unpack(fmu: Path, folder: Path) -> Unpacked:
    extract(str(fmu), str(folder))
    return Unpacked(folder, read_model_description(str(fmu)))


@dataclass
class HostMemory:
    """Memory of a host: blocks by address, which are not zeroed, up to `limit` bytes in all."""

    limit: float = math.inf
    blocks: dict[int, ctypes.Array[ctypes.c_char]] = field(default_factory=dict)
    given: int = 0
    """How many blocks were given so far."""

    @property
    def in_use(self) -> int:
        return sum(map(len, self.blocks.values()))

    def allocate(self, count: int, size: int) -> int | None:
        if self.in_use + count * size > self.limit:
            return None
        block = ctypes.create_string_buffer(b"\xa5" * (count * size), count * size)
        self.blocks[ctypes.addressof(block)] = block
        self.given += 1
        return ctypes.addressof(block)

    def release(self, address: int) -> None:
        del self.blocks[address]


class Entry(NamedTuple):
    """A message to the host's logger."""

    instance: str
    status: int
    category: str
    text: str


class AnyInstance:
    """One instance of any version of FMI.

    `slave` is fmpy's object, for calls that a proper host does not make.
    """

    real = "Real"
    """The type of real variables."""

    def __init__(self, unpacked: Unpacked, slave: Any) -> None:
        self.slave = slave
        self.entries: list[Entry] = []
        self.time = 0.0
        self._status_of_refusals = unpacked.status_of_refusals
        self._variables = {v.name: v for v in unpacked.description.modelVariables}

    @property
    def log(self) -> list[str]:
        """Texts of all messages so far."""
        return [entry.text for entry in self.entries]

    def reference(self, name: str) -> int:
        return int(self._variables[name].valueReference)

    def set(self, **values: float) -> None:
        """One call per variable, in the order given."""
        for name, value in values.items():
            kind = self._variables[name].type
            number = value if kind == self.real else int(value)
            getattr(self.slave, f"set{kind}")([self.reference(name)], [number])

    def get(self, *names: str) -> tuple[float, ...]:
        references = [self.reference(name) for name in names]
        return tuple(getattr(self.slave, f"get{self.real}")(references))

    def state(self) -> bytes:
        """The serialized state: everything that decides how a run goes on."""
        state = self.slave.getFMUstate()
        try:
            return bytes(self.slave.serializeFMUstate(state))
        finally:
            self.slave.freeFMUstate(state)

    def restore(self, data: bytes) -> None:
        state = self.slave.deSerializeFMUstate(data)
        try:
            self.slave.setFMUstate(state)
        finally:
            self.slave.freeFMUstate(state)

    def free(self) -> None:
        self.slave.freeInstance()

    @contextmanager
    def refuses(self, *fragments: str) -> Iterator[None]:
        """Expects the calls inside to be refused with a text, and to change nothing."""
        before, messages = self.state(), len(self.log)
        with pytest.raises(FMICallException) as caught:
            yield
        assert caught.value.status == self._status_of_refusals, (
            "a refusal is an error, never fmi2Discard"
        )
        assert len(self.log) == messages + 1, "a refusal sends one message to the host's log"
        for fragment in fragments:
            assert fragment in self.log[-1], "the text names thing, value and requirement"
        assert self.state() == before, "a refused call leaves the state as it was, bit by bit"


class Instance(AnyInstance):
    """An instance of FMI 2.0."""

    def __init__(
        self,
        unpacked: Unpacked,
        *,
        logging_on: bool = True,
        memory: HostMemory | None = None,
        missing: Collection[str] = (),
    ) -> None:
        """Make an instance; the callbacks called `missing` are null."""
        super().__init__(unpacked, FMU2Slave(**unpacked.arguments))
        # Not fmpy's own logger: that sends the messages of all instances to the newest of them.
        callbacks = {
            "logger": fmi2CallbackLoggerTYPE(self._receive),
            "allocateMemory": fmi2CallbackAllocateMemoryTYPE(memory.allocate if memory else calloc),
            "freeMemory": fmi2CallbackFreeMemoryTYPE(memory.release if memory else free),
        }
        present = {name: function for name, function in callbacks.items() if name not in missing}
        self.slave.instantiate(callbacks=fmi2CallbackFunctions(**present), loggingOn=logging_on)

    def _receive(self, _: object, name: bytes, status: int, category: bytes, text: bytes) -> None:
        self.entries.append(Entry(name.decode(), status, (category or b"").decode(), text.decode()))

    def enter_initialization(self, start_time: float = 0.0, **values: float) -> Instance:
        self.slave.setupExperiment(startTime=start_time)
        self.slave.enterInitializationMode()
        self.set(**values)
        self.time = start_time
        return self

    def initialize(self, start_time: float = 0.0, **values: float) -> Instance:
        self.enter_initialization(start_time, **values).slave.exitInitializationMode()
        return self

    def ramp(self, **derivatives: float) -> None:
        """Set the first derivatives of inputs, per s; one call per input, in the order given."""
        for name, derivative in derivatives.items():
            self.slave.setRealInputDerivatives([self.reference(name)], [1], [derivative])

    def derivatives(self, *names: str) -> tuple[float, ...]:
        """First derivatives of outputs, per s."""
        references = [self.reference(name) for name in names]
        return tuple(self.slave.getRealOutputDerivatives(references, [1] * len(names)))

    def step(self, size: float) -> None:
        self.slave.doStep(currentCommunicationPoint=self.time, communicationStepSize=size)
        self.time += size

    def run(self, steps: int, size: float) -> list[tuple[float, ...]]:
        """All outputs after each of equal steps."""
        rows = []
        for _ in range(steps):
            self.step(size)
            rows.append(self.get(*OUTPUTS))
        return rows


Instantiate = Callable[[], Instance]
"""Makes an instance that is not initialized yet, as the fixture `instantiate` does."""
