"""Held orbits of both twins: the C functions and the Python ones."""

from __future__ import annotations

import pytest

from fmu_src.python.slider_component.device import Device
from fmu_src.python.slider_component.held_orbit import (
    NoOrbitError,
    OrbitStatus,
    held_orbit_at,
    held_orbit_linearised,
)
from fmu_src.python.slider_component.orbit_drift import (
    held_orbit_moment,
    held_orbit_offset,
)
from fmu_src.python.slider_component.steady_orbit import steady_orbit
from tests.fmu_src.native_orbits import HELD, STEADY, NativeOrbits, Orbit
from tests.fmu_src.orbit_devices import STICKING, TABLE_1, Case, random_case

THETA = 1.3


def python_orbit(
    case: Case, kind: int, given: float, neighbour: float, excess: float
) -> tuple[int, Orbit | None]:
    scales = case.map
    try:
        if kind == HELD:
            near = held_orbit_at(scales, case.lead, neighbour)
            orbit = held_orbit_at(scales, case.lead, given, near)
            orbit = held_orbit_linearised(scales, orbit)
        else:
            orbit = steady_orbit(scales, case.lead, given)
    except NoOrbitError as error:
        return int(error.status), None
    moment = held_orbit_moment(scales, orbit, excess - orbit.friction, THETA)
    return 0, Orbit(
        orbit.velocity,
        orbit.friction,
        orbit.factor,
        orbit.slope,
        orbit.fast_multiplier,
        orbit.reversals,
        orbit.sticks,
        orbit.maps,
        *moment.state,
        moment.bristle,
        moment.position,
        held_orbit_offset(scales, orbit, moment),
        scales.speed,
    )


def assert_equal(
    native: NativeOrbits, case: Case, kind: int, given: float, neighbour: float, excess: float
) -> None:
    """To 1e-11; what differences tell, whose step is 1e-6, to 1e-8."""
    scales = case.map
    expected_status, expected = python_orbit(case, kind, given, neighbour, excess)
    status, found = native.find(case, kind, given, neighbour=neighbour, excess=excess, theta=THETA)
    assert status == expected_status
    if expected is None:
        assert status == OrbitStatus.NOT_SLOW, "soft bristles alone leave no slow motion"
        return
    assert found.reversals == expected.reversals
    assert found.sticks == expected.sticks
    assert abs(found.maps - expected.maps) <= 1
    full, w = scales.sliding_friction(case.lead), case.device.drive_frequency
    units = {
        "velocity": scales.speed,
        "friction": full,
        "speed": scales.speed,
        "slider_velocity": scales.speed,
        "displacement": scales.swing,
        "rate": scales.swing * w,
        "bristle": case.device.friction_coefficient,
        "position": scales.speed / w,
        "offset": scales.speed,
    }
    tolerance = 1e-11 if excess == 0.0 else 1e-9
    for name, unit in units.items():
        number, twin = getattr(found, name) / unit, getattr(expected, name) / unit
        assert number == pytest.approx(twin, abs=tolerance), name
    for name, unit in {
        "factor": 1.0,
        "fast_multiplier": 1.0,
        "slope": scales.force / scales.speed,
    }.items():
        number, twin = getattr(found, name) / unit, getattr(expected, name) / unit
        assert number == pytest.approx(twin, abs=1e-8), name


@pytest.mark.parametrize("seed", range(20))
def test_held_orbits_are_equal(seed: int, native_orbits: NativeOrbits) -> None:
    case = random_case(seed)
    velocity = case.share * case.map.speed
    assert_equal(native_orbits, case, HELD, velocity, 0.9 * velocity, 0.0)


@pytest.mark.parametrize("seed", range(20, 30))
def test_drifting_moments_are_equal(seed: int, native_orbits: NativeOrbits) -> None:
    case = random_case(seed)
    velocity = case.share * case.map.speed
    excess = 0.2 * case.map.sliding_friction(case.lead)
    assert_equal(native_orbits, case, HELD, velocity, 0.9 * velocity, excess)


@pytest.mark.parametrize("seed", range(30, 36))
def test_steady_motions_are_equal(seed: int, native_orbits: NativeOrbits) -> None:
    case = random_case(seed)
    load = 0.5 * case.share * case.map.sliding_friction(case.lead)
    assert_equal(native_orbits, case, STEADY, load, 0.0, 0.0)


def test_orbits_that_stick_are_equal(native_orbits: NativeOrbits) -> None:
    case = Case(STICKING, 0.3, 1.0, 1, 0.8)
    assert_equal(native_orbits, case, HELD, 0.2, 0.19, 0.0)


@pytest.mark.parametrize(
    ("parameters", "ratio", "kind", "given"),
    [
        ({"damping_ratio": 0.0}, 1.0, HELD, 0.1),
        ({"base_amplitude": 0.0}, 1.0, HELD, 0.1),
        ({"friction_coefficient": 1000.0, "normal_amplitude": 0.5}, 1.0, HELD, 0.0),
        ({}, 1.0, STEADY, 0.3),
        ({"damping_ratio": 0.0}, 1.0, STEADY, 0.0),
        ({"normal_amplitude": 3.0}, 2.0, STEADY, 0.0),
    ],
)
def test_reasons_are_the_same(
    parameters: dict[str, float],
    ratio: float,
    kind: int,
    given: float,
    native_orbits: NativeOrbits,
) -> None:
    case = Case(Device(**parameters), 0.5, ratio, 1, 0.0)  # type: ignore[arg-type]
    status, _ = native_orbits.find(case, kind, given, neighbour=given)
    expected, _ = python_orbit(case, kind, given, given, 0.0)
    assert status == expected != 0


def test_a_device_without_friction_law_has_no_map(native_orbits: NativeOrbits) -> None:
    case = Case(Device(friction_law=1, friction_coefficient=0.0), 0.0, 1.0, 1, 0.0)
    assert native_orbits.find(case, HELD, 0.1)[0] == -1


@pytest.mark.parametrize("law", [0, 1])
def test_orbits_from_a_neighbour_are_cheap(law: int, native_orbits: NativeOrbits) -> None:
    """Up to five maps, and those of the linearisation."""
    case = Case(
        Device(friction_law=law, friction_coefficient=TABLE_1.friction_coefficient),
        0.0,
        1.0,
        1,
        0.0,
    )
    for velocity in (-0.1, 0.0, 0.05, 0.1, 0.15):
        _, orbit = native_orbits.find(case, HELD, velocity, neighbour=velocity - 0.01)
        assert orbit.maps <= 5 + case.map.states + 2
