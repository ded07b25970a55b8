"""A trace of a motion against the moments at which motions of the same length end."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from fmu_src.python.slider_component.held_orbit import held_orbit_at
from fmu_src.python.slider_component.motion import State
from fmu_src.python.slider_component.trace import Trace
from tests.fmu_src.orbit_devices import BRISTLES, FLIGHT, STICKING, STRONG, TABLE_1, Case

LOOKS = 32


@pytest.mark.parametrize(
    ("case", "tolerance"),
    [
        pytest.param(Case(TABLE_1, 0.0, 1.0, 1, 0.2), 1e-12, id="sliding"),
        pytest.param(Case(TABLE_1, 0.0, 1.0, 1, 4.0), 1e-12, id="no reversal"),
        pytest.param(Case(STRONG, 0.0, 1.0, 1, 0.5), 1e-12, id="strong"),
        pytest.param(Case(STICKING, 0.0, 1.0, 1, 0.1), 1e-12, id="sticking"),
        pytest.param(Case(FLIGHT, 0.4, 1.5, 2, 0.4), 1e-12, id="flight"),
        pytest.param(Case(BRISTLES, 0.0, 1.0, 1, 0.2), 1e-9, id="bristles"),
        pytest.param(
            Case(replace(BRISTLES, bristle_stiffness=1e3), 0.3, 1.0, 1, -0.6), 1e-9, id="soft"
        ),
    ],
)
def test_looks_are_the_ends_of_shorter_motions(case: Case, tolerance: float) -> None:
    """The last look is at the end of the motion, or behind it by rounding."""
    scales = case.map
    orbit = held_orbit_at(scales, case.lead, case.share * scales.speed)
    begin, load, every = orbit.section, -orbit.friction, scales.period / LOOKS
    seen: list[tuple[State, float]] = []

    def see(index: int, state: State, position: float) -> None:
        assert index == len(seen)
        seen.append((state, position))

    trace = Trace(every * (1.0 + 1e-15), every, LOOKS, see)
    scales.advance(case.lead, load, begin, scales.period, trace)
    assert len(seen) == LOOKS
    for index, (state, position) in enumerate(seen):
        end = scales.advance(case.lead, load, begin, (index + 1) * every)
        assert end is not None
        w = case.device.drive_frequency
        units = scales.speed, scales.swing, scales.swing * w, scales.speed / w
        expected = np.array([*end.state, end.position]) / units
        assert np.array([*state, position]) / units == pytest.approx(expected, abs=tolerance)
