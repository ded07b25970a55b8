"""A small host of FMI 3.0 on top of fmpy: one instance, addressed by names."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import NamedTuple

from fmpy.fmi3 import FMU3Slave

from tests.fmu.host import OUTPUTS, AnyInstance, Entry, Unpacked


class Located(NamedTuple):
    """An event at which a step ended, with the outputs there."""

    time: float
    outputs: Mapping[str, float]


class Run(NamedTuple):
    """The outputs at the ends of the steps asked for, and the events."""

    rows: list[tuple[float, ...]]
    events: list[Located]


class _Slave(FMU3Slave):  # type: ignore[misc]
    """fmpy's object, whose calls for states have the names of FMI 2.0."""

    getFMUstate = FMU3Slave.getFMUState
    setFMUstate = FMU3Slave.setFMUState
    freeFMUstate = FMU3Slave.freeFMUState
    serializeFMUstate = FMU3Slave.serializeFMUState
    deSerializeFMUstate = FMU3Slave.deserializeFMUState


class Instance3(AnyInstance):
    """An instance of FMI 3.0."""

    real = "Float64"

    def __init__(
        self, unpacked: Unpacked, *, event_mode: bool = True, early_return: bool = True
    ) -> None:
        super().__init__(unpacked, _Slave(**unpacked.arguments))
        self.event_mode = event_mode
        self.slave.instantiate(
            loggingOn=True,
            eventModeUsed=event_mode,
            earlyReturnAllowed=early_return,
            logMessage=self._receive,
        )

    def _receive(self, _: object, status: int, category: bytes, text: bytes) -> None:
        self.entries.append(Entry("", status, category.decode(), text.decode()))

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

    def step_to(self, target: float) -> list[Located]:
        """Step until `target`, and handle the events before and there."""
        events: list[Located] = []
        while self.time < target:
            size = target - self.time
            needed, _, early, last = self.slave.doStep(self.time, size)
            assert early == (needed and last < self.time + size)
            assert self.get("time") == (last,)
            self.time = last if early else target
            if needed:
                events.append(Located(last, dict(zip(OUTPUTS, self.get(*OUTPUTS), strict=True))))
                self.handle_event()
        return events

    def run(self, steps: int, size: float) -> Run:
        """Take equal steps, from time 0 on."""
        run = Run([], [])
        for index in range(1, steps + 1):
            run.events.extend(self.step_to(index * size))
            run.rows.append(self.get(*OUTPUTS))
        return run


@contextmanager
def instance_3(unpacked: Unpacked, **options: bool) -> Iterator[Instance3]:
    """Makes an instance for the length of the block."""
    instance = Instance3(unpacked, **options)
    try:
        yield instance
    finally:
        instance.free()
