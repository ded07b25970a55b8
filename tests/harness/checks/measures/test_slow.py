from __future__ import annotations

import numpy as np
import pytest

from slider_resonator.checks.measures.slow import slow_displacement

PERIOD = 0.002


@pytest.mark.parametrize("amplitude", [0.0, 1.0, 100.0])
def test_ripple_leaves_no_trace_and_a_drift_is_seen_half_a_period_late(amplitude: float) -> None:
    times = np.arange(0, 321) * PERIOD / 16
    ripple = amplitude * np.sin(2.0 * np.pi * times / PERIOD + 0.3)
    slow = slow_displacement(times, 5.0 * times + ripple, PERIOD)
    assert len(slow) == 321 - 16
    expected = 5.0 * (times[16:] - PERIOD / 2.0)
    assert np.abs(slow - expected).max() < 1e-12 * (1.0 + amplitude)


def test_a_record_shorter_than_a_period_is_refused() -> None:
    with pytest.raises(ValueError, match="shorter than the period"):
        slow_displacement(np.array([0.0, 0.001]), np.zeros(2), PERIOD)
