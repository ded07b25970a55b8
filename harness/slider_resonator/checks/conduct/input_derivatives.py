"""Derivatives of inputs, set in other ways: the motion must be the same, and they must end."""

from collections.abc import Callable, Iterator, Mapping
from functools import partial

import numpy as np

from slider_resonator.checks.conduct.findings import outputs_after
from slider_resonator.checks.conduct.replays import Replay, Rows
from slider_resonator.checks.fmu_side import FmuSide
from slider_resonator.device.interface import INPUTS, TUNABLES
from slider_resonator.fmu.instance import Instance, SavedState

AWAY = 1e-4
"""A step (s) that is taken back."""

RATES = (1.0, 2.0, 3.0)
"""Derivatives of the inputs, per s."""

ROUNDING = 1e-9
"""Share of the peak by which positions may differ where inputs are added up differently."""


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
    if not off <= ROUNDING:
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
