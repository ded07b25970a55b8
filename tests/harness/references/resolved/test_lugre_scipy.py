from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved import lugre_scipy, lugre_taylor
from tests.harness.references.comparing import assert_agree, deviation
from tests.harness.references.lugre_problems import DURATION, PROBLEMS, STIFF, TIMES, constant

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
        errors.append(deviation(exact, found, "velocity"))
    for coarse, fine in pairwise(errors):
        assert fine < 0.1 * coarse, f"errors {errors} must fall towards the reference"


def test_unknown_method_is_refused() -> None:
    with pytest.raises(ValueError, match="method = 'RK45': must be one of DOP853, LSODA, Radau"):
        lugre_scipy.simulate_lugre(Device(), constant(), TIMES, method="RK45")


def test_inputs_with_a_gap_are_refused() -> None:
    held = [HeldInputs(0.0, 0.005), HeldInputs(0.006, DURATION)]
    with pytest.raises(ValueError, match="held inputs 1"):
        lugre_scipy.simulate_lugre(Device(), held, TIMES)


@pytest.mark.parametrize("name", ["table 1", "ratio 1.37, lift-off", "schedule", "one face"])
def test_reversals_lift_offs_and_touchdowns_are_located(name: str) -> None:
    device, held = PROBLEMS[name]
    exact = lugre_taylor.simulate_lugre(device, held, TIMES)
    found = lugre_scipy.simulate_lugre(device, held, TIMES)
    assert found.modes.tolist() == exact.modes.tolist()
    for times in ("event_times", "reversal_times"):
        of_exact, of_found = getattr(exact, times), getattr(found, times)
        assert len(of_exact) > 4
        assert of_found == pytest.approx(of_exact, abs=1e-10), "5e-8 of a drive period"
