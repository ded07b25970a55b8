"""Averaged motion of second order against the resolved one: its error falls with 1 / Omega^2."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any

import pytest

from fmu_src.python.slider_component import orbit_price, orbit_tables, slow_friction
from fmu_src.python.slider_component.component import Component
from fmu_src.python.slider_component.constants import MAX_STEP_MAPS
from fmu_src.python.slider_component.device import Device, Inputs
from fmu_src.python.slider_component.law import law_of
from fmu_src.python.slider_component.moment import Moment
from fmu_src.python.slider_component.motion import State
from fmu_src.python.slider_component.orbit_price import CURVE_TURNS, SEARCH_TURNS
from fmu_src.python.slider_component.orbit_state import MAX_LEADS, Stage
from fmu_src.python.slider_component.period_map import PeriodMap
from fmu_src.python.slider_component.trace import Trace
from tests.fmu_src.orbit_devices import SOFT_BRISTLE

FAST_VELOCITY = 0.2366097
TABLE_1 = Device(fidelity=0)
ROUGH = replace(TABLE_1, friction_coefficient=1.0)
PERIOD = math.tau / TABLE_1.drive_frequency


def moments(device: Device, inputs: Inputs, periods: int, steps: int) -> Iterator[Moment]:
    law = law_of(device, inputs)
    moment = law.start(State(device.initial_velocity, 0.0, 0.0), device.initial_position)
    for _ in range(steps):
        moment = law.advance(moment, periods * math.tau / device.drive_frequency / steps)
        yield moment


def run(device: Device, inputs: Inputs, periods: int, steps: int) -> Moment:
    *_, last = moments(device, inputs, periods, steps)
    return last


def worst_error(device: Device, inputs: Inputs, periods: int, steps: int) -> float:
    """Largest error of the mean velocity in m/s at the ends of steps."""
    pairs = zip(
        moments(device, inputs, periods, steps),
        moments(replace(device, fidelity=2), inputs, periods, steps),
        strict=True,
    )
    return max(abs(a.means.mean_velocity - b.means.mean_velocity) for a, b in pairs)


@pytest.mark.parametrize(
    ("parameters", "inputs", "allowed"),
    [
        ({}, Inputs(), 2e-7),
        ({"friction_coefficient": 5.0}, Inputs(), 2e-7),
        ({}, Inputs(0.7, 0.3), 2e-7),
        ({"normal_amplitude": 1.8}, Inputs(0.7, 0.3), 6e-7),
        ({"normal_amplitude": 2.0}, Inputs(0.4, 0.0, 1.5), 3e-7),
        ({}, Inputs(0.4, 0.1, 3.0), 2e-7),
        ({}, Inputs(0.6, 0.1, 0.0), 1e-7),
        ({"normal_amplitude": 0.0}, Inputs(0.6, 0.5, 1.37), 1e-6),
        ({"friction_coefficient": 0.1, "tangential_force": 300.0}, Inputs(0.4), 1e-7),
    ],
)
def test_against_the_resolved_device(
    parameters: dict[str, Any], inputs: Inputs, allowed: float
) -> None:
    device = replace(ROUGH, **parameters)
    slow, full = run(device, inputs, 240, 24), run(replace(device, fidelity=2), inputs, 240, 24)
    assert slow.orbit.stage == Stage.ON_ORBIT
    assert worst_error(device, inputs, 240, 24) <= allowed
    assert slow.position == pytest.approx(full.position, abs=allowed)
    assert slow.state.velocity == pytest.approx(full.state.velocity, abs=30.0 * allowed)
    assert slow.state.displacement == pytest.approx(full.state.displacement, rel=3e-5)
    assert slow.mode == full.mode


def test_the_error_falls_with_the_square_of_the_drive_frequency() -> None:
    """At equal fast velocity, slow time scale and resonance; first order falls with its inverse."""
    errors: dict[int, list[float]] = {1: [], 2: []}
    for factor in (2.0, 8.0):
        faster = replace(
            ROUGH,
            damping_ratio=0.5,
            base_amplitude=1e-4 / factor,
            drive_frequency=3500.0 * factor,
            resonator_frequency=3500.0 * factor,
        )
        for order, found in errors.items():
            device = replace(faster, averaging_order=order)
            found.append(worst_error(device, Inputs(), round(240 * factor), 24))
    assert errors[1][0] / errors[1][1] == pytest.approx(4.0, rel=0.1)
    assert errors[2][0] / errors[2][1] > 9.0, "16 in the limit"
    assert errors[2][0] <= 3e-4 * errors[1][0]


@pytest.mark.parametrize("inputs", [Inputs(0.3, 0.02), Inputs(0.3, 0.02, 1.002)])
def test_any_communication_step(inputs: Inputs) -> None:
    """Also one that ends within the resolved start, and before it."""
    one = run(TABLE_1, inputs, 280, 1)
    for steps in (3, 7, 997):
        other = run(TABLE_1, inputs, 280, steps)
        assert one.orbit.velocity == pytest.approx(other.orbit.velocity, abs=1e-10)
        assert one.means.mean_velocity == pytest.approx(other.means.mean_velocity, abs=1e-10)
        assert one.position == pytest.approx(other.position, abs=1e-10)


def test_it_goes_over_where_the_swing_has_decayed() -> None:
    """exp(-0.345 n) < 1e-7 after n = 47 periods."""
    before, after = list(moments(TABLE_1, Inputs(), 48, 48))[45:47]
    assert (before.orbit.stage, after.orbit.stage) == (Stage.RESOLVED, Stage.ON_ORBIT)
    assert before.counts.reversals > 80, "resolved motion counts its reversals"
    damped = run(replace(TABLE_1, damping_ratio=1.0), Inputs(), 9, 9)
    assert damped.orbit.stage == Stage.ON_ORBIT, "a few periods where it decays at once"


def test_a_direct_drive_from_rest_begins_where_the_slider_just_turns_back() -> None:
    """Friction changes there within a period: what is not resolved errs by share^(3/2) of v_q."""
    rigid = replace(TABLE_1, resonator_mass=0.0, tangential_force=900.0)
    assert worst_error(rigid, Inputs(0.4), 500, 10) <= 3e-7


def test_a_load_leaves_the_slow_velocity_and_a_phase_the_momentum() -> None:
    moment = run(ROUGH, Inputs(), 100, 1)
    loaded = law_of(ROUGH, Inputs(load=0.2)).advance(moment, 1e-12)
    assert loaded.orbit.velocity == pytest.approx(moment.orbit.velocity, abs=1e-11)
    paid = moment.copied()
    paid.orbit = moment.orbit._replace(paid=moment.orbit.paid.with_curve(1.0, 1.0))
    turned = law_of(ROUGH, Inputs(phase=1.0)).advance(paid, 1e-12)
    assert abs(turned.orbit.velocity - moment.orbit.velocity) > 1e-6
    share = ROUGH.mass_fraction
    momentum = [m.state.velocity + share * m.state.rate for m in (moment, turned)]
    assert momentum[1] == pytest.approx(momentum[0], abs=1e-8)
    assert turned.position == pytest.approx(moment.position, abs=1e-11)


@pytest.mark.parametrize("change", [{"base_amplitude": 0.9e-4}, {"drive_frequency": 3600.0}])
def test_a_tuned_drive_is_resolved(change: dict[str, Any]) -> None:
    moment = run(ROUGH, Inputs(), 100, 1)
    tuned = replace(ROUGH, **change)
    ends = []
    for device in (tuned, replace(tuned, fidelity=2)):
        law = law_of(device, Inputs())
        now = law.advance(moment, 10.0 * PERIOD)
        ends.append(law.advance(now, CURVE_TURNS * PERIOD))
        if device.fidelity == 0:
            assert now.orbit.stage == Stage.RESOLVED
            assert ends[-1].orbit.stage == Stage.ON_ORBIT
    assert ends[0].position == pytest.approx(ends[1].position, abs=1e-7)


def component_at(values: dict[str, float]) -> Component:
    component = Component()
    component.setup_experiment(0.0)
    component.enter_initialization()
    component.set({"fidelity": 0, **values})
    component.exit_initialization()
    return component


def forget_tables() -> None:
    for cached in (orbit_tables._map, orbit_tables._curve, orbit_tables._series):
        cached.cache_clear()
    orbit_tables._combined.cache_clear()


def drive(component: Component, steps: range) -> list[float]:
    """Steps of 20 periods in which phase, load and now and then a parameter change."""
    found: list[float] = []
    for i in steps:
        component.set({"phase": 0.4 * math.sin(1.7 * (i // 2)), "load": 0.02 * (i % 3)})
        if i % 5 == 4:
            component.set({"normal_preload": 1.0 + 0.1 * (i // 5)})
        component.step(component.time, 20.0 * PERIOD)
        found += component.get("position", "velocity", "mean_velocity", "friction_force")
    return found


@pytest.mark.parametrize("values", [{}, {"normal_amplitude": 1.7}], ids=["closed", "lifting"])
@pytest.mark.parametrize("price", [0.01, 1.0])
def test_replay_does_not_depend_on_what_is_tabulated(
    values: dict[str, float], price: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Also at prices at which motion soon goes over to many leads."""
    for name in ("CURVE_TURNS", "SERIES_TURNS", "SEARCH_TURNS"):
        monkeypatch.setattr(orbit_price, name, price * getattr(orbit_price, name))
    forget_tables()
    component = component_at(values)
    drive(component, range(8))
    stored = json.loads(json.dumps(component.snapshot()))
    first = drive(component, range(8, 24))
    visits = component.snapshot()["moment"]["orbit"]["leads"]["visits"]
    assert visits == (MAX_LEADS + 1 if price < 1.0 else 1)
    forget_tables()
    other = component_at({})
    other.restore(stored)
    assert drive(other, range(8, 24)) == first


class CountedMaps:
    """How many maps of about a period were made since it was asked last."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self._maps = 0
        advance = PeriodMap.advance

        def counted(
            period_map: PeriodMap,
            lead: float,
            load: float,
            moment: Moment,
            duration: float,
            *trace: Trace | None,
        ) -> Moment | None:
            self._maps += duration > 0.9 * period_map.period
            return advance(period_map, lead, load, moment, duration, *trace)

        monkeypatch.setattr(PeriodMap, "advance", counted)

    def taken(self) -> int:
        maps, self._maps = self._maps, 0
        return maps


def test_preparation_is_bounded(monkeypatch: pytest.MonkeyPatch) -> None:
    """Table 1 from rest to its steady motion: orbits on a panel, ends beyond grazing, shifts."""
    forget_tables()
    maps = CountedMaps(monkeypatch)
    run(TABLE_1, Inputs(), 5000, 5)
    assert 30 < maps.taken() < 170
    run(TABLE_1, Inputs(), 5000, 50)
    assert maps.taken() < 60, "what was tabulated serves the next instance"


def test_an_estimate_that_nobody_reads_costs_no_maps(monkeypatch: pytest.MonkeyPatch) -> None:
    forget_tables()
    maps = CountedMaps(monkeypatch)
    moment = run(TABLE_1, Inputs(), 5000, 5)
    assert maps.taken() < 85, "a linearised orbit for the estimate takes 15"
    assert law_of(TABLE_1, Inputs()).slow_motion_error(moment) > 0.0
    assert maps.taken() > 50


def run_through(device: Device, changes: Sequence[Inputs], periods: float) -> Moment:
    """So many periods under each of the inputs."""
    moment = law_of(device, changes[0]).start(State(0.0, 0.0, 0.0), 0.0)
    for inputs in changes:
        moment = law_of(device, inputs).advance(moment, periods * PERIOD)
    return moment


@pytest.mark.parametrize(
    "changes",
    [
        [Inputs(0.1 * i) for i in range(40)],
        [Inputs(frequency_ratio=1.0 + 0.001 * i) for i in range(40)],
        [Inputs(frequency_ratio=1.0 + i % 5) for i in range(40)],
    ],
    ids=["phases", "beats", "ratios"],
)
@pytest.mark.parametrize("amplitude", [1.0, 1.7])
def test_inputs_that_keep_changing_cost_no_more_maps_than_periods(
    changes: list[Inputs], amplitude: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each of 40 tables would cost some hundred."""
    forget_tables()
    maps = CountedMaps(monkeypatch)
    run_through(replace(TABLE_1, normal_amplitude=amplitude), changes, 10.0)
    assert maps.taken() < 400


@pytest.mark.parametrize("tuned", [False, True], ids=["phase", "preload"])
def test_a_change_that_lasts_is_resolved_for_the_price_of_its_orbits(tuned: bool) -> None:
    device = replace(TABLE_1, normal_preload=1.1) if tuned else TABLE_1
    law = law_of(device, Inputs(0.0 if tuned else 1.0))
    moment = law.advance(run(TABLE_1, Inputs(), 100, 1), (CURVE_TURNS - 1.0) * PERIOD)
    assert moment.orbit.stage == Stage.RESOLVED
    assert law.advance(moment, 2.0 * PERIOD).orbit.stage == Stage.ON_ORBIT


def test_further_changes_do_not_prolong_it() -> None:
    there_and_back = [Inputs(), *[Inputs(1.0), Inputs()] * 5]
    last = run_through(TABLE_1, there_and_back, 50.0)
    assert (last.orbit.stage, last.orbit.lead) == (Stage.ON_ORBIT, 0.0)
    last = law_of(TABLE_1, Inputs(1.0)).advance(last, PERIOD)
    assert (last.orbit.stage, last.orbit.lead) == (Stage.ON_ORBIT, 1.0), "it was paid for"


def test_a_search_costs_the_same_after_each_change() -> None:
    lifting = replace(TABLE_1, normal_amplitude=1.7)
    start = run(lifting, Inputs(frequency_ratio=1.001), 100, 1)
    assert start.orbit.stage == Stage.ON_ORBIT
    for phase in (0.1, 0.2):
        law = law_of(lifting, Inputs(phase, 0.0, 1.001))
        moment = law.advance(start, (SEARCH_TURNS - 1.0) * PERIOD)
        assert moment.orbit.stage == Stage.RESOLVED
        start = law.advance(moment, 2.0 * PERIOD)
        assert start.orbit.stage == Stage.ON_ORBIT


def test_a_load_and_inputs_that_are_set_at_the_start_cost_nothing() -> None:
    resting = law_of(TABLE_1, Inputs()).start(State(0.0, 0.0, 0.0), 0.0)
    moment = law_of(TABLE_1, Inputs(1.0)).advance(resting, 60.0 * PERIOD)
    assert moment.orbit.stage == Stage.ON_ORBIT
    loaded = law_of(TABLE_1, Inputs(1.0, 0.05)).advance(moment, PERIOD)
    assert loaded.orbit.stage == Stage.ON_ORBIT


def test_the_estimate_bounds_the_error() -> None:
    """Also after a slider has come down to the velocity at which it turns back."""
    fast = replace(ROUGH, initial_velocity=0.4)
    assert (
        1e-5
        <= worst_error(fast, Inputs(), 240, 4)
        <= 3.0 * law_of(fast, Inputs()).slow_motion_error(run(fast, Inputs(), 60, 1))
    )
    for device in (TABLE_1, ROUGH, replace(ROUGH, normal_amplitude=1.7)):
        law = law_of(device, Inputs())
        estimate = law.slow_motion_error(run(device, Inputs(), 60, 1))
        error = worst_error(device, Inputs(), 240, 4)
        assert error <= 3.0 * estimate
        assert estimate <= 1e-5 * FAST_VELOCITY
        assert law_of(replace(device, fidelity=2), Inputs()).slow_motion_error(
            run(replace(device, fidelity=2), Inputs(), 1, 1)
        ) == pytest.approx(0.0, abs=0.0)


NO_PRICE = (
    *("CURVE_TURNS", "SERIES_TURNS", "SEARCH_TURNS"),
    *("BRISTLE_CURVE_TURNS", "BRISTLE_SERIES_TURNS", "BRISTLE_SEARCH_TURNS"),
)
ROUGH_BEAT = Device(
    fidelity=0,
    slider_mass=58.5,
    resonator_mass=41.8,
    resonator_frequency=170512.0,
    damping_ratio=0.084,
    base_amplitude=2.34e-6,
    drive_frequency=47099.0,
    tangential_force=142906.0,
    friction_coefficient=4.35,
    friction_faces=2,
    normal_preload=3109.0,
    normal_amplitude=2056.0,
)
"""Its curves have kinks at which panels are halved again and again, at each of nine leads."""


@pytest.fixture
def free_orbits(monkeypatch: pytest.MonkeyPatch) -> None:
    """Motion goes over to orbits at once."""
    for name in NO_PRICE:
        monkeypatch.setattr(orbit_price, name, 0.0)
    forget_tables()


@pytest.mark.usefixtures("free_orbits")
def test_a_step_maps_no_more_turns_for_orbits_than_its_bound(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Under a beat each orbit stands for nine; from where they are too many, motion is resolved."""
    maps = CountedMaps(monkeypatch)
    moment = law_of(ROUGH_BEAT, Inputs()).start(State(0.0, 0.0, 0.0), 0.0)
    for phase, load in ((2.47, -5002.0), (-2.3, 29749.0)):
        law = law_of(ROUGH_BEAT, Inputs(phase, load, 1.01))
        moment = law.advance(moment, 17.0 * math.tau / ROUGH_BEAT.drive_frequency)
        assert 1000 < maps.taken() < 1.1 * MAX_STEP_MAPS


def test_orbits_under_a_beat_from_the_start_are_searched_for_what_tables_cost() -> None:
    law = law_of(TABLE_1, Inputs(0.0, 0.0, 1.001))
    moment = law.start(State(0.0, 0.0, 0.0), 0.0)
    for _ in range(9):
        assert not moment.orbit.paid.has_series
        moment = law.advance(moment, 500.0 * PERIOD)
        assert moment.orbit.stage == Stage.ON_ORBIT
    assert moment.orbit.paid.has_series


@pytest.mark.usefixtures("free_orbits")
def test_motion_without_a_slow_part_is_resolved() -> None:
    inputs = Inputs(1.5, 6.8e-6, 0.0)
    soft = replace(SOFT_BRISTLE, fidelity=0, initial_velocity=0.004)
    assert worst_error(soft, inputs, 60, 12) < 1e-6 * 2.8e-3
    assert run(soft, inputs, 60, 1).orbit.stage == Stage.RESOLVED


def test_motion_along_orbits_makes_no_table_of_first_order(monkeypatch: pytest.MonkeyPatch) -> None:
    """Under LuGre friction that took more time than the orbits."""
    made: list[object] = []
    monkeypatch.setattr(slow_friction, "_table", lambda *of: made.append(of))
    hard = replace(TABLE_1, friction_law=1, bristle_stiffness=1e7, tolerance=1e-6)
    moment = run(hard, Inputs(), 60, 1)
    assert moment.orbit.stage == Stage.ON_ORBIT
    assert not made
