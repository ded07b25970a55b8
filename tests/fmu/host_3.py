"""A small host of FMI 3.0 on top of fmpy: one instance, addressed by names."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import NamedTuple

import pytest
from fmpy.fmi1 import FMICallException
from fmpy.fmi3 import FMU3Slave, fmi3Error

from tests.fmu.host import OUTPUTS, Unpacked


class Located(NamedTuple):
    """An event at which a step ended, with the outputs there."""

    time: float
    outputs: Mapping[str, float]


@dataclass
class Run:
    """The outputs at the ends of the steps asked for, and the events."""

    rows: list[tuple[float, ...]] = field(default_factory=list)
    events: list[Located] = field(default_factory=list)


class Instance3:
    """One instance; `slave` is fmpy's object, for calls that a proper host does not make."""

    def __init__(
        self, unpacked: Unpacked, *, event_mode: bool = True, early_return: bool = True
    ) -> None:
        self.log: list[tuple[int, str, str]] = []
        self.time = 0.0
        self.event_mode = event_mode
        self._variables = {v.name: v for v in unpacked.description.modelVariables}
        self.slave = FMU3Slave(
            guid=unpacked.description.guid,
            modelIdentifier=unpacked.description.coSimulation.modelIdentifier,
            unzipDirectory=str(unpacked.folder),
            instanceName="slider",
        )
        self.slave.instantiate(
            loggingOn=True,
            eventModeUsed=event_mode,
            earlyReturnAllowed=early_return,
            logMessage=self._receive,
        )

    def _receive(self, _: object, status: int, category: bytes, text: bytes) -> None:
        self.log.append((status, category.decode(), text.decode()))

    def initialize(self, **values: float) -> Instance3:
        self.set(**values)
        self.slave.enterInitializationMode()
        self.slave.exitInitializationMode()
        if self.event_mode:
            self.handle_event(enter=False)
        return self

    def handle_event(self, *, enter: bool = True) -> None:
        if enter:
            self.slave.enterEventMode()
        assert self.slave.updateDiscreteStates()[:5] == (False, False, False, False, False)
        self.slave.enterStepMode()

    def reference(self, name: str) -> int:
        return int(self._variables[name].valueReference)

    def set(self, **values: float) -> None:
        """One call per variable, in the order given."""
        for name, value in values.items():
            if self._variables[name].type == "Int32":
                self.slave.setInt32([self.reference(name)], [int(value)])
            else:
                self.slave.setFloat64([self.reference(name)], [value])

    def get(self, *names: str) -> tuple[float, ...]:
        return tuple(self.slave.getFloat64([self.reference(name) for name in names]))

    def step_to(self, target: float) -> list[Located]:
        """Step until `target`, and handle the events before and there."""
        events: list[Located] = []
        while self.time < target:
            needed, _, early, last = self.slave.doStep(self.time, target - self.time)
            assert early == (needed and last < target)
            assert self.get("time") == (last,)
            self.time = last if early else target
            if needed:
                events.append(Located(last, dict(zip(OUTPUTS, self.get(*OUTPUTS), strict=True))))
                self.handle_event()
        return events

    def run(self, steps: int, size: float) -> Run:
        """Take equal steps, from time 0 on."""
        run = Run()
        for index in range(1, steps + 1):
            run.events += self.step_to(index * size)
            run.rows.append(self.get(*OUTPUTS))
        return run

    def state(self) -> bytes:
        """The serialized state: everything that decides how a run goes on."""
        state = self.slave.getFMUState()
        try:
            return bytes(self.slave.serializeFMUState(state))
        finally:
            self.slave.freeFMUState(state)

    def restore(self, data: bytes) -> None:
        state = self.slave.deserializeFMUState(data)
        try:
            self.slave.setFMUState(state)
        finally:
            self.slave.freeFMUState(state)

    @contextmanager
    def refuses(self, *fragments: str) -> Iterator[None]:
        """Expects the call inside to be refused with a text, and to change nothing."""
        before, messages = self.state(), len(self.log)
        with pytest.raises(FMICallException) as caught:
            yield
        assert caught.value.status == fmi3Error
        ((status, category, text),) = self.log[messages:]
        assert (status, category) == (fmi3Error, "logStatusError")
        for fragment in fragments:
            assert fragment in text
        assert self.state() == before, "a refused call changes nothing"


@contextmanager
def instance_3(unpacked: Unpacked, **options: bool) -> Iterator[Instance3]:
    """Makes an instance for the length of the block."""
    instance = Instance3(unpacked, **options)
    try:
        yield instance
    finally:
        instance.slave.freeInstance()
