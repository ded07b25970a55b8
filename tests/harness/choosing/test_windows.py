"""Where windows lie in a long scene."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from slider_resonator.choosing.windows import (
    FIT_PERIODS,
    MAX_SPREAD,
    WINDOW_PERIODS,
    WINDOWS,
    even_starts,
    head_end,
    places,
    starts_along,
)


@given(
    corners=st.lists(st.floats(1.0, 19_999.0), max_size=30).map(sorted),
    end=st.floats(20_000.0, 20_001.0),
    settle=st.floats(2.0, 120.0),
)
def test_every_corner_lies_in_a_window_apart_from_its_edges(
    corners: list[float], end: float, settle: float
) -> None:
    first = head_end(1000.0, corners, settle)
    spans = places(first, end, corners, settle, even_starts(first, end))
    assert spans[-1][1] == end, "the end of the scene is in a window"
    assert all(before[1] < after[0] for before, after in pairwise(spans))
    for corner in corners:
        if corner <= first:
            assert corner <= first - settle, "forgotten where the beginning ends"
            continue
        (span,) = [span for span in spans if span[0] <= corner <= span[1]]
        assert corner - span[0] >= settle + FIT_PERIODS - 1.0
        assert span[1] == end or span[1] - corner >= settle + FIT_PERIODS


def test_a_scene_without_corners_has_windows_at_even_distances() -> None:
    spans = places(1000, 20_000.0, [], 2.0, even_starts(1000, 20_000.0))
    assert len(spans) == WINDOWS
    assert {stop - start for start, stop in spans} == {float(WINDOW_PERIODS)}
    assert np.ptp(np.diff([start for start, _ in spans])) <= 1


def test_windows_are_denser_where_the_slow_velocity_changes() -> None:
    times = np.linspace(0.0, 10.0, 1001)
    velocity = np.where(times < 5.0, 0.0, 2.0 * (1.0 - np.exp(-4.0 * (times - 5.0))))
    starts = np.array(starts_along(times, velocity, 1.0))
    assert np.sum((starts > 5.0) & (starts < 6.0)) > np.sum((starts > 0.0) & (starts < 4.0))
    assert starts[0] == pytest.approx(0.0)
    assert len(starts_along(times, 1e6 * velocity, 1.0)) == MAX_SPREAD
