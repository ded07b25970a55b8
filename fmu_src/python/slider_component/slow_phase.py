"""The slow phase of the normal load: near which fraction of the drive its frequency is."""

from __future__ import annotations

from math import inf, tau
from typing import NamedTuple

from .device import Device
from .vibrating_load import turns_to_repeat

NEAR = 0.1
"""Distance of the frequency ratio from an integer up to which the phase counts as slow; under a
lifting contact that of q times the ratio, times q, for q of a few turns."""


LEAD_DIGITS = 9
"""Decimals to which leads of the normal load [rad] are rounded."""


class SlowPhase(NamedTuple):
    """Near `waves` of the normal load in a turn of the drive its phase drifts by `drift` [rad/s].

    The waves repeat after `turns`; these are None where no phase is slow.
    """

    turns: int | None
    waves: float
    drift: float

    @property
    def beat(self) -> float:
        """Time [s] after which a phase that drifts repeats; infinite for one that does not."""
        return tau / ((self.turns or 1) * abs(self.drift)) if self.drift else inf


def rounded_lead(lead: float) -> float:
    """A lead [rad] without the rounding errors of phases.

    What depends on it does not flicker, and inputs that come back find what was tabulated.
    """
    return round(lead, LEAD_DIGITS)


def slow_phase_of(device: Device, ratio: float) -> SlowPhase:
    """The slow phase at a frequency ratio."""
    turns = turns_to_repeat(device, ratio, NEAR)
    waves = round(turns * ratio) / turns if turns else ratio
    return SlowPhase(turns, waves, (ratio - waves) * device.drive_frequency)
