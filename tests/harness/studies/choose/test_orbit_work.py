"""What averages of second order do in a run, by the rules of the component."""

from __future__ import annotations

import pytest

from slider_resonator.studies.choose.orbit_work import (
    CURVES,
    PAID,
    SERIES_CURVES,
    OrbitWork,
    orbit_work,
    resolved_start,
)
from slider_resonator.studies.choose.plan import Plan, Stay
from slider_resonator.studies.choose.scales import Scales, scales_of
from tests.harness.scene_text import scene_of

TABLE_1 = scales_of(scene_of(""))
FLIGHT = scales_of(scene_of("[device]\nnormal_amplitude = 1.5\n"))
START = resolved_start(TABLE_1, 0)


def work(*stays: Stay, scales: Scales = TABLE_1) -> OrbitWork:
    return orbit_work(Plan(10.0, 100, stays=stays), scales, 0)


def stay(periods: float, phase: float = 0.0, **about: bool) -> Stay:
    about = {"drifts": False, **about}
    return Stay(periods, (phase, 1.0), **about)


def test_a_run_under_one_lead_resolves_its_start_and_tabulates_one_curve() -> None:
    found = work(stay(3000.0))
    assert found.resolved == pytest.approx(START)
    assert found.tabulated == pytest.approx(3000.0 - START)
    assert found.curves == 1


def test_a_run_shorter_than_the_start_is_resolved() -> None:
    found = work(stay(10.0))
    assert (found.resolved, found.tabulated, found.curves) == (10.0, 0.0, 0)


def test_a_new_lead_is_paid_for_by_resolved_motion_and_an_old_one_is_not() -> None:
    found = work(stay(1000.0), stay(1000.0, 0.5), stay(1000.0), stay(1000.0, 0.5))
    assert found.resolved == pytest.approx(START + PAID[0].curve)
    assert (found.curves, found.changes) == (2, 2)


def test_leads_that_change_soon_do_not_prolong_resolved_motion() -> None:
    found = work(stay(1000.0), *(stay(100.0, 0.1 * i) for i in range(1, 5)), stay(1000.0, 0.4))
    assert found.resolved == pytest.approx(START + PAID[0].curve)
    assert found.curves == 2


def test_leads_that_alternate_are_paid_for_once() -> None:
    found = work(*(stay(50.0, 0.5 * (i % 2)) for i in range(100)))
    assert found.resolved == pytest.approx(START + PAID[0].curve)
    assert found.curves == 2


def test_many_leads_share_a_series() -> None:
    leads = [stay(10_000.0, 0.1 * i) for i in range(2 * CURVES)]
    found = work(*leads)
    paid = (CURVES - 1) * PAID[0].curve + PAID[0].series
    assert found.resolved == pytest.approx(START + paid)
    assert found.curves == CURVES + SERIES_CURVES
    assert (found.changes, found.combined) == (CURVES - 1, CURVES - 1)


def test_a_lead_that_drifts_from_the_start_searches_until_a_series_is_due() -> None:
    soon = work(stay(3000.0, drifts=True))
    assert soon.curves == 0
    assert soon.searched == pytest.approx(3000.0 - START)
    long = work(stay(10_000.0, drifts=True))
    assert long.curves == SERIES_CURVES
    assert long.searched == pytest.approx(PAID[0].series)
    assert long.searched + long.tabulated + long.resolved == pytest.approx(10_000.0)


def test_a_line_that_only_bends_is_followed_by_searches_and_one_that_ends_is_resolved() -> None:
    bends = [stay(100.0, 0.1 * i, drifts=True, bends=True) for i in range(20)]
    found = work(*bends)
    assert found.resolved == pytest.approx(START)
    assert found.searched == pytest.approx(2000.0 - START)
    flat = work(*bends, stay(1000.0, bends=True))
    assert flat.resolved == pytest.approx(START + PAID[0].curve)


def test_a_lead_that_drifts_under_flight_searches_throughout() -> None:
    found = work(stay(30_000.0, drifts=True), scales=FLIGHT)
    assert found.curves == 0
    assert found.searched == pytest.approx(30_000.0 - START)


def test_a_tuned_parameter_needs_new_curves_and_a_drive_a_new_start() -> None:
    found = work(stay(1000.0), stay(1000.0, tuned=True))
    assert found.curves == 2
    assert found.resolved == pytest.approx(START + PAID[0].curve)
    again = work(stay(1000.0), *(stay(1000.0, tuned=True) for _ in range(CURVES)))
    assert again.searched > 0.0, "after so many changes each orbit is searched"
