"""A moment of a motion: all that the motion carries from one step to the next."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import floor, inf, tau

from .contact import STICK

Place = tuple[float, float, float, float, float]
"""Velocity of the slider [m/s], displacement [m] and rate [m/s] of the resonator, how far the
slider has moved [m], and the work of friction on the way [J]."""

MARK_TOLERANCE = 1e-7
"""Angle [rad] by which the end of a period may be ahead and still count as reached, so that steps
of whole periods complete their last period in spite of rounding."""


@dataclass(slots=True)
class Moment:
    """State, phases and contact mode, and what outputs count.

    Slider `velocity` [m/s] and `position` [m], resonator `displacement` [m] and `rate` [m/s], and
    the friction sigma_0 z of the `bristle` per unit normal load, 0 with Coulomb friction. Phases of
    the drive `theta` and of the normal load `psi` [rad]. `event_age` is the time since the last
    event [s], infinite before any; `sliding` the direction of the last sliding, 0 before any;
    `reversals` and `sticks` count.
    `travel` [m], `work` of friction [J], `elapsed` [s] and `sticking` [s] are sums since the last
    drive period ended (or the start), `mean_velocity` [m/s], `friction_power` [W] and
    `stick_fraction` the means of the last whole one once it is `complete`. `leap_error` [m/s] is
    what leaps over periods have erred by so far in the slow velocity.

    Only a motion changes a moment, and it begins with a copy.
    """

    velocity: float
    displacement: float
    rate: float
    position: float
    theta: float = 0.0
    psi: float = 0.0
    mode: int = 0
    sliding: int = 0
    reversals: int = 0
    sticks: int = 0
    event_age: float = inf
    bristle: float = 0.0
    travel: float = 0.0
    work: float = 0.0
    elapsed: float = 0.0
    sticking: float = 0.0
    complete: bool = False
    mean_velocity: float = 0.0
    friction_power: float = 0.0
    stick_fraction: float = 0.0
    leap_error: float = 0.0

    def copied(self) -> Moment:
        """The same moment, to be changed."""
        return Moment(*[getattr(self, name) for name in Moment.__slots__])

    def enter(self, mode: int) -> None:
        """Change to contact mode `mode`; that is an event unless it is the present mode."""
        if mode != self.mode:
            self.mode, self.event_age = mode, 0.0
            self.sticks += mode == STICK

    def turn(self, direction: int) -> None:
        """Begin to slide in another direction than before: an event."""
        self.reversals += self.sliding == -direction
        self.sliding, self.event_age = direction, 0.0

    def pass_time(
        self,
        t: float,
        frequency: float,
        sticks: bool,
        travelled: float,
        work: float,
        place_at: Callable[[float], Place],
    ) -> None:
        """Advance position, drive phase and means over a motion of `t` [s] that has `travelled`.

        The last numbers that `place_at` gives are the displacement [m] and the `work` of friction
        [J] after a time [s]; `frequency` [rad/s] is the drive's.
        """
        end = self.theta + frequency * t
        self.position += travelled
        self.event_age += t
        ended = 0 if end + MARK_TOLERANCE < tau else floor((end + MARK_TOLERANCE) / tau)
        if ended <= 0:
            self.travel += travelled
            self.work += work
            self.elapsed += t
            self.sticking += t if sticks else 0.0
            self.theta = end
            return
        last = (tau * ended - self.theta) / frequency
        *_, travel_last, work_last = place_at(last)
        if ended == 1:
            length = self.elapsed + last
            self.mean_velocity = (self.travel + travel_last) / length
            self.friction_power = (self.work + work_last) / length
            fraction = (self.sticking + (last if sticks else 0.0)) / length
        else:
            length = tau / frequency
            *_, travel_first, work_first = place_at(last - length)
            self.mean_velocity = (travel_last - travel_first) / length
            self.friction_power = (work_last - work_first) / length
            fraction = 1.0 if sticks else 0.0
        rest = t - last
        self.travel, self.work, self.elapsed = travelled - travel_last, work - work_last, rest
        self.sticking = rest if sticks else 0.0
        self.complete, self.stick_fraction = True, min(max(fraction, 0.0), 1.0)
        self.theta = end - tau * ended

    def present_mean_velocity(self) -> float:
        """Mean of the last whole period, or since the start, or the velocity at the start [m/s]."""
        if self.complete:
            return self.mean_velocity
        return self.travel / self.elapsed if self.elapsed > 0.0 else self.velocity

    def present_stick_fraction(self, sticks: bool) -> float:
        """Fraction sticking of the last whole period, or since the start, or at the start."""
        if self.complete:
            return self.stick_fraction
        if self.elapsed > 0.0:
            return min(self.sticking / self.elapsed, 1.0)
        return 1.0 if sticks else 0.0
