"""Averaged motion does not depend on the communication step where a slow load has kinks.

The scene `averaged_kinks` judges those that friction has in a beat.
"""

import numpy as np

from tests.fmu.host import Instantiate
from tests.fmus import both_fmus

pytestmark = both_fmus

DEVICE = {
    "fidelity": 0,
    "averaging_order": 1,
    "friction_faces": 1,
    "normal_amplitude": 1.7,
    "phase": 0.4,
    "frequency_ratio": 0.004,
    "initial_velocity": 0.2,
}
STEP = 0.04
PARTS = 4
STEPS = 40

FAST_VELOCITY = 0.144
"""Of the table 1 device, m/s."""


def test_long_steps_pass_kinks_as_short_ones_do(instantiate: Instantiate) -> None:
    """The load itself is slow: the contact lifts and touches down between communication points."""
    velocities = []
    for parts in (1, PARTS):
        instance = instantiate().initialize(**DEVICE)
        course = []
        for _ in range(STEPS):
            instance.run(parts, STEP / parts)
            course.append(instance.get("mean_velocity")[0])
        velocities.append(course)
    gap = np.abs(np.diff(velocities, axis=0)).max()
    assert gap < 2e-8 * FAST_VELOCITY, "2e-10 v_q is allowed in each of some steps"
