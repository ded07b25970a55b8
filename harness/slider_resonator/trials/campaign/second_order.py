"""Averaged motion of second order in a campaign: against the resolved motion of the full device."""

from __future__ import annotations

from slider_resonator.checks.second_order import (
    CENTRE,
    CENTRE_VELOCITY,
    allowed_off,
    centre_signals,
    lag_of,
)
from slider_resonator.trials.campaign.expected import Expected
from slider_resonator.trials.campaign.random_case import RandomCase

OUTPUTS = (
    *("position", "velocity", "resonator_displacement", "resonator_velocity"),
    "slow_motion_error",
)


def of_second_order(case: RandomCase, full: Expected, estimate: float) -> Expected:
    """Return what is expected where the reference of the full device expects `full`.

    `estimate` (m/s) is what the FMU says of its error, its largest slow_motion_error.
    """
    device = case.device
    lag = lag_of(device, case.schedule.held())
    off = allowed_off(device, lag, estimate, float(case.schedule.times[-1]))
    own, share = full.allowed, device.mass_ratio
    allowed = {
        CENTRE_VELOCITY: own["velocity"] + share * own["resonator_velocity"],
        CENTRE: own["position"] + share * own["resonator_displacement"],
    }
    return Expected(
        centre_signals(device, full.signals),
        {name: value + off[name] for name, value in allowed.items()},
        full.resolution + lag.share,
    )
