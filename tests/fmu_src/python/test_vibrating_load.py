"""Integrals of the vibrating normal load by quadrature, lift-off included."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fmu_src.python.slider_component.device import Device
from fmu_src.python.slider_component.vibrating_load import VibratingLoad, turns_to_repeat


@given(
    st.sampled_from([1.0, 2.0, 3.0, -1.0, 0.0]),
    st.floats(0.0, 3.0),
    st.floats(-4.0, 4.0),
    st.floats(-7.0, 7.0),
    st.floats(0.0, 10.0),
)
def test_integral(ratio: float, amplitude: float, delta: float, begin: float, span: float) -> None:
    load = VibratingLoad(Device(normal_amplitude=amplitude), ratio, delta)
    angles = begin + span * (np.arange(20_000) + 0.5) / 20_000
    normal = np.maximum(0.0, 1.0 + amplitude * np.sin(ratio * angles + delta))
    assert load.integral(begin, begin + span) == pytest.approx(
        float(normal.mean()) * span, abs=2e-5 * (1.0 + span)
    )
    assert load.at(begin) == pytest.approx(
        max(0.0, 1.0 + amplitude * math.sin(ratio * begin + delta)), abs=1e-12
    )


@pytest.mark.parametrize("ratio", [1e-12, -1e-12, 1e-15, 1e-300])
@pytest.mark.parametrize("amplitude", [0.0, 0.5, 2.5])
def test_a_ratio_of_rounding_is_none(ratio: float, amplitude: float) -> None:
    device = Device(normal_amplitude=amplitude)
    near, still = (VibratingLoad(device, r, 0.4) for r in (ratio, 0.0))
    assert near.integral(0.3, 6.0) == pytest.approx(still.integral(0.3, 6.0), rel=1e-11), (
        "over a turn of the drive the normal load does not change"
    )


@pytest.mark.parametrize("amplitude", [0.5, 2.5])
def test_between_integers_only_the_mean_counts(amplitude: float) -> None:
    angles = (np.arange(100_000) + 0.5) / 100_000 * math.tau
    mean = float(np.maximum(0.0, 1.0 + amplitude * np.sin(angles)).mean())
    load = VibratingLoad(Device(normal_amplitude=amplitude), 1.37, 0.4)
    assert load.at(0.1) == load.at(2.0) == pytest.approx(mean, rel=1e-8)
    assert load.integral(1.0, 3.5) == pytest.approx(2.5 * mean, rel=1e-8)


@pytest.mark.parametrize("ratio", [1.0, 3.0, -2.0])
def test_kinks_are_at_lift_off_and_touchdown(ratio: float) -> None:
    load = VibratingLoad(Device(normal_amplitude=1.7), ratio, 0.9)
    angles = np.linspace(-1.0, 6.0, 70_001)
    lifted = np.array([load.at(float(angle)) == 0.0 for angle in angles])
    switches = angles[1:][lifted[1:] != lifted[:-1]]
    assert sorted(load.kinks(-1.0, 6.0)) == pytest.approx(switches, abs=1.1e-4)


def test_only_a_lifting_contact_has_kinks() -> None:
    assert VibratingLoad(Device(normal_amplitude=1.0), 1.0, 0.9).kinks(-1.0, 6.0) == []
    assert VibratingLoad(Device(normal_amplitude=1.7), 0.0, 0.9).kinks(-1.0, 6.0) == []


@pytest.mark.parametrize(
    ("amplitude", "ratio", "turns"),
    [(1.0, 3.0, 1), (1.0, 0.5, None), (2.0, 0.5, 2), (2.0, -1.25, 4), (2.0, 0.2, None)],
)
def test_turns_to_repeat(amplitude: float, ratio: float, turns: int | None) -> None:
    assert turns_to_repeat(Device(normal_amplitude=amplitude), ratio, 1e-9) == turns


def test_clipped_load_is_averaged_over_its_turns() -> None:
    load = VibratingLoad(Device(normal_amplitude=2.0), 2 / 3, 0.4)
    turns = np.array([0.0, 1.0, 2.0]) * math.tau
    for angle in (0.1, 2.0, 5.0):
        normal = np.maximum(0.0, 1.0 + 2.0 * np.sin(2 / 3 * (angle + turns) + 0.4))
        assert load.at(angle) == pytest.approx(float(normal.mean()), abs=1e-14)
    angles = 0.3 + 2.1 * (np.arange(20_000) + 0.5) / 20_000
    middle = float(np.mean([load.at(float(angle)) for angle in angles]))
    assert load.integral(0.3, 2.4) == pytest.approx(2.1 * middle, rel=1e-7)
