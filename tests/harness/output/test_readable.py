from __future__ import annotations

from slider_resonator.output.readable import number_of, readable


def test_noise_and_minus_zero_are_0() -> None:
    assert readable(-1e-15, 3) == "0"
    assert readable(-0.0, 3) == "0"
    assert readable(0.126667, 3) == "0.127"


def test_a_count_agrees_with_its_noun() -> None:
    assert [number_of(count, "check") for count in (0, 1, 2)] == ["0 checks", "1 check", "2 checks"]
