"""Friction with tanh: Coulomb in the limit of zero width, a creep in place of a stick."""

from __future__ import annotations

import math

import numpy as np
import pytest

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved import taylor
from slider_resonator.studies.trade.peers.event_free import simulate_tanh

PERIOD = 2.0 * math.pi / 3500.0
BLOCK = Device(resonator_mass=0.0, base_amplitude=0.0, normal_amplitude=0.0)


def test_the_limit_of_zero_width_is_coulomb_friction() -> None:
    held = [HeldInputs(0.0, 6 * PERIOD, phase=0.4)]
    times = np.linspace(0.0, held[0].stop, 49)
    reference = taylor.simulate(Device(), held, times)
    widths = np.array([1e-2, 1e-3, 1e-4, 1e-5])
    errors = np.array(
        [
            np.abs(
                simulate_tanh(Device(), held, times, width=w).position - reference.position
            ).max()
            for w in widths
        ]
    )
    assert (np.diff(errors) < 0.0).all(), f"a narrower tanh is nearer to sgn: {errors}"
    order = np.polyfit(np.log(widths), np.log(errors), 1)[0]
    assert order > 0.3, f"the error vanishes with a power of the width, not {order}"
    assert errors[-1] < 1e-3 * np.abs(reference.position).max()


@pytest.mark.parametrize("method", ["DOP853", "LSODA", "Radau"])
def test_it_creeps_where_friction_should_hold(method: str) -> None:
    width, stop = 1e-3, 0.1
    run = simulate_tanh(
        BLOCK, [HeldInputs(0.0, stop, load=0.1)], np.array([stop]), width=width, method=method
    )
    creep = -width * math.atanh(0.1 / 0.2)
    assert run.velocity[0] == pytest.approx(creep, rel=1e-5), "tanh(v / width) holds 0.1 of 0.2 N"
    assert run.friction_force[0] == pytest.approx(-0.1, rel=1e-5)


@pytest.mark.parametrize("width", [0.0, -1.0, math.nan, math.inf])
def test_a_width_that_is_none_is_refused(width: float) -> None:
    with pytest.raises(ValueError, match=r"width = .* m/s: must be a finite number above 0"):
        simulate_tanh(BLOCK, [HeldInputs(0.0, 1.0)], np.empty(0), width=width)


def test_an_unknown_method_is_refused() -> None:
    with pytest.raises(ValueError, match="method = 'Euler': must be one of DOP853, LSODA, Radau"):
        simulate_tanh(BLOCK, [HeldInputs(0.0, 1.0)], np.empty(0), width=1e-3, method="Euler")
