"""What an FMU says of the error of its mean velocity, and what that error is."""

from __future__ import annotations

import numpy as np

from slider_resonator.checks.fmu_side import FmuSide
from slider_resonator.checks.natural_scale import largest_fast_velocity

_ESTIMATE = "slow_motion_error"
WITHIN = 0.1
"""Share of the error that `tolerance` allows up to which an error counts as none."""


def error_over_estimate(fmu: FmuSide) -> float:
    """Return the largest error of the mean velocity over the estimate of it at the same point.

    The error is that against the run of the same FMU at fidelity 2. An estimate must hold at each
    moment, also after a larger one. The start is left out: there is no mean yet. So are errors far
    below `tolerance` times v_q: nothing estimates rounding.
    NotApplicable for an FMU without estimate.
    """
    fmu.instance.fmu.variable(_ESTIMATE)
    error = np.abs(fmu.record["mean_velocity"] - fmu.resolved["mean_velocity"])[1:]
    device, held = fmu.scene.device, fmu.scene.schedule().held()
    counts = error > WITHIN * device.tolerance * largest_fast_velocity(device, held)
    with np.errstate(divide="ignore"):
        shares = error[counts] / fmu.record[_ESTIMATE][1:][counts]
    return float(shares.max(initial=0.0))
