from __future__ import annotations

import numpy as np
import pytest

from slider_resonator.device.device import Device
from slider_resonator.references.averaged.bristle_path import BristlePath, bristle_path
from slider_resonator.references.averaged.hold import Hold
from slider_resonator.references.averaged.panels import Panels
from slider_resonator.references.averaged.reversals import sign_changes

Array = np.ndarray[tuple[int, ...], np.dtype[np.float64]]


def path_of(device: Device, velocity: float, change: float = 0.0) -> BristlePath:
    """The bristle under V - v_q cos(theta) + change sin(3 theta)."""
    hold = Hold(device, velocity)

    def at(theta: Array) -> Array:
        ripple = hold.vibration.velocity_amplitude * np.cos(theta)
        return velocity - ripple + change * np.sin(3.0 * theta)

    reversals = sign_changes(at, hold.period)
    finest = 0.05 if len(reversals) else 1.0
    panels = hold.panels(reversals, float(reversals[0]) if len(reversals) else 0.0, finest)
    return bristle_path(device, panels, at(panels.nodes), reversals)


@pytest.mark.parametrize("stiffness", [1e2, 1e4, 1e5])
def test_the_stretch_repeats_and_obeys_its_equation(stiffness: float) -> None:
    device = Device(friction_law=1, bristle_stiffness=stiffness)
    path = path_of(device, 0.05)
    rate = stiffness / device.friction_coefficient / device.drive_frequency
    slope = rate * (path.velocity - np.abs(path.velocity) * path.stretch)
    gained, at_edges = path.panels.integral(slope)
    first = path.panels.at(path.stretch, np.array([path.panels.start]))[0]
    assert path.stretch == pytest.approx(first + gained, abs=1e-10)
    assert at_edges[-1] == pytest.approx(0.0, abs=1e-10)


def test_the_variation_is_the_difference_of_neighbours() -> None:
    device = Device(friction_law=1, bristle_stiffness=3e3)
    path = path_of(device, 0.05)
    step = 1e-6
    angles = np.linspace(0.1, 6.0, 9)

    def there(near: BristlePath) -> Array:
        return near.panels.at(near.friction(), angles)

    differences = (there(path_of(device, 0.05, step)) - there(path_of(device, 0.05, -step))) / (
        2.0 * step
    )
    _, friction = path.variation(np.sin(3.0 * path.panels.nodes))
    assert path.panels.at(friction, angles) == pytest.approx(differences, rel=1e-6)


def test_a_variation_that_drifts_gains_the_jump() -> None:
    path = path_of(Device(friction_law=1, bristle_stiffness=1e2), 0.05)
    stretch, _ = path.variation(np.zeros_like(path.velocity), jump=0.1)
    panels: Panels = path.panels
    begin = panels.at(stretch, np.array([panels.start]))[0]
    end = panels.at(stretch, np.array([panels.start - 1e-9]))[0]
    assert end - begin == pytest.approx(0.1, rel=1e-6)


def test_without_reversal_the_stretch_is_that_of_steady_sliding() -> None:
    path = path_of(Device(friction_law=1), -0.5)
    assert (path.stretch == -1.0).all()
    assert path.friction() == pytest.approx(-np.ones_like(path.stretch))
