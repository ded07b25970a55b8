"""The velocity without the resonator's swing, and what an FMU says of its error in it."""

from __future__ import annotations

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.checks.fmu_side import FmuSide
from slider_resonator.fmu.record import Record
from slider_resonator.fmu.run import run

_OUTPUTS = ("velocity", "resonator_velocity", "slow_motion_error")


def slow_error_share(fmu: FmuSide) -> float:
    """Return the largest error of the slow velocity over the largest estimate of it.

    The error is that of ``X' + r Y'``, against the run of the same FMU at fidelity 2. The start is
    left out: nothing is averaged yet.
    NotApplicable for an FMU without estimate.
    """
    for name in _OUTPUTS:
        fmu.instance.fmu.variable(name)
    scene = fmu.scene
    exact = run(
        fmu.instance,
        {**scene.parameters, "fidelity": 2},
        scene.schedule(),
        outputs=_OUTPUTS[:2],
    )
    share = scene.device.mass_ratio
    error = centre_velocity(fmu.record, share) - centre_velocity(exact, share)
    made = np.abs(error[1:]).max()
    return float(made / fmu.record["slow_motion_error"].max())


def centre_velocity(record: Record, mass_ratio: float) -> Array:
    """Return the velocity of slider and resonator as one mass, m/s, shape (n,).

    `mass_ratio` is the resonator's share of the mass. The resonator's own swing does not change it.
    """
    return np.asarray(record["velocity"] + mass_ratio * record["resonator_velocity"])
