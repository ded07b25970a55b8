"""Friction by sgn, by tanh and by a bristle, against motion with located events."""

import math
from functools import partial

import numpy as np
import pytest
from scipy.integrate import DOP853

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved import simulate as resolved
from slider_resonator.trading.peers.event_free import simulate
from tests.harness.references.comparing import deviation, until

TABLE_1 = Device()
PERIOD = 2.0 * math.pi / 3500.0
SIGNALS = ("position", "velocity", "resonator_displacement", "resonator_velocity")
BLOCK = Device(
    fidelity=1, base_amplitude=0.0, normal_amplitude=0.0, drive_frequency=10.0, initial_velocity=0.3
)


def test_chatter_replaces_a_stick_and_has_a_bound() -> None:
    stop = 0.3 * 1.1 / 0.25
    times = np.linspace(stop + 0.01, stop + 0.1, 51)
    sgn = partial(simulate, method=DOP853, rtol=1e-6)
    run = sgn(BLOCK, until(stop + 0.1, load=0.05), times, atol=1e-3)
    assert np.abs(run.velocity).max() < 1e-3, "friction keeps the velocity near zero"
    assert run.reversals > 10, "sgn jumps to and fro where the slider should be held"
    assert not len(run.modes), "without events there is no stick"
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
def test_sgn_agrees_with_events(device: Device, held: list[HeldInputs], share: float) -> None:
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
