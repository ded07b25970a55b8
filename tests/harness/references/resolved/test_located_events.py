from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from slider_resonator.device.device import Device
from slider_resonator.references.resolved.located_events import simulate
from tests.harness.references.comparing import assert_agree, deviation, split, until

TABLE_1 = Device()
MOTION = ("position", "velocity", "resonator_displacement", "resonator_velocity")
PERIOD = 2.0 * math.pi / 3500.0


@pytest.mark.parametrize("load", [0.0, 0.1, -0.13])
def test_load_below_minimum_friction_moves_nothing(load: float) -> None:
    device = Device(base_amplitude=0.0, normal_amplitude=0.3)
    run = simulate(device, until(0.05, load=load), np.linspace(0.0, 0.05, 51))
    for name in MOTION:
        assert not getattr(run, name).any(), f"{name} under a load of {load} N"
    assert run.friction_force == pytest.approx(-load, abs=1e-16), "friction balances the load"
    assert (run.event_times.size, run.stick_time) == (0, 0.05), "stuck from first to last"
    assert run.sticks == 0, "a stick from the start is not a stick that begins"


def test_splitting_the_inputs_changes_nothing() -> None:
    times = np.linspace(0.0, 12 * PERIOD, 201)
    held = until(12 * PERIOD, phase=0.4, load=0.03, frequency_ratio=1.3)
    whole = simulate(TABLE_1, held, times)
    assert_agree(whole, simulate(TABLE_1, split(held, 37), times), allowed=1e-10)


def test_samples_do_not_influence_the_motion() -> None:
    few = simulate(TABLE_1, until(8 * PERIOD), np.array([0.0, 8 * PERIOD]))
    many = simulate(TABLE_1, until(8 * PERIOD), np.linspace(0.0, 8 * PERIOD, 999))
    for name in MOTION:
        assert getattr(few, name)[-1] == getattr(many, name)[-1], f"{name} at the end"


def test_error_falls_with_the_tolerance() -> None:
    times = np.linspace(0.0, 10 * PERIOD, 301)
    best = simulate(TABLE_1, until(10 * PERIOD), times)

    def error(rtol: float) -> float:
        held, atol = until(10 * PERIOD), rtol / 100
        coarse = simulate(TABLE_1, held, times, method="DOP853", rtol=rtol, atol=atol)
        return max(deviation(best, coarse, signal) for signal in MOTION)

    assert error(1e-4) < 1e-8, "the bound on steps alone gives this, since no event costs an order"
    assert error(1e-11) < 0.05 * error(1e-4), "below that the tolerance decides"
    assert error(1e-12) < 1e-11


@pytest.mark.parametrize(
    ("changes", "inputs"),
    [
        ({}, {"phase": 0.4, "load": 0.05}),
        ({"normal_amplitude": 1.8}, {"phase": 0.7, "load": 0.02}),
        ({"normal_preload": 500.0, "normal_amplitude": 300.0}, {"frequency_ratio": 1.5}),
        ({"damping_ratio": 0.0, "resonator_frequency": 3300.0}, {"frequency_ratio": 3.0}),
        ({"damping_ratio": 1.2}, {"load": 0.1}),
        ({"fidelity": 1}, {"phase": 0.7}),
        ({"tangential_force": 40.0}, {"phase": 0.2}),
    ],
)
def test_exponentials_agree_with_stepwise_integration(
    changes: dict[str, Any], inputs: dict[str, float]
) -> None:
    device = replace(TABLE_1, **changes)
    times = np.linspace(0.0, 12 * PERIOD, 301)
    ramp = replace(until(12 * PERIOD, **inputs)[0], load_rate=3.0)
    for held in (until(12 * PERIOD, **inputs), [ramp]):
        exact = simulate(device, held, times)
        steps = simulate(device, held, times, method="DOP853")
        assert exact.modes.tolist() == steps.modes.tolist()
        assert exact.event_times == pytest.approx(steps.event_times, abs=1e-11 * PERIOD)
        for signal in MOTION:
            assert deviation(steps, exact, signal) < 1e-11, signal


@pytest.mark.parametrize("method", ["LSODA", "Radau"])
def test_another_method_finds_the_same_events(method: str) -> None:
    held = until(3 * PERIOD, phase=0.4)
    times = np.linspace(0.0, held[0].stop, 13)
    run = simulate(TABLE_1, held, times, method=method, rtol=1e-7, atol=1e-9, steps_per_period=4)
    expected = simulate(TABLE_1, held, times)
    assert run.event_times == pytest.approx(expected.event_times, abs=1e-6 * PERIOD)
    assert deviation(expected, run, "velocity") < 1e-5
