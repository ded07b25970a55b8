"""First derivatives of inputs as FMI 2.0 sets them: how long they hold, and what is refused."""

from __future__ import annotations

import ctypes
import math

import pytest

from fmu_src.python.slider_component.variables import VALUE_REFERENCE, VARIABLES
from tests.fmu.host import OUTPUTS, Instance, Instantiate, Unpacked
from tests.fmu.native_calls import ERROR, OK, call, reals, references
from tests.fmus import native_fmu_only

pytestmark = native_fmu_only

STEP = 2.5e-3
INPUTS = ("phase", "load", "frequency_ratio")
FUNCTIONS = ("fmi2SetRealInputDerivatives", "fmi2GetRealOutputDerivatives")


def orders(values: list[int]) -> ctypes.Array[ctypes.c_int]:
    return (ctypes.c_int * len(values))(*values)


def test_the_description_offers_them(unpacked: Unpacked) -> None:
    co_simulation = unpacked.description.coSimulation
    assert co_simulation.canInterpolateInputs
    assert co_simulation.maxOutputDerivativeOrder == 1


def test_an_input_keeps_the_value_that_its_ramp_has_reached(instance: Instance) -> None:
    instance.set(phase=0.3, load=-0.01)
    instance.ramp(phase=2.0, load=0.4, frequency_ratio=-3.0)
    instance.step(STEP)
    expected = (0.3 + 2.0 * STEP, -0.01 + 0.4 * STEP, 1.0 - 3.0 * STEP)
    assert instance.get(*INPUTS) == pytest.approx(expected, rel=1e-15)
    instance.step(STEP)
    expected = (0.3 + 4.0 * STEP, -0.01 + 0.8 * STEP, 1.0 - 6.0 * STEP)
    assert instance.get(*INPUTS) == pytest.approx(expected, rel=1e-15), "it holds until it is set"


def test_an_input_set_at_a_later_time_is_held(instance: Instance) -> None:
    instance.ramp(phase=2.0, load=0.4)
    instance.step(STEP)
    instance.set(load=0.1)
    instance.step(STEP)
    phase, load, _ = instance.get(*INPUTS)
    assert load == 0.1
    assert phase == pytest.approx(4.0 * STEP), "the other one goes on"


def test_setting_the_value_reached_holds_it_too(instance: Instance) -> None:
    instance.ramp(load=0.4)
    instance.step(STEP)
    (reached,) = instance.get("load")
    instance.set(load=reached)
    instance.step(STEP)
    assert instance.get("load") == (reached,)


@pytest.mark.parametrize("derivative_first", [False, True])
def test_value_and_derivative_may_be_set_in_any_order(
    instantiate: Instantiate, derivative_first: bool
) -> None:
    """And a value again, as a host that iterates sets it."""
    rows = []
    for first in (False, derivative_first):
        instance = instantiate().initialize()
        for k in range(4):
            if first:
                instance.ramp(load=0.4)
            instance.set(load=0.4 * k * STEP)
            if not first:
                instance.ramp(load=0.4)
            instance.set(load=0.4 * k * STEP)
            instance.step(STEP)
            rows.append((first, instance.get(*OUTPUTS)))
    assert [row for first, row in rows[:4]] == [row for first, row in rows[4:]]


def test_derivatives_set_before_initialization_ends_count(instantiate: Instantiate) -> None:
    early = instantiate().enter_initialization(load=0.02)
    early.ramp(load=0.4)
    early.slave.exitInitializationMode()
    late = instantiate().initialize(load=0.02)
    late.ramp(load=0.4)
    for instance in (early, late):
        instance.step(STEP)
    assert early.get(*OUTPUTS) == late.get(*OUTPUTS)


def test_reset_forgets_them(instance: Instance) -> None:
    instance.ramp(load=0.4)
    instance.slave.reset()
    instance.initialize()
    instance.step(STEP)
    assert instance.get("load") == (0.0,)


@pytest.mark.parametrize("fidelity", [0, 1, 2])
@pytest.mark.parametrize("law", [0, 1])
def test_states_carry_them(instantiate: Instantiate, law: int, fidelity: int) -> None:
    instance = instantiate().initialize(friction_law=law, fidelity=fidelity)
    instance.run(3, STEP)
    instance.ramp(phase=2.0, load=0.1, frequency_ratio=0.5)
    fresh = instance.state()
    instance.step(STEP)
    used = instance.state()
    time = instance.time
    went_on = instance.run(3, STEP)
    for state, before, steps in ((fresh, time - STEP, 4), (used, time, 3)):
        instance.restore(state)
        assert instance.state() == state
        instance.time = before
        assert instance.run(steps, STEP)[-3:] == went_on, "bit for bit"
    other = instantiate()
    other.restore(used)
    other.time = time
    assert other.run(3, STEP) == went_on, "in another instance as well"


def test_a_state_tells_a_new_derivative_from_a_used_one(instance: Instance) -> None:
    """A value that is set next to a new derivative leaves it; later it holds the input."""
    instance.ramp(load=0.4)
    fresh = instance.state()
    instance.step(STEP)
    instance.restore(fresh)
    instance.time = 0.0
    instance.set(load=0.1)
    instance.step(STEP)
    assert instance.get("load")[0] == pytest.approx(0.1 + 0.4 * STEP)


@pytest.mark.parametrize("derivative", [math.nan, math.inf, -math.inf])
@pytest.mark.parametrize("name", INPUTS)
def test_a_derivative_that_is_no_number_is_refused(
    instance: Instance, name: str, derivative: float
) -> None:
    with instance.refuses(f"derivative of {name} = {derivative!r} refused", "a finite number"):
        instance.ramp(**{name: derivative})


@pytest.mark.parametrize("order", [0, 2, -1])
def test_any_order_but_the_first_is_refused(instance: Instance, order: int) -> None:
    text = f"derivative of load of order {order} refused: the order must be 1"
    with instance.refuses("fmi2SetRealInputDerivatives: " + text):
        instance.slave.setRealInputDerivatives([VALUE_REFERENCE["load"]], [order], [1.0])
    text = f"derivative of position of order {order} refused: the order must be 1"
    with instance.refuses("fmi2GetRealOutputDerivatives: " + text):
        instance.slave.getRealOutputDerivatives([VALUE_REFERENCE["position"]], [order])


@pytest.mark.parametrize("name", ["position", "normal_preload", "tolerance"])
def test_only_inputs_have_derivatives_to_set(instance: Instance, name: str) -> None:
    with instance.refuses(f"derivative of {name} = 1.0 refused: it is no input", "phase, load or"):
        instance.slave.setRealInputDerivatives([VALUE_REFERENCE[name]], [1], [1.0])


def test_one_bad_derivative_refuses_all(instance: Instance) -> None:
    both = [VALUE_REFERENCE["phase"], VALUE_REFERENCE["load"]]
    with instance.refuses("derivative of load = nan refused"):
        instance.slave.setRealInputDerivatives(both, [1, 1], [1.0, math.nan])
    instance.step(STEP)
    assert instance.get("phase") == (0.0,)


@pytest.mark.parametrize("function", FUNCTIONS)
def test_null_pointers_counts_and_types(instance: Instance, function: str) -> None:
    null = ctypes.c_void_p()
    one = references([VALUE_REFERENCE["load"]])
    for arguments in ((null, 1, orders([1]), reals([1.0])), (one, 1, null, reals([1.0])),
                      (one, 1, orders([1]), null)):  # fmt: skip
        assert call(instance, function, *arguments) == ERROR
        assert f"{function}: a null pointer refused" in instance.log[-1]
    for count in (len(VARIABLES) + 1, 2**64 - 1):
        assert call(instance, function, one, count, orders([1]), reals([1.0])) == ERROR
        assert f"{function}: nvr = " in instance.log[-1]
    choice = references([VALUE_REFERENCE["fidelity"]])
    assert call(instance, function, choice, 1, orders([1]), reals([1.0])) == ERROR
    assert "its type is Integer, not Real" in instance.log[-1]
    assert call(instance, function, references([999]), 1, orders([1]), reals([1.0])) == ERROR
    assert "valueReference = 999 refused" in instance.log[-1]
    assert call(instance, function, null, 0, null, null) == OK, "nothing asked, nothing refused"


def test_after_the_end_none_is_taken(instance: Instance) -> None:
    instance.slave.terminate()
    with instance.refuses("setting the derivative of load refused in state 'terminated'"):
        instance.ramp(load=0.1)


@pytest.mark.parametrize("fidelity", [0, 1, 2])
@pytest.mark.parametrize("name", INPUTS)
def test_a_step_in_which_an_input_leaves_its_bounds_is_refused(
    instantiate: Instantiate, name: str, fidelity: int
) -> None:
    instance = instantiate().initialize(fidelity=fidelity)
    instance.ramp(**{name: 1.7e308})
    with instance.refuses(f"with its derivative 1.7e+308, {name} reaches inf", "a finite number"):
        instance.slave.doStep(instance.time, 10.0)
    instance.ramp(**{name: 0.0})
    instance.step(STEP)


@pytest.mark.parametrize(
    ("values", "derivatives", "text"),
    [
        (
            {"fidelity": 2},
            {"frequency_ratio": 1e15},
            "the step must be at most 8000000 turns of it",
        ),
        ({"fidelity": 1}, {"phase": 1e300}, "the step must be at most 8000000 turns of it"),
        (
            {"fidelity": 0, "averaging_order": 1},
            {"frequency_ratio": 1e9},
            "it takes more work than 1000 slow phases of",
        ),
        (
            {"fidelity": 0, "averaging_order": 2},
            {"frequency_ratio": 1e9},
            "it takes more work than 1000000 segments of motion",
        ),
    ],
)
def test_the_work_of_a_step_stays_bounded(
    instantiate: Instantiate, values: dict[str, int], derivatives: dict[str, float], text: str
) -> None:
    instance = instantiate().initialize(**values)
    instance.ramp(**derivatives)
    with instance.refuses("doStep: communicationStepSize = 1.0 refused", text):
        instance.slave.doStep(instance.time, 1.0)


@pytest.mark.parametrize(
    ("values", "turns", "growth", "text"),
    [
        ({"averaging_order": 1}, 1e7, 50.0, "400000 steps of averaged motion; must be at most 1e3"),
        ({"averaging_order": 1, "friction_law": 1}, 1e6, 90.0, "steps of averaged motion"),
        ({"averaging_order": 2}, 1e7, 50.0, "1000000 segments of motion; must be at most 1e2 s"),
    ],
    ids=["Coulomb", "quadratures", "resolved where orbits are unknown"],
)
def test_all_slow_phases_of_a_step_draw_from_one_budget(
    instantiate: Instantiate, values: dict[str, float], turns: float, growth: float, text: str
) -> None:
    """Each slow phase alone is within the bound."""
    start = {"fidelity": 0, "normal_amplitude": 2.0, "phase": 0.4, **values}
    instance, size = instantiate().initialize(**start), turns * math.tau / 3500.0
    instance.ramp(frequency_ratio=growth / size)
    before = instance.get(*OUTPUTS)
    with instance.refuses(f"communicationStepSize = {size!r} refused: it takes more work", text):
        instance.slave.doStep(instance.time, size)
    assert instance.get(*OUTPUTS) == before, "a refusal leaves the state as it was"


def test_a_refused_step_leaves_the_inputs(instance: Instance) -> None:
    instance.ramp(load=0.1)
    with instance.refuses("must be a finite number above 0"):
        instance.slave.doStep(instance.time, -1.0)
    instance.step(STEP)
    assert instance.get("load") == (0.1 * STEP,)
