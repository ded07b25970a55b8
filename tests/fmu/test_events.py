"""Events at their limits: releases by an input, starts in flight, slides too short to travel."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest

from tests.fmu.host import Instance
from tests.fmus import both_fmus

pytestmark = both_fmus


def test_a_release_by_an_input_is_the_last_event(
    instantiate: Callable[[], Instance],
) -> None:
    """Where the parts of the step sum up to more than it by rounding, too."""
    instance = instantiate().initialize(base_amplitude=0.0, resonator_mass=0.0)
    instance.step(1e-3)
    instance.set(load=5.0)
    stuck, released = instance.state(), instance.time
    for k in range(400):
        instance.restore(stuck)
        instance.time = released
        instance.step(0.02 + 0.000471 * k)
        mode, event = instance.get("contact_mode", "last_event_time")
        assert mode == -1.0
        assert event == pytest.approx(released, abs=1e-12)


@pytest.mark.parametrize(
    "device",
    [
        {
            "normal_preload": 0.0,
            "damping_ratio": 0.23416453451909713,
            "resonator_mass": 0.01242897871348076,
        },
        {"phase": 3.895139822727085, "drive_frequency": 8.5, "resonator_frequency": 53769.0},
        {"normal_preload": 0.0, "frequency_ratio": 0.0},
        {"phase": -2.1758310349471994, "normal_preload": 0.0},
    ],
)
@pytest.mark.parametrize("force", [-1.0, -0.3, 0.3, 1.0])
def test_a_start_from_rest_in_flight_is_no_reversal(
    instantiate: Callable[[], Instance], device: dict[str, float], force: float
) -> None:
    """The acceleration begins at zero, and rounding may give it either sign."""
    flight = {"friction_law": 1, "normal_amplitude": 2.0, "phase": -math.pi / 2} | device
    instance = instantiate().initialize(base_amplitude=0.0, tangential_force=force, **flight)
    instance.step(1e-5)
    velocity, *found = instance.get("velocity", "contact_mode", "reversals")
    assert math.copysign(1.0, velocity) == math.copysign(1.0, force)
    assert found == [2.0, 0.0]


@pytest.mark.parametrize("before", [1e-9, 1e-11, 1e-12, 1e-13, 1e-14])
def test_a_slide_just_before_the_contact_lifts_is_a_reversal(
    instantiate: Callable[[], Instance], before: float
) -> None:
    """However short it is, and though its travel may be lost in rounding."""
    instance = instantiate().initialize(
        base_amplitude=0.0, initial_velocity=1e-5, normal_amplitude=2.0, resonator_mass=0.0
    )
    lifts = (math.pi + math.pi / 6.0) / 3500.0
    instance.step(lifts - before)
    assert instance.get("contact_mode", "reversals") == (0.0, 0.0)
    instance.set(load=0.1)
    instance.step(2.0 * before)
    assert instance.get("contact_mode", "reversals") == (2.0, 1.0)


@pytest.mark.parametrize("law", [0, 1])
def test_a_first_slide_is_no_reversal_whatever_the_load_was_before(
    instantiate: Callable[[], Instance], law: int
) -> None:
    """Some hosts set inputs only after initialization, which may end under one that pushes."""
    still = {"base_amplitude": 0.0, "resonator_mass": 0.0, "friction_law": law}
    instance = instantiate().initialize(load=10.0, **still)
    instance.set(load=-10.0)
    instance.step(1e-3)
    assert instance.get("contact_mode", "reversals") == (1.0, 0.0)
