from __future__ import annotations

import numpy as np

from harness.measures.deviation import mismatch_share, peak_deviation


def test_a_sign_flip_deviates_by_twice_the_peak() -> None:
    signal = np.sin(np.linspace(0.0, 100.0, 5000))
    assert abs(peak_deviation(-signal, signal) - 2.0) < 1e-12


def test_rest_agrees_only_with_rest() -> None:
    rest = np.zeros(5)
    assert peak_deviation(rest, rest) == 0.0
    assert peak_deviation(rest + 1e-300, rest) == np.inf


def test_a_signal_that_is_not_finite_never_passes() -> None:
    signal = np.array([1.0, np.nan])
    assert not peak_deviation(signal, np.ones(2)) <= 1e9


def test_mismatch_counts_points() -> None:
    assert mismatch_share(np.array([1.0, 0.0, -1.0, 2.0]), np.array([1.0, 1.0, -1.0, 2.0])) == 0.25
