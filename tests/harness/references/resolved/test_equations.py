import math

import pytest

from slider_resonator.device.device import Device
from slider_resonator.references.resolved.equations import equations_of

RESONANT = {"fidelity": 1, "damping_ratio": 0.0, "resonator_frequency": 3500.0 / math.sqrt(1.1)}


@pytest.mark.parametrize(
    ("parameters", "message"),
    [
        ({"fidelity": 0}, "fidelity = 0"),
        (RESONANT, r"damping_ratio = 0\.0 .* greater than 0"),
        ({"friction_law": 1, "friction_coefficient": 0.0}, "friction_coefficient"),
        ({"friction_law": 1, "bristle_stiffness": 0.0}, "bristle_stiffness"),
    ],
)
def test_unsupported_devices_are_refused(parameters: dict[str, float], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        equations_of(Device.from_mapping(parameters))
