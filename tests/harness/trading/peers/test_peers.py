"""Every peer follows the same motion; what each needs and leaves out."""

import math
from functools import partial

import numpy as np
import pytest
from scipy.integrate import DOP853

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved import simulate as resolved
from slider_resonator.trading.peer_methods import peer_methods
from slider_resonator.trading.peers.event_free import simulate
from slider_resonator.trading.problem import Method
from tests.harness.references.comparing import deviation, until
from tests.harness.trading.problems import LUGRE, RAMP, TABLE_1, problem, reference_of
from tests.problems import SIGNALS

PERIOD = math.tau / 3500.0
PERIODS = 4
UNDAMPED_RESONANCE = """
[device]
damping_ratio = 0.0
resonator_mass = 1.0
resonator_frequency = 2474.8737341529163
"""
EXACT = {"heyoka", "Taylor", "DOP853 with", "LSODA, bristle"}
"""Families whose error is what their tolerance asks for."""


@pytest.mark.parametrize("text", [TABLE_1, LUGRE])
def test_the_last_setting_of_each_family_is_near_the_reference(text: str) -> None:
    short = problem(text, max_periods=PERIODS)
    reference = reference_of(short)
    names = [peer.row.method for peer in peer_methods(short)]
    assert len(set(names)) == len(names), "every setting has a name of its own"
    most_exact = {peer.row.family: peer for peer in peer_methods(short)}
    for family, peer in most_exact.items():
        if family.startswith("DOP853 on sgn"):
            continue
        _, solution = peer.run(PERIODS)
        found = short.errors(solution, reference, PERIODS)
        is_exact = any(family.startswith(exact) for exact in EXACT)
        allowed = 1e-6 if is_exact else 5e-2
        compared = "slow_displacement" if family.startswith("averaged") else "velocity"
        assert found[compared] < allowed, f"{family}: {found}"
        assert ("event_times" in found) == ("event_times" not in peer.missing), family


def test_a_width_in_fast_velocities_needs_a_steady_vibration() -> None:
    peers = by_family(UNDAMPED_RESONANCE)
    assert "Moreau-Jean" in peers, "the others follow resonance as it grows"
    with pytest.raises(ValueError, match="there is no steady state"):
        peers["tanh, LSODA"].run(PERIODS)


def by_family(text: str) -> dict[str, Method]:
    return {peer.row.family: peer for peer in peer_methods(problem(text, max_periods=PERIODS))}


IN_ONE_CALL = "heyoka at its fastest"


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        (RAMP, "inputs vary"),
        ("[device]\nnormal_amplitude = 1.5\n", "the contact lifts"),
        ("[device]\nresonator_mass = 0\n", "only full devices"),
        ("[device]\nbase_amplitude = 0\n", "the slider sticks"),
    ],
)
def test_what_it_does_not_cover_is_refused(text: str, reason: str) -> None:
    with pytest.raises(ValueError, match=reason):
        by_family(text)[IN_ONE_CALL].run(PERIODS)


def test_it_is_not_used_for_shooting_which_starts_at_rest_too() -> None:
    answers = {one.row.family for one in peer_methods(problem(TABLE_1)) if one.answers}
    assert "Moreau-Jean" in answers
    assert not any("at its fastest" in family for family in answers)


def test_being_led_into_motion_is_not_charged() -> None:
    peers = by_family(TABLE_1)
    led = peers[IN_ONE_CALL].run(PERIODS)[1].start_cpu
    assert led is not None
    assert led > 0.0
    assert peers["Moreau-Jean"].run(PERIODS)[1].start_cpu is None, "it starts by itself"


BLOCK = Device(
    fidelity=1, base_amplitude=0.0, normal_amplitude=0.0, drive_frequency=10.0, initial_velocity=0.3
)


def test_chatter_replaces_a_stick_and_has_a_bound() -> None:
    stop = 0.3 * 1.1 / 0.25
    times = np.linspace(stop + 0.01, stop + 0.1, 51)
    sgn = partial(simulate, method=DOP853, rtol=1e-6)
    run = sgn(BLOCK, until(stop + 0.1, load=0.05), times, atol=1e-3)
    assert np.abs(run.velocity).max() < 1e-3, "friction keeps the velocity near zero"
    assert run.reversal_times.size > 10, "sgn jumps to and fro where the slider should be held"
    assert not len(run.modes), "without events there is no stick"
    assert abs(run.friction_force) == pytest.approx(0.2), "never the force that would hold it"
    with pytest.raises(RuntimeError, match=r"t = 1\.3.* = 20000: it chatters"):
        sgn(BLOCK, until(9.0, load=0.05), np.empty(0), atol=1e-10, max_evaluations=20_000)


RAMPS = [
    HeldInputs(0.0, 3 * PERIOD, 0.3, 0.05, 1.0, phase_rate=20.0, load_rate=3.0, ratio_rate=20.0),
    HeldInputs(3 * PERIOD, 6 * PERIOD, 0.4, load=0.06, load_rate=-3.0, ratio_rate=-30.0),
]


def test_sgn_agrees_with_events() -> None:
    """Other devices are compared on bristles, with the same equations."""
    device, held = Device(), RAMPS
    times = np.linspace(0.0, held[-1].stop, 201)
    exact = resolved.simulate(device, held, times)
    coarse, fine = (
        simulate(device, held, times, method=DOP853, rtol=atol, atol=atol) for atol in (1e-4, 1e-8)
    )
    errors = [max(deviation(exact, run, name) for name in SIGNALS[:4]) for run in (coarse, fine)]
    assert errors[1] < min(1e-4, 0.02 * errors[0]), errors
    assert deviation(exact, fine, "velocity") < 1e-5
    assert fine.evaluations > 2 * coarse.evaluations
    assert fine.normal_force == pytest.approx(exact.normal_force, abs=1e-12), "psi is continuous"
    assert (fine.contact_mode == exact.contact_mode).mean() > 0.95
