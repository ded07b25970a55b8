"""Event mode of FMI 3.0: steps that end at events, what they answer, and the time in between."""

from collections.abc import Iterator
from contextlib import AbstractContextManager, ExitStack
from ctypes import c_double, c_uint
from math import tau

import numpy as np
from fmpy.fmi2 import fmi2Warning

from slider_resonator.checks.conduct.findings import is_refused
from slider_resonator.fmu.instance import Instance, load
from slider_resonator.fmu.opening import Fmu

DEVICE = {"normal_amplitude": 1.8, "base_amplitude": 3e-6, "phase": 0.4, "load": 0.02}
"""A slider that sticks, slides both ways and flies in each period."""
LAST = "last_event_time"

STEP = 0.9 * tau / 3500.0
"""Size of a step, s."""
STEPS = 8
FINE = 40
"""Parts of a step after which the run without event mode is asked for the last event."""
SAME_TIME = 1e-12
"""Difference of times that are equal but for rounding, s."""
MAX_EVENTS = 100
"""Events in a step from which on it makes no progress."""


class _EventRun(AbstractContextManager["_EventRun"]):
    """A run of the device on an instance of its own, by the calls that only FMI 3.0 has.

    `seen` are the times (s) of the events that have ended a step. The end of a `with` block frees
    the instance.
    """

    def __init__(self, fmu: Fmu, *, events: bool = True, early: bool = True) -> None:
        self.fmu = fmu
        self.slave = load(fmu, "events")
        self.seen: list[float] = []
        every = fmu.variables.values()
        (self.time,) = (v.valueReference for v in every if v.causality == "independent")
        self.slave.instantiate(
            eventModeUsed=events, earlyReturnAllowed=early, logMessage=lambda *_: None
        )

    def __enter__(self) -> "_EventRun":
        with ExitStack() as on_error:
            on_error.callback(self.slave.freeInstance)
            self.slave.enterInitializationMode(startTime=0.0, stopTime=STEPS * STEP)
            for name, value in DEVICE.items():
                self.slave.setFloat64([self.fmu.reference(name)], [value])
            self.slave.exitInitializationMode()
            on_error.pop_all()
        return self

    def __exit__(self, *_: object) -> None:
        self.slave.freeInstance()

    def read(self, *names: str) -> list[float]:
        return list(self.slave.getFloat64([self.fmu.reference(name) for name in names]))

    def now(self) -> float:
        return float(self.slave.getFloat64([self.time])[0])

    def handle_event(self) -> Iterator[str]:
        """Ask for what is to be done in event mode, and leave it."""
        needed, ended, *_, defined, following = self.slave.updateDiscreteStates()
        if needed or ended:
            yield "fmi3UpdateDiscreteStates asks for another call, or for the end"
        if defined and not following > self.now():
            yield f"fmi3UpdateDiscreteStates announces an event at {following!r} s, which is over"
        self.slave.enterStepMode()

    def advance(self, now: float, target: float) -> Iterator[str]:
        """Advance to a time, by as many steps as there are events."""
        for _ in range(MAX_EVENTS):
            (before,) = self.read(LAST)
            event, ended, early, reached = self.slave.doStep(now, target - now)
            (last,) = self.read(LAST)
            if ended:
                yield f"the step to {reached!r} s asks for the end"
            if self.now() != reached:
                yield f"time is {self.now()!r} s after a step to {reached!r} s"
            if early and not (event and reached < target):
                yield f"an early return at {reached!r} s in a step to {target!r} s"
            if not early and abs(reached - target) > SAME_TIME:
                yield f"a step to {target!r} s ends at {reached!r} s without an early return"
            if event and abs(last - reached) > SAME_TIME:
                yield f"a step ends at an event at {reached!r} s, but the last one is at {last!r} s"
            if not event and abs(last - before) > SAME_TIME:
                yield f"the event at {last!r} s ends no step"
            if event:
                self.seen.append(last)
                self.slave.enterEventMode()
                yield from self.handle_event()
            now = reached
            if not early:
                return
        yield f"{MAX_EVENTS} events between two communication points"


def event_mode_faults(instance: Instance) -> Iterator[str]:
    """Run an FMI 3.0 FMU with and without event mode, and compare."""
    fmu = instance.fmu
    rows, times = [], set[float]()
    instance.start(DEVICE, stop_time=STEPS * STEP)
    for part in range(1, STEPS * FINE + 1):
        instance.step_to(part * STEP / FINE)
        times.add(instance.value(LAST))
        if part % FINE == 0:
            rows.append([*instance.outputs().values()])
    yield from _event_faults(fmu, rows, sorted(times - {0.0}))
    yield from _return_faults(fmu)
    yield from _call_faults(fmu)


def _event_faults(fmu: Fmu, rows: list[list[float]], times: list[float]) -> Iterator[str]:
    """Run with event mode and early return: each event ends a step, and changes no output.

    Step to the very times of events, too, each from the start, and on: by rounding they come then.
    """
    peaks = np.max(np.abs(rows), axis=0)
    with _EventRun(fmu) as run:
        yield from run.handle_event()
        for step, row in enumerate(rows):
            yield from run.advance(step * STEP, (step + 1) * STEP)
            found = run.read(*fmu.outputs)
            for name, value, right, peak in zip(fmu.outputs, found, row, peaks, strict=True):
                if not abs(value - right) <= 1e-9 * peak:  # which events leave to rounding
                    yield f"with event mode {name} is {value!r}, was {right!r}"
        if not is_refused(run.slave.doStep, STEPS * STEP, STEP):
            yield "with event mode a step beyond the stop time is accepted"
    for time in times:
        if not any(abs(time - other) <= SAME_TIME for other in run.seen):
            yield f"the event at {time!r} s ends no step"
    for time in times:
        with _EventRun(fmu) as run:
            yield from run.handle_event()
            yield from run.advance(0.0, time)
            yield from run.advance(time, time + 1e-9)
        if not (run.seen and abs(run.seen[-1] - time) <= SAME_TIME):
            yield f"the event at {time!r} s is lost where a step ends there"


def _return_faults(fmu: Fmu) -> Iterator[str]:
    """Run with event mode, but without early return: steps run through events."""
    with _EventRun(fmu, early=False) as run:
        run.slave.enterStepMode()
        for step in range(STEPS):
            *_, early, reached = run.slave.doStep(step * STEP, STEP)
            if early or abs(reached - (step + 1) * STEP) > SAME_TIME:
                yield "a step returns early though the host did not allow it"
                return


def _call_faults(fmu: Fmu) -> Iterator[str]:
    """Try calls that only FMI 3.0 has."""
    with _EventRun(fmu, events=False, early=False) as run:
        slave, position = run.slave, fmu.reference("position")
        slave.doStep(0.0, STEP)
        if not is_refused(slave.enterEventMode):
            yield "fmi3EnterEventMode is accepted though the host announced that it uses none"
        if not is_refused(slave.setFloat64, [run.time], [1.0]):
            yield "time can be set"
        names = [position, run.time, fmu.reference("resonator_velocity")]
        if list(slave.getFloat64(names)) != [slave.getFloat64([name])[0] for name in names]:
            yield "values read together with time are others than alone"
        values, references = (c_double * 2)(), (c_uint * 1)(position)
        status = slave.dll.fmi3GetFloat64(slave.component, references, 1, values, 2)
        if status <= fmi2Warning:
            yield "fmi3GetFloat64 accepts two values for one reference"
