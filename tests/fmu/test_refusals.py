"""Refused calls, call by call: the text names what is wrong, and nothing changes."""

from __future__ import annotations

import ctypes
import math
from collections.abc import Callable

import pytest

from fmu_src.python.slider_component.variable import Variable
from fmu_src.python.slider_component.variables import VARIABLES
from tests.fmu.host import Instance, Instantiate
from tests.fmu.lifecycle import REACH
from tests.fmus import both_fmus

pytestmark = both_fmus

NAN, INF = math.nan, math.inf
STEP = 1.7e-3

SETTABLE = [v for v in VARIABLES if v.causality != "output"]
FIXED = [v for v in SETTABLE if v.variability == "fixed"]
ANYTIME = [v for v in SETTABLE if v.variability != "fixed"]
OUTPUTS = [v for v in VARIABLES if v.causality == "output"]


def by_name(variables: list[Variable]) -> pytest.MarkDecorator:
    return pytest.mark.parametrize("variable", variables, ids=lambda v: v.name)


def bad_values(variable: Variable) -> list[float]:
    """Values that are not finite, and the nearest beyond the bounds of a variable."""
    if variable.type == "Integer":
        assert variable.minimum is not None
        assert variable.maximum is not None
        return [int(variable.minimum) - 1, int(variable.maximum) + 1]
    bounds = ((variable.minimum, -INF), (variable.maximum, INF))
    return [NAN, INF, -INF] + [math.nextafter(x, to) for x, to in bounds if x is not None]


def assert_bad_values_are_refused(instance: Instance, variable: Variable) -> None:
    for value in bad_values(variable):
        with instance.refuses(f"{variable.name} = {value!r} refused", variable.requirement):
            instance.set(**{variable.name: value})


@by_name(SETTABLE)
def test_bad_value_before_the_run(instantiate: Instantiate, variable: Variable) -> None:
    assert_bad_values_are_refused(instantiate().enter_initialization(), variable)


@by_name(ANYTIME)
def test_bad_value_during_the_run(instance: Instance, variable: Variable) -> None:
    instance.step(STEP)
    assert_bad_values_are_refused(instance, variable)


@by_name([v for v in SETTABLE if v.minimum is not None or v.maximum is not None])
def test_the_bounds_themselves_are_accepted(instantiate: Instantiate, variable: Variable) -> None:
    instance = instantiate().enter_initialization()
    for value in (variable.minimum, variable.maximum):
        if value is not None:
            instance.set(**{variable.name: value})


@by_name(FIXED)
def test_fixed_parameter_after_initialization(instance: Instance, variable: Variable) -> None:
    assert variable.start is not None
    value = int(variable.start) if variable.type == "Integer" else variable.start
    with instance.refuses(f"{variable.name} = {value!r} refused", "it is fixed"):
        instance.set(**{variable.name: value})


@by_name(OUTPUTS)
def test_output_set_from_outside(instance: Instance, variable: Variable) -> None:
    with instance.refuses(variable.name, "0.5", "output"):
        instance.set(**{variable.name: 0.5})


@pytest.mark.parametrize("fidelity", [0, 1])
@pytest.mark.parametrize("ulps", [-2, -1, 0, 1, 2])
def test_undamped_resonance_to_rounding(instantiate: Instantiate, fidelity: int, ulps: int) -> None:
    """Steady force and velocity would be numbers without a correct digit."""
    frequency = 3500.0 * math.sqrt(1.0 / 1.1)
    for _ in range(abs(ulps)):
        frequency = math.nextafter(frequency, math.copysign(INF, ulps))
    undamped = {"damping_ratio": 0.0, "resonator_frequency": frequency, "fidelity": fidelity}
    undamped["averaging_order"] = (
        1  # leaps need no steady vibration: there is none, so none is made
    )
    instance = instantiate().enter_initialization(**undamped)
    with instance.refuses("damping_ratio = 0.0 refused", "drive_frequency = 3500.0", "be above 0"):
        instance.slave.exitInitializationMode()
    instance.set(damping_ratio=1e-12)
    instance.slave.exitInitializationMode()
    instance.step(STEP)


def test_undamped_resonance_is_resolved_by_order_2(instantiate: Instantiate) -> None:
    frequency = 3500.0 * math.sqrt(1.0 / 1.1)
    undamped = {"damping_ratio": 0.0, "resonator_frequency": frequency}
    found = []
    for fidelity in (0, 2):
        instance = instantiate().initialize(**undamped, fidelity=fidelity)
        instance.step(0.2)
        assert instance.get("prediction_valid", "slow_motion_error") == (0.0, 0.0)
        found.append(instance.get("position", "velocity", "mean_velocity"))
    assert found[0] == found[1]


@pytest.mark.parametrize("fidelity", [0, 1, 2])
def test_values_that_do_not_fit_each_other(instantiate: Instantiate, fidelity: int) -> None:
    instance = instantiate().enter_initialization(
        fidelity=fidelity, friction_law=1, friction_coefficient=0.0
    )
    with instance.refuses("friction_coefficient = 0.0 refused: with LuGre friction it must be"):
        instance.slave.exitInitializationMode()
    instance.set(friction_coefficient=0.1)
    instance.slave.exitInitializationMode()
    with instance.refuses("friction_coefficient = 0.0 refused: with LuGre friction it must be"):
        instance.set(friction_coefficient=0.0)


@pytest.mark.parametrize(
    ("name", "value", "others"),
    [
        ("friction_coefficient", 1e308, {}),
        ("friction_coefficient", 1e308, {"fidelity": 0}),
        ("friction_coefficient", 1.7976931348623157e308, {"friction_law": 1}),
        ("friction_coefficient", 5e-324, {"friction_law": 1}),
        ("bristle_damping", 1e308, {"friction_law": 1}),
        (
            *("bristle_stiffness", 1e308),
            {"friction_law": 1, "initial_bristle_deflection": 1e10},
        ),
        (
            *("initial_bristle_deflection", 1e300),
            {"friction_law": 1, "bristle_stiffness": 1e8, "fidelity": 0, "averaging_order": 1},
        ),
        *(("initial_velocity", 1e308, {"friction_law": 1, "fidelity": n}) for n in range(3)),
        ("initial_velocity", -1e308, {"friction_law": 1, "bristle_damping": 1e10}),
        ("normal_preload", 1.7e308, {"normal_amplitude": 1.7e308, "friction_coefficient": 1e-200}),
    ],
)
def test_forces_that_leave_the_range_of_numbers(
    instantiate: Instantiate, name: str, value: float, others: dict[str, float]
) -> None:
    instance = instantiate()
    instance.enter_initialization(**{name: value} | others)
    with instance.refuses(f"{name} = {value!r} refused: together with the other values"):
        instance.slave.exitInitializationMode()


def test_output_that_leaves_the_range_of_numbers(instantiate: Callable[[], Instance]) -> None:
    instance = instantiate().initialize(
        friction_law=1,
        friction_coefficient=1e-300,
        bristle_damping=0.0,
        initial_bristle_deflection=1e5,
    )
    with instance.refuses("friction_force = ", "the output leaves the range of floating point"):
        instance.get("position", "friction_force")
    assert instance.get("position", "normal_force") == (0.0, 1.0)


@pytest.mark.parametrize("size", [0.0, -0.0, -1e-3, NAN, INF, -INF])
def test_step_size(instance: Instance, size: float) -> None:
    instance.step(STEP)
    expected = f"communicationStepSize = {size!r} refused: must be a finite number above 0"
    with instance.refuses("doStep", expected):
        instance.slave.doStep(instance.time, size)


@pytest.mark.parametrize("jump", [-STEP, -1e-6, 1e-6, STEP, 1e9, NAN, INF, -INF])
def test_step_that_does_not_continue_from_the_present(instance: Instance, jump: float) -> None:
    instance.step(STEP)
    with instance.refuses("doStep", repr(instance.time + jump), repr(instance.time)):
        instance.slave.doStep(instance.time + jump, STEP)


@pytest.mark.parametrize(
    ("name", "value"),
    [
        *(("startTime", value) for value in (NAN, INF, -INF)),
        *(("stopTime", value) for value in (NAN, -INF, 4.0)),
        ("tolerance", NAN),
    ],
)
def test_experiment(instantiate: Instantiate, name: str, value: float) -> None:
    instance = instantiate()
    experiment = {"startTime": 5.0} | {name: value}
    with instance.refuses(f"{name} = {value!r} refused: must be"):
        instance.slave.setupExperiment(**experiment)


def test_step_beyond_the_stop_time(instantiate: Instantiate) -> None:
    instance = instantiate()
    instance.slave.setupExperiment(startTime=0.0, stopTime=0.1)
    instance.slave.enterInitializationMode()
    instance.slave.exitInitializationMode()
    instance.step(0.06)
    with instance.refuses("doStep", "0.05", "stopTime = 0.1"):
        instance.slave.doStep(instance.time, 0.05)
    instance.step(0.04)


UNKNOWN = [len(VARIABLES), 10**6, 2**31 - 1, 2**31, 2**32 - 1]


@pytest.mark.parametrize("reference", UNKNOWN)
@pytest.mark.parametrize("kind", ["Real", "Integer", "Boolean", "String"])
def test_unknown_value_reference(instance: Instance, reference: int, kind: str) -> None:
    value = {"Real": 0.5, "Integer": 1, "Boolean": True, "String": "x"}[kind]
    with instance.refuses("refused"):
        getattr(instance.slave, f"set{kind}")([reference], [value])
    with instance.refuses("refused"):
        getattr(instance.slave, f"get{kind}")([reference])


@pytest.mark.parametrize(
    ("name", "kind", "value"),
    [
        ("load", "Integer", 1),
        ("load", "Boolean", True),
        ("load", "String", "1"),
        ("friction_faces", "Real", 1.0),
        ("fidelity", "Boolean", True),
    ],
)
def test_type_of_another_variable(
    instantiate: Instantiate, name: str, kind: str, value: object
) -> None:
    instance = instantiate().enter_initialization()
    reference = [instance.reference(name)]
    with instance.refuses(name, kind):
        getattr(instance.slave, f"set{kind}")(reference, [value])
    with instance.refuses(name, kind):
        getattr(instance.slave, f"get{kind}")(reference)


def test_one_bad_value_among_good_ones_sets_none_of_them(instance: Instance) -> None:
    references = [instance.reference(n) for n in ("phase", "load", "frequency_ratio")]
    with instance.refuses("load = nan refused"):
        instance.slave.setReal(references, [1.0, NAN, 2.0])
    assert tuple(instance.slave.getReal(references)) == (0.0, 0.0, 1.0)


CALLS: dict[str, Callable[[Instance], object]] = {
    "setupExperiment": lambda i: i.slave.setupExperiment(startTime=0.0),
    "enterInitializationMode": lambda i: i.slave.enterInitializationMode(),
    "exitInitializationMode": lambda i: i.slave.exitInitializationMode(),
    "doStep": lambda i: i.slave.doStep(0.0, STEP),
    "terminate": lambda i: i.slave.terminate(),
    "setting load": lambda i: i.set(load=0.1),
}


OUT_OF_ORDER: dict[str, tuple[str, ...]] = {
    "instantiated": ("exitInitializationMode", "doStep"),
    "experiment set up": ("exitInitializationMode", "doStep"),
    "initializing": ("setupExperiment", "enterInitializationMode", "doStep"),
    "stepping": ("setupExperiment", "enterInitializationMode", "exitInitializationMode"),
    "terminated": tuple(CALLS),
}


@pytest.mark.parametrize(
    ("reached", "call"), [(state, call) for state, calls in OUT_OF_ORDER.items() for call in calls]
)
def test_call_out_of_order(instantiate: Instantiate, reached: str, call: str) -> None:
    instance = instantiate()
    REACH[reached](instance)
    with instance.refuses(call, "refused", "the state must be"):
        CALLS[call](instance)


def test_status_inquiries_do_not_speak_of_an_end(instance: Instance) -> None:
    with instance.refuses("doStep"):
        instance.slave.doStep(0.0, NAN)
    terminated = ctypes.c_int()
    instance.slave.fmi2GetBooleanStatus(instance.slave.component, 3, ctypes.byref(terminated))
    assert terminated.value == 0, "a refused step is not a wish to end the run"
