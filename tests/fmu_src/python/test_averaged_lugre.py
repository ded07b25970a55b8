"""Quadratures of mean LuGre friction: nodes, many waves, flight; scenes judge the averages."""

from __future__ import annotations

import math

import numpy as np
import pytest

from fmu_src.python.slider_component import mean_friction
from fmu_src.python.slider_component.device import Device
from fmu_src.python.slider_component.mean_friction import (
    MAX_WAVES,
    NODES,
    MeanFriction,
    _gauss_legendre,
)
from fmu_src.python.slider_component.vibrating_load import VibratingLoad


def test_quadrature_rule() -> None:
    nodes, weights = np.polynomial.legendre.leggauss(NODES)
    ours = np.array(sorted(_gauss_legendre(NODES)))
    assert ours[:, 0] == pytest.approx(nodes, abs=1e-15)
    assert ours[:, 1] == pytest.approx(weights, abs=1e-14)


@pytest.mark.parametrize("stiffness", [1e2, 1e4, 1e6, 1e8, 1e10])
@pytest.mark.parametrize("n", [0.0, 1.0, 3.0, 17.0, 50.0])
def test_twice_the_nodes_change_no_mean(
    monkeypatch: pytest.MonkeyPatch, stiffness: float, n: float
) -> None:
    friction = MeanFriction(0.1, stiffness, 0.01, 0.2366, 3500.0)
    load = VibratingLoad(Device(normal_amplitude=1.5), n, 0.7)
    turnings = (1e-3, 0.3, 1.1, 2.0, 3.1)
    means = [friction.mean(load, turning) for turning in turnings]
    monkeypatch.setattr(mean_friction, "_RULE", _gauss_legendre(2 * NODES))
    finer = [friction.mean(load, turning) for turning in turnings]
    assert means == pytest.approx(finer, abs=1e-12 * 0.1)


@pytest.mark.parametrize("n", [1, 3, 50])
@pytest.mark.parametrize("amplitude", [0.8, 2.0])
def test_quadrature_follows_many_waves_and_flight(n: int, amplitude: float) -> None:
    """A bristle this soft keeps its deflection over a turn, and the mean of the load counts."""
    friction = MeanFriction(0.1, 1e-6, 0.0, 0.2366, 3500.0)
    load = VibratingLoad(Device(normal_amplitude=amplitude), float(n), 0.7)
    mean = load.integral(0.0, math.tau) / math.tau
    turning = 1.1
    # A bristle this soft settles where it is bent forward as much as backward per turn.
    velocity = math.cos(turning)
    forward = velocity * (math.tau - 2.0 * turning) + 2.0 * math.sin(turning)
    backward = 2.0 * math.sin(turning) - 2.0 * turning * velocity
    bent = 0.1 * (forward - backward) / (forward + backward)
    assert friction.mean(load, turning) == pytest.approx(mean * bent, rel=1e-8)


def test_beyond_a_thousand_waves_only_the_mean_counts() -> None:
    friction = MeanFriction(0.1, 1e4, 10.0, 0.2366, 3500.0)
    waves = [VibratingLoad(Device(), float(MAX_WAVES + more), 0.4) for more in (0, 1)]
    counted, beyond = (friction.mean(load, 1.1) for load in waves)
    assert beyond == pytest.approx(friction.mean(waves[0].flattened(), 1.1), abs=1e-13)
    assert 0.0 < abs(counted - beyond) < 1e-3 * friction.coefficient
