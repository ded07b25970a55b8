"""What is expected in a run: at events, over periods, of averages."""

import math

import numpy as np
import pytest

from slider_resonator.checks.fmu_side import FmuSide
from slider_resonator.checks.measuring import WITHIN, error_over_estimate
from slider_resonator.checks.natural_scale import fast_velocity
from slider_resonator.checks.period_means import last_events, reversal_counts
from slider_resonator.checks.reference_side import ReferenceSide
from slider_resonator.device.device import Device
from slider_resonator.device.drive_periods import DrivePeriods
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.errors import NotApplicable
from slider_resonator.fmu.instance import Instance
from slider_resonator.references.resolved.contact import LIFTED
from slider_resonator.references.resolved.simulate import simulate
from tests.harness.scene_text import scene_of

RUN = "[run]\ndrive_periods = 12.3\nsteps_per_period = 8\n"


def test_a_tube_contains_signals_shifted_by_less_than_its_width() -> None:
    reference = ReferenceSide(scene_of(RUN))
    tube = reference.tube("velocity", 0.02)
    velocity = reference.signal("velocity")
    assert np.abs(tube.middle - velocity).max() < 1e-12 * np.abs(velocity).max()
    held = reference.scene.schedule().held()
    for late, inside in ((0.015, True), (-0.015, True), (0.03, False)):
        shift = late * reference.scene.drive_period
        times = np.clip(reference.times - shift, 0.0, reference.times[-1])
        shifted = simulate(reference.device, held, np.unique(times)).velocity
        shifted = shifted[np.searchsorted(np.unique(times), times)]
        assert (np.max(tube.outside(shifted)) < 1e-3 * np.abs(velocity).max()) == inside


STEPS = (
    "[inputs]\nload = { steps = [[0.0, 0.0], [0.001, 0.02]] }\n"
    "frequency_ratio = { steps = [[0.0, 1.0], [0.002, 1.5], [0.003, 1.0]] }\n"
)


def test_predictions_follow_the_inputs_before_each_point() -> None:
    reference = ReferenceSide(scene_of(STEPS + "[run]\nstop_time = 0.004\nstep_size = 0.001\n"))
    found = reference.predictions("predicted_velocity")
    at_start = ReferenceSide(scene_of(RUN)).steady.predicted_velocity
    assert found[:2] == pytest.approx([at_start] * 2), "a point on a change is still before it"
    assert found[2] != pytest.approx(at_start)
    assert found[-1] == reference.steady_at_end.predicted_velocity


def test_at_the_end_of_a_run_the_inputs_are_the_last_and_the_phase_has_its_lead() -> None:
    end = ReferenceSide(scene_of(STEPS + RUN)).steady_at_end
    lead = 0.5 * 3500.0 * 0.001  # rad: half the drive frequency for a millisecond
    assert (end.phase, end.load, end.frequency_ratio) == pytest.approx((lead, 0.02, 1.0))


def test_a_device_that_never_moves_has_no_event_after_its_start() -> None:
    weak = "[device]\nbase_amplitude = 5e-9\nnormal_amplitude = 0.5\n"
    assert ReferenceSide(scene_of(weak + RUN)).last_event_time == 0.0


PERIODS = "[run]\ndrive_periods = {end}\nsteps_per_period = 2\n"
PURE_SINE = "[device]\nnormal_preload = 0.0\nbase_amplitude = 1e-6\n[inputs]\nload = 0.03\n"


def side_until(text: str, end: float) -> ReferenceSide:
    return ReferenceSide(scene_of(text + PERIODS.format(end=end)))


@pytest.mark.parametrize("early", [-1e-12, 0.0, 1e-12])
def test_at_an_event_both_of_its_sides_are_right(early: float) -> None:
    """The contact of a pure sine load closes at each whole period, where this run ends."""
    references = side_until(PURE_SINE, 3.0 - early)
    modes = references.beside_events("contact_mode")
    assert modes.upper[-1] == LIFTED
    assert modes.lower[-1] != LIFTED, "the contact closes at the end, to rounding"
    last = references.in_run(last_events)
    assert last.upper[-1] == pytest.approx(3.0, abs=1e-9)
    assert last.lower[-1] == pytest.approx(2.5, abs=1e-9)
    references = side_until(PURE_SINE, 3.3)
    for name in ("contact_mode", "friction_force"):
        tube = references.beside_events(name)
        assert tube.upper[-1] == tube.lower[-1] == tube.middle[-1], "away from events"


def test_an_event_that_a_change_of_inputs_causes_has_one_right_side() -> None:
    """A load above full friction sets a slider at rest in motion when it arrives."""
    rest = "[device]\nbase_amplitude = 0.0\nnormal_amplitude = 0.0\n"
    push = "[inputs]\nload = { steps = [[0.0, 0.0], [0.002, 1.0]] }\n"
    run = "[run]\nstop_time = 0.004\nstep_size = 0.001\n"
    references = ReferenceSide(scene_of(rest + push + run))
    modes = references.beside_events("contact_mode")
    assert (modes.lower == modes.upper).all()
    assert sorted(set(modes.middle.tolist())) == [-1.0, 0.0]


def test_an_event_beyond_the_end_is_not_counted() -> None:
    whole = side_until("", 3.3)
    reversal = float(whole.trajectory.reversal_times[-1])
    late = 1e-7 * whole.scene.drive_period
    references = side_until("", (reversal - late) / whole.scene.drive_period)
    counts = references.in_run(reversal_counts)
    at_end = references.at_end(reversal_counts)
    assert at_end == counts.middle[-1] == counts.lower[-1]
    assert counts.upper[-1] == counts.middle[-1] + 1.0, "the next coincides with the end"
    force = references.beside_events("friction_force")
    assert force.lower[-1] < 0.0 < force.upper[-1], "friction changes its sign there"


def test_counts_and_last_events_open_where_a_point_coincides_with_an_event() -> None:
    period = 2.0 * np.pi / 3500.0
    held = [HeldInputs(0.0, 4.0 * period)]
    event = float(simulate(Device(), held, np.array([held[0].stop])).reversal_times[2])
    times = np.array([0.0, event - 0.01 * period, event, event + 0.01 * period])
    periods = DrivePeriods(period)
    run = simulate(Device(), held, np.union1d(times, periods.ends(times)))
    counts = reversal_counts(run, times, periods)
    assert counts.lower.tolist() == [0.0, 2.0, 2.0, 3.0]
    assert counts.upper.tolist() == [0.0, 2.0, 3.0, 3.0]
    events = last_events(run, times, periods)
    assert events.middle[-1] * period == pytest.approx(event)
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
    device = side.scene.device
    negligible = WITHIN * device.tolerance * fast_velocity(device)
    side.record["slow_motion_error"][:] = 0.0
    for share, expected in ((0.9, 0.0), (1.1, math.inf)):
        side.record["mean_velocity"][:] = side.resolved["mean_velocity"] + share * negligible
        assert error_over_estimate(side) == expected


def test_fmu_without_error_estimate(instance: Instance, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delitem(instance.fmu.variables, "slow_motion_error")
    with pytest.raises(NotApplicable):
        error_over_estimate(FmuSide(instance, scene_of(AVERAGED)))
