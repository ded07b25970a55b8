"""Means over whole drive periods, however the motion is cut."""

from __future__ import annotations

import math
from functools import partial

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fmu_src.python.slider_component.period import PeriodMeans

FREQUENCY = 2.0
PERIOD = math.tau / FREQUENCY


def position(t: float) -> float:
    return 0.3 * t + 0.05 * t * t + math.sin(1.7 * t)


def _moved(start: float, duration: float) -> float:
    return position(start + duration) - position(start)


def follow(durations: list[float]) -> tuple[PeriodMeans, float, float]:
    means, theta, now = PeriodMeans(), 0.0, 0.0
    for duration in durations:
        moved = partial(_moved, now)
        means, theta = means.advanced(duration, theta, FREQUENCY, False, moved, moved(duration))
        now += duration
    return means, theta, now


@given(st.lists(st.floats(0.01, 3.0 * PERIOD), min_size=1, max_size=12))
def test_mean_over_the_last_whole_period(durations: list[float]) -> None:
    means, theta, now = follow(durations)
    whole = math.floor(now / PERIOD + 1e-8)
    assert theta == pytest.approx(FREQUENCY * (now - whole * PERIOD), abs=1e-12)
    if whole == 0:
        assert means.present_mean_velocity(9.9) == pytest.approx(position(now) / now)
    else:
        end = whole * PERIOD
        expected = (position(end) - position(end - PERIOD)) / PERIOD
        assert means.present_mean_velocity(9.9) == pytest.approx(expected, abs=1e-11)


def test_velocity_before_any_motion() -> None:
    assert PeriodMeans().present_mean_velocity(0.7) == 0.7
    assert PeriodMeans().present_stick_fraction(True) == 1.0


def test_step_of_a_rounded_period_completes_it() -> None:
    means, _, _ = follow([PERIOD * (1 - 1e-12)])
    assert means.complete


def test_stick_fraction() -> None:
    means, theta = PeriodMeans(), 0.0
    for share, sticks in ((0.25, True), (0.5, False), (0.35, True)):
        means, theta = means.advanced(share * PERIOD, theta, FREQUENCY, sticks, lambda t: 0.0, 0.0)
    assert means.present_stick_fraction(False) == pytest.approx(0.5, abs=1e-12)
    assert means.sticking == pytest.approx(0.1 * PERIOD, rel=1e-9), (
        "what belongs to the next period"
    )
