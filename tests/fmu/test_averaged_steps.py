"""Averaged motion does not depend on the communication step, whatever kinks friction has.

The scene `averaged_kinks` judges another device.
"""

import numpy as np
import pytest

from tests.fmu.host import Instantiate
from tests.fmus import both_fmus

pytestmark = both_fmus

AVERAGES = {"fidelity": 0, "averaging_order": 1}
STEP = 0.04
PARTS = 10
STEPS = 40

FAST_VELOCITY = 0.144
"""Of the table 1 device, m/s."""


@pytest.mark.parametrize(
    "device",
    [
        {
            "normal_amplitude": 1.56488675,
            "phase": -1.71231049,
            "load": -0.03627517,
            "frequency_ratio": 1.00403285,
            "initial_velocity": -0.08500605,
        },
        {
            "friction_faces": 1,
            "normal_amplitude": 0.84482857,
            "phase": 0.78190653,
            "load": -0.02746063,
            "frequency_ratio": 3.00417262,
            "initial_velocity": -0.28410927,
        },
        {
            "friction_faces": 1,
            "normal_amplitude": 1.7,
            "phase": 0.4,
            "frequency_ratio": 0.004,
            "initial_velocity": 0.2,
        },
    ],
    ids=["lifts, beat at 1", "beyond v_q", "slow load"],
)
def test_long_steps_pass_kinks_as_short_ones_do(
    instantiate: Instantiate, device: dict[str, float]
) -> None:
    """Mean friction has kinks where the contact lifts as sliding turns, and at |V| = v_q.

    The steps of the pair are as long as its error allows, and a kink can hide from that.
    """
    velocities = []
    for parts in (1, PARTS):
        instance = instantiate().initialize(**AVERAGES, **device)
        course = []
        for _ in range(STEPS):
            instance.run(parts, STEP / parts)
            course.append(instance.get("mean_velocity")[0])
        velocities.append(course)
    gap = np.abs(np.diff(velocities, axis=0)).max()
    assert gap < 2e-8 * FAST_VELOCITY, "2e-10 v_q is allowed in each of some steps"
