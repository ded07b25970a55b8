from __future__ import annotations

from math import asin, cos, pi

import pytest

from slider_resonator.device.device import Device
from slider_resonator.fmu.instance import Instance
from slider_resonator.references.averaged.uniform_average import LugreCase
from slider_resonator.references.equivalent_force import equivalent_force
from studies.paper import mapping
from studies.paper.measure import record
from studies.paper.slow_theory import length_scale, strength_of


def _device(values: mapping.Values) -> Device:
    return Device.from_mapping({k: v for k, v in values.items() if k != "phase"})


@pytest.mark.parametrize("frequency", [10.0, 1000.0])
def test_coulomb_case_is_in_the_paper_s_units(frequency: float) -> None:
    device = _device(mapping.coulomb_case(1.5, frequency))
    force = equivalent_force(device)
    assert length_scale(device) == 1.0, "x0 = mu N0 / (m w0^2) = 1 m"
    assert strength_of(device) == pytest.approx(1.5, rel=1e-12), "q = F_T / Omega"
    assert force.angle == 0.0, "the drive acts on the slider itself"


def test_lugre_case_keeps_mu_and_the_drive() -> None:
    case = LugreCase(strength=2.0, friction_coefficient=0.3, damping=0.7)
    device = _device(mapping.lugre_case(case, 50.0, 100.0))
    assert (device.friction_law, device.bristle_stiffness, device.bristle_damping) == (1, 100, 0.7)
    assert device.normal_preload / device.total_mass == 1.0, "x0 = N0 / (m w0^2) = 1 m"
    assert equivalent_force(device).velocity_amplitude == pytest.approx(2.0, rel=1e-12)
    assert device.friction_coefficient == 0.3


def test_resonator_case_is_in_the_paper_s_units() -> None:
    values = mapping.resonator_case(
        0.1, 100.0, 90.0, 0.01, amplitude_ratio=0.8, phase=0.85, damping_ratio=0.05
    )
    device = _device(values)
    assert length_scale(device) == 1.0, "x0 = 2 mu N0 / ((M + m) w0^2) = 1 m"
    assert device.mass_ratio == pytest.approx(0.1, rel=1e-15)
    assert values["phase"] == 0.85


def test_table_1_mapped_has_the_strength_of_table_1() -> None:
    """Section 4 against (28)-(29): the same q and phase from a = A / x0 = 0.00055."""
    table = equivalent_force(Device())
    values = mapping.resonator_case(
        1.0 / 11.0, 3500.0, 3500.0, 5.5e-4, amplitude_ratio=1.0, phase=0.0, damping_ratio=0.05
    )
    force = equivalent_force(_device(values))
    assert strength_of(_device(values)) == pytest.approx(strength_of(Device()), rel=1e-12)
    assert force.angle == pytest.approx(table.angle, rel=1e-12)


def test_a_first_swing_of_the_fmu_is_that_of_the_dimensionless_equation(instance: Instance) -> None:
    """From rest (2) sets off with F_T sin(Omega tau) - 1: X' is in closed form while X' > 0."""
    frequency, strength = 10.0, 3.0
    values = mapping.coulomb_case(strength, frequency, amplitude_ratio=0.0)
    run = record(instance, values, pi / frequency, 64)
    start = asin(1.0 / (strength * frequency)) / frequency
    expected = strength * (cos(frequency * start) + 1.0) - (pi / frequency - start)
    assert run["velocity"][-1] == pytest.approx(expected, rel=1e-12)
