from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.located_events import simulate
from tests.harness.references.comparing import assert_agree, deviation, split, until

TABLE_1 = Device()
MOTION = ("position", "velocity", "resonator_displacement", "resonator_velocity")
PERIOD = 2.0 * math.pi / 3500.0
BLOCK = Device(
    fidelity=1,
    base_amplitude=0.0,
    normal_amplitude=0.0,
    drive_frequency=10.0,
    initial_velocity=0.3,
)
STICKING = Device(base_amplitude=5e-8)


def test_block_reverses_under_load_above_friction() -> None:
    load = 0.5
    stop = 0.3 * 1.1 / (0.2 + load)
    run = simulate(BLOCK, until(2.0, load=load), np.array([stop, 2.0]))
    acceleration = (load - 0.2) / 1.1
    assert run.velocity == pytest.approx([0.0, -acceleration * (2.0 - stop)], abs=1e-12)
    assert (run.reversals, run.sticks) == (1, 0), "friction cannot hold it for an instant"


@pytest.mark.parametrize("load", [0.0, 0.1, -0.13])
def test_load_below_minimum_friction_moves_nothing(load: float) -> None:
    device = Device(base_amplitude=0.0, normal_amplitude=0.3)
    run = simulate(device, until(0.05, load=load), np.linspace(0.0, 0.05, 51))
    for name in MOTION:
        assert not getattr(run, name).any(), f"{name} under a load of {load} N"
    assert run.friction_force == pytest.approx(-load, abs=1e-16), "friction balances the load"
    assert (run.event_times.size, run.stick_time) == (0, 0.05), "stuck from first to last"
    assert run.sticks == 0, "a stick from the start is not a stick that begins"


def test_growing_resonance_breaks_a_stuck_slider_loose_on_time() -> None:
    device = Device(damping_ratio=0.0, base_amplitude=1e-8, normal_amplitude=0.0)
    half = 0.5 * device.base_amplitude

    def resonator(time: float) -> float:
        angle = 3500.0 * time
        return half * (math.sin(angle) - angle * math.cos(angle))

    # |Y| peaks at w t = n pi with height A n pi / 2: the first peak above the limit lies at n.
    reach = 0.2 / device.stiffness
    peak = math.ceil(reach / (half * math.pi)) * math.pi / 3500.0
    sign = math.copysign(1.0, resonator(peak))
    loose = brentq(
        lambda time: sign * resonator(time) - reach, peak - math.pi / 7000.0, peak, xtol=1e-18
    )
    times = np.linspace(0.0, loose, 201)
    run = simulate(device, until(loose * 1.01), times)
    assert run.event_times[0] == pytest.approx(loose, rel=1e-11), "released where k |Y| = limit"
    expected = np.array([resonator(float(time)) for time in times])
    assert run.resonator_displacement == pytest.approx(expected, abs=1e-11 * reach), (
        "undamped at resonance the amplitude grows in proportion to time"
    )
    assert not run.velocity[:-1].any(), "held until then"


def test_counts_agree_with_sampled_modes() -> None:
    run = simulate(STICKING, until(30 * PERIOD), np.linspace(0.0, 30 * PERIOD, 60001))
    modes = run.contact_mode
    changes = modes[np.flatnonzero(np.diff(modes)) + 1]
    slips = modes[modes != 0]
    # The sampling is fine enough to show every stick of the settled motion.
    assert run.sticks == int((changes == 0).sum()), "sticks that are seen to begin"
    assert run.sticks >= 29, "one stick in every period but the first"
    assert run.reversals == int((np.diff(slips) != 0).sum()), "slips that start the other way"
    assert run.event_times.size == changes.size, "every change of mode is an event"
    assert run.stick_time == pytest.approx((modes == 0).mean() * 30 * PERIOD, rel=2e-3)


def test_splitting_the_inputs_changes_nothing() -> None:
    times = np.linspace(0.0, 12 * PERIOD, 201)
    held = until(12 * PERIOD, phase=0.4, load=0.03, frequency_ratio=1.3)
    whole = simulate(TABLE_1, held, times)
    assert_agree(whole, simulate(TABLE_1, split(held, 37), times), allowed=1e-10)


def test_ratio_change_keeps_the_angle() -> None:
    stop = 1.3 * PERIOD
    held = [HeldInputs(0.0, stop), HeldInputs(stop, 2 * stop, frequency_ratio=3.0)]
    times = np.linspace(0.0, 2 * stop, 401)
    run = simulate(TABLE_1, held, times)
    angle = 3500.0 * (times + 2.0 * np.maximum(0.0, times - stop))
    assert run.normal_force == pytest.approx(1.0 + np.sin(angle), abs=1e-12), "psi is continuous"


def test_samples_do_not_influence_the_motion() -> None:
    few = simulate(TABLE_1, until(8 * PERIOD), np.array([0.0, 8 * PERIOD]))
    many = simulate(TABLE_1, until(8 * PERIOD), np.linspace(0.0, 8 * PERIOD, 999))
    for name in MOTION:
        assert getattr(few, name)[-1] == getattr(many, name)[-1], f"{name} at the end"


def test_error_falls_with_the_tolerance() -> None:
    times = np.linspace(0.0, 10 * PERIOD, 301)
    best = simulate(TABLE_1, until(10 * PERIOD), times, rtol=1e-13, atol=1e-15)

    def error(rtol: float) -> float:
        coarse = simulate(TABLE_1, until(10 * PERIOD), times, rtol=rtol, atol=rtol / 100)
        return max(deviation(best, coarse, signal) for signal in MOTION)

    assert error(1e-4) < 1e-8, "the bound on steps alone gives this, since no event costs an order"
    assert error(1e-11) < 0.05 * error(1e-4), "below that the tolerance decides"
    assert error(1e-12) < 1e-11


@pytest.mark.parametrize("method", ["LSODA", "Radau"])
def test_another_method_finds_the_same_events(method: str) -> None:
    held = until(3 * PERIOD, phase=0.4)
    times = np.linspace(0.0, held[0].stop, 13)
    run = simulate(TABLE_1, held, times, method=method, rtol=1e-7, atol=1e-9, steps_per_period=4)
    expected = simulate(TABLE_1, held, times)
    assert run.event_times == pytest.approx(expected.event_times, abs=1e-6 * PERIOD)
    assert deviation(expected, run, "velocity") < 1e-5
