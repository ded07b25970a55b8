"""The same run in other ways, each of which must give the same outputs to the last bit."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, suppress
from dataclasses import replace

import numpy as np
from fmpy.fmi1 import FMICallException

from slider_resonator.checks.conduct.findings import CHOSEN, other_value, unequal
from slider_resonator.checks.conduct.output_derivatives import (
    derivative_faults,
    read_derivatives,
    status_faults,
)
from slider_resonator.checks.fmu_side import FmuSide
from slider_resonator.device.interface import PARAMETERS, TUNABLES
from slider_resonator.device.schedule import Schedule
from slider_resonator.errors import Refusal
from slider_resonator.fmu.instance import Instance, SavedState, instantiate
from slider_resonator.fmu.run import Running

Rows = Sequence[Sequence[float]]

SAVED_AT = (0.0, 0.37, 0.81)
"""Shares of the steps of a run after which its state is saved."""
TRANSFERRED_AT = (0.22, 0.53, 0.87)
"""Shares of the steps after which another instance takes over."""
BREAKING_LOAD = 10.0
"""Added load (N) under which initialization ends where the load is set after it."""
DETOUR = 3
"""Steps under other values before a state is restored."""


class Replay:
    """A run on an instance, and how the rows of the same run in another way differ."""

    def __init__(
        self, instance: Instance, parameters: Mapping[str, float], schedule: Schedule
    ) -> None:
        self.instance = instance
        self.parameters = parameters
        self.schedule = schedule
        self.rows = self.again()

    @classmethod
    def of(cls, fmu: FmuSide) -> "Replay":
        """Return the run of the scene."""
        return cls(fmu.instance, fmu.scene.parameters, fmu.scene.schedule())

    def again(self) -> Rows:
        """Return the rows of the run."""
        with self.instance.explained():
            running = self.started()
            running.finish()
        return running.rows

    def started(self) -> Running:
        """Return the run, started anew, with its first reading."""
        running = Running(self.instance, self.schedule)
        running.start(self.parameters)
        running.read()
        return running

    def differences(self, what: str, rows: Rows, *, begin: int = 0) -> Iterator[str]:
        """Yield where rows from the reading `begin` on are not those of the run to the last bit.

        `what` begins each finding.
        """
        outputs, times = self.instance.fmu.outputs, self.schedule.readings()[begin:]
        expected = self.rows[begin:]
        for row, column in np.argwhere(np.array(rows) != np.array(expected)).tolist():
            yield (
                f"{what}: {outputs[column]} at {times[row]:.9g} s is {rows[row][column]!r}, was "
                f"{expected[row][column]!r}"
            )


def reset_differences(fmu: FmuSide) -> Iterator[str]:
    """Compare a run on a new instance with one after a reset: after a run, and in its middle."""
    fmu.instance.renew()
    first = Replay.of(fmu)
    yield from first.differences("after a reset", first.again())
    running = first.started()
    running.finish(end=running.steps // 2)
    fmu.instance.terminate()
    yield from first.differences("after a run that was terminated and reset", first.again())


def restored_differences(fmu: FmuSide) -> Iterator[str]:
    """Save states in a run, and go on from each after the run and a detour.

    From each saved state derivatives of outputs are compared with a short step, but not from the
    start of averages of first order, whose fast part sets in with the first step.
    """
    plain, instance, device = Replay.of(fmu), fmu.instance, fmu.scene.device
    begins_resolved = device.fidelity > 0 or device.averaging_order == 2
    largest = np.abs(np.array(plain.rows)).max(axis=0).tolist()
    peaks = dict(zip(instance.fmu.outputs, largest, strict=True))
    running = plain.started()
    steps = {int(share * running.steps) for share in SAVED_AT}
    saved: list[tuple[int, int, SavedState]] = []
    with ExitStack() as states:
        for step in range(running.steps):
            if step in steps:
                state = states.enter_context(SavedState.of(instance))
                saved.append((step, len(running.rows), state))
                if begins_resolved or step > 0:
                    yield from derivative_faults(instance, state, peaks)
            running.advance(step)
        yield from plain.differences("while states are saved", running.rows)
        for step, rows, state in reversed(saved):
            state.restore()
            # A detour: other inputs and tunables for a few steps.
            present = {**running.first, **instance.read(TUNABLES)}
            instance.set({name: other_value(name, value) for name, value in present.items()})
            for index in range(step, min(step + DETOUR, running.steps)):
                instance.step_by(running.step_size(index))
            state.restore()
            running.rows = []
            running.read()
            running.finish(step)
            what = f"restored after step {step}"
            yield from plain.differences(what, running.rows, begin=rows - 1)


def transferred_differences(fmu: FmuSide) -> Iterator[str]:
    """Go on in another instance, at first new and then used, from serialised states."""
    instance = fmu.instance
    instance.fmu.require("canGetAndSetFMUstate")
    instance.fmu.require("canSerializeFMUstate")
    instance.fmu.require("canBeInstantiatedOnlyOncePerProcess", of=False)
    plain = Replay.of(fmu)
    with instantiate(instance.fmu) as other:
        running, taken = plain.started(), Running(other, plain.schedule)
        steps = {int(share * running.steps) for share in TRANSFERRED_AT}
        for step in range(running.steps):
            if step in steps:
                with SavedState.of(instance) as state:
                    state.transfer(other)
                taken.rows = []
                taken.read()
                taken.finish(step)
                what = f"in another instance from step {step} on"
                yield from plain.differences(what, taken.rows, begin=len(running.rows) - 1)
            running.advance(step)
    yield from plain.differences("while its state is taken over", running.rows)


def beside_differences(fmu: FmuSide) -> Iterator[str]:
    """Step two instances in turn, the second started later, and compare each with itself alone.

    The second one is the same model of another device, under other inputs.
    """
    fmu.instance.fmu.require("canBeInstantiatedOnlyOncePerProcess", of=False)
    plain = Replay.of(fmu)
    others = {
        name: other_value(name, plain.parameters.get(name))
        for name in PARAMETERS
        if name in fmu.instance.fmu.variables and name not in CHOSEN
    }
    signals = {
        name: replace(signal, values=tuple(other_value(name, value) for value in signal.values))
        for name, signal in plain.schedule.signals.items()
    }
    own = replace(plain.schedule, signals=signals, tuning={})
    with instantiate(fmu.instance.fmu) as other, other.explained():
        alone = Replay(other, {**plain.parameters, **others}, own)
        first = plain.started()
        late = min(1, first.steps)
        first.finish(end=late)
        second = alone.started()
        for step in range(first.steps):
            if step + late < first.steps:
                first.advance(step + late)
            second.advance(step)
        yield from plain.differences("beside another instance", first.rows)
        for run, when in ((plain, "beside another instance"), (alone, "in the other instance")):
            kept = {n: value for n, value in run.parameters.items() if n not in TUNABLES}
            yield from unequal(run.instance, kept, when)
        yield from alone.differences("the other instance", second.rows)


def overwritten_differences(fmu: FmuSide) -> Iterator[str]:
    """Set another value before each value, at the start and in the run.

    Before the run outputs are read under the other values.
    """
    plain, instance = Replay.of(fmu), fmu.instance
    running = Running(instance, plain.schedule)
    values = dict(instance.fmu.settings({**plain.parameters, **running.first}))

    def set_twice(values: Mapping[str, float]) -> None:
        for name, value in values.items():
            instance.set({name: other_value(name, value)})
        instance.set(values)

    instance.set_up(**running.span)
    set_twice(values)
    instance.call("fmi2EnterInitializationMode")
    for name, value in reversed(values.items()):
        instance.set({name: other_value(name, value)})
        with suppress(FMICallException):  # some values have no meaning together
            instance.outputs()
        instance.set({name: value})
    instance.begin()
    running.read()
    for step in range(running.steps):
        set_twice(running.values_at(step))
        running.advance(step)
    yield from plain.differences("with values set again", running.rows)


def separate_differences(fmu: FmuSide) -> Iterator[str]:
    """Set what changes, and nothing else, each value by a call of its own.

    Initialization ends under a load that breaks a stick; that of the scene is set after it, as many
    hosts do.
    """
    plain, instance = Replay.of(fmu), fmu.instance
    running = Running(instance, plain.schedule)
    present = dict(running.first)
    broken = {"load": present["load"] + BREAKING_LOAD}
    instance.start({**plain.parameters, **present, **broken}, **running.span)
    instance.set({"load": present["load"]})
    running.read()
    for step in range(running.steps):
        for name, value in reversed(running.values_at(step).items()):
            if value != present[name]:
                instance.set({name: value})
                present[name] = value
        running.advance(step)
    yield from plain.differences("with values set one by one", running.rows)


def reading_differences(fmu: FmuSide) -> Iterator[str]:
    """Read all variables, one by one and backwards, and the status, between any two calls."""
    plain, instance = Replay.of(fmu), fmu.instance
    running = Running(instance, plain.schedule)
    names = [name for name, v in instance.fmu.variables.items() if v.type == "Real"]
    blocks = [instance.block([name]) for name in names]
    backwards = instance.block(names[::-1])
    changed: list[str] = []

    def read_all() -> None:
        one_by_one = [block.read()[0] for block in blocks]
        at_once = backwards.read()[::-1]
        for name, first, second in zip(names, one_by_one, at_once, strict=True):
            if first != second:
                changed.append(f"{name} read twice is {first!r} and {second!r}")
        read_derivatives(instance)

    instance.initialise({**plain.parameters, **running.first}, **running.span)
    read_all()
    instance.begin()
    read_all()
    running.read()
    for step in range(running.steps):
        running.advance(step, read_all)
        read_all()
        yield from status_faults(instance)
    yield from plain.differences("with more readings", running.rows)
    yield from changed


def other_device_differences(fmu: FmuSide) -> Iterator[str]:
    """Compare a run with those after runs of devices that differ in one parameter each.

    Each of them is the first on its instance. A device that the FMU refuses is left out.
    """
    instance = fmu.instance
    instance.renew()
    plain = Replay.of(fmu)
    for name in PARAMETERS:
        if name not in instance.fmu.variables or name in plain.schedule.tuning:
            continue
        other = {name: other_value(name, plain.parameters.get(name))}
        instance.renew()  # for the other device to be the first one that is prepared
        try:
            Replay(instance, {**plain.parameters, **other}, plain.schedule)
        except Refusal:
            continue
        yield from plain.differences(f"after a device of another {name}", plain.again())
