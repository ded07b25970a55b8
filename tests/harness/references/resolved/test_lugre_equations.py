from __future__ import annotations

import math

import numpy as np
import pytest

from slider_resonator.device.device import Device
from slider_resonator.references.resolved.lugre_equations import lugre_equations_of


def test_friction_follows_equation_8_on_every_face() -> None:
    device = Device(friction_faces=2, bristle_stiffness=3e4, bristle_damping=7.0)
    lugre = lugre_equations_of(device)
    velocity = np.array([-0.3, 0.0, 0.02])
    deflection = np.array([2e-6, -1e-6, 3e-6])
    angle = np.array([0.0, 1.0, -2.0])
    normal = device.normal_preload + device.normal_amplitude * np.sin(angle)
    rate = velocity - 3e4 * np.abs(velocity) * deflection / device.friction_coefficient
    expected = 2.0 * normal * (3e4 * deflection + 7.0 * rate)
    found = lugre.friction_force(velocity, deflection / lugre.max_deflection, angle)
    np.testing.assert_allclose(found, expected, rtol=1e-13, err_msg="F = faces N (s0 z + s1 z')")


def test_open_contact_has_no_friction() -> None:
    lugre = lugre_equations_of(Device(normal_amplitude=2.0))
    force = lugre.friction_force(np.array([0.1]), np.array([0.5]), np.array([-0.5 * math.pi]))
    assert force[0] == 0.0, "bristles that touch nothing exert no force"


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("friction_coefficient", 0.0),
        ("friction_coefficient", -0.1),
        ("bristle_stiffness", 0.0),
        ("bristle_stiffness", math.inf),
        ("bristle_damping", -1.0),
        ("bristle_damping", math.nan),
        ("fidelity", 0),
    ],
)
def test_invalid_lugre_parameters_are_refused(name: str, value: float) -> None:
    with pytest.raises(ValueError, match=name):
        lugre_equations_of(Device(**{name: value}))  # type: ignore[arg-type]
