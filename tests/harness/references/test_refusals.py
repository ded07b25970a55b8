"""What references cannot follow is refused by name and value."""

import math
from collections.abc import Callable

import numpy as np
import pytest

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.averaged import uniform_average
from slider_resonator.references.averaged.averaged_motion import simulate_averaged
from slider_resonator.references.averaged.device_average import steady_velocity
from slider_resonator.references.averaged.uniform_average import LugreCase
from slider_resonator.references.resolved.equations import equations_of

GROWING = HeldInputs(0.0, 1.0, load_rate=0.3)
HELD = HeldInputs(0.0, 1.0)
SLIPPING = {"damping_ratio": 0.0, "resonator_frequency": 3500.0 / math.sqrt(1.1)}
Call = Callable[[Device], object]


def velocity_under(load: float) -> Call:
    return lambda device: steady_velocity(device, 0.0, load, 1.0)


def bent(stiffness: float) -> Call:
    return lambda _: uniform_average.mean_friction(0.1, LugreCase(), stiffness, 1.0)


def averaged(inputs: HeldInputs, time: float) -> Call:
    return lambda device: simulate_averaged(device, [inputs], np.array([time]))


@pytest.mark.parametrize(
    ("call", "parameters", "message"),
    [
        (equations_of, {"fidelity": 0}, "fidelity = 0"),
        (equations_of, SLIPPING | {"fidelity": 1}, r"damping_ratio = 0\.0 .* greater than 0"),
        (equations_of, {"friction_law": 1, "friction_coefficient": 0.0}, "friction_coefficient"),
        (equations_of, {"friction_law": 1, "bristle_stiffness": 0.0}, "bristle_stiffness"),
        (velocity_under(0.25), {}, r"load = 0\.25 .* 0\.2"),
        (velocity_under(0.32), {"normal_amplitude": 3.0}, r"load = 0\.32"),
        (velocity_under(0), {"base_amplitude": 0.0}, r"base_amplitude = 0\.0 m and tangential_fo"),
        (velocity_under(0), {"normal_preload": 0.0}, r"normal_preload = 0\.0 N must be greater th"),
        (velocity_under(0), SLIPPING, r"damping_ratio = 0\.0 .* greater than 0"),
        (averaged(HELD, 1.0), {"fidelity": 0, "normal_preload": 0.0}, r"normal_preload = 0\.0"),
        (averaged(GROWING, 1.0), {"fidelity": 0, "base_amplitude": 0.0}, r"load_rate = 0\.3: must"),
        (bent(0.0), {}, r"stiffness = .* must be greater than 0"),
        (bent(math.nan), {}, r"stiffness = .* must be greater than 0"),
    ],
)
def test_refusals(call: Call, parameters: dict[str, float], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        call(Device.from_mapping(parameters))
