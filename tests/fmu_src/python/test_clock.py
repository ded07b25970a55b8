"""Many advances of a step sum up without loss."""

from __future__ import annotations

from fractions import Fraction

from hypothesis import given
from hypothesis import strategies as st

from fmu_src.python.slider_component.clock import Clock


@given(st.lists(st.floats(1e-9, 1e-3), min_size=1, max_size=300), st.floats(1.0, 1e6))
def test_what_is_left_is_exact(parts: list[float], duration: float) -> None:
    clock, left = Clock(duration), duration
    for part in parts:
        left = clock.advance(part)
    exact = Fraction(duration) - sum(map(Fraction, parts))
    assert abs(Fraction(left) - exact) <= abs(exact) * Fraction(2) ** -52
