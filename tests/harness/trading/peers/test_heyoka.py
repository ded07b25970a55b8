"""heyoka in one call, on motions without sticking."""

import math
from dataclasses import replace

import numpy as np
import pytest

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.trading.peer_methods import peer_answers, peer_methods
from slider_resonator.trading.peers.switching_taylor import simulate_sliding
from tests.harness.trading.problems import RAMP, TABLE_1, problem

MOVING = Device(
    initial_velocity=-0.0491,
    initial_resonator_displacement=-4.978e-4,
    initial_resonator_velocity=1.5837,
)
PERIOD = 2.0 * math.pi / MOVING.drive_frequency


def test_what_it_does_not_cover_is_refused() -> None:
    held, times = HeldInputs(0.0, PERIOD), np.array([PERIOD])
    with pytest.raises(ValueError, match="initial_velocity not 0"):
        simulate_sliding(Device(), held, times, tolerance=1e-10)
    with pytest.raises(ValueError, match="the contact lifts"):
        simulate_sliding(replace(MOVING, normal_amplitude=1.5), held, times, tolerance=1e-10)
    by_family = {method.label.family: method for method in peer_methods(problem(RAMP))}
    with pytest.raises(ValueError, match="inputs vary"):
        by_family["heyoka at its fastest"].run(4)
    answers = {answer.label.family for answer in peer_answers(problem(TABLE_1))}
    assert "Moreau-Jean" in answers
    assert not any("at its fastest" in family for family in answers), "shooting starts at rest too"


def test_being_led_into_motion_is_not_charged() -> None:
    by_family = {m.label.family: m for m in peer_methods(problem(TABLE_1, max_periods=4))}
    _, led = by_family["heyoka at its fastest"].run(4)
    assert led.start_cpu is not None
    assert led.start_cpu > 0.0
    assert by_family["Moreau-Jean"].run(4)[1].start_cpu is None, "it starts by itself"
