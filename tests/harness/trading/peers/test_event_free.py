"""Friction by sgn, by tanh and by a bristle, against motion with located events."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import DOP853

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved import simulate as resolved
from slider_resonator.trading.peers import located_scipy, moreau_jean
from slider_resonator.trading.peers.event_free import simulate
from tests.harness.references.comparing import deviation, until
from tests.harness.references.lugre_problems import PROBLEMS, TIMES

TABLE_1 = Device()
PERIOD = 2.0 * math.pi / 3500.0
SIGNALS = ("position", "velocity", "resonator_displacement", "resonator_velocity")
BLOCK = Device(
    fidelity=1,
    base_amplitude=0.0,
    normal_amplitude=0.0,
    drive_frequency=10.0,
    initial_velocity=0.3,
)


def test_chatter_replaces_a_stick_and_has_a_bound() -> None:
    stop = 0.3 * 1.1 / 0.25
    times = np.linspace(stop + 0.01, stop + 0.1, 51)
    sgn = partial(simulate, method=DOP853, rtol=1e-6)
    run = sgn(BLOCK, until(stop + 0.1, load=0.05), times, atol=1e-3)
    assert np.abs(run.velocity).max() < 1e-3, "friction keeps the velocity near zero"
    assert run.reversals > 10, "sgn jumps to and fro where the slider should be held"
    assert (run.sticks, run.stick_time) == (0, 0.0), "without events there is no stick"
    assert abs(run.friction_force) == pytest.approx(0.2), "never the force that would hold it"
    with pytest.raises(RuntimeError, match=r"t = 1\.3.* = 20000: it chatters"):
        sgn(BLOCK, until(9.0, load=0.05), np.empty(0), atol=1e-10, max_evaluations=20_000)


RAMPS = [
    HeldInputs(0.0, 3 * PERIOD, 0.3, 0.05, 1.0, phase_rate=20.0, load_rate=3.0, ratio_rate=20.0),
    HeldInputs(3 * PERIOD, 6 * PERIOD, 0.4, load=0.06, load_rate=-3.0, ratio_rate=-30.0),
]


@pytest.mark.parametrize(
    ("device", "held", "share"),
    [
        (TABLE_1, RAMPS, 0.02),
        (Device(normal_amplitude=1.5), until(4 * PERIOD, frequency_ratio=3.0), 0.05),
        (Device(fidelity=1, tangential_force=50.0), until(4 * PERIOD, phase=0.4), 0.05),
    ],
)
def test_sgn_agrees_with_located_events(
    device: Device, held: list[HeldInputs], share: float
) -> None:
    times = np.linspace(0.0, held[-1].stop, 201)
    exact = resolved.simulate(device, held, times)
    coarse, fine = (
        simulate(device, held, times, method=DOP853, rtol=atol, atol=atol) for atol in (1e-4, 1e-8)
    )
    errors = [max(deviation(exact, run, name) for name in SIGNALS) for run in (coarse, fine)]
    assert errors[1] < min(1e-4, share * errors[0]), errors
    assert deviation(exact, fine, "velocity") < 1e-5
    assert fine.evaluations > 2 * coarse.evaluations
    assert fine.normal_force == pytest.approx(exact.normal_force, abs=1e-12), "psi is continuous"
    assert (fine.contact_mode == exact.contact_mode).mean() > 0.95


def test_ramps_of_all_inputs_are_followed() -> None:
    """By a slider that moves from the start: at rest sgn chatters, and its error is rounding's."""
    device, times = replace(TABLE_1, initial_velocity=-0.02), np.linspace(0.0, 6 * PERIOD, 25)
    reference = resolved.simulate(device, RAMPS, times)
    followed = simulate(device, RAMPS, times, method=DOP853, rtol=1e-12, atol=1e-12)
    stepped = moreau_jean.simulate(device, RAMPS, times, steps_per_period=4096)
    still = [replace(one, phase_rate=0.0, load_rate=0.0, ratio_rate=0.0) for one in RAMPS]
    held = resolved.simulate(device, still, times)
    for run, allowed in ((followed, 1e-8), (stepped, 1e-4)):
        assert max(deviation(reference, run, name) for name in SIGNALS) < allowed
    assert max(deviation(reference, held, name) for name in SIGNALS) > 1e-3, "the ramps count"


def test_tanh_is_coulomb_friction_in_the_limit_and_creeps() -> None:
    held = until(6 * PERIOD, phase=0.4)
    times = np.linspace(0.0, held[0].stop, 49)
    exact = resolved.simulate(TABLE_1, held, times)
    widths = np.array([1e-2, 1e-3, 1e-4, 1e-5])
    runs = [simulate(TABLE_1, held, times, width=w, rtol=1e-9, atol=1e-11) for w in widths]
    errors = [deviation(exact, run, "position") for run in runs]
    assert (np.diff(errors) < 0.0).all(), f"a narrower tanh is nearer to sgn: {errors}"
    assert np.polyfit(np.log(widths), np.log(errors), 1)[0] > 0.3, f"errors {errors}"
    assert errors[-1] < 1e-3
    slider = Device(resonator_mass=0.0, base_amplitude=0.0, normal_amplitude=0.0)
    width, stop = 0.01, np.array([1.0])
    run = simulate(slider, until(1.0, load=0.1), stop, width=width, rtol=1e-9, atol=1e-11)
    creep = -width * math.atanh(0.1 / 0.2)
    assert run.velocity[0] == pytest.approx(creep, rel=1e-5), "tanh(v / width) holds 0.1 of 0.2 N"
    assert run.friction_force[0] == pytest.approx(-0.1, rel=1e-5)


def test_the_error_of_a_bristle_falls_with_the_tolerance() -> None:
    device, held = PROBLEMS["table 1"]
    exact = resolved.simulate(device, held, TIMES)
    errors = []
    for rtol in (1e-4, 1e-7, 1e-10):
        found = simulate(device, held, TIMES, rtol=rtol, atol=1e-2 * rtol)
        errors.append(deviation(exact, found, "velocity"))
    for coarse, fine in pairwise(errors):
        assert fine < 0.1 * coarse, f"errors {errors} must fall towards the reference"


def test_the_error_of_located_events_falls_with_the_tolerance() -> None:
    times, held = np.linspace(0.0, 10 * PERIOD, 301), until(10 * PERIOD)
    best = resolved.simulate(TABLE_1, held, times)

    def error(rtol: float) -> float:
        coarse = located_scipy.simulate(TABLE_1, held, times, rtol=rtol, atol=rtol / 100)
        return deviation(best, coarse, "velocity")

    assert error(1e-4) < 1e-8, "the bound on steps alone gives this, since no event costs an order"
    assert error(1e-11) < 0.05 * error(1e-4), "below that the tolerance decides"
    assert error(1e-12) < 1e-11
