"""A moment of a motion: all that the motion carries from one step to the next."""

from dataclasses import dataclass
from operator import attrgetter

Place = tuple[float, float, float, float]
"""Slider velocity [m/s], resonator displacement [m] and rate [m/s], and slider travel [m]."""


@dataclass(slots=True)
class Moment:
    """State, phases and contact mode, and what outputs count.

    Slider `velocity` [m/s] and `position` [m], resonator `displacement` [m] and `rate` [m/s], and
    the friction sigma_0 z of the `bristle` per unit normal load, 0 with Coulomb friction. Phases of
    the drive `theta` and of the normal load `psi` [rad]. The `time` and `last_event_time` [s];
    `sliding` is the direction of the last sliding, 0 before any; `reversals` counts.
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
    time: float = 0.0
    last_event_time: float = 0.0
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

    def copied(self) -> "Moment":
        """The same moment, to be changed."""
        return Moment(*_entries(self))

    def enter(self, mode: int) -> None:
        """Change to contact mode `mode`; that is an event unless it is the present mode."""
        if mode != self.mode:
            self.mode, self.last_event_time = mode, self.time

    def turn(self, direction: int) -> None:
        """Begin to slide in another direction than before: an event."""
        self.reversals += self.sliding == -direction
        self.sliding, self.last_event_time = direction, self.time

    def end_period(self) -> None:
        """End a drive period: the sums give its means, and begin anew."""
        if self.elapsed > 0.0:
            self.mean_velocity = self.travel / self.elapsed
            self.friction_power = self.work / self.elapsed
            self.stick_fraction = min(self.sticking / self.elapsed, 1.0)
            self.complete = True
        self.travel = self.work = self.sticking = self.elapsed = 0.0

    def mean(self, whole: float, so_far: float, momentary: float) -> float:
        """Mean of the last `whole` period, or of the sum `so_far`, or at the start `momentary`."""
        if self.complete:
            return whole
        return so_far / self.elapsed if self.elapsed > 0.0 else momentary


_entries = attrgetter(*Moment.__slots__)
