"""The series against scipy on the equations with the bristle as a state."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from fmu_src.python.slider_component.bristle import Bristle
from fmu_src.python.slider_component.device import Device, Inputs
from fmu_src.python.slider_component.first_zero import first_zero
from fmu_src.python.slider_component.held import hold
from fmu_src.python.slider_component.motion import State
from fmu_src.python.slider_component.taylor_slide import TaylorSlide

THETA, PSI, BENT = 0.7, 1.9, -0.06
STATE = State(2e-4, 1e-4, -0.8)


def slide(bristle: Bristle, sign: int, state: State, tolerance: float) -> TaylorSlide:
    held = hold(Device(), Inputs(phase=0.3, load=0.02, frequency_ratio=3.0))
    chi = PSI + held.plant.phase
    return TaylorSlide(held.plant, bristle, sign, state, BENT, THETA, chi, tolerance)


def integrated(bristle: Bristle, state: State, t: float) -> np.ndarray:
    """x, v, y, u from the equations as they stand in (8), (26) and (27)."""
    m, k, c, w = 0.1, 0.1 * 3500.0**2, 2 * 0.05 * 0.1 * 3500.0, 3500.0

    def rates(s: float, z: np.ndarray) -> list[float]:
        _, v, y, u, bent = z
        rate = v - abs(v) * bent / bristle.coefficient
        normal = 1.0 + math.sin(PSI + 3.0 * w * s + 0.3)
        friction = 2.0 * normal * (bent + bristle.damping * rate)
        acceleration = -friction - 0.02 + c * u + k * y
        swing = 1e-4 * w * w * math.sin(THETA + w * s) - (c * u + k * y) / m
        return [v, acceleration, u, swing - acceleration, bristle.stiffness * rate]

    start = [0.0, *state, BENT]
    run = solve_ivp(rates, (0.0, t), start, method="Radau", rtol=1e-11, atol=1e-15)
    return np.asarray(run.y[:4, -1])


@pytest.mark.parametrize("stiffness", [0.0, 1e3, 1e5, 1e7])
@pytest.mark.parametrize("damping", [0.0, 10.0])
def test_series_solves_the_equations(stiffness: float, damping: float) -> None:
    bristle = Bristle(0.1, stiffness, damping)
    motion = slide(bristle, 1, STATE, 1e-13)
    (watch,) = motion.watches(motion.reach)
    zero = first_zero(watch, motion.reach)
    t = 0.9 * (zero if zero is not None else motion.reach)
    x, v, y, u = integrated(bristle, STATE, t)
    assert motion.travel(t) == pytest.approx(x, rel=1e-8, abs=1e-16)
    assert motion.state(t).velocity == pytest.approx(v, rel=1e-8, abs=1e-12)
    assert motion.state(t).displacement == pytest.approx(y, rel=1e-9)
    assert motion.state(t).rate == pytest.approx(u, rel=1e-9)


def test_reach_shrinks_with_the_tolerance() -> None:
    bristle = Bristle(0.1, 1e5, 10.0)
    reaches = [slide(bristle, 1, STATE, t).reach for t in (1e-6, 1e-10, 1e-14)]
    assert reaches[0] > reaches[1] > reaches[2] > 0.3 * reaches[0], "a digit costs little"


def test_from_rest_it_departs_in_one_direction_only() -> None:
    bristle, rest = Bristle(0.1, 1e5, 10.0), State(0.0, 1e-4, -0.8)
    departs = [slide(bristle, sign, rest, 1e-12).departs() for sign in (1, -1)]
    assert sorted(departs) == [False, True]
