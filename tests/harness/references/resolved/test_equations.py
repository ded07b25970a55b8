import math
from dataclasses import replace

import numpy as np
import pytest

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.equivalent_force import equivalent_force
from slider_resonator.references.resolved.contact import LIFTED, SLIP_FORWARD, STICK
from slider_resonator.references.resolved.equations import equations_of

TABLE_1 = Device()
DIRECT = replace(TABLE_1, tangential_force=0.7)
STATE = np.array([0.3, -0.2, 1e-4, 0.5])
LOAD, THETA, ANGLE = 0.05, 0.6, 1.1


@pytest.mark.parametrize("mode", [-1, 1, LIFTED])
def test_slopes_satisfy_the_two_equations_of_motion(mode: int) -> None:
    time, ratio = 2e-4, 1.3
    inputs = HeldInputs(0.0, 1.0, load=LOAD, frequency_ratio=ratio)
    slopes = equations_of(DIRECT).slopes(mode, THETA, ANGLE, inputs)(time, STATE)
    _, acceleration, _, resonator = slopes
    theta, angle = THETA + 3500.0 * time, ANGLE + ratio * 3500.0 * time
    drive = 1e-4 * 3500.0**2 * math.sin(theta)
    friction = 0.0 if mode == LIFTED else mode * 0.2 * (1.0 + math.sin(angle))
    momentum = 1.1 * acceleration + 0.1 * (resonator - drive)
    direct = 0.7 * math.sin(theta)
    assert momentum == pytest.approx(direct - friction - LOAD, abs=1e-11), "(26) with load"
    internal = 0.1 * (resonator + acceleration - drive)
    spring = 35.0 * STATE[3] + 1.225e6 * STATE[2]
    assert internal == pytest.approx(-spring, rel=1e-12), "(27)"
    assert slopes[0] == STATE[1]
    assert slopes[2] == STATE[3]


def test_stuck_slider_leaves_the_resonator_its_own_equation() -> None:
    inputs = HeldInputs(0.0, 1.0, load=LOAD)
    slopes = equations_of(TABLE_1).slopes(STICK, THETA, ANGLE, inputs)(0.0, STATE)
    drive = 1e-4 * 3500.0**2 * math.sin(THETA)
    assert slopes[:3] == [0.0, 0.0, STATE[3]]
    own = drive - 350.0 * STATE[3] - 3500.0**2 * STATE[2]
    assert slopes[3] == pytest.approx(own), "(27) with X'' = 0"


def test_contact_forces_of_each_mode() -> None:
    equations = equations_of(replace(DIRECT, normal_amplitude=2.0))
    theta, angle = np.array([THETA]), np.array([ANGLE])
    normal, friction = equations.contact_forces(SLIP_FORWARD, LOAD, theta, angle, STATE[None])
    assert normal == pytest.approx(1.0 + 2.0 * math.sin(ANGLE))
    assert friction == pytest.approx(0.2 * normal), "faces mu N"
    _, held = equations.contact_forces(STICK, LOAD, theta, angle, STATE[None])
    spring = 35.0 * STATE[3] + 1.225e6 * STATE[2]
    assert held == pytest.approx(spring + 0.7 * math.sin(THETA) - LOAD), "all that pulls"
    open_contact = equations.contact_forces(LIFTED, LOAD, theta, angle, STATE[None])
    assert not np.any(open_contact), "no force through an open contact"


@pytest.mark.parametrize("device", [TABLE_1, DIRECT, replace(DIRECT, base_amplitude=0.0)])
def test_fidelity_1_has_the_equivalent_force_of_the_closed_forms(device: Device) -> None:
    equations = equations_of(replace(device, fidelity=1))
    force = equivalent_force(device)
    theta = np.linspace(0.0, 6.0, 13)
    found = equations.needed_force(LOAD, theta, 0.0 * theta, 0.0 * theta)
    expected = force.amplitude * np.sin(theta - force.angle) - LOAD
    assert found == pytest.approx(expected, rel=1e-12), "F_T* sin(theta - theta1) - load, (33)"
    displacement, velocity = equations.resonator_motion(theta, np.zeros((13, 4)))
    turned = theta - force.resonator_angle
    assert displacement == pytest.approx(force.resonator_amplitude * np.sin(turned), rel=1e-9)
    assert velocity == pytest.approx(3500.0 * force.resonator_amplitude * np.cos(turned), rel=1e-9)
    assert equations.inertia == 1.1, "slider and resonator move as one in (33)"


@pytest.mark.parametrize(
    ("parameters", "message"),
    [
        ({"fidelity": 0}, "fidelity = 0"),
        (
            {"fidelity": 1, "damping_ratio": 0.0, "resonator_frequency": 3500.0 / math.sqrt(1.1)},
            r"damping_ratio = 0\.0 .* greater than 0",
        ),
        ({"friction_law": 1, "friction_coefficient": 0.0}, "friction_coefficient"),
        ({"friction_law": 1, "bristle_stiffness": 0.0}, "bristle_stiffness"),
        ({"friction_law": 1, "fidelity": 0}, "fidelity"),
    ],
)
def test_unsupported_devices_are_refused(parameters: dict[str, float], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        equations_of(Device.from_mapping(parameters))


def test_lugre_friction_follows_equation_8_on_every_face() -> None:
    device = Device(friction_law=1, friction_faces=2, bristle_stiffness=3e4, bristle_damping=7.0)
    states = np.zeros((3, 5))
    states[:, 1] = velocity = np.array([-0.3, 0.0, 0.02])
    states[:, 4] = deflection = np.array([2e-6, -1e-6, 3e-6])
    angle = np.array([0.0, 1.0, -2.0])
    normal = device.normal_preload + device.normal_amplitude * np.sin(angle)
    rate = velocity - 3e4 * np.abs(velocity) * deflection / device.friction_coefficient
    expected = 2.0 * normal * (3e4 * deflection + 7.0 * rate)
    _, found = equations_of(device).contact_forces(SLIP_FORWARD, 0.0, np.zeros(3), angle, states)
    np.testing.assert_allclose(found, expected, rtol=1e-13, err_msg="F = faces N (s0 z + s1 z')")
