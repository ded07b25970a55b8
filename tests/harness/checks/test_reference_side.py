from __future__ import annotations

import numpy as np
import pytest

from slider_resonator.checks.period_means import mean_velocities, stick_fractions
from slider_resonator.checks.reference_side import ReferenceSide
from slider_resonator.references.resolved.simulate import simulate
from tests.harness.scene_text import scene_of

RUN = "[run]\ndrive_periods = 12.3\nsteps_per_period = 8\n"


def side(text: str) -> ReferenceSide:
    return ReferenceSide(scene_of(text))


def test_the_mean_velocity_is_that_of_the_last_whole_period() -> None:
    reference = side(RUN.replace("12.3", "12").replace("8", "1"))
    position = reference.signal("located_events", "position")
    expected = (position[-1] - position[-2]) / reference.scene.drive_period
    assert reference.at_end("located_events", mean_velocities) == pytest.approx(expected, rel=1e-12)
    assert side(RUN).at_end("located_events", mean_velocities) == pytest.approx(
        expected, rel=1e-9
    ), "the third of a period after it does not count"


def test_a_device_that_never_moves_sticks_all_the_time() -> None:
    weak = "[device]\nbase_amplitude = 5e-9\nnormal_amplitude = 0.5\n"
    reference = side(weak + RUN)
    assert reference.at_end("located_events", stick_fractions) == pytest.approx(1.0, abs=1e-12)
    assert reference.last_event_time("located_events") == 0.0


def test_a_tube_contains_signals_shifted_by_less_than_its_width() -> None:
    reference = side(RUN)
    tube = reference.tube("located_events", "velocity", 0.02)
    velocity = reference.signal("located_events", "velocity")
    assert np.abs(tube.middle - velocity).max() < 1e-12 * np.abs(velocity).max()
    held = reference.scene.schedule().held()
    for late, inside in ((0.015, True), (-0.015, True), (0.03, False)):
        shift = late * reference.scene.drive_period
        times = np.clip(reference.times - shift, 0.0, reference.times[-1])
        shifted = simulate(reference.device, held, np.unique(times)).velocity
        shifted = shifted[np.searchsorted(np.unique(times), times)]
        assert (np.max(tube.outside(shifted)) < 1e-3 * np.abs(velocity).max()) == inside


def test_predictions_follow_the_inputs_before_each_point() -> None:
    inputs = (
        "[inputs]\nload = { steps = [[0.0, 0.0], [0.001, 0.02]] }\n"
        "frequency_ratio = { steps = [[0.0, 1.0], [0.002, 1.5], [0.003, 1.0]] }\n"
    )
    reference = side(inputs + "[run]\nstop_time = 0.004\nstep_size = 0.001\n")
    found = reference.predictions("predicted_velocity")
    at_start = side(RUN).steady.predicted_velocity
    assert found[:2] == pytest.approx([at_start] * 2), "a point on a change is still before it"
    assert found[2] == side("[inputs]\nload = 0.02\n" + RUN).steady.predicted_velocity
    assert found[-1] == reference.steady_at_end.predicted_velocity


def test_at_the_end_of_a_run_the_inputs_are_the_last_and_the_phase_has_its_lead() -> None:
    inputs = (
        "[inputs]\nload = { steps = [[0.0, 0.0], [0.001, 0.02]] }\n"
        "frequency_ratio = { steps = [[0.0, 1.0], [0.002, 1.5], [0.003, 1.0]] }\n"
    )
    end = side(inputs + RUN).steady_at_end
    lead = 0.5 * 3500.0 * 0.001  # rad: half the drive frequency for a millisecond
    assert (end.phase, end.load, end.frequency_ratio) == pytest.approx((lead, 0.02, 1.0))
    there = side(f"[inputs]\nphase = {lead}\nload = 0.02\n" + RUN)
    assert end.predicted_velocity == pytest.approx(there.steady.predicted_velocity, rel=1e-9)
    assert end.predicted_blocking_force == pytest.approx(
        there.steady.predicted_blocking_force, rel=1e-9
    )
