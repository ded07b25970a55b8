from __future__ import annotations

import numpy as np
import pytest

from slider_resonator.checks.measures.frequency import dominant_frequency


@pytest.mark.parametrize("frequency", [11.140846, 3.3, 40.0])
def test_a_frequency_between_the_lines_of_the_spectrum_is_found(frequency: float) -> None:
    times = np.linspace(0.0, 3.6, 2001)
    angle = 2.0 * np.pi * frequency * times
    signal = 0.1 + 0.02 * times + np.sin(angle + 0.3) + 0.3 * np.cos(3.0 * angle)
    found = dominant_frequency(times, signal)
    assert found == pytest.approx(frequency, rel=1e-8), "finer than 1 / duration = 0.28 Hz"


def test_the_strongest_oscillation_wins() -> None:
    times = np.linspace(0.0, 4.0, 4001)
    signal = np.sin(2.0 * np.pi * 7.0 * times) + 2.0 * np.sin(2.0 * np.pi * 31.0 * times)
    assert dominant_frequency(times, signal) == pytest.approx(31.0, rel=1e-3)


@pytest.mark.parametrize(
    ("times", "signal"),
    [
        (np.arange(8.0), np.arange(8.0)),
        (np.arange(32.0) ** 2, np.arange(32.0)),
        (np.arange(32.0), np.full(32, 3.0)),
    ],
)
def test_records_without_an_answer_are_refused(times: np.ndarray, signal: np.ndarray) -> None:
    with pytest.raises(ValueError, match=r"equal steps|does not oscillate"):
        dominant_frequency(times, signal)
