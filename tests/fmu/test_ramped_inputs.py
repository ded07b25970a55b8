"""Resolved motion under inputs that vary linearly over steps, against independent programs."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np
import pytest

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.simulate import simulate
from tests.fmu.host import Instance, Instantiate
from tests.fmu.trajectories import assert_equal
from tests.fmus import native_fmu_only
from tests.problems import PROBLEMS, SIGNALS

pytestmark = native_fmu_only

STEP = 0.01
"""A communication step [s]: 5.6 drive periods."""
RATES = {"phase": "phase_rate", "load": "load_rate", "frequency_ratio": "ratio_rate"}
STARTS = {"phase": 0.0, "load": 0.0, "frequency_ratio": 1.0}

PHASE = {"phase": 2.0}
LOAD = {"load": 0.12}
CHIRP = {"frequency_ratio": 4.0}
"""From a ratio of 1 to 1.4 in 0.1 s."""
BACK = {"phase": -30.0, "load": -3.0}

ORDINARY = ("table 1", "lift-off", "sticking every period", "undamped, slipping resonance")
STILL = ("ratio 0", "softest resonator")
"""Problems whose normal load does not vibrate."""


def inputs_at(
    first: Mapping[str, float], rates: Mapping[str, float], time: float
) -> dict[str, float]:
    return {name: first.get(name, STARTS[name]) + rate * time for name, rate in rates.items()}


def start(
    instantiate: Instantiate, parameters: Mapping[str, float], first: Mapping[str, float]
) -> Instance:
    return instantiate().initialize(**parameters, **first)


def ramped(
    instance: Instance,
    first: Mapping[str, float],
    rates: Mapping[str, float],
    times: Array,
) -> Array:
    """Signals at `times`, the ends of steps; inputs and derivatives are set before each."""
    rows = []
    for time in times.tolist():
        instance.set(**inputs_at(first, rates, instance.time))
        instance.ramp(**rates)
        instance.step(time - instance.time)
        rows.append(instance.get(*SIGNALS))
    return np.array(rows)


def staircase(
    instance: Instance,
    first: Mapping[str, float],
    rates: Mapping[str, float],
    stop: float,
    count: int,
) -> Array:
    """Signals at the stop after steps with inputs held at their values in the middle of each."""
    for k in range(count):
        instance.set(**inputs_at(first, rates, (k + 0.5) * stop / count))
        instance.step(stop / count)
    return np.array(instance.get(*SIGNALS))


def straight(
    first: Mapping[str, float], rates: Mapping[str, float], stop: float
) -> list[HeldInputs]:
    return [HeldInputs(0.0, stop, **first, **{RATES[name]: rate for name, rate in rates.items()})]


def turned_away(ratio: float) -> float:
    """A rate of the frequency ratio by which it keeps its sign."""
    return math.copysign(50.0, ratio)


@pytest.mark.parametrize(
    "name", [n if n in ORDINARY else pytest.param(n, marks=pytest.mark.slow) for n in PROBLEMS]
)
def test_motion_is_that_of_the_reference(instantiate: Instantiate, name: str) -> None:
    problem = PROBLEMS[name]
    first = problem.pieces[0][1]
    times = STEP * np.arange(1.0, 4.0)
    ramps = [PHASE | LOAD]
    if name not in STILL:
        ratio = first.get("frequency_ratio", 1.0)
        ramps.append((LOAD if abs(ratio) < 0.1 else BACK) | {"frequency_ratio": turned_away(ratio)})
    for rates in ramps:
        instance = start(instantiate, problem.parameters, first)
        signals = ramped(instance, first, rates, times)
        reference = simulate(problem.device, straight(first, rates, times[-1]), times)
        assert_equal(signals, reference, 1e-9)
        reversals, last, mode = instance.get("reversals", "last_event_time", "contact_mode")
        assert reversals == reference.reversals, "reversals seen by the reference"
        assert mode == reference.contact_mode[-1], "the contact at the end"
        if reference.event_times.size:
            assert last == pytest.approx(reference.event_times[-1], abs=1e-12)


@pytest.mark.parametrize("lifts", [False, True])
@pytest.mark.parametrize("fidelity", [1, 2])
@pytest.mark.parametrize(
    "stiffness", [1e5, *(pytest.param(x, marks=pytest.mark.slow) for x in (50.0, 1e8))]
)
def test_lugre_motion_under_ramps_is_within_its_tolerance(
    instantiate: Instantiate, stiffness: float, fidelity: int, lifts: bool
) -> None:
    parameters = {
        "friction_law": 1,
        "bristle_stiffness": stiffness,
        "fidelity": fidelity,
        "normal_amplitude": 1.8 if lifts else 1.0,
    }
    times = STEP * np.arange(1.0, 4.0)
    for rates in (PHASE | LOAD, CHIRP | BACK):
        instance = start(instantiate, parameters, {})
        signals = ramped(instance, {}, rates, times)
        held = straight({}, rates, times[-1])
        reference = simulate(Device.from_mapping(parameters), held, times)
        assert_equal(signals, reference, 1e-7)
        # From rest a growing load moves the slider by 1e-27 m before the resonator turns it.
        below_rounding = np.count_nonzero(reference.event_times < 1e-8)
        (reversals,) = instance.get("reversals")
        assert 0 <= reference.reversals - reversals <= below_rounding, (
            "every reversal beyond rounding is counted"
        )


@pytest.mark.parametrize("law", [0, 1])
@pytest.mark.parametrize("count", [2, 7, 1000])
def test_motion_under_ramps_does_not_depend_on_the_steps(
    instantiate: Instantiate, law: int, count: int
) -> None:
    parameters = {"friction_law": law, "normal_amplitude": 1.5}
    rates, stop = {"phase": 20.0, "load": 0.5, "frequency_ratio": -40.0}, 0.04
    whole, parts = (
        ramped(start(instantiate, parameters, {}), {}, rates, np.linspace(0.0, stop, n + 1)[1:])[-1]
        for n in (1, count)
    )
    allowed = 1e-11 if law == 0 else 1e-7
    assert parts[:4] == pytest.approx(whole[:4], rel=allowed, abs=allowed * 1e-3), (
        f"{count} steps give the motion of one"
    )


def test_a_ratio_that_changes_its_sign(instantiate: Instantiate) -> None:
    """The normal load turns back, also in flight; held steps, extrapolated, are the reference."""
    rates, stop = {"frequency_ratio": -40.0}, 0.04
    for phase in (0.0, 2.0, 4.0):
        first = {"phase": phase}
        parameters = {"normal_amplitude": 1.5}
        signals = ramped(start(instantiate, parameters, first), first, rates, np.array([stop]))[-1]
        coarse, fine = (
            staircase(start(instantiate, parameters, first), first, rates, stop, count)
            for count in (2000, 4000)
        )
        extrapolated = fine + (fine - coarse) / 3.0
        assert signals[:4] == pytest.approx(extrapolated[:4], rel=1e-6), f"phase {phase} rad"


@pytest.mark.parametrize("fidelity", [0, 1, 2])
@pytest.mark.parametrize("law", [0, 1])
def test_a_derivative_of_zero_is_a_held_input_bit_for_bit(
    instantiate: Instantiate, law: int, fidelity: int
) -> None:
    rows: list[Sequence[tuple[float, ...]]] = []
    for sets_derivatives in (False, True):
        instance = start(instantiate, {"friction_law": law, "fidelity": fidelity}, {"phase": 0.3})
        if sets_derivatives:
            instance.ramp(phase=0.0, load=0.0, frequency_ratio=0.0)
        rows.append(instance.run(20, 1.3e-3))
    assert rows[0] == rows[1], "inputs with derivatives of zero are held"


def test_short_steps_under_ramps_stay_close_to_held_inputs(instantiate: Instantiate) -> None:
    for rates in (PHASE, LOAD, CHIRP):
        for size in (1e-15, 1e-9, 1e-6):
            instance = start(instantiate, {}, {})
            instance.ramp(**rates)
            instance.step(size)
            held = start(instantiate, {}, {})
            held.step(size)
            motion = instance.get(*SIGNALS[:4])
            assert motion == pytest.approx(held.get(*SIGNALS[:4]), rel=1e-5, abs=1e-15), (
                f"in {size:g} s {rates} change the motion by less than 1e-5"
            )


def test_the_step_size_does_not_move_a_release(instantiate: Instantiate) -> None:
    problem = PROBLEMS["sticking every period"]
    events = []
    for count in (1, 13):
        instance = start(instantiate, problem.parameters, {})
        for k in range(count):
            instance.set(load=0.5 * k * 0.03 / count)
            instance.ramp(load=0.5)
            instance.step(0.03 / count)
        events.append(instance.get("last_event_time", "reversals", "position"))
    assert events[1] == pytest.approx(events[0], rel=1e-10), "13 steps release where one does"
