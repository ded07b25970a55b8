from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.averaged.averaged_coulomb import device_steady_velocity_at_ratio
from slider_resonator.references.averaged.held_orbit import (
    HeldOrbit,
    NoSlidingOrbitError,
    held_orbit,
)
from slider_resonator.references.averaged.held_orbit_that_sticks import (
    any_held_orbit,
    held_orbit_by_shooting,
)
from slider_resonator.references.averaged.hold import Hold
from slider_resonator.references.resolved import lugre_taylor, taylor
from slider_resonator.references.resolved.trajectory import Trajectory

TABLE_1 = Device()
BRISTLES = replace(TABLE_1, friction_law=1)
STRONG = replace(TABLE_1, friction_coefficient=5.0)
FLIGHT = replace(TABLE_1, friction_coefficient=1.0, normal_amplitude=1.8)


def steady_velocity(device: Device, lead: float, load: float, ratio: float) -> float:
    def excess(velocity: float) -> float:
        return held_orbit(Hold(device, velocity, lead, ratio)).mean_friction + load

    return float(brentq(excess, -0.15, 0.15, xtol=1e-12))


def repeated(orbit: HeldOrbit) -> Trajectory:
    """The resolved motion over a period that starts on an orbit, sampled at the panels' nodes."""
    hold = orbit.hold
    origin = np.zeros(1)
    velocity, displacement, swing = (
        float(orbit.panels.at(values, origin)[0])
        for values in (
            orbit.slider_velocity,
            orbit.resonator_displacement,
            orbit.resonator_velocity,
        )
    )
    device = replace(
        hold.device,
        initial_velocity=velocity,
        initial_resonator_displacement=displacement,
        initial_resonator_velocity=swing,
    )
    stop = hold.period / device.drive_frequency
    held = [HeldInputs(0.0, stop, hold.lead, -orbit.mean_friction, hold.ratio)]
    times = np.linspace(0.0, stop, 41)
    if device.friction_law == 0:
        return taylor.simulate(device, held, times)
    stretch = float(orbit.panels.at(orbit.bristle.stretch, origin)[0])
    deflection = stretch * device.friction_coefficient / device.bristle_stiffness
    return lugre_taylor.simulate_lugre(
        replace(device, initial_bristle_deflection=deflection), held, times
    )


@pytest.mark.parametrize(
    ("lead", "load", "ratio", "velocity"),
    [
        (0.0, 0.0, 1.0, 0.126666997),
        (0.4, 0.05, 1.0, 0.0986951),
        (0.4, 0.0, 3.0, -0.0362968),
    ],
)
def test_the_steady_velocity_is_that_of_the_full_device(
    lead: float, load: float, ratio: float, velocity: float
) -> None:
    found = steady_velocity(TABLE_1, lead, load, ratio)
    assert found == pytest.approx(velocity, abs=6e-8 if velocity < 0.12 else 6e-10)
    first_order = device_steady_velocity_at_ratio(TABLE_1, lead, ratio, load)
    assert abs(first_order - velocity) > 1e-5, "which the first order is not"


def test_the_blocking_force_is_that_of_the_full_device() -> None:
    assert -held_orbit(Hold(TABLE_1, 0.0)).mean_friction == pytest.approx(0.0851861, abs=6e-8)


CASES = {
    "table 1": Hold(TABLE_1, 0.1, 0.7),
    "table 1, ratio 3": Hold(TABLE_1, -0.1, 0.7, 3.0),
    "table 1, ratio -1": Hold(TABLE_1, 0.1, 0.7, -1.0),
    "table 1, ratio 0": Hold(TABLE_1, 0.1, 0.7, 0.0),
    "strong": Hold(STRONG, 0.2, 0.7),
    "flight": Hold(FLIGHT, 0.1, 0.7),
    "flight, ratio 3/2": Hold(FLIGHT, 0.1, 0.7, 1.5, 2),
    "next to grazing": Hold(STRONG, 0.2363, 0.7),
    "heavy soft resonator": Hold(
        replace(STRONG, resonator_mass=1.5, resonator_frequency=600.0, damping_ratio=1.2), 0.01, 0.7
    ),
    "driven slider": Hold(replace(TABLE_1, tangential_force=300.0), 0.05, -0.7),
    "soft bristles": Hold(replace(BRISTLES, bristle_stiffness=1e2), 0.1, 0.7),
    "medium bristles": Hold(replace(BRISTLES, bristle_stiffness=1e4), -0.1, 0.7),
    "hard bristles": Hold(replace(BRISTLES, bristle_stiffness=1e7), 0.1, 0.7),
    "bristles in flight": Hold(replace(FLIGHT, friction_law=1, bristle_stiffness=1e6), 0.1, 0.7),
}


@pytest.mark.parametrize("name", CASES)
def test_the_full_device_under_the_load_repeats_the_orbit(name: str) -> None:
    orbit = held_orbit(CASES[name])
    motion = repeated(orbit)
    device = orbit.hold.device
    theta = motion.time * device.drive_frequency
    speed = orbit.hold.vibration.velocity_amplitude
    for values, resolved, scale in (
        (orbit.slider_velocity, motion.velocity, speed),
        (orbit.resonator_velocity, motion.resonator_velocity, speed),
        (
            orbit.resonator_displacement,
            motion.resonator_displacement,
            speed / device.drive_frequency,
        ),
    ):
        assert orbit.panels.at(values, theta) == pytest.approx(resolved, abs=2e-10 * scale)
    way = orbit.hold.velocity * float(motion.time[-1])
    assert motion.position[-1] == pytest.approx(way, abs=1e-11 * speed)


def test_an_orbit_is_the_same_from_a_neighbour_and_found_sooner() -> None:
    cold = held_orbit(Hold(STRONG, 0.1, 0.7))
    warm = held_orbit(Hold(STRONG, 0.1, 0.7), held_orbit(Hold(STRONG, 0.0999, 0.7)))
    assert warm.mean_friction == pytest.approx(cold.mean_friction, rel=1e-12)
    assert warm.iterations < cold.iterations


def test_the_momentum_excess_is_the_response_to_friction() -> None:
    orbit = held_orbit(Hold(STRONG, 0.1, 0.7))
    panels, device = orbit.panels, orbit.hold.device
    carried = orbit.slider_velocity + device.mass_ratio * orbit.resonator_velocity
    push = device.resonator_mass * device.base_amplitude * device.drive_frequency
    whole = carried + push / device.total_mass * np.cos(panels.nodes)
    assert whole - 0.1 == pytest.approx(orbit.momentum_excess, abs=1e-14)
    assert panels.mean(orbit.centre_excess) == pytest.approx(0.0, abs=1e-18)


@pytest.mark.parametrize("device", [FLIGHT, replace(FLIGHT, friction_law=1)])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_beyond_grazing_the_friction_is_that_of_sliding(device: Device, sign: float) -> None:
    hold = Hold(device, 0.3 * sign, 0.7)
    theta = np.linspace(0.0, 2.0 * np.pi, 100_001)[:-1]
    full = float(hold.friction_limit(theta).mean())
    orbit = held_orbit(hold)
    assert orbit.mean_friction == pytest.approx(sign * full, rel=1e-8)
    assert not len(orbit.reversals)


STICKY = replace(TABLE_1, friction_coefficient=150.0)


@pytest.mark.parametrize("velocity", [0.0, 0.15])
def test_an_orbit_with_sticking_is_found_by_shooting(velocity: float) -> None:
    hold = Hold(STICKY, velocity, 0.7)
    with pytest.raises(NoSlidingOrbitError, match=r"sticks|converge"):
        held_orbit(hold)
    orbit = any_held_orbit(hold, simulate=taylor.simulate)
    assert (orbit.slider_velocity == 0.0).any()
    motion = repeated(orbit)
    assert motion.stick_time > 0.0
    speed = hold.vibration.velocity_amplitude
    assert motion.velocity[-1] == pytest.approx(motion.velocity[0], abs=1e-8 * speed)
    way = velocity * float(motion.time[-1])
    assert motion.position[-1] == pytest.approx(way, abs=1e-10 * speed)
    assert orbit.panels.mean(orbit.friction) == pytest.approx(orbit.mean_friction, rel=1e-8)


@pytest.mark.parametrize("hold", [Hold(STRONG, 0.1, 0.7), Hold(FLIGHT, 0.1, 0.7, 1.5, 2)])
def test_shooting_finds_the_orbit_of_the_iteration(hold: Hold) -> None:
    iterated, shot = held_orbit(hold), held_orbit_by_shooting(hold, 0.0)
    assert shot.mean_friction == pytest.approx(iterated.mean_friction, rel=1e-9)
    theta = np.linspace(0.0, hold.period, 17)
    for name in ("slider_velocity", "momentum_excess", "centre_excess", "resonator_displacement"):
        values = [orbit.panels.at(getattr(orbit, name), theta) for orbit in (iterated, shot)]
        assert values[1] == pytest.approx(values[0], rel=1e-8, abs=1e-10), name


def test_what_has_no_orbit_is_refused() -> None:
    with pytest.raises(ValueError, match=r"damping_ratio = 0\.0"):
        Hold(replace(TABLE_1, damping_ratio=0.0, resonator_frequency=2000.0), 0.0)
    with pytest.raises(ValueError, match=r"ratio = 1\.37"):
        Hold(TABLE_1, 0.0, ratio=1.37)
