from __future__ import annotations

import numpy as np
import pytest

from slider_resonator.checks.measures.ripple import ripple_amplitude

PERIOD = 0.002


def test_the_amplitude_is_found_beside_drift_and_harmonics() -> None:
    times = np.arange(0, 201) * PERIOD / 20
    angle = 2.0 * np.pi * times / PERIOD
    position = 0.13 * times + 6.76e-5 * np.sin(angle - 0.7) + 1e-5 * np.sin(3.0 * angle)
    assert ripple_amplitude(times, position, PERIOD) == pytest.approx(6.76e-5, rel=5e-3)


def test_without_harmonics_it_is_exact() -> None:
    times = np.arange(0, 201) * PERIOD / 20
    position = 0.13 * times + 6.76e-5 * np.sin(2.0 * np.pi * times / PERIOD)
    assert ripple_amplitude(times, position, PERIOD) == pytest.approx(6.76e-5, rel=1e-12)


@pytest.mark.parametrize(("points", "periods"), [(4, 20), (20, 2)])
def test_a_record_that_cannot_show_it_is_refused(points: int, periods: int) -> None:
    times = np.arange(0, points * periods + 1) * PERIOD / points
    with pytest.raises(ValueError, match="ripple needs"):
        ripple_amplitude(times, times, PERIOD)
