"""Friction by sgn, and by tanh: Coulomb in the limit of zero width, a creep for a stick."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.simulate import simulate
from slider_resonator.references.resolved.trajectory import Trajectory
from slider_resonator.trading.peers import moreau_jean
from slider_resonator.trading.peers.event_free import simulate_bristle, simulate_sgn, simulate_tanh
from tests.harness.references.lugre_problems import PROBLEMS, TIMES

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
SLIDER = Device(resonator_mass=0.0, base_amplitude=0.0, normal_amplitude=0.0)


def until(stop: float, **inputs: float) -> list[HeldInputs]:
    return [HeldInputs(0.0, stop, **inputs)]


def deviation(first: Trajectory, second: Trajectory) -> float:
    """Largest deviation of any signal, in fractions of its peak."""
    pairs = [(getattr(first, name), getattr(second, name)) for name in SIGNALS]
    return max(float(abs(a - b).max() / abs(b).max()) for a, b in pairs)


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


CHANGING = [
    HeldInputs(0.0, 3.3 * PERIOD),
    HeldInputs(3.3 * PERIOD, 6.6 * PERIOD, phase=1.0, load=0.1, frequency_ratio=3.0),
]


@pytest.mark.parametrize(
    ("device", "held"),
    [
        (TABLE_1, until(10 * PERIOD)),
        (TABLE_1, until(10 * PERIOD, phase=0.4, load=0.05)),
        (TABLE_1, until(10 * PERIOD, frequency_ratio=3.0)),
        (TABLE_1, CHANGING),
        (Device(normal_amplitude=1.5), until(10 * PERIOD)),
        (Device(fidelity=1), until(10 * PERIOD, phase=0.4)),
        (Device(tangential_force=50.0), until(10 * PERIOD)),
    ],
)
def test_sgn_agrees_with_located_events_to_its_own_accuracy(
    device: Device, held: list[HeldInputs]
) -> None:
    times = np.linspace(0.0, held[-1].stop, 401)
    exact = simulate(device, held, times)
    run = simulate_sgn(device, held, times, atol=ATOL)
    assert deviation(run, exact) < 2e-3, "rtol 1e-6, less what is lost in every jump"
    assert run.normal_force == pytest.approx(exact.normal_force, abs=1e-12), "psi is continuous"
    assert (run.contact_mode == exact.contact_mode).mean() > 0.95


def test_samples_do_not_influence_the_motion() -> None:
    few = simulate_sgn(TABLE_1, until(4 * PERIOD), np.array([0.0, 4 * PERIOD]), atol=ATOL)
    many = simulate_sgn(TABLE_1, until(4 * PERIOD), np.linspace(0.0, 4 * PERIOD, 333), atol=ATOL)
    for name in SIGNALS:
        assert getattr(few, name)[-1] == getattr(many, name)[-1], f"{name} at the end"


def test_the_error_of_sgn_falls_with_the_tolerance_and_its_cost_grows() -> None:
    times = np.linspace(0.0, 5 * PERIOD, 201)
    held = until(5 * PERIOD)
    exact = simulate(TABLE_1, held, times)
    coarse = simulate_sgn(TABLE_1, held, times, rtol=1e-4, atol=1e-4)
    fine = simulate_sgn(TABLE_1, held, times, rtol=1e-8, atol=1e-8)
    assert deviation(fine, exact) < 0.02 * deviation(coarse, exact)
    assert fine.evaluations > 2 * coarse.evaluations
    assert fine.evaluations >= 12 * fine.steps, "each step of DOP853 takes at least 12"


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


def test_the_limit_of_zero_width_is_coulomb_friction() -> None:
    held = until(6 * PERIOD, phase=0.4)
    times = np.linspace(0.0, held[0].stop, 49)
    exact = simulate(TABLE_1, held, times)
    widths = np.array([1e-2, 1e-3, 1e-4, 1e-5])
    runs = [simulate_tanh(TABLE_1, held, times, width=width) for width in widths]
    errors = np.array([np.abs(run.position - exact.position).max() for run in runs])
    assert (np.diff(errors) < 0.0).all(), f"a narrower tanh is nearer to sgn: {errors}"
    order = np.polyfit(np.log(widths), np.log(errors), 1)[0]
    assert order > 0.3, f"the error vanishes with a power of the width, not {order}"
    assert errors[-1] < 1e-3 * np.abs(exact.position).max()


@pytest.mark.slow
def test_it_creeps_where_friction_should_hold() -> None:
    width, stop = 1e-3, 0.1
    run = simulate_tanh(SLIDER, until(stop, load=0.1), np.array([stop]), width=width)
    creep = -width * math.atanh(0.1 / 0.2)
    assert run.velocity[0] == pytest.approx(creep, rel=1e-5), "tanh(v / width) holds 0.1 of 0.2 N"
    assert run.friction_force[0] == pytest.approx(-0.1, rel=1e-5)


@pytest.mark.parametrize("width", [0.0, -1.0, math.nan, math.inf])
def test_a_width_that_is_none_is_refused(width: float) -> None:
    with pytest.raises(ValueError, match=r"width = .* m/s: must be a finite number above 0"):
        simulate_tanh(SLIDER, until(1.0), np.empty(0), width=width)


def test_an_unknown_method_is_refused() -> None:
    with pytest.raises(ValueError, match="method = 'Euler': must be one of DOP853, LSODA, Radau"):
        simulate_bristle(*PROBLEMS["table 1"], TIMES, method="Euler")


@pytest.mark.parametrize("method", ["LSODA", "Radau"])
def test_the_error_of_a_bristle_falls_with_the_tolerance(method: str) -> None:
    device, held = PROBLEMS["table 1"]
    exact = simulate(device, held, TIMES)
    errors = []
    for rtol in (1e-4, 1e-7, 1e-10):
        found = simulate_bristle(device, held, TIMES, method=method, rtol=rtol, atol=1e-2 * rtol)
        errors.append(float(np.abs(found.velocity - exact.velocity).max()))
    for coarse, fine in pairwise(errors):
        assert fine < 0.1 * coarse, f"errors {errors} must fall towards the reference"


def test_ramps_of_all_inputs_are_followed() -> None:
    held = [
        HeldInputs(
            0.0, 3 * PERIOD, 0.3, 0.05, 1.0, phase_rate=20.0, load_rate=3.0, ratio_rate=20.0
        ),
        HeldInputs(3 * PERIOD, 6 * PERIOD, 0.4, load=0.06, load_rate=-3.0, ratio_rate=-30.0),
    ]
    times = np.linspace(0.0, 6 * PERIOD, 25)
    reference = simulate(TABLE_1, held, times)
    followed = simulate_sgn(TABLE_1, held, times, rtol=1e-10, atol=1e-10)
    assert deviation(followed, reference) < 1e-8
    stepped = moreau_jean.simulate(TABLE_1, held, times, steps_per_period=4096)
    assert deviation(stepped, reference) < 1e-4
    held_still = [replace(one, phase_rate=0.0, load_rate=0.0, ratio_rate=0.0) for one in held]
    still = simulate(TABLE_1, held_still, times)
    assert deviation(still, reference) > 1e-3, "the ramps count"
