from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.averaged import added_mass
from slider_resonator.references.averaged.added_mass import slow_linearisation
from slider_resonator.references.averaged.held_orbit import HeldOrbit, held_orbit
from slider_resonator.references.averaged.held_orbit_that_sticks import any_held_orbit
from slider_resonator.references.averaged.hold import Hold
from slider_resonator.references.resolved import lugre_taylor, taylor

BRISTLES = Device(friction_law=1)


def period_map_multipliers(orbit: HeldOrbit) -> NDArray[np.complex128]:
    """The multipliers of (X', Y, Y', z) over a period under an orbit's load, by differences."""
    hold = orbit.hold
    device = hold.device
    speed = hold.vibration.velocity_amplitude
    reach = speed / device.drive_frequency
    deflection = device.friction_coefficient / device.bristle_stiffness
    scales = np.array([speed, reach, speed, deflection])[: 4 if device.friction_law else 3]
    origin = np.zeros(1)
    bristles = device.friction_law == 1
    signals = [orbit.slider_velocity, orbit.resonator_displacement, orbit.resonator_velocity]
    if bristles:
        signals.append(deflection * orbit.bristle.stretch)
    start = np.array([orbit.panels.at(values, origin)[0] for values in signals])
    stop = hold.period / device.drive_frequency
    held = [HeldInputs(0.0, stop, hold.lead, -orbit.mean_friction, hold.ratio)]

    def after(state: np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> list[float]:
        begun = replace(
            device,
            initial_velocity=state[0],
            initial_resonator_displacement=state[1],
            initial_resonator_velocity=state[2],
            initial_bristle_deflection=state[3] if bristles else 0.0,
        )
        simulate = lugre_taylor.simulate_lugre if bristles else taylor.simulate
        end = simulate(begun, held, np.array([stop]))
        names = ["velocity", "resonator_displacement", "resonator_velocity", "bristle_deflection"]
        return [getattr(end, name)[0] for name in names[: len(state)]]

    step = 1e-5
    slopes = [
        (np.array(after(start + step * unit * scales)) - after(start - step * unit * scales))
        / (2.0 * step * scales)
        for unit in np.eye(len(start))
    ]
    return np.linalg.eigvals(np.column_stack(slopes)).astype(np.complex128)


COULOMB = Device(friction_coefficient=5.0, resonator_frequency=3340.0, damping_ratio=0.02)


@pytest.mark.parametrize(
    "device",
    [
        *(
            replace(BRISTLES, friction_coefficient=1.0, bristle_stiffness=stiffness)
            for stiffness in (1e3, 1e4, 1e6)
        ),
        COULOMB,
        replace(COULOMB, normal_amplitude=1.8),
    ],
    ids=["soft", "medium", "hard", "Coulomb", "Coulomb, flight"],
)
def test_the_multiplier_is_that_of_the_period_map(device: Device) -> None:
    orbit = held_orbit(Hold(device, 0.1, 0.7))
    multipliers = period_map_multipliers(orbit)
    slow = multipliers[np.argmax(multipliers.real)]
    found = slow_linearisation(orbit)
    assert found.multiplier == pytest.approx(slow.real, abs=2e-9)
    duration = orbit.hold.period / device.drive_frequency
    added = -device.total_mass * math.log(slow.real) / (duration * found.friction_slope) - 1.0
    assert found.added_mass == pytest.approx(added, abs=1e-6)


@pytest.mark.parametrize(
    "device",
    [COULOMB, replace(BRISTLES, bristle_stiffness=1e2), replace(BRISTLES, bristle_stiffness=1e5)],
)
def test_the_slope_is_that_of_the_mean_friction(device: Device) -> None:
    step = 1e-5
    above, below = (held_orbit(Hold(device, 0.1 + sign * step)) for sign in (1.0, -1.0))
    slope = (above.mean_friction - below.mean_friction) / (2.0 * step)
    found = slow_linearisation(held_orbit(Hold(device, 0.1))).friction_slope
    assert found == pytest.approx(slope, rel=1e-5)


@pytest.mark.parametrize(
    ("stiffness", "size"), [(1e3, 7e-3), (1e4, 8.1e-4), (1e5, 6e-5), (1e7, 9e-7)]
)
def test_the_added_mass_falls_with_the_stiffness(stiffness: float, size: float) -> None:
    device = replace(BRISTLES, bristle_stiffness=stiffness)
    added = slow_linearisation(held_orbit(Hold(device, 0.1))).added_mass
    assert abs(added) == pytest.approx(size, rel=0.1)


def test_the_drift_of_a_period_gives_the_same_where_the_decay_is_slow(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    orbit = held_orbit(Hold(replace(BRISTLES, bristle_stiffness=1e4), 0.1))
    exact = slow_linearisation(orbit)
    monkeypatch.setattr(added_mass, "_FLAT", 1.0)
    drifted = slow_linearisation(orbit)
    decay = 1.0 - exact.multiplier
    assert drifted.added_mass == pytest.approx(exact.added_mass, abs=decay**2)
    assert drifted.multiplier == pytest.approx(exact.multiplier, abs=decay**3)


def test_it_stays_finite_where_the_friction_is_flat() -> None:
    device = replace(BRISTLES, bristle_stiffness=1e4)
    found = slow_linearisation(held_orbit(Hold(device, 0.3)))
    assert abs(found.friction_slope) < 1e-9
    assert found.multiplier == pytest.approx(1.0, abs=1e-9)
    assert found.added_mass == pytest.approx(0.0, abs=1e-9)


def test_an_orbit_found_by_shooting_is_refused() -> None:
    sticky = Hold(Device(friction_coefficient=150.0), 0.1, 0.7)
    with pytest.raises(ValueError, match="found by shooting"):
        slow_linearisation(any_held_orbit(sticky, simulate=taylor.simulate))


def test_a_motion_that_friction_stops_at_once_is_not_slow() -> None:
    device = replace(
        BRISTLES, normal_preload=600.0, normal_amplitude=100.0, resonator_frequency=900.0
    )
    with pytest.raises(RuntimeError, match=r"nothing is slow|does not converge"):
        slow_linearisation(held_orbit(Hold(device, 0.0)))
