"""Motion that leaps over periods in a campaign: against the resolved motion of the full device."""

from __future__ import annotations

from slider_resonator.checks.leap_error import (
    CENTRE,
    CENTRE_VELOCITY,
    MARGIN,
    allowed_by_leaps,
    centre_signals,
)
from slider_resonator.stress.campaign.expected import Expected
from slider_resonator.stress.campaign.random_case import RandomCase


def of_second_order(case: RandomCase, full: Expected) -> Expected:
    """Return what is expected where the reference of the full device expects `full`."""
    device, own = case.device, full.allowed
    off = allowed_by_leaps(device, case.schedule.held(), float(case.schedule.times[-1]))
    share = device.mass_ratio
    allowed = {
        CENTRE_VELOCITY: own["velocity"] + share * own["resonator_velocity"],
        CENTRE: own["position"] + share * own["resonator_displacement"],
    }
    return Expected(
        centre_signals(device, full.signals),
        {name: value + off[name] for name, value in allowed.items()},
        full.resolution + MARGIN * device.tolerance,
    )
