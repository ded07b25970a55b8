from __future__ import annotations

from dataclasses import replace

import pytest

from slider_resonator.device.device import Device
from slider_resonator.references.averaged.added_mass import slow_linearisation
from slider_resonator.references.averaged.held_curve import HeldCurve
from slider_resonator.references.averaged.hold import Hold
from slider_resonator.references.resolved import taylor

TABLE_1 = Device()
FLIGHT = replace(TABLE_1, friction_coefficient=1.0, normal_amplitude=1.8)


@pytest.mark.parametrize("device", [TABLE_1, FLIGHT], ids=["closed", "flight"])
def test_the_table_agrees_with_the_orbits(device: Device) -> None:
    curve = HeldCurve(Hold(device, 0.0, 0.7))
    full = device.friction_faces * device.friction_coefficient * device.normal_preload
    fastest = curve.hold.vibration.velocity_amplitude
    for share in (0.31, 0.67, 0.9, 0.9996):
        velocity = share * fastest
        friction, factor = curve.friction(velocity)
        orbit = curve.orbit(velocity)
        assert friction == pytest.approx(orbit.mean_friction, abs=3e-9 * full)
        assert factor == pytest.approx(1.0 + slow_linearisation(orbit).added_mass, abs=1e-5)


def test_the_table_holds_the_added_mass_of_bristles() -> None:
    device = replace(TABLE_1, friction_law=1, bristle_stiffness=1e3)
    curve = HeldCurve(Hold(device, 0.0))
    _, factor = curve.friction(0.1)
    assert factor == pytest.approx(1.0 + slow_linearisation(curve.orbit(0.1)).added_mass, abs=1e-8)


def test_beyond_grazing_there_is_only_sliding() -> None:
    curve = HeldCurve(Hold(TABLE_1, 0.0, 0.7), simulate=taylor.simulate)
    low, high = curve.grazing
    fastest = curve.hold.vibration.velocity_amplitude
    assert (low, high) == pytest.approx((-fastest, fastest), rel=1e-3)
    assert len(curve.orbit(high * (1.0 - 1e-5)).reversals) == 2
    assert not len(curve.orbit(high * (1.0 + 1e-5)).reversals)
    assert curve.friction(2.0 * high) == pytest.approx((0.2, 1.0))
    assert curve.friction(2.0 * low) == pytest.approx((-0.2, 1.0))


def test_next_to_grazing_the_slider_sticks_and_the_table_goes_on() -> None:
    curve = HeldCurve(Hold(TABLE_1, 0.0, 0.7), accuracy=1e-6, simulate=taylor.simulate)
    _, high = curve.grazing
    shares = [curve.friction(high * (1.0 - close))[0] / 0.2 for close in (1e-4, 1e-6, 1e-8)]
    assert shares == sorted(shares), "friction grows with the velocity"
    assert shares[-1] == pytest.approx(1.0, abs=1e-3)


def test_orbits_are_found_only_where_the_motion_goes() -> None:
    curve = HeldCurve(Hold(TABLE_1, 0.0))
    assert curve.orbits == 0
    for velocity in (0.05, 0.06, 0.07):
        curve.friction(velocity)
    assert curve.orbits == 12, "one panel of 12 nodes"
