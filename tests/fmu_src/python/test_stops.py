"""Where the next stop is expected."""

from __future__ import annotations

import math

import pytest

from fmu_src.python.slider_component.stops import Stops


@pytest.mark.parametrize("direction", [-1, 1])
def test_a_drift_goes_on(direction: int) -> None:
    stops = Stops().then(direction, 3.0).then(direction, 3.01)
    stops = stops.then(-direction, 1.0)
    assert stops.expected(direction, 2.0, 100.0) == pytest.approx(0.0102)


def test_a_jump_is_no_drift() -> None:
    stops = Stops().then(1, 3.0).then(1, 4.0)
    assert stops.expected(1, 3.5, 1.0) == pytest.approx(0.5)


def test_the_next_stop_is_within_a_turn() -> None:
    assert Stops(forward=1.0).expected(1, 1.5, 1.0) == pytest.approx(math.tau - 0.5)
