"""Motion that drifts along held orbits against resolved motion: its error is of second order."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from fmu_src.python.slider_component.device import Device
from fmu_src.python.slider_component.held_orbit import held_orbit_at, held_orbit_linearised
from fmu_src.python.slider_component.orbit_drift import held_orbit_moment
from tests.fmu_src.native_orbits import HELD, NativeOrbits, Orbit
from tests.fmu_src.orbit_devices import TABLE_1, Case, random_case

NODES = 40
Array = NDArray[np.float64]


@dataclass(frozen=True)
class Errors:
    """Largest errors over v_q of mean and present velocity, that of displacement over its own."""

    mean_velocity: float
    velocity: float
    displacement: float


def tabulated(
    native: NativeOrbits, case: Case, low: float, high: float, load: float
) -> Callable[[str, Array | float], Array]:
    """Numbers of drifting moments over the slow velocity between two velocities in v_q."""
    speed = case.map.speed
    points = np.cos((np.arange(NODES) + 0.5) * math.pi / NODES)
    velocities = speed * (0.5 * (low + high) + 0.5 * (high - low) * points)
    orbits = []
    for velocity in velocities.tolist():
        _, still = native.find(case, HELD, velocity, neighbour=0.5 * (low + high) * speed)
        excess = still.friction + load
        status, orbit = native.find(
            case, HELD, velocity, neighbour=0.5 * (low + high) * speed, excess=excess
        )
        assert status == 0
        orbits.append(orbit)
    fits = {
        name: np.polynomial.Chebyshev.fit(
            velocities, [getattr(orbit, name) for orbit in orbits], NODES - 1
        )
        for name in Orbit.__dataclass_fields__
    }
    return lambda name, velocity: np.asarray(fits[name](velocity))


def errors_of(
    native: NativeOrbits, case: Case, start: float, end: float, time_constants: float = 3.0
) -> Errors:
    """Errors of the slow motion from `start` towards `end` (in v_q), the steady velocity."""
    scales = case.map
    speed, period, mass = scales.speed, scales.period, scales.held.plant.total_mass
    status, last = native.find(case, HELD, end * speed)
    assert status == 0
    load = -last.friction
    periods = max(10, int(time_constants * mass / (last.slope * period)))
    low, high = sorted((start, end))
    look = tabulated(native, case, low - 0.02, high + 0.02, load)

    def slope(time: float, state: Array) -> list[float]:
        force = float(look("friction", state[1])) + load
        return [float(state[1]), -float(look("factor", state[1])) * force / mass]

    times = period * np.arange(periods + 1)
    way, velocity = solve_ivp(
        slope, (0.0, times[-1]), [0.0, start * speed], "DOP853", times, rtol=1e-11, atol=1e-14
    ).y
    states = native.run(case, load, start * speed, periods)
    assert states is not None
    position, slider, displacement, _ = states
    mean = np.diff(way + look("position", velocity)) - np.diff(position)
    return Errors(
        float(np.abs(mean).max()) / (period * speed),
        float(np.abs(look("slider_velocity", velocity) - slider).max()) / speed,
        float(np.abs(look("displacement", velocity) - displacement).max()) / scales.swing,
    )


@pytest.mark.parametrize(
    "parameters",
    [{}, {"friction_law": 1, "bristle_stiffness": 1e6}, {"friction_law": 1, "damping_ratio": 0.3}],
)
def test_the_error_is_of_second_order_in_friction(
    parameters: dict[str, float], native_orbits: NativeOrbits
) -> None:
    """Half the friction, a quarter of the error; that of the resonator falls even faster."""
    device = replace(TABLE_1, tolerance=1e-10, **parameters)  # type: ignore[arg-type]
    rows = []
    for coefficient in (2.0, 1.0, 0.5):
        case = Case(replace(device, friction_coefficient=coefficient), 0.4, 1.0, 1, 0.0)
        errors = errors_of(native_orbits, case, 0.5, -0.2)
        rows.append((errors.mean_velocity, errors.velocity, errors.displacement))
    ratios = np.array(rows[:-1]) / np.array(rows[1:])
    assert (ratios[:, 0] > 3.5).all()
    assert (ratios[:, 0] < 5.5).all()
    assert (ratios[:, 1] > 3.5).all()
    assert (np.array(rows[0]) / np.array(rows[-1]) > 12.0).all()


def test_the_error_of_table_1(native_orbits: NativeOrbits) -> None:
    """1e-8 of v_q in the mean velocity and in the present one."""
    errors = errors_of(native_orbits, Case(TABLE_1, 0.0, 1.0, 1, 0.0), 0.0, 0.5)
    assert errors.mean_velocity < 1e-8
    assert errors.velocity < 1e-8
    assert errors.displacement < 1e-8


def test_without_drift_it_is_the_orbit() -> None:
    case = random_case(3)
    scales = case.map
    orbit = held_orbit_at(scales, case.lead, 0.4 * scales.speed)
    linear = held_orbit_linearised(scales, orbit)
    for theta in (0.0, 1.0, 5.0):
        plain = held_orbit_moment(scales, orbit, 0.3, theta)
        still = held_orbit_moment(scales, linear, -linear.friction, theta)
        assert plain.state == still.state
        assert plain.theta == pytest.approx(theta, abs=1e-12)
        assert plain.position == still.position


def test_an_orbit_of_two_turns_repeats_after_two() -> None:
    case = Case(Device(normal_amplitude=1.8), 0.4, 1.5, 2, 0.0)
    scales = case.map
    orbit = held_orbit_at(scales, case.lead, 0.05)
    first, second, again = (
        held_orbit_moment(scales, orbit, -orbit.friction, 0.5 + turn * math.tau)
        for turn in range(3)
    )
    assert first.state == pytest.approx(again.state, rel=1e-12)
    assert abs(first.state.velocity - second.state.velocity) > 1e-6
