"""Reading the bristle from friction and path, on motions whose bristle is known."""

from dataclasses import replace
from math import pi

import numpy as np
import pytest

from slider_resonator.device.device import Device
from slider_resonator.device.interface import INPUT_STARTS
from slider_resonator.errors import FmuError
from slider_resonator.steady.bristle_reading import BristleReading, bristle_reading

VALUES = {**vars(Device(friction_law=1, bristle_stiffness=1e4)), **INPUT_STARTS}


def reading_of(**changed: float) -> BristleReading:
    reading = bristle_reading({**VALUES, **changed})
    assert reading is not None
    return reading


def test_open_contact_cannot_be_read() -> None:
    reading = replace(reading_of(), leads=(1e-4, 0.0))
    zeros, ones = np.zeros(2), np.ones(2)
    with pytest.raises(FmuError, match="cannot be read"):
        reading.deflection(np.array([1.0, 2.0]), ones, ones, zeros, zeros)


@pytest.mark.parametrize(
    "changed",
    [
        {"friction_law": 0.0},
        {"fidelity": 0.0},
        {"friction_coefficient": 0.0},
        {"bristle_stiffness": 0.0},
        {"friction_faces": 0.0},
        {"normal_preload": 0.0, "normal_amplitude": 0.0},
        {"frequency_ratio": 0.0, "phase": -pi / 2.0, "normal_amplitude": 2.0},
    ],
)
def test_no_bristle_is_read_without_bristle_friction(changed: dict[str, float]) -> None:
    assert bristle_reading({**VALUES, **changed}) is None
