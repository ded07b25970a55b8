"""The velocity without the resonator's swing, and what an FMU says of its error in it."""

from __future__ import annotations

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.checks.fmu_side import FmuSide
from slider_resonator.fmu.record import Record

_ESTIMATE = "slow_motion_error"


def slow_error_share(fmu: FmuSide) -> float:
    """Return the largest error of the slow velocity over the largest estimate of it.

    The error is that of ``X' + r Y'``, against the run of the same FMU at fidelity 2. The start is
    left out: nothing is averaged yet.
    NotApplicable for an FMU without estimate.
    """
    fmu.instance.fmu.variable(_ESTIMATE)
    share = fmu.scene.device.mass_ratio
    error = centre_velocity(fmu.record, share) - centre_velocity(fmu.resolved, share)
    return _over_estimate(error, fmu.record)


def mean_error_share(fmu: FmuSide) -> float:
    """Return the largest error of the mean velocity over the largest estimate of it.

    The same as `slow_error_share`, but of the mean over a drive period, which the estimate is for:
    what the velocity errs by within a period does not count.
    """
    return _over_estimate(_error_of_mean(fmu), fmu.record)


def momentary_error_share(fmu: FmuSide) -> float:
    """Return the largest error of the mean velocity over the estimate of it at the same point.

    An estimate must hold at each moment, also after a larger one. The start is left out;
    NotApplicable for an FMU without estimate.
    """
    error = np.abs(_error_of_mean(fmu))[1:]
    with np.errstate(divide="ignore"):
        shares = error[error > 0.0] / fmu.record[_ESTIMATE][1:][error > 0.0]
    return float(shares.max(initial=0.0))


def _error_of_mean(fmu: FmuSide) -> Array:
    fmu.instance.fmu.variable(_ESTIMATE)
    return np.asarray(fmu.record["mean_velocity"] - fmu.resolved["mean_velocity"])


def _over_estimate(error: Array, record: Record) -> float:
    return float(np.abs(error[1:]).max() / record[_ESTIMATE].max())


def centre_velocity(record: Record, mass_ratio: float) -> Array:
    """Return the velocity of slider and resonator as one mass, m/s, shape (n,).

    `mass_ratio` is the resonator's share of the mass. The resonator's own swing does not change it.
    """
    return np.asarray(record["velocity"] + mass_ratio * record["resonator_velocity"])
