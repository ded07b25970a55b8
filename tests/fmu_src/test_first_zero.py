"""The native search: the first zero is found, none is passed over, and touches are no zeros."""

from __future__ import annotations

import ctypes
import math
from dataclasses import dataclass

import pytest
from hypothesis import given
from hypothesis import strategies as st

Wave = tuple[float, float, float]
"""Amplitude, frequency (rad/s) and phase (rad) of a sine."""

COSINE = (1.0, 1.0, math.pi / 2)
ROUNDING = 4e-16

LIBRARY: list[ctypes.CDLL] = []
"""The compiled sources; examples of hypothesis cannot take a fixture anew."""


@pytest.fixture(autouse=True, scope="module")
def _search(native_library: ctypes.CDLL) -> None:
    native_library.first_zero_of_waves.restype = ctypes.c_double
    LIBRARY[:] = [native_library]


@dataclass(frozen=True)
class Sum:
    """offset + sum of sines, whose curvature is bounded by ``loose`` times what it must be."""

    offset: float
    waves: tuple[Wave, ...]
    loose: float = 1.0

    def value(self, t: float) -> float:
        return self.offset + sum(a * math.sin(w * t + p) for a, w, p in self.waves)

    def search(
        self, limit: float, expected: float = -1.0, noise: float = ROUNDING, fastest: float = 1.0
    ) -> tuple[float | None, int]:
        """Return the first zero, and the number of evaluations."""
        numbers = [number for wave in self.waves for number in wave]
        work = ctypes.c_int()
        zero = LIBRARY[0].first_zero_of_waves(
            *(ctypes.c_double(number) for number in (self.offset, self.loose)),
            (ctypes.c_double * len(numbers))(*numbers),
            len(self.waves),
            *(ctypes.c_double(number) for number in (noise, fastest, limit, expected)),
            ctypes.byref(work),
        )
        return (None if zero < 0.0 else zero), work.value


@pytest.mark.parametrize("start", [0.5, 0.0])
def test_a_start_at_zero_is_none_and_the_next_is_found_to_rounding(start: float) -> None:
    signal = Sum(0.0, ((1.0, 1.0, start),))
    assert signal.search(10.0)[0] == pytest.approx(math.pi - start, abs=ROUNDING)
    assert signal.search(3.14 - start)[0] is None, "none before the limit"


@pytest.mark.parametrize("loose", [1.0, 1e4, 1e8, 1e12])
@pytest.mark.parametrize("depth", [1.0, 1e-2, 1e-4, 1e-6, 1e-8])
def test_twin_zeros_are_located_however_loose_the_bound(depth: float, loose: float) -> None:
    """1 - depth + cos(t) falls below zero around pi; a loose bound makes all steps short."""
    zero, work = Sum(1.0 - depth, (COSINE,), loose).search(10.0)
    steepness = math.sqrt(2.0 * depth)
    assert zero == pytest.approx(math.acos(depth - 1.0), abs=2.0 * ROUNDING / steepness)
    assert work <= 1000, "a motion of many legs would take minutes"


@pytest.mark.parametrize("before", [1e-3, 1e-5, 1e-7])
def test_a_zero_just_before_the_limit_is_found_however_loose_the_bound(before: float) -> None:
    """A short step that is lengthened does not end beyond the limit."""
    zero, _ = Sum(0.0, ((1.0, 1.0, 0.0),), 1e12).search(math.pi + before)
    assert zero == pytest.approx(math.pi, abs=1e-15)


@pytest.mark.parametrize("height", [0.0, 1e-15, 1e-12, 1e-6])
def test_a_touch_is_no_zero(height: float) -> None:
    assert Sum(1.0 + height, (COSINE,)).search(2.0 * math.pi)[0] is None


@pytest.mark.parametrize("noise", [1e-16, 1e-14, 1e-12, 1e-10])
def test_a_signal_within_rounding_costs_few_evaluations(noise: float) -> None:
    zero, work = Sum(0.0, ((1e-20, 1e10, 0.0),)).search(1.0, noise=noise)
    assert zero is None
    assert work <= 1000, "a motion of many legs would take minutes"


@given(
    waves=st.lists(
        st.tuples(st.floats(0.01, 2.0), st.floats(0.1, 5.0), st.floats(0.0, 2.0 * math.pi)),
        min_size=1,
        max_size=4,
    ),
    offset=st.floats(-1.0, 1.0),
    loose=st.sampled_from([1.0, 1e6]),
)
def test_nothing_is_passed_over(waves: list[Wave], offset: float, loose: float) -> None:
    """Before the zero found, a dense scan sees no negative value."""
    signal = Sum(offset, tuple(waves), loose)
    if signal.value(0.0) <= 0.0:
        return
    limit = 20.0
    zero, _ = signal.search(limit, noise=1e-14, fastest=5.0)
    end = limit if zero is None else zero
    lowest = min(signal.value(end * i / 4000) for i in range(4000))
    assert lowest > -1e-12, f"a zero before {end} was passed over: the signal fell to {lowest}"
    assert zero is None or abs(signal.value(zero)) < 1e-12


@given(
    offset=st.floats(-0.9, 0.9),
    phase=st.floats(0.0, 6.0),
    second=st.tuples(st.floats(-0.5, 0.5), st.floats(0.5, 4.0), st.floats(0.0, 6.0)),
    expected=st.floats(-1.0, 12.0),
)
def test_an_expected_zero_changes_nothing(
    offset: float, phase: float, second: Wave, expected: float
) -> None:
    """Wherever a zero is expected, the first one is found, to what rounding makes of its slope."""
    signal = Sum(offset, ((1.0, 1.0, phase), second))
    if signal.value(0.0) <= 0.0:
        return
    plain, guided = (signal.search(10.0, guess, fastest=4.0)[0] for guess in (-1.0, expected))
    assert (plain is None) == (guided is None)
    if plain is not None and guided is not None:
        steepness = max(signal.value(plain - 1e-4) * 1e4, 1e-7)
        assert guided == pytest.approx(plain, abs=ROUNDING * 20.0 / steepness + 4e-15)


def test_a_zero_where_it_is_expected_costs_few_evaluations() -> None:
    zero, work = Sum(0.0, ((1.0, 1.0, 0.1),)).search(10.0, math.pi - 0.1 + 1e-6)
    assert zero == pytest.approx(math.pi - 0.1, abs=ROUNDING)
    assert work <= 3
