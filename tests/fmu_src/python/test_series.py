"""Closed forms and Taylor series of a segment against each other."""

from __future__ import annotations

import pytest

from fmu_src.python.slider_component.contact import BACKWARD, FORWARD, LIFTED, STICK
from fmu_src.python.slider_component.device import Device, System
from fmu_src.python.slider_component.moment import Moment
from fmu_src.python.slider_component.parameters import Inputs
from fmu_src.python.slider_component.series import Series
from fmu_src.python.slider_component.sliding import Rest, Segment, Slide


@pytest.mark.parametrize("ratio", [1.0, 3.0, 1.37, -1.0, 0.0])
@pytest.mark.parametrize("mode", [FORWARD, BACKWARD, LIFTED, STICK])
@pytest.mark.parametrize("damping", [0.025, 0.6, 2.0])
def test_exponentials_and_series_agree(ratio: float, mode: int, damping: float) -> None:
    device = Device(damping_ratio=damping, tangential_force=3.0)
    system = System(device, Inputs(phase=0.3, load=0.02, frequency_ratio=ratio))
    velocity = 0.1 * mode if mode != LIFTED else 0.1
    now = Moment(velocity, 2e-4, -1.1, 0.0, theta=1.0, psi=1.7, mode=mode)
    if mode == STICK:
        motions: tuple[Segment, ...] = (Rest(system, now), Series(system, now, 0, rests=True))
    else:
        direction = 0 if mode == LIFTED else mode
        motions = (Slide(system, now, direction), Series(system, now, direction))
    fast, slow = motions
    assert slow.reach > 1e-5
    for t in (1e-7, 0.5 * slow.reach, slow.reach):
        assert fast.at(t) == pytest.approx(slow.at(t), rel=1e-12, abs=1e-14)
        for a, b in zip(fast.watches(t), slow.watches(t), strict=True):
            value, slope, bound = a.signal(t)
            assert (value, slope) == pytest.approx(b.signal(t)[:2], rel=1e-11, abs=1e-9)
            before = a.signal(0.9 * t)[1]
            assert abs(slope - before) <= 1.001 * a.signal(0.9 * t)[2] * 0.1 * t + 1e-9 * bound
