from __future__ import annotations

import numpy as np

from slider_resonator.checks.conduct.findings import differences

TIMES = np.array([0.0, 0.5, 1.0])
ROWS = [[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]]


def test_the_last_bit_counts() -> None:
    other = [*ROWS[:2], [float(np.nextafter(5.0, 6.0)), 6.0]]
    found = differences("replayed", ("a", "b"), TIMES, other, ROWS)
    assert found == ["replayed: a at 1 s is 5.000000000000001, was 5.0"]


def test_nan_and_missing_rows_are_differences() -> None:
    nan = [[float("nan"), 2.0], *ROWS[1:]]
    assert len(differences("x", ("a", "b"), TIMES, nan, ROWS)) == 1
    short = differences("x", ("a", "b"), TIMES, ROWS[:2], ROWS)
    assert short == ["x: 2 readings, expected 3"]
    assert len(differences("x", ("a", "b"), TIMES, [], ROWS)) == 3
