"""Means over whole drive periods, which end where the drive phase theta passes 2 pi."""

from __future__ import annotations

from collections.abc import Callable
from math import floor, tau
from typing import NamedTuple

MARK_TOLERANCE = 1e-7
"""Angle [rad] by which the end of a period may be ahead and still count as reached, so that steps
of whole periods complete their last period in spite of rounding."""


class PeriodMeans(NamedTuple):
    """Sums since the last period ended, and the means of the last whole period.

    `travel` [m], `elapsed` [s] and `sticking` [s] since the last period ended (or the start);
    `mean_velocity` [m/s] and `stick_fraction` of the last whole period once `complete`.
    """

    travel: float = 0.0
    elapsed: float = 0.0
    sticking: float = 0.0
    complete: bool = False
    mean_velocity: float = 0.0
    stick_fraction: float = 0.0

    def advanced(
        self,
        duration: float,
        theta: float,
        frequency: float,
        sticks: bool,
        travel_at: Callable[[float], float],
        travelled: float,
    ) -> tuple[PeriodMeans, float]:
        """The means after a motion of `duration` [s] that began at drive phase `theta` [rad].

        `travel_at(t)` is its displacement [m], `travelled` that at its end. Returns the new means
        and the drive phase at the end, modulo 2 pi.
        """
        end = theta + frequency * duration
        ended = 0 if end + MARK_TOLERANCE < tau else floor((end + MARK_TOLERANCE) / tau)
        if ended <= 0:
            return (
                PeriodMeans(
                    self.travel + travelled,
                    self.elapsed + duration,
                    self.sticking + (duration if sticks else 0.0),
                    self.complete,
                    self.mean_velocity,
                    self.stick_fraction,
                ),
                end,
            )
        last = (tau * ended - theta) / frequency
        travel_last = travel_at(last)
        if ended == 1:
            length = self.elapsed + last
            mean = (self.travel + travel_last) / length
            fraction = (self.sticking + (last if sticks else 0.0)) / length
        else:
            length = tau / frequency
            mean = (travel_last - travel_at(last - length)) / length
            fraction = 1.0 if sticks else 0.0
        rest = duration - last
        if not 0.0 <= fraction <= 1.0:
            fraction = 0.0 if fraction < 0.0 else 1.0
        means = PeriodMeans(
            travelled - travel_last, rest, rest if sticks else 0.0, True, mean, fraction
        )
        return means, end - tau * ended

    def present_mean_velocity(self, velocity: float) -> float:
        """Mean of the last whole period, or since the start, or at the start `velocity` [m/s]."""
        if self.complete:
            return self.mean_velocity
        return self.travel / self.elapsed if self.elapsed > 0.0 else velocity

    def present_stick_fraction(self, sticks: bool) -> float:
        """Fraction sticking of the last whole period, or since the start, or at the start."""
        if self.complete:
            return self.stick_fraction
        if self.elapsed > 0.0:
            return min(self.sticking / self.elapsed, 1.0)
        return 1.0 if sticks else 0.0
