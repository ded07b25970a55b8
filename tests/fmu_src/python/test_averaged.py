"""Averaged theory against the paper's formulas and the figures that were measured for them."""

from __future__ import annotations

import math
from dataclasses import asdict, replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fmu_src.python.slider_component.device import Device, equivalent_force
from fmu_src.python.slider_component.parameters import Inputs
from fmu_src.python.slider_component.prediction import first_order
from slider_resonator.device.device import Device as ReferenceDevice
from slider_resonator.references.averaged.prediction_validity import prediction_valid

TABLE_1 = Device()
FAST_VELOCITY = abs(equivalent_force(TABLE_1)) / 1.1 / 3500.0
LAG = 0.733313


def test_equivalent_force_of_table_1() -> None:
    force = equivalent_force(TABLE_1)
    assert abs(force) == pytest.approx(910.947, abs=5e-4)
    assert -math.atan2(force.imag, force.real) == pytest.approx(LAG, abs=5e-7)


def test_table_1() -> None:
    theory = first_order(TABLE_1, Inputs(), 0.0)
    assert theory.steady_velocity == pytest.approx(0.126731, abs=5e-7)
    assert theory.blocking_force == pytest.approx(0.085222, abs=5e-7)


@pytest.mark.parametrize("phase", [-2.0, 0.0, 0.4, 1.5])
@pytest.mark.parametrize("load", [-0.05, 0.0, 0.05])
def test_load_speed_curve_is_equation_20(phase: float, load: float) -> None:
    theory = first_order(TABLE_1, Inputs(phase, load), 0.0)
    turning = math.acos(theory.steady_velocity / FAST_VELOCITY)
    lead = math.sin(turning) * math.sin(phase + LAG)
    balance = 1.0 - 2.0 / math.pi * turning - 2.0 / math.pi * lead + load / 0.2
    assert balance == pytest.approx(0.0, abs=2e-6)
    assert theory.blocking_force == pytest.approx(
        2.0 / math.pi * 0.2 * math.sin(phase + LAG), rel=2e-6
    )


@pytest.mark.parametrize("ratio", [1.0, 3.0, -1.0, 2.0, 0.0, 1.37])
@pytest.mark.parametrize("amplitude", [0.7, 2.5])
def test_mean_friction_by_quadrature(ratio: float, amplitude: float) -> None:
    """At the steady velocity, with flight, friction and load cancel over the phases met."""
    device = replace(TABLE_1, normal_amplitude=amplitude)
    inputs = Inputs(0.3, 0.02, ratio)
    velocity = first_order(device, inputs, 0.0).steady_velocity
    angles = (np.arange(400_000) + 0.5) / 400_000 * math.tau
    if ratio == round(ratio):
        load = np.maximum(0.0, 1.0 + amplitude * np.sin(ratio * (angles + LAG) + 0.3))
    else:
        load = np.maximum(0.0, 1.0 + amplitude * np.sin(angles)).mean(keepdims=True)
    sliding = np.sign(velocity - FAST_VELOCITY * np.cos(angles))
    assert np.mean(0.2 * load * sliding) == pytest.approx(-0.02, abs=3e-6)


def test_lead_of_the_normal_drive_counts_as_phase() -> None:
    assert first_order(TABLE_1, Inputs(0.1), 0.3) == first_order(TABLE_1, Inputs(0.4), 0.0)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_overload_saturates(sign: float) -> None:
    theory = first_order(TABLE_1, Inputs(load=0.3 * sign), 0.0)
    assert theory.steady_velocity == pytest.approx(-sign * FAST_VELOCITY, rel=1e-12)


def test_undamped_resonance_has_no_steady_velocity() -> None:
    """The slipping resonance is at wn (1 - m / (M + m))^(-1/2), here 2 wn."""
    resonant = Device(
        damping_ratio=0.0,
        slider_mass=1.0 / 3.0,
        resonator_mass=1.0,
        resonator_frequency=8.0,
        drive_frequency=16.0,
    )
    assert first_order(resonant, Inputs(), 0.0).steady_velocity == 0.0


devices = st.builds(
    Device,
    resonator_mass=st.sampled_from([0.0, 0.1, 3.0]),
    resonator_frequency=st.floats(500.0, 9000.0),
    damping_ratio=st.sampled_from([0.0, 0.05, 1.5]),
    normal_preload=st.sampled_from([0.0, 0.3, 1.0]),
    normal_amplitude=st.sampled_from([0.0, 0.5, 2.0]),
    base_amplitude=st.floats(-11.0, -4.0).map(lambda decade: 10.0**decade),
    tangential_force=st.sampled_from([0.0, 0.1, -3.0]),
    friction_law=st.sampled_from([0, 1]),
    bristle_stiffness=st.sampled_from([1e3, 1e6, 1e9]),
)


@given(
    devices,
    st.floats(-3.0, 3.0),
    st.floats(-0.3, 0.3),
    st.sampled_from([0.0, 1.0, 1.5, 2.0, math.pi, -3.0]),
)
def test_validity_is_that_of_the_reference(
    device: Device, phase: float, load: float, ratio: float
) -> None:
    reference = ReferenceDevice.from_mapping(asdict(device))
    expected = prediction_valid(reference, phase, load, ratio)
    assert first_order(device, Inputs(phase, load, ratio), 0.0).valid == expected
