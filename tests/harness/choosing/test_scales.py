from __future__ import annotations

from math import inf, pi

import pytest

from slider_resonator.choosing.scales import scales_of
from tests.harness.scene_text import scene_of


def test_table_1() -> None:
    """Against the design's own figures: F_T* = 910.947 N on 1.1 kg, a transient of 2.05 s."""
    scales = scales_of(scene_of("[device]\nfriction_law = 1\n"))
    assert scales.period == pytest.approx(2.0 * pi / 3500.0)
    assert scales.fast_velocity == pytest.approx(910.947 / (1.1 * 3500.0), rel=1e-6)
    assert scales.relaxation == pytest.approx(2.05, rel=1e-2)
    assert scales.slowness == pytest.approx(0.2 / 910.947, rel=1e-6)
    assert scales.kappa == pytest.approx(1e5 * 910.947 / (1.1 * 3500.0) / 0.1 / 3500.0, rel=1e-6)
    assert scales.mass_ratio == pytest.approx(1.0 / 11.0)
    assert (scales.detuning, scales.beat, scales.saturation, scales.input_rate) == (0, 0, 0, 0)


def test_inputs() -> None:
    scales = scales_of(
        scene_of(
            "[inputs]\nfrequency_ratio = 2.99\nload = { ramp = [[0, 0], [0.1, -0.15]] }\n",
        )
    )
    assert scales.detuning == pytest.approx(0.01)
    assert scales.beat == pytest.approx(0.01 * 3500.0 / (2.0 * pi))
    assert scales.saturation == pytest.approx(0.75)
    assert scales.input_rate == pytest.approx(1.5 * 2.0 * pi / 3500.0 / 0.2)


@pytest.mark.parametrize(
    "device",
    [
        "friction_coefficient = 0.0",
        "base_amplitude = 0.0",
        "damping_ratio = 0.0\nresonator_mass = 1.0\nresonator_frequency = 2474.8737341529163",
    ],
)
def test_without_vibration_or_friction_there_is_nothing_to_average(device: str) -> None:
    scales = scales_of(scene_of(f"[device]\n{device}\n"))
    assert scales.fast_velocity is None
    assert scales.slowness is None
    assert scales.relaxation == inf
