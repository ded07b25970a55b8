"""The problem that every method solves."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest

from slider_resonator.references.resolved.simulate import simulate
from slider_resonator.trading.problem import MIN_PERIODS
from tests.harness.trading.problems import (
    BEAT,
    JUMPS,
    LUGRE,
    RAMP,
    SCAN,
    TABLE_1,
    TURNS_BACK,
    problem,
)

PERIOD = 2.0 * pi / 3500.0


def test_a_scene_without_a_run_is_as_long_as_the_longest_step() -> None:
    found = problem(TABLE_1)
    assert found.periods == MIN_PERIODS == 1000
    assert found.horizons == (31, 62, 125, 250, 500, 1000)
    assert found.constant
    assert found.steady
    assert found.beat is None


def test_the_full_device_is_the_reference_whatever_the_scene_asks_for() -> None:
    found = problem("[device]\nfidelity = 0\nfriction_law = 1\ntolerance = 1e-3\n")
    assert (found.device.fidelity, found.device.friction_law) == (2, 1)
    assert found.parameters == {}, "fidelity, law and tolerance are for the methods to set"


def test_readings_are_windows_of_a_drive_period() -> None:
    found = problem(LUGRE, max_periods=8)
    assert found.horizons == (1, 2, 4, 8)
    times = found.readings(4)
    assert times[-1] == pytest.approx(4 * PERIOD)
    assert found.windows(5) == (1, 2, 4)
    assert not ((times > 2.001 * PERIOD) & (times < 2.999 * PERIOD)).any()


def test_a_beat_is_at_the_difference_of_the_frequencies() -> None:
    found = problem(BEAT)
    assert found.beat == pytest.approx(0.05 * 3500.0 / (2.0 * pi))
    assert found.steady, "21/20 repeats after twenty periods"


def test_inputs_that_vary_allow_no_steady_motion() -> None:
    found = problem(RAMP)
    assert not found.constant
    assert not found.steady
    assert found.periods == 16, "the scene sets the duration of its inputs"
    assert found.lengths == (16,), "a method that stops earlier has not seen all of them"


@pytest.mark.parametrize(
    "device", ["friction_coefficient = 0.0", "normal_preload = 0.0\nnormal_amplitude = 0.0"]
)
def test_nothing_draws_a_slider_without_friction_into_a_steady_motion(device: str) -> None:
    assert not problem(f"[device]\n{device}\n").steady


def test_jumps_are_exact_for_every_method() -> None:
    found = problem(JUMPS)
    assert [(inputs.start, inputs.load) for inputs in found.lines(16)] == [
        (0.0, 0.0),
        (0.0101, 0.05),
    ]


def test_reference_and_peers_follow_ramps() -> None:
    line, constant = problem(RAMP).lines(16)
    assert (line.start, line.stop, line.load) == (0.0, 0.02, 0.0)
    assert line.load_rate == pytest.approx(5.0)
    assert (constant.load, constant.load_rate) == (0.1, 0.0), "from where the ramp ends"


def test_a_drive_that_changes_is_held_over_the_steps_of_the_scene() -> None:
    found = problem(SCAN)
    assert not found.constant
    drives = [inputs.tuned_device(found.device) for inputs in found.lines(16)]
    assert [drives[i].base_amplitude for i in (0, 10, -1)] == pytest.approx([1e-4, 0.0, 1.5e-4])
    ramp = np.arange(5) * PERIOD / 2.0 / 0.02 * 0.2 - 0.1
    rates = [drive.drive_frequency for drive in drives[:5]]
    assert rates == pytest.approx(3500.0 * (1.0 + ramp)), "whatever the step of a method"


def test_a_window_is_a_period_of_the_drive_as_it_is() -> None:
    found = problem(SCAN)
    assert found.periods == 16
    turned = 0.0
    ends = [0.0]
    for inputs in found.lines(16):
        rate = inputs.tuned_device(found.device).drive_frequency / (2.0 * pi)
        for turn in range(len(ends), int(turned + rate * (inputs.stop - inputs.start) + 1e-9) + 1):
            ends.append(inputs.start + (turn - turned) / rate)
        turned += rate * (inputs.stop - inputs.start)
    assert found.ends(16) == pytest.approx(ends, rel=1e-12)
    assert found.window(7)[[0, -1]] == pytest.approx(ends[6:8], rel=1e-12)


def test_lines_that_turn_the_normal_load_back_are_the_limit_of_shorter_steps() -> None:
    found = problem(TURNS_BACK)
    times = np.array([16 * PERIOD])
    (limit,) = simulate(found.device, found.lines(16), times).position
    off = [
        abs(
            simulate(found.device, found.schedule(16, PERIOD / n).held(), times).position[0] - limit
        )
        for n in (16, 256)
    ]
    order = np.log(off[0] / off[1]) / np.log(16.0)
    assert order == pytest.approx(1.0, abs=0.1), f"inputs held over steps are off by {off}"
