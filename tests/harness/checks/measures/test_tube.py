from __future__ import annotations

import numpy as np

from slider_resonator.checks.measures.tube import Tube, no_tube

MIDDLE = np.array([0.0, 1.0, 0.0])
BELOW, ABOVE = np.array([0.0, 0.5, 0.1]), np.array([0.0, 0.0, 0.2])
TUBE = Tube(MIDDLE, MIDDLE - BELOW, MIDDLE + ABOVE)


def test_only_points_outside_count() -> None:
    assert TUBE.outside(MIDDLE).tolist() == [0.0, 0.0, 0.0]
    assert np.allclose(TUBE.outside(np.array([0.1, 0.4, -0.05])), [0.1, 0.1, 0.0])


def test_without_width_it_is_the_difference() -> None:
    signal = np.array([0.3, 0.9, -0.2])
    assert no_tube(MIDDLE).outside(signal).tolist() == np.abs(signal - MIDDLE).tolist()


def test_nan_is_never_inside_a_tube() -> None:
    assert np.isnan(TUBE.outside(np.array([np.nan, 1.0, 0.0]))[0])
    assert TUBE.outside(np.array([0.0, np.inf, 0.0]))[1] == np.inf
