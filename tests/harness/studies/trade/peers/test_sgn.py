from __future__ import annotations

import math

import numpy as np
import pytest

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved import located_events
from slider_resonator.references.resolved.trajectory import Trajectory
from slider_resonator.studies.trade.peers.event_free import simulate_sgn

TABLE_1 = Device()
PERIOD = 2.0 * math.pi / 3500.0
ATOL = 1e-6
SIGNALS = ("position", "velocity", "resonator_displacement", "resonator_velocity")
BLOCK = Device(
    fidelity=1,
    base_amplitude=0.0,
    normal_amplitude=0.0,
    drive_frequency=10.0,
    initial_velocity=0.3,
)


def until(stop: float, **inputs: float) -> list[HeldInputs]:
    return [HeldInputs(0.0, stop, **inputs)]


def deviation(first: Trajectory, second: Trajectory) -> float:
    """Largest deviation of any signal, in fractions of its peak."""
    pairs = [(getattr(first, name), getattr(second, name)) for name in SIGNALS]
    return max(float(abs(a - b).max() / abs(b).max()) for a, b in pairs)


def test_before_it_stops_a_sliding_block_slows_down_evenly() -> None:
    deceleration = (0.2 + 0.05) / 1.1
    times = np.linspace(0.0, 1.3, 51)
    run = simulate_sgn(BLOCK, until(1.3, load=0.05), times)
    assert run.velocity == pytest.approx(0.3 - deceleration * times, abs=1e-9)
    assert run.position == pytest.approx(0.3 * times - 0.5 * deceleration * times**2, abs=1e-9)
    assert (run.contact_mode == 1).all()
    assert run.friction_force == pytest.approx(0.2), "full friction against the motion"


def test_a_block_that_should_stick_chatters_about_rest_instead() -> None:
    stop = 0.3 * 1.1 / 0.25
    times = np.linspace(stop + 0.01, stop + 0.1, 51)
    run = simulate_sgn(BLOCK, until(stop + 0.1, load=0.05), times, atol=1e-3)
    assert np.abs(run.velocity).max() < 1e-3, "friction keeps the velocity near zero"
    assert run.reversals > 10, "sgn jumps to and fro where the slider should be held"
    assert (run.sticks, run.stick_time) == (0, 0.0), "without events there is no stick"
    assert abs(run.friction_force) == pytest.approx(0.2), "never the force that would hold it"


def test_a_chatter_without_end_is_refused_with_its_time_and_cost() -> None:
    with pytest.raises(RuntimeError, match=r"max_evaluations = 20000: it chatters") as refusal:
        simulate_sgn(BLOCK, until(9.0, load=0.05), np.empty(0), max_evaluations=20_000)
    assert "t = 1.3" in str(refusal.value), "the block comes to rest at 1.32 s"


def test_at_exact_rest_friction_vanishes() -> None:
    run = simulate_sgn(Device(base_amplitude=0.0), until(0.02), np.linspace(0.0, 0.02, 21))
    for name in (*SIGNALS, "friction_force", "contact_mode"):
        assert not getattr(run, name).any(), f"{name}: sgn 0 is 0 and nothing drives"


def test_without_normal_load_nothing_but_the_load_takes_momentum() -> None:
    device = Device(normal_preload=0.0, normal_amplitude=0.0, initial_velocity=0.2)
    times = np.linspace(0.0, 0.03, 101)
    run = simulate_sgn(device, until(0.03, load=0.7), times)
    momentum = 1.1 * run.velocity + 0.1 * run.resonator_velocity
    drive = 0.1 * 1e-4 * 3500.0 * (1.0 - np.cos(3500.0 * times))
    assert momentum == pytest.approx(0.22 - 0.7 * times + drive, abs=1e-5), "(26), no friction"
    assert (run.contact_mode == 2).all(), "the contact never closes"


@pytest.mark.parametrize(
    ("device", "inputs"),
    [
        (TABLE_1, {}),
        (TABLE_1, {"phase": 0.4, "load": 0.05}),
        (TABLE_1, {"frequency_ratio": 3.0}),
        (Device(normal_amplitude=1.5), {}),
        (Device(fidelity=1), {"phase": 0.4}),
        (Device(tangential_force=50.0), {}),
    ],
)
def test_it_agrees_with_located_events_to_its_own_accuracy(
    device: Device, inputs: dict[str, float]
) -> None:
    times = np.linspace(0.0, 10 * PERIOD, 401)
    held = until(10 * PERIOD, **inputs)
    exact = located_events.simulate(device, held, times, rtol=1e-10, atol=1e-12)
    error = deviation(simulate_sgn(device, held, times, atol=ATOL), exact)
    assert error < 2e-3, "rtol 1e-6, less what is lost in every jump"


def test_its_error_falls_with_the_tolerance_and_its_cost_grows() -> None:
    times = np.linspace(0.0, 5 * PERIOD, 201)
    held = until(5 * PERIOD)
    exact = located_events.simulate(TABLE_1, held, times)
    coarse = simulate_sgn(TABLE_1, held, times, rtol=1e-4, atol=1e-4)
    fine = simulate_sgn(TABLE_1, held, times, rtol=1e-8, atol=1e-8)
    assert deviation(fine, exact) < 0.02 * deviation(coarse, exact)
    assert fine.evaluations > 2 * coarse.evaluations
    assert fine.evaluations >= 12 * fine.steps, "each step of DOP853 takes at least 12"


def test_inputs_change_at_the_boundaries_and_angles_go_on() -> None:
    cut = 3.3 * PERIOD
    held = [
        HeldInputs(0.0, cut),
        HeldInputs(cut, 2 * cut, phase=1.0, load=0.1, frequency_ratio=3.0),
    ]
    times = np.linspace(0.0, 2 * cut, 301)
    run = simulate_sgn(TABLE_1, held, times, atol=ATOL)
    exact = located_events.simulate(TABLE_1, held, times)
    assert deviation(run, exact) < 2e-3, "in every signal, across the change"
    assert run.normal_force == pytest.approx(exact.normal_force, abs=1e-12), "psi is continuous"


def test_samples_do_not_influence_the_motion() -> None:
    few = simulate_sgn(TABLE_1, until(4 * PERIOD), np.array([0.0, 4 * PERIOD]), atol=ATOL)
    many = simulate_sgn(TABLE_1, until(4 * PERIOD), np.linspace(0.0, 4 * PERIOD, 333), atol=ATOL)
    for name in SIGNALS:
        assert getattr(few, name)[-1] == getattr(many, name)[-1], f"{name} at the end"
        assert getattr(few, name)[0] == 0.0, f"{name} at the start"


@pytest.mark.parametrize(
    ("device", "held", "times", "message"),
    [
        (Device(friction_law=1), until(1.0), [0.0], "friction_law = 1"),
        (TABLE_1, [HeldInputs(0.0, 1.0), HeldInputs(1.5, 2.0)], [0.0], r"start = 1\.5 s"),
        (TABLE_1, until(1.0), [-0.5], "must lie within"),
    ],
)
def test_devices_that_cannot_be_simulated_are_refused(
    device: Device, held: list[HeldInputs], times: list[float], message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        simulate_sgn(device, held, np.array(times))
