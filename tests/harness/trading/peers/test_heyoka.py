"""heyoka in one call, on motions without sticking."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.simulate import simulate
from slider_resonator.trading.peer_methods import peer_answers, peer_methods
from slider_resonator.trading.peers.switching_taylor import device_at, simulate_sliding
from tests.harness.trading.problems import RAMP, TABLE_1, problem

MOVING = Device(
    initial_velocity=-0.0491,
    initial_resonator_displacement=-4.978e-4,
    initial_resonator_velocity=1.5837,
)
PERIOD = 2.0 * math.pi / MOVING.drive_frequency


@pytest.mark.parametrize(("law", "accuracy"), [(0, 1e-11), (1, 1e-10)])
def test_it_agrees_with_the_reference_from_within_its_inputs_on(law: int, accuracy: float) -> None:
    device = replace(MOVING, friction_law=law, bristle_stiffness=1e4)
    held = HeldInputs(0.0, (20 - 15 * law) * PERIOD, phase=0.2, load=0.01, frequency_ratio=1.5)
    times = np.linspace(0.0, held.stop, 21)
    reference = simulate(device, [held], times)
    assert reference.sticks == 0, "the peer covers no sticking"
    whole = simulate_sliding(device, held, times, tolerance=1e-14)
    assert whole.reversals == reference.reversals
    later = device_at(device, reference, 8)
    rest = simulate_sliding(later, held, times[8:], tolerance=1e-14, start=float(times[8]))
    for column, name in enumerate(("position", "velocity", "resonator_displacement")):
        expected = getattr(reference, name)
        assert whole.samples[-1, column] == pytest.approx(expected[-1], rel=accuracy), name
        assert rest.samples[:, column] == pytest.approx(expected[8:], rel=1e-9), name


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
