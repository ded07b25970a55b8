"""Every peer follows the same motion, and says what it does not cover."""

from __future__ import annotations

from math import inf
from pathlib import Path

import numpy as np
import pytest

from harness.references import taylor
from harness.references.lugre_taylor import simulate_lugre
from harness.trade.motion import errors, windows
from harness.trade.peers import Peer, motion_of, peer_answers, peer_methods, peers, shoot
from harness.trade.task import Task
from tests.harness.trade.scenes import LUGRE, RAMP, TABLE_1, task

PERIODS = 4
EXACT = {"heyoka", "DOP853 with", "LSODA with", "CVODE with", "LSODA, bristle", "CVODE BDF"}
"""Families whose error is what their tolerance asks for."""


def most_exact(task: Task) -> list[Peer]:
    by_family = {peer.family: peer for peer in peers(task)}
    return [peer for peer in by_family.values() if not peer.family.startswith("DOP853 on sgn")]


@pytest.mark.parametrize("text", [TABLE_1, LUGRE])
def test_the_last_setting_of_each_family_is_near_the_referee(tmp_path: Path, text: str) -> None:
    short = task(tmp_path, text, most_periods=PERIODS)
    simulate = simulate_lugre if short.device.friction_law else taylor.simulate
    run = simulate(short.device, short.truth(PERIODS), short.readings(PERIODS))
    truth = windows(short, motion_of(run, located=True), PERIODS)
    for peer in most_exact(short):
        if peer.family.startswith("Radau"):
            continue
        motion = peer.follow(short.device, short.held(PERIODS), short.readings(PERIODS))
        found = errors(short, motion, truth, PERIODS)
        exact = any(peer.family.startswith(family) for family in EXACT)
        allowed = 1e-6 if exact else 5e-2
        compared = "slow_displacement" if peer.family.startswith("averaged") else "velocity"
        assert found[compared] < allowed, f"{peer.family}: {found}"
        assert ("event_times" in found) == ("event_times" not in peer.missing), peer.family


def test_one_call_of_heyoka_covers_no_inputs_that_vary(tmp_path: Path) -> None:
    ramp = task(tmp_path, RAMP)
    peer = next(peer for peer in peers(ramp) if peer.family == "heyoka at its fastest")
    with pytest.raises(ValueError, match="inputs vary"):
        peer.follow(ramp.device, ramp.held(4), ramp.readings(4))


def test_being_led_into_motion_is_not_charged(tmp_path: Path) -> None:
    short = task(tmp_path, TABLE_1, most_periods=PERIODS)
    by_family = {method.label.family: method for method in peer_methods(short)}
    led = by_family["heyoka at its fastest"].run(PERIODS)
    assert led.start_cpu is not None
    assert led.start_cpu > 0.0
    assert by_family["Moreau-Jean"].run(PERIODS).start_cpu is None, "it starts by itself"


def test_every_setting_has_a_name_of_its_own(tmp_path: Path) -> None:
    for text in (TABLE_1, LUGRE):
        names = [method.label.name for method in peer_methods(task(tmp_path, text))]
        assert len(set(names)) == len(names)


def test_any_integrator_can_be_shot_with(tmp_path: Path) -> None:
    table_1 = task(tmp_path, TABLE_1)
    found = shoot(table_1, "steady_velocity", taylor.simulate, 1e-9, inf)
    assert found.value == pytest.approx(0.12666700, rel=1e-7)
    assert 30 <= found.periods <= 100, "a long run needs thousands"
    with pytest.raises(RuntimeError, match="more than its budget of 0 s"):
        shoot(table_1, "steady_velocity", taylor.simulate, 1e-9, 0.0)
    answers = {answer.label.family for answer in peer_answers(table_1)}
    assert "Moreau-Jean" in answers
    assert not any("at its fastest" in family for family in answers)


def test_peers_hold_inputs_over_the_step_of_the_scene(tmp_path: Path) -> None:
    ramp = task(tmp_path, RAMP)
    lengths = np.diff([inputs.start for inputs in ramp.held(16)])
    assert lengths == pytest.approx(ramp.period / 8)
