"""LuGre friction: analytic cases, its limits, its error against its tolerance, its cost."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from fmu_src.python.slider_component import lugre
from fmu_src.python.slider_component.component import motion_of
from fmu_src.python.slider_component.device import Device
from fmu_src.python.slider_component.parameters import Inputs
from fmu_src.python.slider_component.series import Series
from tests.fmu_src.python import motions
from tests.fmu_src.python.motions import PERIOD, after, begin

TABLE_1 = Device(friction_law=1)
STATE = ("velocity", "displacement", "rate", "position", "bristle")
BLOCK = replace(motions.BLOCK, friction_law=1, tolerance=1e-12)


def test_tiny_motion_swings_on_the_bristles() -> None:
    """Undamped bristles far from their limit: angular frequency (faces N sigma_0 / M)^(1/2)."""
    device = replace(BLOCK, bristle_stiffness=1e4, bristle_damping=0.0)
    frequency = math.sqrt(2.0 * 1.0 * 1e4)
    velocity = 1e-12
    quarter = after(0.5 * math.pi / frequency, device, velocity=velocity)
    assert quarter.position == pytest.approx(velocity / frequency, rel=1e-5)
    assert abs(quarter.velocity) < 1e-5 * velocity
    half = after(math.pi / frequency, device, velocity=velocity)
    assert half.velocity == pytest.approx(-velocity, rel=1e-5)
    assert half.reversals == 1


def test_steady_sliding_has_coulomb_friction() -> None:
    bending = after(1e-3, BLOCK, velocity=3.0)
    assert bending.bristle == pytest.approx(0.1, rel=1e-12), "sigma_0 z tends to mu"
    end = motion_of(BLOCK, Inputs()).advance(bending, 1.0)
    assert bending.velocity - end.velocity == pytest.approx(0.2, rel=1e-11)


def test_bristles_without_stiffness_are_a_damper() -> None:
    """sigma_0 = 0 leaves F = N sigma_1 v: velocity decays with rate faces N sigma_1 / M."""
    device = replace(BLOCK, bristle_stiffness=0.0, bristle_damping=0.5)
    end = after(2.0, device, velocity=3.0)
    assert end.velocity == pytest.approx(3.0 * math.exp(-2.0 * 0.5 * 2.0), rel=1e-10)


def test_a_block_at_rest_stays() -> None:
    end = after(1.0, BLOCK)
    assert (end.position, end.velocity, end.reversals) == (0.0, 0.0, 0)


def test_stiff_bristles_are_coulomb_friction() -> None:
    """The velocity lost over a bending path falls with sigma_0^(-1/2) or faster."""
    exact = after(20 * PERIOD, Device())
    errors = []
    for stiffness in (1e6, 1e8, 1e10):
        device = replace(TABLE_1, bristle_stiffness=stiffness, bristle_damping=0.0, tolerance=1e-12)
        end = after(20 * PERIOD, device)
        errors.append(abs(end.velocity - exact.velocity))
    assert errors[0] > 5.0 * errors[1] > 25.0 * errors[2], errors


@pytest.mark.parametrize("stiffness", [50.0, 1e4, 1e5, 1e6, 1e8])
@pytest.mark.parametrize("amplitude", [1e-4, 5e-8])
def test_error_falls_with_the_tolerance(stiffness: float, amplitude: float) -> None:
    device = replace(TABLE_1, bristle_stiffness=stiffness, base_amplitude=amplitude)
    exact = after(30 * PERIOD, replace(device, tolerance=1e-14))
    scale = 3500.0 * amplitude
    for tolerance in (1e-5, 1e-7, 1e-9):
        end = after(30 * PERIOD, replace(device, tolerance=tolerance))
        error = abs(end.velocity - exact.velocity)
        assert error <= 30.0 * tolerance * scale, f"error {error / scale:.2g} at {tolerance}"


def test_stiffness_costs_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    """Series per run, a count that is the same on any machine."""
    made = []

    class Counted(Series):
        def __init__(self, *args: Any, **settings: Any) -> None:
            made.append(1)
            super().__init__(*args, **settings)

    monkeypatch.setattr(lugre, "Series", Counted)

    def series(stiffness: float) -> int:
        made.clear()
        after(50 * PERIOD, replace(TABLE_1, bristle_stiffness=stiffness))
        return len(made)

    assert 0 < series(1e8) <= 1.5 * series(1e5)


@pytest.mark.parametrize("fidelity", [1, 2])
@pytest.mark.parametrize("amplitude", [1.0, 2.0])
def test_the_partition_matters_within_the_tolerance(fidelity: int, amplitude: float) -> None:
    device = replace(TABLE_1, fidelity=fidelity, normal_amplitude=amplitude, tolerance=1e-10)
    whole = after(10 * PERIOD, device)
    moment = after(10 * PERIOD, device, parts=170)
    assert moment.velocity == pytest.approx(whole.velocity, abs=1e-8)
    assert moment.position == pytest.approx(whole.position, abs=1e-11)
    assert moment.reversals == whole.reversals


@given(
    st.builds(
        Device,
        friction_law=st.just(1),
        bristle_stiffness=st.floats(1.0, 1e7),
        bristle_damping=st.floats(0.0, 50.0),
        normal_amplitude=st.floats(0.0, 2.0),
    ),
    st.builds(
        Inputs, st.just(0.3), st.floats(-0.3, 0.3), st.sampled_from([0.0, 1.0, 3.0, 1.37, -1.0])
    ),
    st.floats(-1.0, 1.0),
    st.floats(-0.3, 0.3),
)
def test_bristles_stay_within_their_limit_and_dissipate(
    device: Device, inputs: Inputs, deflection: float, velocity: float
) -> None:
    mu, damping = device.friction_coefficient, device.bristle_damping
    bent = deflection * mu / device.bristle_stiffness
    law = motion_of(replace(device, initial_bristle_deflection=bent), inputs)
    moment = law.start()
    moment.velocity = velocity
    for _ in range(8):
        moment = law.advance(moment, 0.137 * PERIOD)
        assert abs(moment.bristle) <= mu * (1.0 + 1e-12)
        speed = abs(moment.velocity)
        bent = moment.bristle / mu
        drag = moment.velocity * (moment.velocity - speed * bent)
        assert bent * bent * speed * mu + damping * drag >= 0.0, "friction gave energy"


@given(st.floats(10.0, 1e7), st.floats(0.0, 20.0), st.floats(-3.0, 3.0), st.floats(-0.1, 0.1))
def test_mirror_symmetry(stiffness: float, damping: float, phase: float, load: float) -> None:
    """Half a drive period on, with load and bristle reversed, the motion is mirrored."""
    device = replace(TABLE_1, bristle_stiffness=stiffness, bristle_damping=damping, tolerance=1e-11)
    law = motion_of(device, Inputs(phase, load))
    half = law.advance(law.start(), 0.5 * PERIOD)
    inputs = Inputs(phase + math.pi, -load)
    state = {name: -getattr(half, name) for name in STATE}
    mirror, mirrored = motion_of(device, inputs), begin(device, inputs, **state)
    one, other = law.advance(half, 1.3 * PERIOD), mirror.advance(mirrored, 1.3 * PERIOD)
    assume(abs(one.velocity) > 1e-6)
    assert other.velocity == pytest.approx(-one.velocity, rel=1e-6, abs=1e-9)
    assert other.position == pytest.approx(-one.position, rel=1e-6, abs=1e-12)
