from __future__ import annotations

import numpy as np
import pytest

from slider_resonator.references.averaged.panels import Oscillator, Panels

PANELS = Panels(0.3 + np.array([0.0, 0.4, 1.3, 2.0, 2.9, 3.6, 4.5, 5.4, 2.0 * np.pi]))


def test_integral_mean_and_value_of_a_sine_are_exact() -> None:
    values = 0.7 + np.sin(PANELS.nodes)
    within, at_edges = PANELS.integral(values)
    exact = 0.7 * (PANELS.nodes - 0.3) + np.cos(0.3) - np.cos(PANELS.nodes)
    assert within == pytest.approx(exact, abs=1e-14)
    assert at_edges[-1] == pytest.approx(0.7 * 2.0 * np.pi, abs=1e-14)
    assert PANELS.mean(values) == pytest.approx(0.7, abs=1e-15)
    angles = np.array([-0.1, 0.3, 1.3, 6.0, 20.0])
    assert PANELS.at(values, angles) == pytest.approx(0.7 + np.sin(angles), abs=1e-13)


def test_a_jump_at_an_edge_costs_no_digits() -> None:
    values = np.where(PANELS.nodes < 2.3, 1.0, -1.0)
    _, at_edges = PANELS.integral(values)
    assert at_edges[-1] == pytest.approx(2.0 - (2.0 * np.pi - 2.0), abs=1e-14)


def test_slopes_are_those_on_either_side_of_an_edge() -> None:
    left, right = PANELS.slopes_at_edges(np.abs(np.sin(PANELS.nodes - 2.3)))
    assert right[2] == pytest.approx(-1.0, abs=1e-11)
    assert left[3] == pytest.approx(1.0, abs=1e-11)


def test_the_response_to_a_sine_is_the_known_one() -> None:
    oscillator = Oscillator(inertia=0.9, damping=0.1, stiffness=1.7)
    displacement, velocity = oscillator.response(PANELS, np.sin(2.0 * PANELS.nodes))
    gain = 1.0 / (1.7 - 4.0 * 0.9 + 2j * 0.1)
    rotating = gain * np.exp(2j * PANELS.nodes)
    assert displacement == pytest.approx(rotating.imag, abs=1e-13)
    assert velocity == pytest.approx((2j * rotating).imag, abs=1e-13)


def test_the_response_that_drifts_gains_the_jump() -> None:
    oscillator = Oscillator(inertia=0.9, damping=0.1, stiffness=1.7)
    ramp = PANELS.nodes - 0.3
    displacement, velocity = oscillator.response(PANELS, 0.1 + 1.7 * ramp, jump=(2.0 * np.pi, 0.0))
    assert displacement == pytest.approx(ramp, abs=1e-12)
    assert velocity == pytest.approx(np.ones_like(ramp), abs=1e-12)


def test_the_response_that_decays_loses_its_share() -> None:
    oscillator = Oscillator(inertia=0.9, damping=0.1, stiffness=1.7)
    decay = np.exp(-0.01 * (PANELS.nodes - 0.3))
    gain = 1.0 / (0.9e-4 - 0.1e-2 + 1.7)
    displacement, velocity = oscillator.response(
        PANELS, decay, multiplier=float(np.exp(-0.02 * np.pi))
    )
    assert displacement == pytest.approx(gain * decay, abs=1e-12)
    assert velocity == pytest.approx(-0.01 * gain * decay, abs=1e-12)
