"""Motion under a load that varies linearly, against closed forms."""

from __future__ import annotations

import pytest

from tests.fmu.host import Instantiate
from tests.fmus import native_fmu_only

pytestmark = native_fmu_only

BLOCK = {"base_amplitude": 0.0, "normal_amplitude": 0.0, "resonator_mass": 0.0}
"""A slider without resonator or vibration."""


def test_a_growing_load_releases_the_slider_inside_the_step(instantiate: Instantiate) -> None:
    """At rest under 0.2 N of friction; then X = -rate (t - t0)^3 / (6 M)."""
    for direction in (1.0, -1.0):
        instance = instantiate().initialize(**BLOCK)
        instance.ramp(load=0.12 * direction)
        instance.step(2.0)
        released = 0.2 / 0.12
        since = 2.0 - released
        position, velocity, event, mode = instance.get(
            "position", "velocity", "last_event_time", "contact_mode"
        )
        assert event == pytest.approx(released, abs=1e-12)
        assert position == pytest.approx(-direction * 0.12 * since**3 / 6.0, rel=1e-12)
        assert velocity == pytest.approx(-direction * 0.12 * since**2 / 2.0, rel=1e-12)
        assert mode == -direction


def test_a_falling_load_brings_the_slider_to_rest_and_back(instantiate: Instantiate) -> None:
    """It slides under 0.5 N, stops while the load falls, sticks, and is released the other way."""
    instance = instantiate().initialize(**BLOCK, load=0.5)
    instance.ramp(load=-1.0)
    instance.step(2.0)
    # Backwards: v = -0.3 t + t^2 / 2 is 0 at 0.6 s, where the load is -0.1 N and friction holds;
    # released at -0.2 N, at 0.7 s.
    position, event, reversals = instance.get("position", "last_event_time", "reversals")
    assert event == pytest.approx(0.7, abs=1e-12)
    assert position == pytest.approx(-0.15 * 0.36 + 0.216 / 6.0 + 1.3**3 / 6.0, rel=1e-11)
    assert reversals == 1.0
