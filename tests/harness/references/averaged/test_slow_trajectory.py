from __future__ import annotations

import numpy as np
import pytest

from slider_resonator.references.averaged.slow_trajectory import slow_trajectory


def test_decay_toward_a_terminal_velocity() -> None:
    times = np.linspace(0.0, 3.0, 7)
    position, velocity = slow_trajectory(lambda time, v: 1.0 - v, times, velocity=0.5)
    assert velocity == pytest.approx(1.0 - 0.5 * np.exp(-times), abs=1e-6)
    assert position == pytest.approx(times - 0.5 * (1.0 - np.exp(-times)), abs=1e-6)
