"""The work that a motion takes, in counts that are the same on any machine."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import pytest

from fmu_src.python.slider_component import events, lugre
from fmu_src.python.slider_component.component import motion_of
from fmu_src.python.slider_component.device import Device
from fmu_src.python.slider_component.first_zero import Watch, first_zero
from fmu_src.python.slider_component.moment import Moment
from fmu_src.python.slider_component.parameters import Inputs
from fmu_src.python.slider_component.period_map import PeriodMap
from fmu_src.python.slider_component.series import Series

TABLE_1 = Device()
PERIOD = math.tau / 3500.0
"""Drive period of table 1 [s]."""


def after(periods: int, device: Device) -> Moment:
    motion = motion_of(device, Inputs())
    return motion.advance(motion.start(), periods * PERIOD)


def test_searches_for_a_zero_are_few(monkeypatch: pytest.MonkeyPatch) -> None:
    """Per drive period: two while it moves, none where nothing can happen."""
    searches = []

    def counted(watch: Watch, limit: float) -> float | None:
        searches.append(1)
        return first_zero(watch, limit)

    monkeypatch.setattr(events, "first_zero", counted)
    after(100, TABLE_1)
    assert len(searches) <= 3 * 100
    searches.clear()
    after(100, replace(TABLE_1, base_amplitude=0.0))
    assert searches == []


def test_stiffness_costs_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    made = []

    class Counted(Series):
        def __init__(self, *args: Any, **settings: Any) -> None:
            made.append(1)
            super().__init__(*args, **settings)

    monkeypatch.setattr(lugre, "Series", Counted)

    def series(stiffness: float) -> int:
        made.clear()
        after(50, replace(TABLE_1, friction_law=1, bristle_stiffness=stiffness))
        return len(made)

    assert 0 < series(1e8) <= 1.5 * series(1e5)


def test_a_long_step_takes_few_maps(monkeypatch: pytest.MonkeyPatch) -> None:
    maps = []
    sections = PeriodMap.sections

    def counted(self: PeriodMap, now: Moment, count: int, budget: Any) -> Any:
        maps.append(count)
        return sections(self, now, count, budget)

    monkeypatch.setattr(PeriodMap, "sections", counted)
    after(20_000, replace(TABLE_1, fidelity=0))
    assert sum(maps) <= 1500
