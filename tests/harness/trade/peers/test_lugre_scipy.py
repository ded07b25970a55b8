from __future__ import annotations

from itertools import pairwise

import pytest

from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.simulate import simulate
from slider_resonator.trade.peers import lugre_scipy
from tests.harness.references.comparing import deviation
from tests.harness.references.lugre_problems import DURATION, PROBLEMS, TIMES

DEVICE, HELD = PROBLEMS["table 1"]


@pytest.mark.parametrize("method", ["LSODA", "Radau"])
def test_error_falls_with_the_tolerance(method: str) -> None:
    exact = simulate(DEVICE, HELD, TIMES)
    errors = []
    for rtol in (1e-4, 1e-7, 1e-10):
        found = lugre_scipy.simulate_lugre(
            DEVICE, HELD, TIMES, method=method, rtol=rtol, atol=1e-2 * rtol
        )
        errors.append(deviation(exact, found, "velocity"))
    for coarse, fine in pairwise(errors):
        assert fine < 0.1 * coarse, f"errors {errors} must fall towards the reference"


def test_unknown_method_is_refused() -> None:
    with pytest.raises(ValueError, match="method = 'RK45': must be one of DOP853, LSODA, Radau"):
        lugre_scipy.simulate_lugre(DEVICE, HELD, TIMES, method="RK45")


def test_inputs_with_a_gap_are_refused() -> None:
    held = [HeldInputs(0.0, 0.005), HeldInputs(0.006, DURATION)]
    with pytest.raises(ValueError, match="held inputs 1"):
        lugre_scipy.simulate_lugre(DEVICE, held, TIMES)
