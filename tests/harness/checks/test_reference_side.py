"""What is expected in a run: at events, over periods, of averages."""

import math
from dataclasses import replace

import numpy as np
import pytest

from slider_resonator.checks.fmu_side import FmuSide
from slider_resonator.checks.measuring import WITHIN, error_over_estimate
from slider_resonator.checks.natural_scale import fast_velocity
from slider_resonator.checks.period_means import (
    last_events,
    mean_velocities,
    reversal_counts,
    stick_fractions,
)
from slider_resonator.checks.reference_side import ReferenceSide
from slider_resonator.device.device import Device
from slider_resonator.device.drive_periods import DrivePeriods
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.errors import NotApplicable
from slider_resonator.fmu.instance import Instance
from slider_resonator.references.resolved.contact import LIFTED
from slider_resonator.references.resolved.simulate import simulate
from slider_resonator.references.resolved.trajectory import Trajectory
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


PERIODS = "[run]\ndrive_periods = {end}\nsteps_per_period = 2\n"
PURE_SINE = "[device]\nnormal_preload = 0.0\nbase_amplitude = 1e-6\n[inputs]\nload = 0.03\n"


def side_until(text: str, end: float) -> ReferenceSide:
    return ReferenceSide(scene_of(text + PERIODS.format(end=end)))


@pytest.mark.parametrize("early", [-1e-12, 0.0, 1e-12])
def test_at_an_event_both_of_its_sides_are_right(early: float) -> None:
    """The contact of a pure sine load closes at each whole period, where this run ends."""
    references = side_until(PURE_SINE, 3.0 - early)
    modes = references.beside_events("located_events", "contact_mode")
    assert modes.upper[-1] == LIFTED
    assert modes.lower[-1] != LIFTED, "the contact closes at the end, to rounding"
    last = references.in_run("located_events", last_events)
    assert last.upper[-1] == pytest.approx(3.0, abs=1e-9)
    assert last.lower[-1] == pytest.approx(2.5, abs=1e-9)


def test_away_from_events_there_is_one_right_value() -> None:
    references = side_until(PURE_SINE, 3.3)
    for name in ("contact_mode", "friction_force"):
        tube = references.beside_events("located_events", name)
        assert tube.upper[-1] == tube.lower[-1] == tube.middle[-1]


def test_an_event_that_a_change_of_inputs_causes_has_one_right_side() -> None:
    """A load above full friction sets a slider at rest in motion when it arrives."""
    rest = "[device]\nbase_amplitude = 0.0\nnormal_amplitude = 0.0\n"
    push = "[inputs]\nload = { steps = [[0.0, 0.0], [0.002, 1.0]] }\n"
    run = "[run]\nstop_time = 0.004\nstep_size = 0.001\n"
    references = ReferenceSide(scene_of(rest + push + run))
    modes = references.beside_events("located_events", "contact_mode")
    assert (modes.lower == modes.upper).all()
    assert sorted(set(modes.middle.tolist())) == [-1.0, 0.0]


def test_an_event_beyond_the_end_is_not_counted() -> None:
    whole = side_until("", 3.3)
    reversal = float(whole.trajectory("located_events").reversal_times[-1])
    late = 1e-7 * whole.scene.drive_period
    references = side_until("", (reversal - late) / whole.scene.drive_period)
    counts = references.in_run("located_events", reversal_counts)
    at_end = references.at_end("located_events", reversal_counts)
    assert at_end == counts.middle[-1] == counts.lower[-1]
    assert counts.upper[-1] == counts.middle[-1] + 1.0, "the next coincides with the end"
    force = references.beside_events("located_events", "friction_force")
    assert force.lower[-1] < 0.0 < force.upper[-1], "friction changes its sign there"


PERIOD = 2.0 * np.pi / 3500.0
DRIVE_PERIODS = DrivePeriods(PERIOD)
TIMES = np.linspace(0.0, 4.1 * PERIOD, 30)
STICKY = Device(base_amplitude=5e-8)


def run_of(device: Device, times: np.ndarray = TIMES) -> Trajectory:
    held = [HeldInputs(0.0, float(TIMES[-1]))]
    every = np.union1d(times, DRIVE_PERIODS.ends(times))
    return simulate(device, held, every)


def test_means_are_travel_over_time() -> None:
    device = replace(STICKY, initial_velocity=3e-4)
    run = run_of(device)
    means = mean_velocities(run, TIMES, DRIVE_PERIODS)
    assert means[0] == 3e-4, "at the start it is the velocity"
    position = run.position[np.searchsorted(run.time, TIMES)]
    first = TIMES[1:] < PERIOD
    assert means[1:][first] == pytest.approx(position[1:][first] / TIMES[1:][first])
    at = {end: float(run.position[np.searchsorted(run.time, end * PERIOD)]) for end in (3, 4)}
    assert means[-1] == pytest.approx((at[4] - at[3]) / PERIOD, rel=1e-9)


def test_stick_fractions_are_those_of_finely_sampled_modes() -> None:
    fine = np.linspace(0.0, TIMES[-1], 100_001)
    sticks = run_of(STICKY, fine)
    stuck = (sticks.contact_mode[np.searchsorted(sticks.time, fine)] == 0).astype(float)
    shares = stick_fractions(run_of(STICKY), TIMES, DRIVE_PERIODS)
    assert shares[0] == 1.0
    for time, share in zip(TIMES[1:], shares[1:], strict=True):
        begin, end = DRIVE_PERIODS.ends(np.array([time]))[0]
        within = (fine >= begin) & (fine < end)
        assert share == pytest.approx(stuck[within].mean(), abs=2e-4)
    assert 0.0 < shares[-1] < 1.0


def test_counts_and_last_events_open_where_a_point_coincides_with_an_event() -> None:
    run = run_of(Device())
    event = float(run.reversal_times[2])
    times = np.array([0.0, event - 0.01 * PERIOD, event, event + 0.01 * PERIOD])
    counts = reversal_counts(run, times, DRIVE_PERIODS)
    assert counts.lower.tolist() == [0.0, 2.0, 2.0, 3.0]
    assert counts.upper.tolist() == [0.0, 2.0, 3.0, 3.0]
    events = last_events(run, times, DRIVE_PERIODS)
    assert events.middle[-1] * PERIOD == pytest.approx(event)
    assert events.lower[2] < events.upper[2]


def test_periods_of_a_drive_that_changes_end_where_they_are_whole() -> None:
    periods = DrivePeriods(1.0, (0.0, 1.5, 3.5), (0.0, 1.5, 2.5))
    begin, end = periods.ends(np.array([0.9, 1.2, 2.4, 3.5])).T
    assert begin == pytest.approx([0.0, 0.0, 0.0, 1.0])
    assert end == pytest.approx([0.9, 1.0, 1.0, 2.5])
    assert periods.lengths(np.array([3.5])) == pytest.approx([1.5])


AVERAGED = """
[device]
fidelity = 0
averaging_order = 1

[run]
drive_periods = 10
steps_per_period = 2

[[expect]]
quantity = "error_over_estimate"
at_most = 1.0
why = "test"
"""


def test_the_error_is_taken_over_the_estimate_at_the_same_point(instance: Instance) -> None:
    side = FmuSide(instance, scene_of(AVERAGED))
    side.record["mean_velocity"][:] = side.resolved["mean_velocity"]
    assert error_over_estimate(side) == 0.0
    side.record["slow_motion_error"][:] = 1e-3
    side.record["mean_velocity"][2:4] += (1e-3, 1e-4)
    side.record["slow_motion_error"][3] = 5e-5
    assert error_over_estimate(side) == pytest.approx(2.0, rel=1e-6)
    side.record["slow_motion_error"][3] = 0.0
    assert error_over_estimate(side) == math.inf


def test_errors_far_below_the_tolerance_count_as_none(instance: Instance) -> None:
    side = FmuSide(instance, scene_of(AVERAGED))
    device = side.scene.device
    least = WITHIN * device.tolerance * fast_velocity(device)
    side.record["slow_motion_error"][:] = 0.0
    for share, expected in ((0.9, 0.0), (1.1, math.inf)):
        side.record["mean_velocity"][:] = side.resolved["mean_velocity"] + share * least
        assert error_over_estimate(side) == expected


def test_an_fmu_without_estimate_has_no_share(
    instance: Instance, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delitem(instance.fmu.variables, "slow_motion_error")
    with pytest.raises(NotApplicable):
        error_over_estimate(FmuSide(instance, scene_of(AVERAGED)))


def test_a_device_that_never_moves_sticks_all_the_time() -> None:
    weak = "[device]\nbase_amplitude = 5e-9\nnormal_amplitude = 0.5\n"
    reference = side(weak + RUN)
    assert reference.at_end("located_events", stick_fractions) == pytest.approx(1.0, abs=1e-12)
    assert reference.last_event_time("located_events") == 0.0
