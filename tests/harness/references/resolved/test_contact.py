from __future__ import annotations

import math

import numpy as np
import pytest

from slider_resonator.references.resolved.contact import (
    SLIP_BACKWARD,
    SLIP_FORWARD,
    STICK,
    is_lifted,
    mode_at_rest,
    time_to_contact_change,
)


@pytest.mark.parametrize(
    ("needed", "limit", "mode"),
    [
        (0.1, 0.2, STICK),
        (-0.2, 0.2, STICK),
        (0.0, 0.0, STICK),
        (0.21, 0.2, SLIP_FORWARD),
        (-1e-300, 0.0, SLIP_BACKWARD),
    ],
)
def test_slider_at_rest_sticks_while_friction_suffices(
    needed: float, limit: float, mode: int
) -> None:
    assert mode_at_rest(needed, limit) == mode


@pytest.mark.parametrize("rate", [3500.0, -3500.0, 0.5])
@pytest.mark.parametrize("amplitude", [1.0 + 1e-9, 1.5, 40.0])
@pytest.mark.parametrize("angle", [-3.0, 0.0, 1.0, 3.5, 5.0, 100.0])
def test_contact_changes_where_the_normal_load_crosses_zero(
    rate: float, amplitude: float, angle: float
) -> None:
    for lifted in (False, True):
        time = time_to_contact_change(lifted, 1.0, amplitude, angle, rate)
        assert 0.0 <= time <= 2.0 * math.pi / abs(rate), "it happens once in every period"
        load = 1.0 + amplitude * math.sin(angle + rate * time)
        assert load == pytest.approx(0.0, abs=1e-12 * amplitude), "there the load vanishes"
        slope = amplitude * rate * math.cos(angle + rate * time)
        assert (slope < 0.0) == (not lifted), "lift-off where it falls, touchdown where it rises"


@pytest.mark.parametrize("rate", [1.0, -2.0])
def test_contact_is_open_while_the_normal_load_is_negative(rate: float) -> None:
    for angle in np.linspace(-7.0, 7.0, 97):
        pulls = 1.0 + 1.7 * math.sin(angle) < 0.0
        assert is_lifted(1.0, 1.7, float(angle), rate) == pulls, f"at angle {angle}"


@pytest.mark.parametrize("rate", [1.0, -1.0])
def test_contact_at_a_crossing_is_the_one_just_after(rate: float) -> None:
    assert is_lifted(0.0, 1.0, math.pi, 1.0), "at lift-off it has lifted"
    assert not is_lifted(0.0, 1.0, 2.0 * math.pi, 1.0), "at touchdown it has touched down"
    assert time_to_contact_change(False, 1.0, 1.0, -math.pi / 2.0, rate) == math.inf
    assert not is_lifted(1.0, 1.0, -math.pi / 2.0, rate), "touching is not lifting"


def test_constant_normal_load_never_changes_the_contact() -> None:
    assert time_to_contact_change(False, 1.0, 2.0, 0.0, 0.0) == math.inf
    assert time_to_contact_change(True, 1.0, 2.0, -1.5, 0.0) == math.inf
    assert is_lifted(1.0, 2.0, -1.5, 0.0), "1 + 2 sin(-1.5) < 0: open for good"
    assert not is_lifted(1.0, 2.0, 0.0, 0.0)
    assert is_lifted(0.0, 0.0, 0.3, 1.0), "without any normal load there is no contact"
