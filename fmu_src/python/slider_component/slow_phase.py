"""The slow phase of the normal load: the fraction of the drive frequency near it, and the drift."""

from __future__ import annotations

from math import inf, tau
from typing import NamedTuple

from .device import Device
from .vibrating_load import turns_to_repeat

NEAR = 0.1
"""Largest distance of the frequency ratio from an integer at which the phase counts as slow. Under
a lifting contact: largest distance of q times the ratio, times q, for q up to a few turns."""


LEAD_DIGITS = 9
"""Decimals to which leads of the normal load [rad] are rounded."""


class SlowPhase(NamedTuple):
    """The normal load is near `waves` waves in a turn of the drive, and drifts by `drift` [rad/s].

    The waves repeat after `turns` turns; `turns` is None where no phase is slow.
    """

    turns: int | None
    waves: float
    drift: float

    @property
    def beat(self) -> float:
        """Time [s] in which a phase that drifts repeats; infinite for one that does not drift."""
        return tau / ((self.turns or 1) * abs(self.drift)) if self.drift else inf


def rounded_lead(lead: float) -> float:
    """A lead [rad] without the rounding errors of phases.

    Results then do not depend on these, and inputs that return to earlier values find their tables.
    """
    return round(lead, LEAD_DIGITS)


def slow_phase_of(device: Device, ratio: float) -> SlowPhase:
    """The slow phase at a frequency ratio."""
    turns = turns_to_repeat(device, ratio, NEAR)
    waves = round(turns * ratio) / turns if turns else ratio
    return SlowPhase(turns, waves, (ratio - waves) * device.drive_frequency)
