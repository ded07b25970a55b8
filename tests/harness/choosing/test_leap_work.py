"""The drive periods that averages of second order resolve or map, by the counts of `leap_work`."""

from __future__ import annotations

from slider_resonator.choosing.leap_work import resolved_periods
from slider_resonator.choosing.plan import Plan
from slider_resonator.choosing.scales import Scales, scales_of
from tests.harness.scene_text import scene_of

TABLE_1 = scales_of(scene_of(""))


def periods(steps: int, kicks: int = 0, scales: Scales = TABLE_1, tolerance: float = 1e-8) -> float:
    """Return those of 10 000 drive periods."""
    plan = Plan(10_000.0 * scales.period, steps, kicks=kicks)
    return resolved_periods(plan, scales, 0, tolerance)


def test_short_steps_are_resolved_and_long_ones_leap() -> None:
    assert periods(1000) == 10_000.0
    assert periods(100) < 10_000.0
    assert periods(5) < periods(20) < periods(100)


def test_what_changes_and_what_must_be_exact_takes_more() -> None:
    assert periods(10) < periods(10, kicks=3)
    assert periods(10, tolerance=1e-4) < periods(10, tolerance=1e-8)


def test_without_slow_motion_all_is_resolved() -> None:
    undamped = scales_of(scene_of("[device]\ndamping_ratio = 0.0\nresonator_frequency = 3000.0\n"))
    assert periods(10, scales=undamped) == 10_000.0
