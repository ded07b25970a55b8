"""First derivatives of outputs: slopes of the outputs themselves, towards later times."""

from __future__ import annotations

import math

import pytest

from fmu_src.python.slider_component.variables import VALUE_REFERENCE
from tests.fmu.host import OUTPUTS, Instance, Instantiate
from tests.fmus import native_fmu_only

pytestmark = native_fmu_only

STEP = 1e-7
"""Between the samples of a difference quotient [s]."""
MOVING = ("position", "velocity", "resonator_displacement", "resonator_velocity", "normal_force")
JUMPING = ("contact_mode", "reversals", "stick_fraction", "last_event_time", "prediction_valid")
WITHOUT = (
    *("friction_force", "steady_velocity", "blocking_force", "slow_motion_error"),
    "friction_power",
)

DEVICES: dict[str, dict[str, float]] = {
    "table 1": {},
    "lift-off": {"normal_amplitude": 2.0},
    "direct drive": {"tangential_force": 40.0, "base_amplitude": 0.0},
    "detuned": {"frequency_ratio": 1.003, "phase": 0.4, "load": 0.03},
}


def quotients(instance: Instance) -> tuple[float, ...]:
    """Slopes of the moving outputs by a fourth-order rule over the next four short steps."""
    rows = [instance.get(*MOVING)]
    for _ in range(4):
        instance.step(STEP)
        rows.append(instance.get(*MOVING))
    weights = (-25.0 / 12.0, 4.0, -3.0, 4.0 / 3.0, -0.25)
    return tuple(
        math.fsum(w * value for w, value in zip(weights, column, strict=True)) / STEP
        for column in zip(*rows, strict=True)
    )


@pytest.mark.parametrize("device", DEVICES)
@pytest.mark.parametrize("law", [0, 1])
@pytest.mark.parametrize(("fidelity", "order"), [(0, 1), (0, 2), (1, 2), (2, 2)])
def test_they_are_the_slopes(
    instantiate: Instantiate, fidelity: int, order: int, law: int, device: str
) -> None:
    choices = {"fidelity": fidelity, "averaging_order": order, "friction_law": law}
    instance = instantiate().initialize(**choices, **DEVICES[device])
    w = 3500.0
    scales = (1.0, w, 1.0, w, w)
    for size in (1.234e-3, 0.057):
        instance.step(size)
        slopes = instance.derivatives(*MOVING)
        expected = quotients(instance)
        for name, slope, quotient, scale in zip(MOVING, slopes, expected, scales, strict=True):
            peak = 1.0 if name == "normal_force" else 0.3
            assert slope == pytest.approx(quotient, abs=1e-5 * peak * scale), name


def test_an_input_that_grows_adds_to_the_slope_of_the_normal_force(instance: Instance) -> None:
    instance.ramp(phase=900.0, load=50.0)
    instance.step(1.3e-3)
    (slope,) = instance.derivatives("normal_force")
    assert slope == pytest.approx(quotients(instance)[-1], rel=1e-6)


def test_a_slider_at_rest_does_not_accelerate(instantiate: Instantiate) -> None:
    instance = instantiate().initialize(base_amplitude=1e-9, normal_amplitude=0.5)
    instance.step(1e-3)
    assert instance.get("contact_mode") == (0.0,)
    assert instance.derivatives("position", "velocity") == (0.0, 0.0)
    slopes = instance.derivatives("resonator_velocity")
    assert slopes == pytest.approx(quotients(instance)[3:4], rel=1e-6)


def test_a_slider_at_rest_on_bristles_accelerates_at_once(instantiate: Instantiate) -> None:
    instance = instantiate().initialize(friction_law=1, load=0.05)
    (acceleration,) = instance.derivatives("velocity")
    assert acceleration == pytest.approx(-0.05, rel=1e-12)
    assert quotients(instance)[1] == pytest.approx(-0.05, rel=1e-2)


def test_what_changes_at_events_only_stands_still(instance: Instance) -> None:
    instance.step(1e-3)
    assert set(instance.derivatives(*JUMPING, "mean_velocity")) == {0.0}


@pytest.mark.parametrize("law", [0, 1])
def test_the_mean_velocity_of_averaged_motion_has_a_slope(
    instantiate: Instantiate, law: int
) -> None:
    instance = instantiate().initialize(fidelity=0, averaging_order=1, friction_law=law)
    instance.step(0.1)
    (slope,) = instance.derivatives("mean_velocity")
    (before,) = instance.get("mean_velocity")
    instance.step(1e-4)
    (after,) = instance.get("mean_velocity")
    assert slope == pytest.approx((after - before) / 1e-4, rel=1e-3)


@pytest.mark.parametrize("name", WITHOUT)
def test_those_that_are_not_provided_are_refused(instance: Instance, name: str) -> None:
    with instance.refuses(f"derivative of {name} refused: this FMU does not provide it"):
        instance.derivatives(name)


@pytest.mark.parametrize("name", ["phase", "slider_mass"])
def test_only_outputs_have_derivatives_to_get(instance: Instance, name: str) -> None:
    with instance.refuses(f"derivative of {name} refused: it is no output"):
        instance.slave.getRealOutputDerivatives([VALUE_REFERENCE[name]], [1])


def test_every_output_is_given_or_refused(instance: Instance) -> None:
    given = {*MOVING, *JUMPING, "mean_velocity"}
    assert given | set(WITHOUT) == set(OUTPUTS)
    assert all(map(math.isfinite, instance.derivatives(*given)))


def test_they_can_be_read_from_initialization_mode_on(instantiate: Instantiate) -> None:
    instance = instantiate()
    with instance.refuses("reading position refused in state 'instantiated'"):
        instance.derivatives("position")
    instance.enter_initialization(initial_velocity=0.5)
    assert instance.derivatives("position") == (0.5,)
