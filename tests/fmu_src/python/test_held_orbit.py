"""Held orbits against those of the references, which iterate between panels or shoot."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from fmu_src.python.slider_component.device import Device
from fmu_src.python.slider_component.held_orbit import (
    HeldOrbit,
    NoOrbitError,
    OrbitStatus,
    held_orbit_at,
    held_orbit_linearised,
    steady_orbit_at,
)
from fmu_src.python.slider_component.orbit_drift import held_orbit_moment, held_orbit_offset
from fmu_src.python.slider_component.period_map import PeriodMap, period_map
from slider_resonator.references.averaged.added_mass import slow_linearisation
from slider_resonator.references.averaged.held_orbit import HeldOrbit as ReferenceOrbit
from slider_resonator.references.averaged.held_orbit import held_orbit
from slider_resonator.references.averaged.held_orbit_that_sticks import held_orbit_by_shooting
from slider_resonator.references.averaged.hold import Hold
from tests.fmu_src.orbit_devices import (
    BRISTLES,
    FLIGHT,
    SOFT_BRISTLE,
    STICKING,
    STRONG,
    TABLE_1,
    Case,
    as_reference,
    random_case,
)

CASES = {
    "table 1": Case(TABLE_1, 0.0, 1.0, 1, 0.2),
    "backward": Case(TABLE_1, 0.7, 1.0, 1, -0.8),
    "strong": Case(STRONG, 0.0, 1.0, 1, 0.5),
    "flight": Case(FLIGHT, 0.7, 1.0, 1, 0.3),
    "three waves": Case(TABLE_1, 0.4, 3.0, 1, -0.1),
    "three waves in two turns": Case(replace(FLIGHT, friction_coefficient=0.1), 0.4, 1.5, 2, 0.4),
    "low damping": Case(replace(TABLE_1, damping_ratio=0.005), 0.0, 1.0, 1, 0.4),
    "overdamped": Case(replace(TABLE_1, damping_ratio=1.2), 0.0, 1.0, 1, 0.4),
    "no load vibration": Case(replace(TABLE_1, normal_amplitude=0.0), 0.0, 1.0, 1, -0.3),
    "bristles": Case(BRISTLES, 0.0, 1.0, 1, 0.2),
    "soft bristles": Case(replace(BRISTLES, bristle_stiffness=1e2), 0.0, 1.0, 1, 0.2),
    "hard bristles": Case(replace(BRISTLES, bristle_stiffness=1e7), 0.3, 1.0, 1, -0.6),
    "bristles in flight": Case(
        replace(BRISTLES, friction_coefficient=1.0, normal_amplitude=1.8), 0.7, 1.0, 1, 0.6
    ),
}


def full_friction(device: Device) -> float:
    return device.friction_faces * device.friction_coefficient * device.normal_preload


def hold_of(case: Case, speed: float) -> Hold:
    device = as_reference(case.device)
    return Hold(device, case.share * speed, case.lead, case.ratio, case.turns)


def assert_same(case: Case, found: HeldOrbit, expected: ReferenceOrbit) -> None:
    """To rounding under Coulomb friction, else to the tolerance."""
    scales, lugre = case.map, case.device.friction_law == 1
    device, origin = case.device, np.zeros(1)
    loose = 2e-9 if lugre else 2e-12
    full = full_friction(device)
    assert found.friction / full == pytest.approx(expected.mean_friction / full, abs=loose)
    moment = held_orbit_moment(scales, found, -found.friction, 0.0)
    tight = 1e-11 if lugre else 1e-12
    for value, nodes, scale in (
        (moment.state.velocity, expected.slider_velocity, scales.speed),
        (moment.state.displacement, expected.resonator_displacement, scales.swing),
        (moment.state.rate, expected.resonator_velocity, scales.swing * device.drive_frequency),
        (held_orbit_offset(scales, found, moment), expected.momentum_excess, scales.speed),
    ):
        wanted = float(expected.panels.at(nodes, origin)[0])
        assert value / scale == pytest.approx(wanted / scale, abs=tight)


@pytest.mark.parametrize("name", CASES)
def test_against_the_reference(name: str) -> None:
    case = CASES[name]
    scales = case.map
    found = held_orbit_at(scales, case.lead, case.share * scales.speed)
    expected = held_orbit(hold_of(case, scales.speed))
    assert_same(case, found, expected)
    assert found.reversals == len(expected.reversals)
    assert not found.sticks


@pytest.mark.parametrize("seed", range(12))
def test_random_devices_against_the_reference(seed: int) -> None:
    case = random_case(seed)
    scales = case.map
    found = held_orbit_at(scales, case.lead, case.share * scales.speed)
    assert_same(case, found, held_orbit(hold_of(case, scales.speed)))


@pytest.mark.parametrize("share", [0.5, 0.9])
def test_an_orbit_in_which_the_slider_sticks(share: float) -> None:
    case = Case(STICKING, 0.3, 1.0, 1, share)
    scales = case.map
    found = held_orbit_at(scales, case.lead, share * scales.speed)
    expected = held_orbit_by_shooting(hold_of(case, scales.speed), -found.friction)
    assert found.sticks
    full = full_friction(case.device)
    assert found.friction / full == pytest.approx(expected.mean_friction / full, abs=1e-11)
    assert held_orbit_linearised(scales, found).factor == 1.0


@pytest.mark.parametrize("name", [name for name in CASES if name != "backward"])
def test_slope_and_added_mass_against_the_reference(name: str) -> None:
    case = CASES[name]
    scales = case.map
    orbit = held_orbit_at(scales, case.lead, case.share * scales.speed)
    found = held_orbit_linearised(scales, orbit)
    expected = slow_linearisation(held_orbit(hold_of(case, scales.speed)))
    added = expected.added_mass
    # Forward differences: their error grows with friction.
    assert found.factor - 1.0 == pytest.approx(added, rel=1e-3, abs=1e-8)
    scale = full_friction(case.device) / scales.speed
    assert found.slope / scale == pytest.approx(expected.friction_slope / scale, abs=2e-5)
    assert 0.0 < found.fast_multiplier < 1.0


def test_the_fast_multiplier_is_that_of_the_resonator() -> None:
    """0.966 a period at a damping ratio of 0.005: friction hardly adds to it."""
    case = CASES["low damping"]
    orbit = held_orbit_at(case.map, 0.0, 0.1)
    found = held_orbit_linearised(case.map, orbit)
    decay = case.map.held.plant.slip.decay * case.map.period
    assert found.fast_multiplier == pytest.approx(np.exp(-decay), abs=1e-4)


@pytest.mark.parametrize("device", [TABLE_1, FLIGHT, BRISTLES])
def test_a_neighbour_leads_to_the_same_orbit_with_fewer_maps(device: Device) -> None:
    scales = period_map(device, 1.0, 1)
    neighbour = held_orbit_linearised(scales, held_orbit_at(scales, 0.3, 0.05))
    cold, near = held_orbit_at(scales, 0.3, 0.06), held_orbit_at(scales, 0.3, 0.06, neighbour)
    full = full_friction(device)
    tolerance = 1e-8 if device.friction_law else 1e-12
    assert near.friction / full == pytest.approx(cold.friction / full, abs=tolerance)
    assert near.maps <= 6 < cold.maps <= 12


def test_a_neighbour_that_moves_the_other_way() -> None:
    scales = period_map(TABLE_1, 1.0, 1)
    orbit = held_orbit_at(scales, 0.0, 0.2)
    for velocity in (0.1, 0.0, -0.1, -0.2):
        orbit = held_orbit_at(scales, 0.0, velocity, orbit)
        assert orbit.friction == pytest.approx(
            held_orbit_at(scales, 0.0, velocity).friction, abs=1e-12
        )


@pytest.mark.parametrize("device", [TABLE_1, FLIGHT, BRISTLES])
@pytest.mark.parametrize("velocity", [0.5, -0.5, 3.0])
def test_beyond_grazing_friction_is_its_mean_and_does_not_slope(
    device: Device, velocity: float
) -> None:
    scales = period_map(device, 1.0, 1)
    orbit = held_orbit_linearised(scales, held_orbit_at(scales, 0.4, velocity))
    assert orbit.reversals == 0
    assert orbit.friction == np.copysign(scales.sliding_friction(0.4), velocity)
    # One last digit of the travel in a turn, over the step of the difference.
    assert orbit.slope == pytest.approx(0.0, abs=5e-7 * (1.0 + abs(velocity)))
    assert orbit.factor == pytest.approx(1.0, abs=1e-8)


def test_the_load_of_an_orbit_makes_it_steady() -> None:
    for device in (TABLE_1, FLIGHT, BRISTLES):
        scales = period_map(device, 1.0, 1)
        held = held_orbit_at(scales, 0.3, 0.1)
        near = held_orbit_at(scales, 0.3, 0.08)
        steady = steady_orbit_at(scales, 0.3, -held.friction, near)
        assert steady.velocity == pytest.approx(0.1, abs=1e-9)


def failure(scales: PeriodMap, velocity: float) -> OrbitStatus:
    with pytest.raises(NoOrbitError) as caught:
        held_orbit_linearised(scales, held_orbit_at(scales, 0.3, velocity))
    return caught.value.status


def test_reasons_why_there_is_no_orbit() -> None:
    undamped = replace(TABLE_1, damping_ratio=0.0)
    assert failure(period_map(undamped, 1.0, 1), 0.1) is OrbitStatus.UNDAMPED
    idle = replace(TABLE_1, base_amplitude=0.0)
    assert failure(period_map(idle, 1.0, 1), 0.1) is OrbitStatus.STILL
    stuck = replace(TABLE_1, friction_coefficient=1000.0, normal_amplitude=0.5)
    assert failure(period_map(stuck, 1.0, 1), 0.0) is OrbitStatus.STILL


def test_bristles_that_follow_no_faster_than_the_velocity_changes_have_no_slow_motion() -> None:
    """The multipliers of slow velocity and bristle are a pair of complex ones: there is no mass."""
    scales = period_map(SOFT_BRISTLE, 0.0, 1)
    orbit = held_orbit_at(scales, 1.5, 0.0)
    with pytest.raises(NoOrbitError) as caught:
        held_orbit_linearised(scales, orbit)
    assert caught.value.status is OrbitStatus.NOT_SLOW
    unloaded = held_orbit_at(scales, 4.5, 0.0)
    assert held_orbit_linearised(scales, unloaded).factor > 1.0, "next to no normal load bends them"
