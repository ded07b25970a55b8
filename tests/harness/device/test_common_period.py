from __future__ import annotations

import pytest

from slider_resonator.device.common_period import common_period


@pytest.mark.parametrize(
    ("ratio", "count"),
    [
        (1.0, 1),
        (3.0, 1),
        (0.0, 1),
        (-1.0, 1),
        (1.5, 2),
        (1.0 / 3.0, 3),
        (-2.4, 5),
        (19.0 / 20.0, 20),
    ],
)
def test_rational_ratio_repeats_after_its_denominator(ratio: float, count: int) -> None:
    assert common_period(ratio) == count


@pytest.mark.parametrize("ratio", [1.001, 1.37, 2.0**0.5, 1.0 + 1e-9])
def test_ratio_without_small_denominator_has_no_common_period(ratio: float) -> None:
    assert common_period(ratio) is None


def test_max_denominator_is_an_argument() -> None:
    assert common_period(1.37, 100) == 100
