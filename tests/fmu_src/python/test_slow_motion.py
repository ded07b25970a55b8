"""Averaged motion against the resolved one: its error falls with 1 / Omega, at any step."""

from __future__ import annotations

import itertools
import math
from dataclasses import replace
from typing import Any

import pytest

from fmu_src.python.slider_component.component import motion_of
from fmu_src.python.slider_component.device import Device
from fmu_src.python.slider_component.moment import Moment
from fmu_src.python.slider_component.parameters import Inputs
from tests.fmu_src.python.motions import after

TABLE_1 = Device(fidelity=0, averaging_order=1)
BRISTLES = replace(TABLE_1, friction_law=1, bristle_stiffness=3e3, tolerance=1e-6)
FAST_VELOCITY = 0.2366097


def run(device: Device, inputs: Inputs, periods: int, steps: int = 40) -> Moment:
    law = motion_of(device, inputs)
    moment = law.start()
    for _ in range(steps):
        moment = law.advance(moment, periods * math.tau / device.drive_frequency / steps)
    return moment


def pair(device: Device, inputs: Inputs, periods: int) -> tuple[Moment, Moment]:
    return run(device, inputs, periods), run(replace(device, fidelity=2), inputs, periods)


@pytest.mark.parametrize(
    ("parameters", "inputs"),
    [
        ({}, Inputs()),
        ({}, Inputs(0.4, 0.05)),
        ({}, Inputs(1.5, 0.0, 5.0)),
        ({}, Inputs(0.0, 0.0, 1.002)),
        ({}, Inputs(0.0, 0.0, 1.37)),
        ({}, Inputs(0.6, 0.01, 0.0)),
        ({}, Inputs(0.0, 0.5)),
        ({"normal_amplitude": 2.0}, Inputs(0.4)),
        ({"normal_amplitude": 2.0}, Inputs(1.3, 0.0, 2 / 3)),
        ({"normal_amplitude": 2.0}, Inputs(0.4, 0.0, 0.618)),
        ({"initial_velocity": -1.0}, Inputs(0.4)),
        ({"initial_resonator_displacement": 1e-3}, Inputs(0.4)),
        ({"base_amplitude": 0.0, "tangential_force": 900.0}, Inputs(1.0)),
        ({"bristle_stiffness": 50.0}, Inputs(0.4)),
        ({"bristle_stiffness": 1e5, "bristle_damping": 0.0}, Inputs(0.4, 0.05)),
        ({"bristle_stiffness": 1e8}, Inputs(0.4)),
        ({"bristle_stiffness": 1e4}, Inputs(0.3, 0.0, 1.37)),
        ({"bristle_stiffness": 1e5}, Inputs(0.6, 0.01, 0.0)),
        ({"bristle_stiffness": 1e4, "normal_amplitude": 2.0}, Inputs(0.4, 0.0, 1.5)),
        ({"bristle_stiffness": 1e5}, Inputs(0.4, 0.5)),
    ],
)
def test_against_the_resolved_device(parameters: dict[str, Any], inputs: Inputs) -> None:
    """Within 0.4 % of v_q after a second, half a second with bristles; position accordingly."""
    lugre = "bristle_stiffness" in parameters
    device = replace(BRISTLES if lugre else TABLE_1, **parameters)
    slow, full = pair(device, inputs, 280 if lugre else 560)
    allowed = 0.004 * FAST_VELOCITY
    assert slow.mean_velocity == pytest.approx(full.mean_velocity, abs=allowed)
    # A slaved bristle does not know the path on which it is first bent.
    bending = device.friction_coefficient / device.bristle_stiffness if lugre else 0.0
    assert slow.position == pytest.approx(full.position, abs=allowed + 1.5 * bending)
    assert slow.theta == pytest.approx(full.theta, abs=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize(("device", "periods"), [(TABLE_1, 560), (BRISTLES, 140)])
def test_error_falls_with_the_drive_frequency(device: Device, periods: int) -> None:
    """At equal fast velocity, slow time scale and kappa, the ratio of path and bristle length."""
    errors = []
    for factor in (1.0, 3.0, 9.0):
        faster = replace(
            device,
            bristle_stiffness=device.bristle_stiffness * factor,
            base_amplitude=1e-4 / factor,
            drive_frequency=3500.0 * factor,
            resonator_frequency=3500.0 * factor,
        )
        slow, full = pair(faster, Inputs(), round(periods * factor))
        errors.append(abs(slow.mean_velocity - full.mean_velocity))
    for one, other in itertools.pairwise(errors):
        assert one / other == pytest.approx(3.0, rel=0.15), "averaging errs by 1 / Omega"


def test_instantaneous_outputs_carry_the_vibration() -> None:
    slow, full = pair(TABLE_1, Inputs(), 560)
    assert slow.velocity - slow.mean_velocity == pytest.approx(
        full.velocity - full.mean_velocity, abs=0.005 * FAST_VELOCITY
    )
    assert slow.displacement == pytest.approx(full.displacement, rel=2e-3)
    assert slow.rate == pytest.approx(full.rate, rel=2e-3)


@pytest.mark.parametrize("steps", [1, 7, 400])
def test_any_communication_step(steps: int) -> None:
    one = run(TABLE_1, Inputs(0.3, 0.02), 560, steps)
    other = run(TABLE_1, Inputs(0.3, 0.02), 560, 50)
    assert one.mean_velocity == pytest.approx(other.mean_velocity, abs=1e-8)
    assert one.position == pytest.approx(other.position, abs=1e-8)


def test_a_tuned_drive_makes_no_jump() -> None:
    """The momentum of the pair goes on: with less drive the slow velocity changes by its share."""
    device, inputs = replace(TABLE_1, tangential_force=0.0), Inputs()
    moment = after(0.0123, device, inputs)
    weaker = replace(device, base_amplitude=5e-5)
    tuned = motion_of(weaker, inputs).advance(moment, 1e-9)
    share = device.mass_fraction
    momentum = [m.velocity + share * m.rate for m in (moment, tuned)]
    assert momentum[1] == pytest.approx(momentum[0], abs=1e-6)


@pytest.mark.parametrize(("load", "moves"), [(0.0, False), (0.19, False), (0.3, True)])
def test_without_vibration_it_is_a_block(load: float, moves: bool) -> None:
    still = replace(TABLE_1, base_amplitude=0.0, normal_amplitude=0.0)
    end = run(still, Inputs(load=load), 560)
    assert (end.position != 0.0) is moves
    duration = 560 * math.tau / 3500.0
    expected = -0.5 * max(0.0, load - 0.2) / 1.1 * duration**2
    assert end.position == pytest.approx(expected, rel=1e-9, abs=1e-15)


@pytest.mark.parametrize(("law", "normal_amplitude"), [(0, 0.0), (1, 1.0)])
def test_a_block_without_vibration_slides_to_rest(law: int, normal_amplitude: float) -> None:
    still = replace(
        TABLE_1,
        base_amplitude=0.0,
        normal_amplitude=normal_amplitude,
        friction_law=law,
        initial_velocity=0.05,
    )
    end = run(still, Inputs(), 560)
    assert end.position == pytest.approx(0.05**2 / (2 * 0.2 / 1.1), rel=1e-9)
    assert end.mean_velocity == 0.0
