"""First derivatives of outputs: which there are; scenes compare them with quotients."""

from __future__ import annotations

import math

import pytest

from fmu_src.python.slider_component.variables import VALUE_REFERENCE
from tests.fmu.host import OUTPUTS, Instance, Instantiate
from tests.fmus import native_fmu_only

pytestmark = native_fmu_only

MOVING = ("position", "velocity", "resonator_displacement", "resonator_velocity", "normal_force")
JUMPING = ("contact_mode", "reversals", "stick_fraction", "last_event_time", "prediction_valid")
WITHOUT = (
    *("friction_force", "steady_velocity", "blocking_force", "slow_motion_error"),
    "friction_power",
)


def test_a_slider_at_rest_on_bristles_accelerates_at_once(instantiate: Instantiate) -> None:
    instance = instantiate().initialize(friction_law=1, load=0.05)
    (acceleration,) = instance.derivatives("velocity")
    assert acceleration == pytest.approx(-0.05, rel=1e-12)


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
