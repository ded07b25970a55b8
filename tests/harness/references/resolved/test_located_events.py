from __future__ import annotations

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from scipy.optimize import brentq

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.located_events import simulate
from slider_resonator.references.resolved.trajectory import Trajectory
from tests.problems import PROBLEMS

TABLE_1 = Device()
PERIOD = 2.0 * math.pi / 3500.0
BLOCK = Device(
    fidelity=1,
    base_amplitude=0.0,
    normal_amplitude=0.0,
    drive_frequency=10.0,
    initial_velocity=0.3,
)
STICKING = Device(base_amplitude=5e-8)
SIGNALS = ("position", "velocity", "resonator_displacement", "resonator_velocity")


def until(stop: float, **inputs: float) -> list[HeldInputs]:
    return [HeldInputs(0.0, stop, **inputs)]


def deviation(first: Trajectory, second: Trajectory) -> float:
    """Largest deviation of any signal, in fractions of its peak."""
    pairs = [(getattr(first, name), getattr(second, name)) for name in SIGNALS]
    return max(float(abs(a - b).max() / abs(b).max()) for a, b in pairs)


def test_sliding_block_decelerates_stops_and_sticks() -> None:
    load = 0.05
    deceleration = (0.2 + load) / 1.1
    stop = 0.3 / deceleration
    times = np.linspace(0.0, 2.0, 100)
    assert np.abs(times - stop).min() > 1e-3, "no point at the stop, where friction jumps"
    run = simulate(BLOCK, until(2.0, load=load), times)
    sliding = np.minimum(times, stop)
    assert run.position == pytest.approx(0.3 * sliding - 0.5 * deceleration * sliding**2, abs=1e-13)
    assert run.velocity == pytest.approx(0.3 - deceleration * sliding, abs=1e-13)
    assert (run.velocity[times > stop] == 0.0).all(), "rest is exact, not creep"
    assert run.event_times == pytest.approx([stop], rel=1e-12), "one event: the stop"
    assert (run.reversals, run.sticks) == (0, 1), "it sticks, it does not turn round"
    assert run.stick_time == pytest.approx(2.0 - stop, rel=1e-12)
    expected = np.where(times < stop, 0.2, -load)
    assert run.friction_force == pytest.approx(expected, abs=1e-14), "then friction holds the load"
    assert run.contact_mode.tolist() == np.where(times < stop, 1, 0).tolist()


def test_block_reverses_under_load_above_friction() -> None:
    load = 0.5
    stop = 0.3 * 1.1 / (0.2 + load)
    run = simulate(BLOCK, until(2.0, load=load), np.array([stop, 2.0]))
    acceleration = (load - 0.2) / 1.1
    assert run.velocity == pytest.approx([0.0, -acceleration * (2.0 - stop)], abs=1e-12)
    assert (run.reversals, run.sticks) == (1, 0), "friction cannot hold it for an instant"


def test_free_flight_loses_momentum_to_the_load_only() -> None:
    device = Device(
        normal_preload=0.0, normal_amplitude=0.0, initial_velocity=0.2, damping_ratio=0.3
    )
    times = np.linspace(0.0, 0.05, 301)
    run = simulate(device, until(0.05, load=0.7), times)
    momentum = 1.1 * run.velocity + 0.1 * run.resonator_velocity
    drive = 0.1 * 1e-4 * 3500.0 * (1.0 - np.cos(3500.0 * times))
    assert momentum == pytest.approx(0.22 - 0.7 * times + drive, abs=1e-12), (
        "(26) without friction: the momentum of both masses integrates base drive and load"
    )
    assert (run.contact_mode == 2).all(), "the contact never closes"
    assert not run.friction_force.any(), "an open contact has no friction"


@pytest.mark.parametrize("load", [0.0, 0.1, -0.13])
def test_load_below_minimum_friction_moves_nothing(load: float) -> None:
    device = Device(base_amplitude=0.0, normal_amplitude=0.3)
    run = simulate(device, until(0.05, load=load), np.linspace(0.0, 0.05, 51))
    for name in SIGNALS:
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


def test_contact_is_open_exactly_while_the_normal_load_is_negative() -> None:
    device = Device(normal_amplitude=1.5)
    times = np.linspace(0.0, 10 * PERIOD, 997)
    run = simulate(device, until(10 * PERIOD), times)
    pull = 1.0 + 1.5 * np.sin(3500.0 * times)
    assert ((run.contact_mode == 2) == (pull < 0.0)).all(), "lifted where N0 + dN sin < 0"
    assert run.normal_force == pytest.approx(np.maximum(0.0, pull), abs=1e-12)
    half = math.acos(1.0 / 1.5)
    expected = [(2 * n + 1.5) * math.pi + s * half for n in range(10) for s in (-1, 1)]
    for switch in expected:
        nearest = np.abs(run.event_times - switch / 3500.0).min()
        assert nearest < 1e-15, f"no event at the change of contact at angle {switch}"


@pytest.mark.parametrize("device", [TABLE_1, STICKING, Device(normal_amplitude=1.5)])
def test_friction_stays_within_its_limit_and_reaches_it_in_slip(device: Device) -> None:
    run = simulate(device, until(15 * PERIOD), np.linspace(0.0, 15 * PERIOD, 1501))
    limit = 0.2 * run.normal_force
    assert (abs(run.friction_force) <= limit + 1e-12).all(), "Coulomb's bound"
    slip = abs(run.contact_mode) == 1
    assert slip.any()
    assert run.friction_force[slip] == pytest.approx(run.contact_mode[slip] * limit[slip]), (
        "full friction against the motion in slip"
    )
    sign = np.sign(run.velocity[slip])
    assert ((sign == run.contact_mode[slip]) | (sign == 0)).all(), "mode is the sign of velocity"
    assert not run.velocity[run.contact_mode == 0].any(), "a stuck slider is at rest"


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
    inputs = {"phase": 0.4, "load": 0.03, "frequency_ratio": 1.3}
    whole = simulate(TABLE_1, until(12 * PERIOD, **inputs), times)
    cuts = np.linspace(0.0, 12 * PERIOD, 38).tolist()
    pieces = [HeldInputs(a, b, **inputs) for a, b in pairwise(cuts)]
    cut = simulate(TABLE_1, pieces, times)
    assert deviation(cut, whole) < 1e-10, "both angles go on where they were"
    assert cut.reversals == whole.reversals


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
    for name in SIGNALS:
        assert getattr(few, name)[-1] == getattr(many, name)[-1], f"{name} at the end"


def test_error_falls_with_the_tolerance() -> None:
    times = np.linspace(0.0, 10 * PERIOD, 301)
    best = simulate(TABLE_1, until(10 * PERIOD), times, rtol=1e-13, atol=1e-15)

    def error(rtol: float) -> float:
        coarse = simulate(TABLE_1, until(10 * PERIOD), times, rtol=rtol, atol=rtol / 100)
        return deviation(coarse, best)

    assert error(1e-4) < 1e-8, "the bound on steps alone gives this, since no event costs an order"
    assert error(1e-11) < 0.05 * error(1e-4), "below that the tolerance decides"
    assert error(1e-12) < 1e-11


@pytest.mark.parametrize(
    ("device", "held", "times", "message"),
    [
        (Device(friction_law=1), until(1.0), [0.0], "friction_law = 1"),
        (Device(fidelity=0), until(1.0), [0.0], "fidelity = 0"),
        (Device(normal_preload=-1.0), until(1.0), [0.0], r"normal_preload = -1\.0 N"),
        (TABLE_1, [], [0.0], "at least one interval"),
        (TABLE_1, [HeldInputs(1.0, 1.0)], [1.0], r"stop = 1\.0 s must be greater"),
        (TABLE_1, [HeldInputs(0.0, 1.0), HeldInputs(1.5, 2.0)], [0.0], r"start = 1\.5 s"),
        (TABLE_1, until(1.0), [0.5, 1.5], r"to 1\.5\)? s must lie within"),
        (TABLE_1, until(1.0), [0.5, 0.2], "ascending"),
    ],
)
def test_invalid_runs_are_refused(
    device: Device, held: list[HeldInputs], times: list[float], message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        simulate(device, held, np.array(times))


@pytest.mark.slow
@pytest.mark.parametrize("name", PROBLEMS)
def test_taylor_agrees(name: str) -> None:
    from slider_resonator.references.resolved import taylor

    problem = PROBLEMS[name]
    changes = len(problem.held) > 1
    held = problem.held if changes else [replace(problem.held[0], stop=0.06)]
    times = np.linspace(0.0, held[-1].stop, 501)
    run = simulate(problem.device, held, times)
    exact = taylor.simulate(problem.device, held, times)
    for signal in (*SIGNALS, "normal_force", "friction_force"):
        expected = getattr(exact, signal)
        peak = abs(expected).max()
        error = abs(getattr(run, signal) - expected).max()
        assert error <= 3e-9 * peak, f"{signal}: {error} of {peak}"
    assert (run.reversals, run.sticks) == (exact.reversals, exact.sticks), "the same events"


@pytest.mark.parametrize("method", ["LSODA", "Radau"])
def test_another_method_finds_the_same_events(method: str) -> None:
    device, held = Device(), [HeldInputs(0.0, 3 * PERIOD, phase=0.4)]
    times = np.linspace(0.0, held[0].stop, 13)
    run = simulate(device, held, times, method=method, rtol=1e-7, atol=1e-9, steps_per_period=4)
    expected = simulate(device, held, times)
    assert run.event_times == pytest.approx(expected.event_times, abs=1e-6 * PERIOD)
    assert np.abs(run.velocity - expected.velocity).max() < 1e-5 * np.abs(expected.velocity).max()


def test_unknown_method_is_refused() -> None:
    with pytest.raises(ValueError, match="method = 'Euler': must be one of DOP853, LSODA, Radau"):
        simulate(Device(), [HeldInputs(0.0, PERIOD)], np.empty(0), method="Euler")
