"""First derivatives of inputs and outputs: refusals and bounded work; scenes judge motion."""

import math

import pytest

from fmu_src.python.slider_component.variables import VALUE_REFERENCE
from tests.fmu.host import OUTPUTS, Instance, Instantiate
from tests.fmus import native_fmu_only

pytestmark = native_fmu_only

STEP = 2.5e-3
INPUTS = ("phase", "load", "frequency_ratio")
NO_OUTPUTS = ("phase", "slider_mass")
MOVING = ("position", "velocity", "resonator_displacement", "resonator_velocity", "normal_force")
JUMPING = ("contact_mode", "reversals", "stick_fraction", "last_event_time", "prediction_valid")
GIVEN = {*MOVING, *JUMPING, "mean_velocity"}
WITHOUT = tuple(name for name in OUTPUTS if name not in GIVEN)


NO_INPUT = ("derivative of tolerance = 1.0 refused: it is no input", "phase, load or")


@pytest.mark.parametrize(
    ("name", "order", "value", "said"),
    [
        ("load", 2, 1.0, ("derivative of load of order 2 refused: the order must be 1",)),
        ("position", 2, None, ("derivative of position of order 2 refused: the order must be 1",)),
        ("tolerance", 1, 1.0, NO_INPUT),
        ("load", 1, math.nan, ("derivative of load = nan refused: must be a finite number",)),
        *((n, 1, None, (f"derivative of {n} refused: it is no output",)) for n in NO_OUTPUTS),
        *((n, 1, None, (f"derivative of {n} refused: this FMU does not",)) for n in WITHOUT),
        *(("fidelity", 1, value, ("its type is Integer, not Real",)) for value in (None, 1.0)),
        *((999, 1, value, ("valueReference = 999 refused",)) for value in (None, 1.0)),
    ],
)
def test_texts_name_the_derivative_and_what_it_must_be(
    instance: Instance, name: str | int, order: int, value: float | None, said: tuple[str, ...]
) -> None:
    """Of an output where there is no value."""
    reference = name if isinstance(name, int) else VALUE_REFERENCE[name]
    with instance.refuses(*said):
        if value is None:
            instance.slave.getRealOutputDerivatives([reference], [order])
        else:
            instance.slave.setRealInputDerivatives([reference], [order], [value])


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


BEATING = {"normal_amplitude": 2.0, "phase": 0.4}
ORDER_1, ORDER_2 = ({"averaging_order": order, **BEATING} for order in (1, 2))
FASTER = {"frequency_ratio": 50.0}


@pytest.mark.parametrize(
    ("values", "growth", "turns", "text"),
    [
        ({"fidelity": 2}, {"frequency_ratio": 1e15}, None, "must be at most 8000000 turns of it"),
        ({"fidelity": 1}, {"phase": 1e300}, None, "must be at most 8000000 turns of it"),
        ({"averaging_order": 1}, {"frequency_ratio": 1e9}, None, "more work than 1000 slow phases"),
        ({"averaging_order": 2}, {"frequency_ratio": 1e9}, None, "than 1000000 segments of motion"),
        # Each slow phase alone is within the bound: all draw from one budget.
        (ORDER_1, FASTER, 1e7, "400000 steps of averaged motion; must be at most 1e3"),
        ({**ORDER_1, "friction_law": 1}, FASTER, 1e7, "steps of averaged motion"),
        (ORDER_2, FASTER, 1e7, "1000000 segments of motion; must be at most 1e2 s"),
    ],
)
def test_the_work_of_a_step_stays_bounded(
    instantiate: Instantiate,
    values: dict[str, float],
    growth: dict[str, float],
    turns: float | None,
    text: str,
) -> None:
    """In a step of 1 s, or of some turns over which inputs grow by as much."""
    instance = instantiate().initialize(**{"fidelity": 0, **values})
    size = 1.0 if turns is None else turns * math.tau / 3500.0
    instance.ramp(**{name: increase / size for name, increase in growth.items()})
    before = instance.get(*OUTPUTS)
    with instance.refuses(f"doStep: communicationStepSize = {size!r} refused", text):
        instance.slave.doStep(instance.time, size)
    assert instance.get(*OUTPUTS) == before, "a refusal leaves the state as it was"


def test_a_prediction_that_takes_too_much_work_is_not_valid(instantiate: Instantiate) -> None:
    """All maps of a search draw from one budget: a read takes no longer than a few steps may."""
    for ratio, valid in ((1.0, 1.0), (9999.03125, 0.0)):
        instance = instantiate().initialize(normal_amplitude=1.5, frequency_ratio=ratio)
        assert instance.get("prediction_valid") == (valid,)


def test_a_slider_at_rest_on_bristles_accelerates_at_once(instantiate: Instantiate) -> None:
    instance = instantiate().initialize(friction_law=1, load=0.05)
    (acceleration,) = instance.derivatives("velocity")
    assert acceleration == pytest.approx(-0.05, rel=1e-12)


def test_derivatives_are_finite_numbers(instance: Instance) -> None:
    assert all(map(math.isfinite, instance.derivatives(*GIVEN)))
