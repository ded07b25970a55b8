"""Refused calls: the text names what is wrong; values that together have no meaning."""

import math
from collections.abc import Callable

import pytest

from fmu_src.python.slider_component.variable import Variable
from fmu_src.python.slider_component.variables import VARIABLES
from tests.fmu.host import Instance, Instantiate
from tests.fmus import both_fmus

pytestmark = both_fmus

NAN = math.nan
STEP = 1.7e-3


def bad_value(variable: Variable) -> float:
    """The nearest value beyond a bound of a variable, nan for one without bounds."""
    if variable.type == "Integer":
        assert variable.maximum is not None
        return int(variable.maximum) + 1
    return NAN if variable.minimum is None else math.nextafter(variable.minimum, -math.inf)


def test_text_says_what_the_value_of_a_variable_must_be(instantiate: Instantiate) -> None:
    """The scene `interface` tries all bad values; it does not read what they must be."""
    instance = instantiate().enter_initialization()
    for variable in (v for v in VARIABLES if v.causality != "output"):
        value = bad_value(variable)
        with instance.refuses(f"{variable.name} = {value!r} refused", variable.requirement):
            instance.set(**{variable.name: value})


CALLS: dict[str, tuple[Callable[[Instance], object], tuple[str, ...]]] = {
    "step size": (
        lambda i: i.slave.doStep(i.time, -1e-3),
        ("doStep", "communicationStepSize = -0.001 refused: must be a finite number above 0"),
    ),
    "time": (
        lambda i: i.slave.doStep(i.time + 1e-6, STEP),
        ("doStep", repr(STEP + 1e-6), f"must be the present time {STEP!r}"),
    ),
    "no time": (
        lambda i: i.slave.doStep(NAN, STEP),
        ("doStep", "nan refused", f"must be the present time {STEP!r}"),
    ),
    "stop": (lambda i: i.slave.doStep(i.time, 5.0), ("doStep", "5.0", "stopTime = 1.0")),
    "output": (lambda i: i.set(position=0.5), ("position = 0.5 refused: it is an output",)),
    "fixed": (lambda i: i.set(slider_mass=2.0), ("slider_mass = 2.0 refused", "it is fixed")),
    "reference": (
        lambda i: i.slave.getReal([len(VARIABLES)]),
        (f"valueReference = {len(VARIABLES)} refused: must be from 0 to {len(VARIABLES) - 1}",),
    ),
    "type": (
        lambda i: i.slave.getInteger([i.reference("load")]),
        ("load (valueReference = ", "refused: its type is Real, not Integer"),
    ),
    "order": (
        lambda i: i.slave.setupExperiment(startTime=0.0),
        ("setupExperiment refused in state 'step complete'", "must be 'instantiated'"),
    ),
}
"""Calls in a run that ends at 1 s, and what the text names."""


@pytest.mark.parametrize(("attempt", "fragments"), CALLS.values(), ids=CALLS)
def test_text_names_call_value_and_requirement(
    instantiate: Instantiate, attempt: Callable[[Instance], object], fragments: tuple[str, ...]
) -> None:
    instance = instantiate()
    instance.slave.setupExperiment(startTime=0.0, stopTime=1.0)
    instance.slave.enterInitializationMode()
    instance.slave.exitInitializationMode()
    instance.step(STEP)
    with instance.refuses(*fragments):
        attempt(instance)


@pytest.mark.parametrize(
    ("name", "value"), [("startTime", math.inf), ("stopTime", 4.0), ("tolerance", NAN)]
)
def test_text_names_what_is_wrong_in_an_experiment(
    instantiate: Instantiate, name: str, value: float
) -> None:
    instance = instantiate()
    experiment = {"startTime": 5.0} | {name: value}
    with instance.refuses(f"{name} = {value!r} refused: must be"):
        instance.slave.setupExperiment(**experiment)


LUGRE = {"friction_law": 1}
LARGEST = 1.7976931348623157e308
TOGETHER, NEARER = "together with the other values", "must be nearer to"
SLIP_RESONANCE = {"resonator_mass": 3.0, "resonator_frequency": 1.0, "drive_frequency": 2.0}
"""wn^2 = (1 - r_m) w^2."""


@pytest.mark.parametrize(
    ("values", "said"),
    [
        *(({"friction_coefficient": 1e308, "fidelity": n}, TOGETHER) for n in (2, 0)),
        *(({"friction_coefficient": mu, **LUGRE}, TOGETHER) for mu in (LARGEST, 5e-324)),
        ({"bristle_damping": 1e308, **LUGRE}, TOGETHER),
        ({"bristle_stiffness": 1e308, "initial_bristle_deflection": 1e10, **LUGRE}, TOGETHER),
        (
            {"initial_bristle_deflection": 1e300, "bristle_stiffness": 1e8, "fidelity": 0}
            | {"averaging_order": 1, **LUGRE},
            TOGETHER,
        ),
        *(({"initial_velocity": 1e308, "fidelity": n, **LUGRE}, TOGETHER) for n in range(3)),
        ({"initial_velocity": -1e308, "bristle_damping": 1e10, **LUGRE}, TOGETHER),
        (
            {"normal_preload": 1.7e308, "normal_amplitude": 1.7e308}
            | {"friction_coefficient": 1e-200},
            TOGETHER,
        ),
        ({"base_amplitude": 1e300, "drive_frequency": 1e300}, NEARER),
        ({"drive_frequency": 1e200, "frequency_ratio": 1e190}, NEARER),
        ({"base_amplitude": 1e160}, NEARER),
        ({"resonator_frequency": 1e170}, NEARER),
        (
            {"damping_ratio": 0.0, "fidelity": 1, **SLIP_RESONANCE},
            "the steady force of the resonator",
        ),
        ({"friction_coefficient": 0.0, **LUGRE}, "with LuGre friction it must be"),
    ],
)
def test_values_that_together_have_no_meaning(
    instantiate: Instantiate, values: dict[str, float], said: str
) -> None:
    """The text names the first of them."""
    name, value = next(iter(values.items()))
    instance = instantiate().enter_initialization(**values)
    with instance.refuses(f"{name} = {value!r} refused", said):
        instance.slave.exitInitializationMode()


def test_output_that_leaves_the_range_of_numbers(instantiate: Instantiate) -> None:
    instance = instantiate().initialize(
        friction_law=1,
        friction_coefficient=1e-300,
        bristle_damping=0.0,
        initial_bristle_deflection=1e5,
    )
    with instance.refuses("friction_force = ", "the output leaves the range of floating point"):
        instance.get("position", "friction_force")
    assert instance.get("position", "normal_force") == (0.0, 1.0)
