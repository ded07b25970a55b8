from __future__ import annotations

import pytest

from slider_resonator.checks.period_means import last_events, reversal_counts
from slider_resonator.checks.reference_side import ReferenceSide
from slider_resonator.references.resolved.contact import LIFTED
from tests.harness.scene_text import scene_of

PERIODS = "[run]\ndrive_periods = {end}\nsteps_per_period = 2\n"
PURE_SINE = "[device]\nnormal_preload = 0.0\nbase_amplitude = 1e-6\n[inputs]\nload = 0.03\n"


def side(text: str, end: float) -> ReferenceSide:
    return ReferenceSide(scene_of(text + PERIODS.format(end=end)))


@pytest.mark.parametrize("early", [-1e-12, 0.0, 1e-12])
def test_at_an_event_both_of_its_sides_are_right(early: float) -> None:
    """The contact of a pure sine load closes at each whole period, where this run ends."""
    references = side(PURE_SINE, 3.0 - early)
    modes = references.beside_events("located_events", "contact_mode")
    assert modes.upper[-1] == LIFTED
    assert modes.lower[-1] != LIFTED, "the contact closes at the end, to rounding"
    last = references.in_run("located_events", last_events)
    assert last.upper[-1] == pytest.approx(3.0, abs=1e-9)
    assert last.lower[-1] == pytest.approx(2.5, abs=1e-9)


def test_away_from_events_there_is_one_right_value() -> None:
    references = side(PURE_SINE, 3.3)
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
    whole = side("", 3.3)
    reversal = float(whole.trajectory("located_events").reversal_times[-1])
    late = 1e-7 * whole.scene.drive_period
    references = side("", (reversal - late) / whole.scene.drive_period)
    counts = references.in_run("located_events", reversal_counts)
    assert references.reversals("located_events") == counts.middle[-1] == counts.lower[-1]
    assert counts.upper[-1] == counts.middle[-1] + 1.0, "the next coincides with the end"
    force = references.beside_events("located_events", "friction_force")
    assert force.lower[-1] < 0.0 < force.upper[-1], "friction changes its sign there"
