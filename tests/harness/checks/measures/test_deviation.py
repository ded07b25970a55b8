from __future__ import annotations

import numpy as np

from slider_resonator.checks.measures.deviation import mismatch_share, peak, share_of


def test_a_sign_flip_deviates_by_twice_the_peak() -> None:
    signal = np.sin(np.linspace(0.0, 100.0, 5000))
    assert abs(share_of(peak(-signal - signal), peak(signal)) - 2.0) < 1e-12


def test_rest_agrees_only_with_rest() -> None:
    assert share_of(0.0, 0.0) == 0.0
    assert share_of(1e-300, 0.0) == np.inf


def test_a_signal_that_is_not_finite_never_passes() -> None:
    signal = np.array([1.0, np.nan])
    for reference in (np.ones(2), np.zeros(2)):
        assert not share_of(peak(signal - reference), peak(reference)) <= 1e9


def test_mismatch_counts_points() -> None:
    error = np.array([0.0, 1.0, 0.0, np.nan])
    assert mismatch_share(error) == 0.5
