"""The same run in other ways, each of which must give the same outputs to the last bit."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, suppress
from dataclasses import replace
from functools import partial

import numpy as np
from fmpy.fmi1 import FMICallException

from slider_resonator.checks.conduct.findings import CHOSEN, other_value, outputs_after, unequal
from slider_resonator.checks.conduct.output_derivatives import (
    derivative_faults,
    read_derivatives,
    status_faults,
)
from slider_resonator.checks.fmu_side import FmuSide
from slider_resonator.device.interface import INPUTS, PARAMETERS, TUNABLES
from slider_resonator.device.schedule import Schedule
from slider_resonator.errors import Refusal
from slider_resonator.fmu.instance import Instance, SavedState, instantiate
from slider_resonator.fmu.run import Running

Rows = Sequence[Sequence[float]]

AWAY = 1e-4
"""A step (s) that is taken back."""
RATES = (1.0, 2.0, 3.0)
"""Derivatives of the inputs, per s."""


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
    steps = {int(share * running.steps) for share in (0.0, 0.37, 0.81)}
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
            # A detour: other inputs and tunables for three steps.
            present = {**running.first, **instance.read(TUNABLES)}
            instance.set({name: other_value(name, value) for name, value in present.items()})
            for index in range(step, min(step + 3, running.steps)):
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
        steps = {int(share * running.steps) for share in (0.22, 0.53, 0.87)}
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
    broken = {"load": present["load"] + 10.0}
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


def rate_differences(fmu: FmuSide) -> Iterator[str]:
    """Set derivatives before values; leave out those of inputs that are held; set one by one.

    An input that is set without a derivative after a step is held from then on. Derivatives that
    are set at the corners of lines only last until the next corner.
    """
    instance = fmu.instance
    instance.fmu.require("canInterpolateInputs")
    plain = Replay.of(fmu)
    sampled, rates = plain.schedule.sampled.tolist(), plain.schedule.rates.tolist()

    def before_values(step: int) -> None:
        instance.inputs.write_rates(rates[step])
        _through_a_state(instance)
        instance.inputs.write(sampled[step])

    def without_zeros(step: int) -> None:
        instance.inputs.write(sampled[step])
        for name, rate in zip(INPUTS, rates[step], strict=True):
            if rate:
                instance.block([name]).write_rates([rate])

    def one_by_one(step: int) -> None:
        for name, value, rate in zip(INPUTS, sampled[step], rates[step], strict=True):
            instance.block([name]).write_rates([rate])
            instance.set({name: value})

    def at_corners(step: int) -> None:
        if step == 0 or not np.allclose(rates[step], rates[step - 1], rtol=1e-9, atol=1e-12):
            instance.inputs.write(sampled[step])
            instance.inputs.write_rates(rates[step])
        _through_a_state(instance)

    for what, set_inputs in (
        ("with derivatives set before values", before_values),
        ("without derivatives of 0", without_zeros),
        ("with derivatives set one by one", one_by_one),
    ):
        yield from plain.differences(what, _rows(plain, set_inputs))
    place = instance.fmu.outputs.index("position")
    kept, expected = (np.array(rows)[:, place] for rows in (_rows(plain, at_corners), plain.rows))
    off = float(np.abs(kept - expected).max() / np.abs(expected).max())
    if not off <= 1e-9:  # for inputs are added up differently
        yield f"position is off by {off:.2g} of its peak where derivatives are kept"
    yield from _begun(instance, fmu.scene.parameters)


def _rows(plain: Replay, set_inputs: Callable[[int], None]) -> Rows:
    """Return the rows of a run whose values and derivatives are set before each step."""
    running = plain.started()
    for step in range(running.steps):
        set_inputs(step)
        plain.instance.step_by(running.step_size(step))
        running.read()
    return running.rows


def _begun(instance: Instance, parameters: Mapping[str, float]) -> Iterator[str]:
    """Set derivatives before a reset, where they must end, and before initialization ends."""
    after_a_step = partial(outputs_after, instance, AWAY)
    instance.start(parameters)
    held = after_a_step()
    instance.start(parameters)
    instance.inputs.write_rates(RATES)
    growing = after_a_step()
    instance.inputs.write_rates(RATES)
    instance.start(parameters)
    if after_a_step() != held:
        yield "derivatives of inputs outlive a reset"
    instance.initialise(parameters)
    instance.inputs.write_rates(RATES)
    instance.begin()
    if after_a_step() != growing:
        yield "derivatives set before initialization ends are forgotten"
    instance.start(parameters)
    instance.inputs.write_rates(RATES)
    instance.set(instance.read(TUNABLES))
    if after_a_step() != growing:
        yield "derivatives of inputs are forgotten where parameters are set"


def _through_a_state(instance: Instance) -> None:
    """Serialise the state, set other derivatives, and go back, where the FMU offers that."""
    offers = instance.fmu.offers
    if offers.canGetAndSetFMUstate and offers.canSerializeFMUstate:
        with SavedState.of(instance) as state:
            instance.step_by(AWAY)
            instance.inputs.write([0.1, 0.2, 1.3])
            instance.inputs.write_rates(RATES)
            state.transfer(instance)
