"""Every peer follows the same motion."""

import pytest

from slider_resonator.trading.peer_methods import peer_methods
from slider_resonator.trading.solution import errors
from tests.harness.trading.problems import LUGRE, TABLE_1, problem, reference_of

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
    names = [(peer.family, peer.setting) for peer in peer_methods(short)]
    assert len(set(names)) == len(names), "every setting has a name of its own"
    most_exact = {peer.family: peer for peer in peer_methods(short)}
    for peer in most_exact.values():
        if peer.family.startswith("DOP853 on sgn"):
            continue
        _, solution = peer.run(PERIODS)
        found = errors(short, solution, reference, PERIODS)
        exact = any(peer.family.startswith(family) for family in EXACT)
        allowed = 1e-6 if exact else 5e-2
        compared = "slow_displacement" if peer.family.startswith("averaged") else "velocity"
        assert found[compared] < allowed, f"{peer.family}: {found}"
        assert ("event_times" in found) == ("event_times" not in peer.missing), peer.family


def test_a_width_in_fast_velocities_needs_a_steady_vibration() -> None:
    resonant = problem(UNDAMPED_RESONANCE, max_periods=PERIODS)
    by_family = {peer.family: peer for peer in peer_methods(resonant)}
    assert "Moreau-Jean" in by_family, "the others follow resonance as it grows"
    with pytest.raises(ValueError, match="there is no steady state"):
        by_family["tanh, LSODA"].run(PERIODS)
