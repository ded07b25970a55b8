"""The component: damaged snapshots, rounded time, and whole turns of the phase."""

import math
from dataclasses import fields, replace
from typing import Any

import pytest

from fmu_src.python.slider_component import lugre, prediction, resolved
from fmu_src.python.slider_component.component import Component, motion_of
from fmu_src.python.slider_component.device import Device
from fmu_src.python.slider_component.outputs import OUTPUTS
from fmu_src.python.slider_component.parameters import Inputs
from fmu_src.python.slider_component.period_map import PeriodMap
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


def counted(monkeypatch: pytest.MonkeyPatch, place: object, name: str) -> list[tuple[Any, ...]]:
    """The arguments of all calls of a function, or of a class, from now on."""
    calls: list[tuple[Any, ...]] = []
    function = getattr(place, name)

    def counting(*arguments: Any, **settings: Any) -> Any:
        calls.append(arguments)
        return function(*arguments, **settings)

    monkeypatch.setattr(place, name, counting)
    return calls


def run(periods: int, **changes: Any) -> None:
    """Advance table 1 with changes by periods of its drive."""
    motion = motion_of(replace(Device(), **changes), Inputs())
    motion.advance(motion.start(), periods * math.tau / 3500.0)


def test_searches_for_a_zero_are_few(monkeypatch: pytest.MonkeyPatch) -> None:
    """Per drive period: two while it moves, none where nothing can happen."""
    searches = counted(monkeypatch, resolved, "first_zero")
    run(100)
    assert len(searches) <= 3 * 100
    searches.clear()
    run(100, base_amplitude=0.0)
    assert searches == []


def test_stiffness_costs_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    series, made = counted(monkeypatch, lugre, "Series"), []
    for stiffness in (1e5, 1e8):
        run(50, friction_law=1, bristle_stiffness=stiffness)
        made.append(len(series))
        series.clear()
    assert 0 < made[1] <= 1.5 * made[0]


def test_a_long_step_takes_few_maps(monkeypatch: pytest.MonkeyPatch) -> None:
    calls = counted(monkeypatch, PeriodMap, "sections")
    run(20_000, fidelity=0)
    assert sum(count for _, _, count, *_ in calls) <= 3000


def test_work_is_bounded_in_a_search(monkeypatch: pytest.MonkeyPatch) -> None:
    # Enough for each map of a search, but not for all. A prediction that was made is kept.
    monkeypatch.setattr(prediction, "MAX_SEGMENTS", 500)
    assert running(normal_amplitude=1.51).get("prediction_valid") == [0.0]
    monkeypatch.undo()
    assert running(normal_amplitude=1.52).get("prediction_valid") == [1.0]


@pytest.mark.parametrize("phase", [0.3, -2.0, 3.0])
def test_whole_turns_of_phase_change_nothing(phase: float) -> None:
    far = phase + 1e12 * math.tau
    near, turned = running(phase=math.remainder(far, math.tau)), running(phase=far)
    for component in (near, turned):
        component.step(0.0, 0.01)
    assert turned.get(*OUTPUTS) == near.get(*OUTPUTS)
    assert turned.get("phase") == [far]
