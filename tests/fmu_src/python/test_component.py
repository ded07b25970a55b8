"""The component: damaged snapshots, rounded time, and whole turns of the phase."""

import math
from dataclasses import fields, replace
from typing import Any

import pytest

from fmu_src.python.slider_component import lugre, prediction, resolved
from fmu_src.python.slider_component.component import Component, motion_of
from fmu_src.python.slider_component.device import Device
from fmu_src.python.slider_component.first_zero import Watch, first_zero
from fmu_src.python.slider_component.moment import Moment
from fmu_src.python.slider_component.outputs import OUTPUTS
from fmu_src.python.slider_component.parameters import Inputs
from fmu_src.python.slider_component.period_map import PeriodMap
from fmu_src.python.slider_component.segment import Series
from fmu_src.python.slider_component.snapshot import from_bytes, to_bytes
from fmu_src.python.slider_component.values import BY_NAME, SETTABLE, Refusal, checked
from fmu_src.python.slider_component.variables import VARIABLES


def running(start_time: float = 0.0, **values: float) -> Component:
    component = Component()
    component.setup_experiment(start_time, None)
    component.enter_initialization()
    component.set(values)
    component.exit_initialization()
    return component


def one(component: Component, name: str) -> float:
    return component.get(name)[0]


def outputs(component: Component) -> dict[str, float]:
    return dict(zip(OUTPUTS, component.get(*OUTPUTS), strict=True))


def test_damaged_and_foreign_states_are_refused_and_change_nothing() -> None:
    component = running()
    component.step(0.0, 0.01)
    before = component.snapshot()
    good = to_bytes(before)
    foreign = to_bytes(before | {"format": "another build state"})
    for bad in (b"", good[:-1], good.replace(b"0", b"1", 1), good + b" ", foreign):
        with pytest.raises(Refusal, match=r"FMU state refused: its format is .*; must be "):
            component.restore(from_bytes(bad))
        assert component.snapshot() == before


def test_a_period_that_counts_as_ended_before_its_end_is_restored() -> None:
    component, period = running(), math.tau / 3500.0
    component.step(0.0, period * (1.0 - 1e-9))
    state = component.snapshot()
    assert state["moment"]["theta"] < 0.0
    component.restore(from_bytes(to_bytes(state)))
    assert component.snapshot() == state


def test_the_table_is_the_interface() -> None:
    """Device, inputs and outputs have the names and starts of the table, and no others."""
    device = {f.name: getattr(Device(), f.name) for f in fields(Device)}
    inputs = {f.name: getattr(Inputs(), f.name) for f in fields(Inputs)}
    table = {c: {v.name: v.start for v in VARIABLES if v.causality == c} for c in
             ("parameter", "input", "output")}  # fmt: skip
    assert table["parameter"] == device
    assert table["input"] == inputs
    assert set(table["output"]) == set(OUTPUTS)


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, "1", True, None])
def test_values_that_are_not_finite_are_refused(value: object) -> None:
    for name in (v.name for v in SETTABLE):
        with pytest.raises(Refusal, match=rf"{name} = .* refused: must be (a finite|an integer)"):
            checked(BY_NAME[name], value)


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

    monkeypatch.setattr(resolved, "first_zero", counted)
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
    assert sum(maps) <= 3000


def test_work_is_bounded_in_a_search(monkeypatch: pytest.MonkeyPatch) -> None:
    # Enough for each map of a search, but not for all. A prediction that was made is kept.
    monkeypatch.setattr(prediction, "MAX_SEGMENTS", 500)
    assert one(running(normal_amplitude=1.51), "prediction_valid") == 0.0
    monkeypatch.undo()
    assert one(running(normal_amplitude=1.52), "prediction_valid") == 1.0


@pytest.mark.parametrize("phase", [0.3, -2.0, 3.0])
def test_whole_turns_of_phase_change_nothing(phase: float) -> None:
    far = phase + 1e12 * math.tau
    near = running(phase=math.remainder(far, math.tau))
    turned = running(phase=far)
    near.step(0.0, 0.01)
    turned.step(0.0, 0.01)
    assert outputs(turned) == outputs(near)
    assert one(turned, "phase") == far
