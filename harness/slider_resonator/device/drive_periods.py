"""The periods of a drive whose frequency may change, and those after which its run repeats."""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from math import tau

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs

MAX_DENOMINATOR = 20
"""Largest number of drive periods that counts as a common period, by default."""


@dataclass(frozen=True)
class DrivePeriods:
    """The whole periods of a drive; `period` (s) is that without deviation.

    Of a drive whose frequency changes `times` (s) are those of the changes, first and last instant
    included, and `passed` the periods by then; else both are empty.
    """

    period: float
    times: tuple[float, ...] = ()
    passed: tuple[float, ...] = ()

    def passed_by(self, times: Array) -> Array:
        """Return how many periods have passed by times (s), of the same shape."""
        return np.interp(times, self.times, self.passed) if self.times else times / self.period

    def instants(self, passed: Array) -> Array:
        """Return the times (s) by which so many periods have passed, of the same shape."""
        return np.interp(passed, self.passed, self.times) if self.times else passed * self.period

    def ends(self, times: Array) -> Array:
        """Return begin and end (s) of the last whole period before each time, shape (n, 2).

        Before the first is over they are the start, 0 s, and the time itself.
        """
        ended = self.whole(times)
        whole = self.instants(np.column_stack([ended - 1.0, ended]))
        running = np.column_stack([np.zeros_like(times), times])
        return np.where(ended[:, None] >= 1.0, np.minimum(whole, times[:, None]), running)

    def lengths(self, times: Array) -> Array:
        """Return what lies between the `ends` (s), shape (n,)."""
        if self.times:
            return np.asarray(np.diff(self.ends(times), axis=1)[:, 0])
        return np.where(self.whole(times) >= 1.0, self.period, times)

    def whole(self, times: Array) -> Array:
        """Return how many periods have ended by each time (s), but for 1e-9 of a period."""
        return np.asarray(np.floor(self.passed_by(times) + 1e-9))


def drive_periods(device: Device, held: Sequence[HeldInputs]) -> DrivePeriods:
    """Return the drive periods of a run of a device through inputs, which may tune its drive."""
    rates = [device.tuned(inputs.tuned).drive_frequency for inputs in held]
    period = tau / device.drive_frequency
    if set(rates) == {device.drive_frequency}:
        return DrivePeriods(period)
    passed = [r * (h.stop - h.start) / tau for r, h in zip(rates, held, strict=True)]
    times = (held[0].start, *(inputs.stop for inputs in held))
    return DrivePeriods(period, times, (0.0, *np.cumsum(passed).tolist()))


@lru_cache(maxsize=1024)  # sweeps ask for the same few again and again
def common_period(frequency_ratio: float, max_denominator: int = MAX_DENOMINATOR) -> int | None:
    """Return the q of frequency_ratio = p/q in lowest terms, None where it exceeds the maximum."""
    fraction = Fraction(frequency_ratio).limit_denominator(max_denominator)
    near = abs(float(fraction) - frequency_ratio) <= 1e-12 * max(1.0, abs(frequency_ratio))
    return fraction.denominator if near else None
