from __future__ import annotations

import pytest

from slider_resonator.output.readable import readable


@pytest.mark.parametrize("value", [0.0, -0.0, -1.7e-14, 9e-13])
def test_noise_and_minus_zero_are_0(value: float) -> None:
    assert readable(value, 10) == "0"


def test_other_numbers_keep_their_digits_and_sign() -> None:
    assert readable(0.12666699702, 10) == "0.126666997"
    assert readable(-2e-12, 9) == "-2e-12"
    assert readable(199, 8) == "199"
