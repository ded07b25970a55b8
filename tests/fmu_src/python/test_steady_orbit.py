"""Steady motion and blocking force as held orbits: exact, against shooting with the references."""

from __future__ import annotations

from dataclasses import replace

import pytest

from fmu_src.python.slider_component.held_orbit import NoOrbitError, OrbitStatus
from fmu_src.python.slider_component.period_map import period_map
from fmu_src.python.slider_component.steady_orbit import blocking_force, steady_orbit
from slider_resonator.references.resolved import located_events, lugre_taylor
from slider_resonator.steady.reference_steady import (
    reference_blocking_force,
    reference_steady_velocity,
)
from tests.fmu_src.orbit_devices import TABLE_1, as_reference, random_case


@pytest.mark.parametrize(
    ("lead", "load", "ratio", "velocity"),
    [
        (0.0, 0.0, 1.0, 0.126666997),
        (0.4, 0.05, 1.0, 0.0986951),
        (0.4, 0.0, 3.0, -0.0362968),
    ],
)
def test_the_known_steady_velocities_of_table_1(
    lead: float, load: float, ratio: float, velocity: float
) -> None:
    found = steady_orbit(period_map(TABLE_1, ratio, 1), lead, load)
    assert found.velocity == pytest.approx(velocity, abs=6e-8 if velocity < 0.12 else 6e-10)
    assert found.friction == pytest.approx(-load, abs=1e-15)


def test_the_known_blocking_force_of_table_1() -> None:
    assert blocking_force(period_map(TABLE_1, 1.0, 1), 0.0) == pytest.approx(0.0851861, abs=5e-8)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(104, 108))
def test_random_devices_against_shooting(seed: int) -> None:
    case = random_case(seed)
    device, scales = as_reference(case.device), case.map
    load = 0.5 * case.share * device.mean_friction
    found = steady_orbit(scales, case.lead, load)
    simulate = lugre_taylor.simulate_lugre if device.friction_law else located_events.simulate
    velocity = reference_steady_velocity(
        device, case.lead, load, case.ratio, found.velocity, simulate=simulate, tolerance=1e-10
    )
    force = reference_blocking_force(
        device, case.lead, case.ratio, simulate=simulate, tolerance=1e-10
    )
    assert velocity is not None
    assert force is not None
    assert found.velocity / scales.speed == pytest.approx(velocity / scales.speed, abs=1e-8)
    full = device.mean_friction
    assert blocking_force(scales, case.lead) / full == pytest.approx(force / full, abs=1e-8)


def status_under(load: float, **parameters: float) -> OrbitStatus:
    scales = period_map(replace(TABLE_1, **parameters), 1.0, 1)  # type: ignore[arg-type]
    with pytest.raises(NoOrbitError) as caught:
        steady_orbit(scales, 0.4, load)
    return caught.value.status


def test_reasons_why_there_is_no_steady_motion() -> None:
    assert status_under(0.21) is OrbitStatus.RUNS_AWAY
    assert status_under(-0.3) is OrbitStatus.RUNS_AWAY
    assert status_under(0.0, damping_ratio=0.0) is OrbitStatus.UNDAMPED


def test_one_of_several_steady_velocities_is_not_chosen() -> None:
    """Two waves of a load that lifts: two velocities are stable, either side of a third."""
    scales = period_map(replace(TABLE_1, normal_amplitude=3.0), 2.0, 1)
    with pytest.raises(NoOrbitError) as caught:
        steady_orbit(scales, 0.5, 0.0)
    assert caught.value.status is OrbitStatus.UNDETERMINED
