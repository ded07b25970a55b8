from __future__ import annotations

import math

import numpy as np
import pytest

from slider_resonator.references.averaged import vibrating_contact as contact


@pytest.mark.parametrize("ratio", [-3.0, -1.0, 0.0, 1.0, 2.0, 5.0])
@pytest.mark.parametrize("amplitude_ratio", [0.6, 1.0, 1.3, 40.0])
@pytest.mark.parametrize("phase", [-2.0, 0.4])
def test_closed_spans_have_a_positive_load(
    amplitude_ratio: float, phase: float, ratio: float
) -> None:
    start, end = -0.7, 6.1
    spans = contact.closed_spans(start, end, amplitude_ratio, phase, ratio)
    angles = np.linspace(start, end, 20_001)
    load = 1.0 + amplitude_ratio * np.sin(ratio * angles + phase)
    inside = np.zeros(angles.shape, dtype=bool)
    for first, last in spans:
        assert start - 1e-12 <= first < last <= end + 1e-12, "spans lie within the arc"
        inside |= (angles >= first - 1e-12) & (angles <= last + 1e-12)
    clear = abs(load) > 1e-3
    assert (inside[clear] == (load[clear] > 0.0)).all(), "closed where it pushes, else open"
    assert spans == sorted(spans), "spans ascend"


@pytest.mark.parametrize("amplitude_ratio", [0.0, 1.0, 1.0 + 1e-9, 1.5, 30.0])
def test_mean_load_is_the_mean_over_a_turn(amplitude_ratio: float) -> None:
    angles = (np.arange(400_000) + 0.5) / 400_000 * 2.0 * math.pi
    mean = np.maximum(0.0, 1.0 + amplitude_ratio * np.sin(angles)).mean()
    assert contact.mean_load(amplitude_ratio) == pytest.approx(mean, rel=1e-8)


@pytest.mark.parametrize("value", [-0.1, math.inf, math.nan])
def test_invalid_amplitudes_are_refused(value: float) -> None:
    with pytest.raises(ValueError, match=f"amplitude_ratio = {value!r}"):
        contact.check_amplitude_ratio(value)
    with pytest.raises(ValueError, match="amplitude_ratio"):
        contact.closed_spans(0.0, 1.0, value, 0.0, 1.0)


@pytest.mark.parametrize(
    ("amplitude_ratio", "ratio", "turns"),
    [(1.0, 2.0, 1), (1.0, 1.5, 0), (1.1, 1.5, 2), (3.0, -2 / 3, 3), (3.0, 0.25, 4), (3.0, 0.2, 0)],
)
def test_turns_until_a_load_repeats(amplitude_ratio: float, ratio: float, turns: int) -> None:
    assert contact.turns_until_repeat(amplitude_ratio, ratio) == turns
