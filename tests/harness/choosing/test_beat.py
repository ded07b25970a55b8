from __future__ import annotations

import pytest

from slider_resonator.choosing.choosing import choose_with
from slider_resonator.choosing.errors import ErrorEstimate, unseen_beat
from slider_resonator.choosing.scales import scales_of
from slider_resonator.fmu.instance import Instance
from tests.harness.scene_text import scene_of


@pytest.mark.parametrize(
    ("found", "shown"), [(1.0, True), (1.15, True), (2.1, True), (0.1, False), (1.5, False)]
)
def test_the_strongest_oscillation_is_the_beat_or_a_multiple_of_it(
    found: float, shown: bool
) -> None:
    scales = scales_of(scene_of("[inputs]\nfrequency_ratio = 1.02\n"))
    reason = unseen_beat(ErrorEstimate(0.0, found * scales.beat), scales)
    assert (reason == "") == shown
    assert shown or f"strongest oscillation has {found * scales.beat:.4g} Hz" in reason


def test_a_slow_motion_that_does_not_beat_has_no_beat(instance: Instance) -> None:
    """Without a vibrating load only the drift of the start is left in the mean velocity."""
    scene = scene_of(
        "[device]\nnormal_amplitude = 0.0\ninitial_velocity = 0.1\n"
        "[inputs]\nfrequency_ratio = 1.01\n"
        "[run]\ndrive_periods = 1000\nsteps_per_period = 1\n[need]\nbeat = { rel = 1e-2 }\n"
    )
    choice = choose_with(instance, scene)
    assert not choice.meets
    assert "in the resolved run" in choice.reason
