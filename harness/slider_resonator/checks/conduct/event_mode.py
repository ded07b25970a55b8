"""Event mode of FMI 3.0: steps that end at events, what they answer, and the time in between."""

from collections.abc import Iterator
from contextlib import contextmanager
from ctypes import c_double, c_uint
from math import tau

import numpy as np
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import fmi2Warning

from slider_resonator.checks.conduct.findings import is_refused
from slider_resonator.fmu.instance import Instance, load
from slider_resonator.fmu.opening import Fmu

DEVICE = {"normal_amplitude": 1.8, "base_amplitude": 3e-6, "phase": 0.4, "load": 0.02}
"""A slider that sticks, slides both ways and flies in each period."""

STEP = 0.9 * tau / 3500.0
"""Size of a step, s."""
STEPS = 8
FINE = 40
"""Parts of a step after which the run without event mode is asked for the last event."""
SOON = 1e-9
"""Size of a step after an event, s."""
SAME_TIME = 1e-12
"""Difference of times that are equal but for rounding, s."""
SAME_SHARE = 1e-9
"""Difference of outputs, over their peak, that events leave to rounding."""
MAX_EVENTS = 100
"""Events in a step from which on it makes no progress."""


class _Slave:
    """An instance of an FMI 3.0 FMU, its variables by name."""

    def __init__(self, fmu: Fmu, *, events: bool, early: bool) -> None:
        self.slave = load(fmu, "events")
        self._found = fmu.variables
        self.outputs = fmu.outputs
        (self.time,) = (
            v.valueReference for v in fmu.variables.values() if v.causality == "independent"
        )
        self.slave.instantiate(
            eventModeUsed=events, earlyReturnAllowed=early, logMessage=lambda *_: None
        )

    def reference(self, name: str) -> int:
        return int(self._found[name].valueReference)

    def read(self, *names: str) -> list[float]:
        return list(self.slave.getFloat64([self.reference(name) for name in names]))

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


@contextmanager
def _started(fmu: Fmu, *, events: bool, early: bool) -> Iterator[_Slave]:
    """Start a run of the device, at whose end the instance is freed."""
    started = _Slave(fmu, events=events, early=early)
    try:
        started.slave.enterInitializationMode(startTime=0.0, stopTime=STEPS * STEP)
        for name, value in DEVICE.items():
            started.slave.setFloat64([started.reference(name)], [value])
        started.slave.exitInitializationMode()
        yield started
    finally:
        started.slave.freeInstance()


def event_mode_faults(instance: Instance) -> list[str]:
    """Run an FMI 3.0 FMU with and without event mode, and compare."""
    fmu = instance.fmu
    try:
        rows, times = _plain_run(fmu)
        faults = [*_run_faults(fmu, rows, times), *_last_moment_faults(fmu, times)]
        faults += [*_late_return_faults(fmu), *_call_faults(fmu)]
    except FMICallException as error:
        faults = [f"a run with event mode fails: {error}"]
    return faults


def _plain_run(fmu: Fmu) -> tuple[list[list[float]], list[float]]:
    """Return the outputs after each step of a run without event mode, and the times of events."""
    rows, times = [], list[float]()
    with _started(fmu, events=False, early=False) as plain:
        for part in range(STEPS * FINE):
            plain.slave.doStep(part * STEP / FINE, STEP / FINE)
            (last,) = plain.read("last_event_time")
            if last > 0.0 and not (times and times[-1] == last):
                times.append(last)
            if (part + 1) % FINE == 0:
                rows.append(plain.read(*fmu.outputs))
    return rows, times


def _run_faults(fmu: Fmu, rows: list[list[float]], times: list[float]) -> Iterator[str]:
    """Run with event mode and early return: each event ends a step, and changes no output."""
    peaks = np.max(np.abs(rows), axis=0)
    seen: list[float] = []
    with _started(fmu, events=True, early=True) as slave:
        yield from slave.handle_event()
        for step, row in enumerate(rows):
            yield from _step_faults(slave, step * STEP, (step + 1) * STEP, seen)
            found = slave.read(*fmu.outputs)
            for name, value, right, peak in zip(fmu.outputs, found, row, peaks, strict=True):
                if not abs(value - right) <= SAME_SHARE * peak:
                    yield f"with event mode {name} is {value!r}, was {right!r}"
        if not is_refused(lambda: slave.slave.doStep(STEPS * STEP, STEP)):
            yield "with event mode a step beyond the stop time is accepted"
    for time in times:
        if not any(abs(time - other) <= SAME_TIME for other in seen):
            yield f"the event at {time!r} s ends no step"


def _step_faults(slave: _Slave, now: float, target: float, seen: list[float]) -> Iterator[str]:
    """Advance to a time, by as many steps as there are events; gather the times of these."""
    for _ in range(MAX_EVENTS):
        (before,) = slave.read("last_event_time")
        event, ended, early, reached = slave.slave.doStep(now, target - now)
        (last,) = slave.read("last_event_time")
        if ended:
            yield f"the step to {reached!r} s asks for the end"
        if slave.now() != reached:
            yield f"time is {slave.now()!r} s after a step to {reached!r} s"
        if early and not (event and reached < target):
            yield f"an early return at {reached!r} s in a step to {target!r} s"
        if not early and abs(reached - target) > SAME_TIME:
            yield f"a step to {target!r} s ends at {reached!r} s without an early return"
        if event and abs(last - reached) > SAME_TIME:
            yield f"a step ends at an event at {reached!r} s, but the last one is at {last!r} s"
        if not event and last != before:
            yield f"the event at {last!r} s ends no step"
        if event:
            seen.append(last)
            slave.slave.enterEventMode()
            yield from slave.handle_event()
        now = reached
        if not early:
            return
    yield f"{MAX_EVENTS} events between two communication points"


def _last_moment_faults(fmu: Fmu, times: list[float]) -> Iterator[str]:
    """Step to the very times of events, each from the start, and on: by rounding they come then."""
    for time in times:
        seen: list[float] = []
        with _started(fmu, events=True, early=True) as slave:
            yield from slave.handle_event()
            yield from _step_faults(slave, 0.0, time, seen)
            yield from _step_faults(slave, time, time + SOON, seen)
        if not (seen and abs(seen[-1] - time) <= SAME_TIME):
            yield f"the event at {time!r} s is lost where a step ends there"


def _late_return_faults(fmu: Fmu) -> Iterator[str]:
    """Run with event mode, but without early return: steps run through events."""
    with _started(fmu, events=True, early=False) as slave:
        slave.slave.enterStepMode()
        for step in range(STEPS):
            *_, early, reached = slave.slave.doStep(step * STEP, STEP)
            if early or abs(reached - (step + 1) * STEP) > SAME_TIME:
                yield "a step returns early though the host did not allow it"
                return


def _call_faults(fmu: Fmu) -> Iterator[str]:
    """Try calls that only FMI 3.0 has."""
    with _started(fmu, events=False, early=False) as slave:
        slave.slave.doStep(0.0, STEP)
        if not is_refused(slave.slave.enterEventMode):
            yield "fmi3EnterEventMode is accepted though the host announced that it uses none"
        if not is_refused(lambda: slave.slave.setFloat64([slave.time], [1.0])):
            yield "time can be set"
        names = [slave.reference("position"), slave.time, slave.reference("resonator_velocity")]
        alone = [slave.slave.getFloat64([name])[0] for name in names]
        if list(slave.slave.getFloat64(names)) != alone:
            yield "values read together with time are others than alone"
        values = (c_double * 2)()
        references = (c_uint * 1)(slave.reference("position"))
        status = slave.slave.dll.fmi3GetFloat64(slave.slave.component, references, 1, values, 2)
        if status <= fmi2Warning:
            yield "fmi3GetFloat64 accepts two values for one reference"
