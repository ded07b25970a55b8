from __future__ import annotations

import math

import numpy as np
import pytest

from slider_resonator.device.device import Device
from slider_resonator.references.resolved import simulate as reference
from slider_resonator.trading.peers.located_scipy import simulate
from tests.harness.references.comparing import deviation, until

PERIOD = 2.0 * math.pi / 3500.0


def test_error_falls_with_the_tolerance() -> None:
    times, held = np.linspace(0.0, 10 * PERIOD, 301), until(10 * PERIOD)
    best = reference.simulate(Device(), held, times)

    def error(rtol: float) -> float:
        coarse = simulate(Device(), held, times, rtol=rtol, atol=rtol / 100)
        return deviation(best, coarse, "velocity")

    assert error(1e-4) < 1e-8, "the bound on steps alone gives this, since no event costs an order"
    assert error(1e-11) < 0.05 * error(1e-4), "below that the tolerance decides"
    assert error(1e-12) < 1e-11


@pytest.mark.parametrize("method", ["LSODA", "Radau"])
def test_another_method_finds_the_same_events(method: str) -> None:
    held = until(3 * PERIOD, phase=0.4)
    times = np.linspace(0.0, held[0].stop, 13)
    run = simulate(Device(), held, times, method=method, rtol=1e-7, atol=1e-9, steps_per_period=4)
    expected = reference.simulate(Device(), held, times)
    assert run.event_times == pytest.approx(expected.event_times, abs=1e-6 * PERIOD)
    assert deviation(expected, run, "velocity") < 1e-5
