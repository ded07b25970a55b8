"""The search of either build: it finds the first zero, passes none over, and takes no touch."""

import ctypes
import math
from collections.abc import Callable
from dataclasses import dataclass

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fmu_src.python.slider_component.first_zero import Watch, first_zero

Wave = tuple[float, float, float]
"""Amplitude, frequency (rad/s) and phase (rad) of a sine."""

COSINE = (1.0, 1.0, math.pi / 2)
ROUNDING = 4e-16
MAX_EVALUATIONS = 1000
"""A motion of many segments would take minutes with more in each."""

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


@dataclass(frozen=True)
class Search:
    """How a search is asked for; native ones may expect a zero, but not at times below 0."""

    limit: float
    expected: float = -1.0
    noise: float = ROUNDING
    fastest: float = 1.0


Found = tuple[float | None, int]
"""The first zero and the number of evaluations."""


def native(signal: Sum, search: Search) -> Found:
    waves = [number for wave in signal.waves for number in wave]
    work = ctypes.c_int()
    zero = LIBRARY[0].first_zero_of_waves(
        *map(ctypes.c_double, (signal.offset, signal.loose)),
        (ctypes.c_double * len(waves))(*waves),
        len(signal.waves),
        *map(ctypes.c_double, (search.noise, search.fastest, search.limit, search.expected)),
        ctypes.byref(work),
    )
    return (None if zero < 0.0 else zero), work.value


def python(signal: Sum, search: Search) -> Found:
    bound = signal.loose * sum(abs(a) * w * w for a, w, _ in signal.waves)
    calls = []

    def evaluated(t: float) -> tuple[float, float, float]:
        calls.append(t)
        return signal.value(t), sum(a * w * math.cos(w * t + p) for a, w, p in signal.waves), bound

    return first_zero(Watch(evaluated, search.noise, search.fastest), search.limit), len(calls)


both = pytest.mark.parametrize("find", [native, python])
"""That of the Python build is tried with bounds that are not loose only: it relies on them."""

Find = Callable[[Sum, Search], Found]


@both
@pytest.mark.parametrize("start", [0.5, 0.0])
def test_a_start_at_zero_is_none_and_the_next_is_found_to_rounding(
    find: Find, start: float
) -> None:
    signal = Sum(0.0, ((1.0, 1.0, start),))
    assert find(signal, Search(10.0))[0] == pytest.approx(math.pi - start, abs=ROUNDING)
    assert find(signal, Search(3.14 - start))[0] is None, "none before the limit"


@pytest.mark.parametrize(
    ("find", "loose"), [(native, 1.0), (native, 1e4), (native, 1e8), (native, 1e12), (python, 1.0)]
)
@pytest.mark.parametrize("depth", [1.0, 1e-2, 1e-4, 1e-6, 1e-8])
def test_twin_zeros_are_located_however_loose_the_bound(
    find: Find, depth: float, loose: float
) -> None:
    """1 - depth + cos(t) falls below zero around pi; a loose bound makes all steps short."""
    zero, work = find(Sum(1.0 - depth, (COSINE,), loose), Search(10.0))
    steepness = math.sqrt(2.0 * depth)
    assert zero == pytest.approx(math.acos(depth - 1.0), abs=2.0 * ROUNDING / steepness)
    assert work <= MAX_EVALUATIONS


@pytest.mark.parametrize("loose", [1e6, 1e8, 1e10])
def test_short_steps_pass_no_dip_that_is_longer_than_they_are(loose: float) -> None:
    """Steps are lengthened no further than to the length that counts as short."""
    signal = Sum(1.01, (COSINE, (0.02, 1.0 / 3.0, math.pi / 2)), loose)
    zero, _ = python(signal, Search(20.0))
    assert zero is not None, "it is below 0 around 3 pi"
    assert abs(zero - 3.0 * math.pi) < 0.2
    assert signal.value(zero) == pytest.approx(0.0, abs=1e-15)


@pytest.mark.parametrize("before", [1e-3, 1e-5, 1e-7])
def test_a_zero_just_before_the_limit_is_found_however_loose_the_bound(before: float) -> None:
    """A short step that is lengthened does not end beyond the limit."""
    zero, _ = native(Sum(0.0, ((1.0, 1.0, 0.0),), 1e12), Search(math.pi + before))
    assert zero == pytest.approx(math.pi, abs=1e-15)


@both
@pytest.mark.parametrize("height", [0.0, 1e-15, 1e-12, 1e-6])
def test_a_touch_is_no_zero(find: Find, height: float) -> None:
    assert find(Sum(1.0 + height, (COSINE,)), Search(2.0 * math.pi))[0] is None


@both
@pytest.mark.parametrize("noise", [1e-16, 1e-14, 1e-12, 1e-10])
def test_a_signal_within_rounding_costs_few_evaluations(find: Find, noise: float) -> None:
    zero, work = find(Sum(0.0, ((1e-20, 1e10, 0.0),)), Search(1.0, noise=noise))
    assert zero is None
    assert work <= MAX_EVALUATIONS


@both
@given(
    waves=st.lists(
        st.tuples(st.floats(0.01, 2.0), st.floats(0.1, 5.0), st.floats(0.0, 2.0 * math.pi)),
        min_size=1,
        max_size=4,
    ),
    offset=st.floats(-1.0, 1.0),
    loose=st.sampled_from([1.0, 1e6]),
)
def test_nothing_is_passed_over(find: Find, waves: list[Wave], offset: float, loose: float) -> None:
    """Before the zero found, a dense scan sees no negative value."""
    signal = Sum(offset, tuple(waves), loose if find is native else 1.0)
    if signal.value(0.0) <= 0.0:
        return
    limit = 20.0
    zero, _ = find(signal, Search(limit, noise=1e-14, fastest=5.0))
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
    plain, guided = (
        native(signal, Search(10.0, guess, fastest=4.0))[0] for guess in (-1.0, expected)
    )
    assert (plain is None) == (guided is None)
    if plain is not None and guided is not None:
        steepness = max(signal.value(plain - 1e-4) * 1e4, 1e-7)
        assert guided == pytest.approx(plain, abs=ROUNDING * 20.0 / steepness + 4e-15)


def test_a_zero_where_it_is_expected_costs_few_evaluations() -> None:
    search = Search(10.0, expected=math.pi - 0.1 + 1e-6)
    zero, work = native(Sum(0.0, ((1.0, 1.0, 0.1),)), search)
    assert zero == pytest.approx(math.pi - 0.1, abs=ROUNDING)
    assert work <= 3


@pytest.mark.parametrize("bound", [1e300, math.inf, math.nan])
def test_a_search_that_hardly_advances_ends(bound: float) -> None:
    """A bound of the curvature beyond all devices makes all steps short, and then longer."""
    assert first_zero(Watch(lambda t: (1.0, 0.0, bound), 1e-16, 1.0), 1.0) is None


def test_a_zero_that_short_steps_pass_is_refined() -> None:
    """A bound of the curvature far above it makes all steps short, and then longer."""
    watch = Watch(lambda t: ((2e-3 - t) * 1e-9, -1e-9, 1.0), 1e-30, 1.0)
    assert first_zero(watch, 1.0) == pytest.approx(2e-3, rel=1e-12)
