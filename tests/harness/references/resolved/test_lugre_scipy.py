from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved import lugre_scipy, lugre_taylor
from tests.harness.references.comparing import assert_agree
from tests.harness.references.lugre_problems import (
    DURATION,
    PROBLEMS,
    STIFF,
    TIMES,
    constant,
)

QUICK = ("table 1", "ratio 1.37, lift-off", "deep presliding", "schedule", "1e6")


@pytest.mark.parametrize(
    "name",
    [
        pytest.param(name, marks=() if name in QUICK else pytest.mark.slow)
        for name in [*PROBLEMS, *STIFF]
    ],
)
def test_lsoda_agrees_with_taylor(name: str) -> None:
    device, held = (PROBLEMS | STIFF)[name]
    exact = lugre_taylor.simulate_lugre(device, held, TIMES)
    found = lugre_scipy.simulate_lugre(device, held, TIMES, rtol=1e-13, atol=1e-15)
    assert_agree(exact, found, allowed=1e-8)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["table 1", "ratio 1.37, lift-off", "presliding", "1e6"])
def test_radau_agrees_with_taylor(name: str) -> None:
    device, held = (PROBLEMS | STIFF)[name]
    short = [replace(inputs, stop=0.004) for inputs in held]
    times = np.linspace(0.0, 0.004, 81)
    exact = lugre_taylor.simulate_lugre(device, short, times)
    found = lugre_scipy.simulate_lugre(device, short, times, method="Radau")
    assert_agree(exact, found, allowed=1e-9)


def test_error_falls_with_the_tolerance() -> None:
    device, held = PROBLEMS["table 1"]
    exact = lugre_taylor.simulate_lugre(device, held, TIMES)
    errors = []
    for rtol in (1e-7, 1e-10, 1e-13):
        found = lugre_scipy.simulate_lugre(device, held, TIMES, rtol=rtol, atol=1e-2 * rtol)
        errors.append(float(np.abs(found.velocity - exact.velocity).max()))
    assert errors[1] < 0.1 * errors[0], f"errors {errors} must fall towards the reference"
    assert errors[2] < 0.1 * errors[1], f"errors {errors} must fall towards the reference"


def test_steady_sliding_stretches_the_bristle_to_its_limit() -> None:
    device = Device(base_amplitude=0.0, normal_amplitude=0.0, initial_velocity=-3.0)
    motion = lugre_scipy.simulate_lugre(device, constant(), TIMES)
    assert motion.bristle_deflection[-1] == pytest.approx(-1e-6, rel=1e-9), "z = mu / s0"
    assert motion.friction_force[-1] == pytest.approx(-0.2, rel=1e-9), "F = faces mu N"


def test_unknown_method_is_refused() -> None:
    with pytest.raises(ValueError, match="method = 'RK45'"):
        lugre_scipy.simulate_lugre(Device(), constant(), TIMES, method="RK45")


def test_friction_coefficient_of_zero_is_refused() -> None:
    with pytest.raises(ValueError, match=r"friction_coefficient = 0\.0"):
        lugre_scipy.simulate_lugre(Device(friction_coefficient=0.0), constant(), TIMES)


def test_inputs_with_a_gap_are_refused() -> None:
    held = [HeldInputs(0.0, 0.005), HeldInputs(0.006, DURATION)]
    with pytest.raises(ValueError, match="held inputs 1"):
        lugre_scipy.simulate_lugre(Device(), held, TIMES)
