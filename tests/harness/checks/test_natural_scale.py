"""The size that counts as near zero follows from the device."""

from __future__ import annotations

from dataclasses import replace

import pytest

from slider_resonator.checks.natural_scale import NEAR_ZERO, smallest_reference
from slider_resonator.device.device import Device

TABLE_1 = Device()


def scale(quantity: str, device: Device = TABLE_1) -> float:
    return smallest_reference(quantity, device) / NEAR_ZERO


def test_scales_of_table_1_are_those_of_the_paper() -> None:
    assert scale("steady_velocity") == pytest.approx(910.947 / (1.1 * 3500.0), rel=1e-5)
    assert scale("position") == pytest.approx(67.603e-6, rel=1e-4)
    assert scale("blocking_force") == pytest.approx(2 * 0.1 * (1.0 + 1.0))
    assert scale("normal_force") == 2.0


def test_the_vibration_does_not_depend_on_friction() -> None:
    for change in ({"friction_coefficient": 0.0}, {"normal_preload": 0.0}, {"friction_faces": 1}):
        assert scale("velocity", replace(TABLE_1, **change)) == scale("velocity")


def test_quantities_without_a_scale_have_none() -> None:
    assert scale("velocity", replace(TABLE_1, base_amplitude=0.0)) == 0.0
    assert scale("beat_frequency") == 0.0, "a beat may be as slow as it likes"
    undamped = replace(TABLE_1, damping_ratio=0.0, resonator_frequency=3500.0 * (1 / 1.1) ** 0.5)
    assert scale("velocity", undamped) == 0.0, "at resonance the vibration grows for ever"
