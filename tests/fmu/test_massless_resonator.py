"""A resonator without mass moves nothing: what it is like does not matter to predictions."""

from __future__ import annotations

import math

import pytest

from tests.fmu.host import Instantiate
from tests.fmus import both_fmus

pytestmark = both_fmus

TRACK = {
    "resonator_mass": 0.0,
    "base_amplitude": 0.0,
    "tangential_force": 1.6,
    "normal_amplitude": 2.2,
    "normal_preload": 1.8,
    "friction_faces": 1,
    "slider_mass": 0.2,
    "drive_frequency": 314.0,
}


@pytest.mark.parametrize("phase", [-2.5, -0.4, 0.3, math.pi])
def test_the_resonator_does_not_matter(instantiate: Instantiate, phase: float) -> None:
    """Light damping far above the drive rings for many periods, and changes nothing."""
    predicted = []
    for resonator in ({}, {"resonator_frequency": 1e4, "damping_ratio": 1e-3}):
        instance = instantiate().initialize(**TRACK, **resonator, phase=phase)
        *prediction, valid = instance.get("steady_velocity", "blocking_force", "prediction_valid")
        assert valid == 1.0, "the slider's motion is steady, whatever rings beside it"
        predicted.append(prediction)
    assert predicted[1] == pytest.approx(predicted[0], rel=1e-9, abs=1e-12)
