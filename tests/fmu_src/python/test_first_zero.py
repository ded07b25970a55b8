"""The first zero is found, none is passed over, and touches are no zeros."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fmu_src.python.slider_component.first_zero import Signal, Watch, first_zero


def sine_sum(offset: float, waves: list[tuple[float, float, float]]) -> Signal:
    """offset + sum of a sin(w t + p), with the curvature bound sum |a| w^2."""
    bound = sum(abs(a) * w * w for a, w, _ in waves)

    def signal(t: float) -> tuple[float, float, float]:
        value = offset + sum(a * math.sin(w * t + p) for a, w, p in waves)
        slope = sum(a * w * math.cos(w * t + p) for a, w, p in waves)
        return value, slope, bound

    return signal


def watch(
    signal: Signal, noise: float = 1e-16, fastest: float = 1.0, expected: float = 0.0
) -> Watch:
    return Watch(signal, noise, fastest, expected)


@pytest.mark.parametrize("start", [0.5, 0.0])
def test_a_start_at_zero_is_none_and_the_next_is_found_to_rounding(start: float) -> None:
    signal = sine_sum(0.0, [(1.0, 1.0, start)])
    assert first_zero(watch(signal), 10.0) == pytest.approx(math.pi - start, abs=4e-16)
    assert first_zero(watch(signal), 3.14 - start) is None, "none before the limit"


@pytest.mark.parametrize("depth", [1e-3, 1e-6, 1e-9, 1e-12])
def test_twin_zeros_of_a_shallow_dip(depth: float) -> None:
    """1 - depth + cos(t) dips below zero by `depth` around pi."""
    signal = sine_sum(1.0 - depth, [(1.0, 1.0, math.pi / 2)])
    zero = first_zero(watch(signal), 10.0)
    expected = math.pi - math.acos(1.0 - depth)
    assert zero is not None, f"a dip of depth {depth} was passed over"
    assert abs(zero - expected) < 1e-3 * (math.pi - expected)


@pytest.mark.parametrize("height", [0.0, 1e-15, 1e-12, 1e-6])
def test_touch_is_no_zero(height: float) -> None:
    signal = sine_sum(1.0 + height, [(1.0, 1.0, math.pi / 2)])
    assert first_zero(watch(signal, noise=4e-16), 2.0 * math.pi) is None


def test_identically_zero_ends() -> None:
    assert first_zero(watch(lambda t: (0.0, 0.0, 1.0)), 1e3) is None


@pytest.mark.parametrize("noise", [1e-16, 1e-14, 1e-12, 1e-10])
def test_a_signal_within_rounding_costs_few_evaluations(noise: float) -> None:
    """Each step is short, at the shortest one or above it."""
    calls = []

    def counted(t: float) -> tuple[float, float, float]:
        calls.append(t)
        return 0.0, 0.0, 1.0

    assert first_zero(watch(counted, noise=noise), 1.0) is None
    assert len(calls) <= 500, "a motion of many legs would take minutes"


@given(
    st.lists(
        st.tuples(st.floats(0.01, 2.0), st.floats(0.1, 5.0), st.floats(0.0, 2.0 * math.pi)),
        min_size=1,
        max_size=4,
    ),
    st.floats(-1.0, 1.0),
)
def test_nothing_is_passed_over(waves: list[tuple[float, float, float]], offset: float) -> None:
    """Before the zero found, a dense scan sees no negative value."""
    signal = sine_sum(offset, waves)
    if signal(0.0)[0] <= 0.0:
        return
    limit = 20.0
    zero = first_zero(watch(signal, noise=1e-14, fastest=5.0), limit)
    end = limit if zero is None else zero
    lowest = min(signal(end * i / 4000)[0] for i in range(4000))
    assert lowest > -1e-12, f"a zero before {end} was passed over: the signal fell to {lowest}"
    if zero is not None:
        assert abs(signal(zero)[0]) < 1e-12


@given(
    offset=st.floats(-0.9, 0.9),
    phase=st.floats(0.0, 6.0),
    second=st.tuples(st.floats(-0.5, 0.5), st.floats(0.5, 4.0), st.floats(0.0, 6.0)),
    expected=st.floats(-1.0, 12.0),
)
def test_an_expected_zero_changes_nothing(
    offset: float, phase: float, second: tuple[float, float, float], expected: float
) -> None:
    """Wherever a zero is expected, the first one is found, to what rounding makes of its slope."""
    signal = sine_sum(offset, [(1.0, 1.0, phase), second])
    if signal(0.0)[0] <= 0.0:
        return
    plain, guided = (
        first_zero(watch(signal, 4e-16, 4.0, guess), 10.0) for guess in (0.0, expected)
    )
    assert (plain is None) == (guided is None)
    if plain is not None and guided is not None:
        steepness = max(-signal(plain)[1], 1e-7)
        assert guided == pytest.approx(plain, abs=4e-15 / steepness + 4e-15)


@pytest.mark.parametrize("expected", [0.97, 0.98, 0.99])
def test_a_zero_expected_beyond_the_limit_does_not_hide_the_first(expected: float) -> None:
    """The bound of the curvature holds up to the limit; beyond it the signal falls steeply."""
    smooth = sine_sum(0.5, [(1.0, math.tau / 0.96, math.pi / 2)])

    def signal(t: float) -> tuple[float, float, float]:
        value, slope, bound = smooth(min(t, 1.0))
        return value - 1e4 * max(0.0, t - 1.0), slope - 1e4 * (t > 1.0), bound

    zero = first_zero(watch(signal, expected=expected), 1.0)
    assert zero == pytest.approx(0.32, abs=1e-15)


@pytest.mark.parametrize("bound", [1e300, math.inf, math.nan])
def test_a_search_that_hardly_advances_ends(bound: float) -> None:
    """A bound of the curvature beyond all devices makes all steps short, and then longer."""
    assert first_zero(watch(lambda t: (1.0, 0.0, bound)), 1.0) is None


def test_a_zero_that_short_steps_pass_is_refined() -> None:
    """A bound of the curvature far above it makes all steps short, and then longer."""
    zero = 2e-3

    def signal(t: float) -> tuple[float, float, float]:
        return (zero - t) * 1e-9, -1e-9, 1.0

    found = first_zero(watch(signal, noise=1e-30), 1.0)
    assert found == pytest.approx(zero, rel=1e-12)
