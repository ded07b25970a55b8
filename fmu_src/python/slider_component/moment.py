"""A moment of a motion: all that the motion carries from one step to the next."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from .contact import STICK
from .motion import State
from .orbit_state import NO_ORBIT, OrbitState
from .period import PeriodMeans
from .stops import NO_STOPS, Stops


class Counts(NamedTuple):
    """Direction of the last sliding (0 before any), number of reversals, number of sticks begun."""

    sliding: int = 0
    reversals: int = 0
    sticks: int = 0

    def slid(self, direction: int) -> Counts:
        """The counts after the slider has moved in `direction`."""
        sliding, reversals, sticks = self
        return Counts(direction, reversals + (sliding == -direction), sticks)


@dataclass(slots=True)
class Moment:
    """Position [m], phases [rad], contact mode, and what outputs count.

    `event_age` is the time [s] since the last event, infinite before any; `bristle` is the friction
    sigma_0 z of the bristle per unit normal load, 0 with Coulomb friction. `stops` determine where
    the search for a stop begins, and so the last digit of the time that it finds: as part of the
    state they make a replay equal to the last bit. `orbit` is for averages of second order alone.
    Only the loop over events changes a moment, and it begins with a copy.
    """

    state: State
    position: float
    theta: float
    psi: float
    mode: int
    counts: Counts
    event_age: float
    means: PeriodMeans
    bristle: float = 0.0
    stops: Stops = NO_STOPS
    orbit: OrbitState = NO_ORBIT

    def copied(self) -> Moment:
        """The same moment, to be changed."""
        return Moment(
            self.state,
            self.position,
            self.theta,
            self.psi,
            self.mode,
            self.counts,
            self.event_age,
            self.means,
            self.bristle,
            self.stops,
            self.orbit,
        )

    def enter(self, mode: int) -> None:
        """Change to contact mode `mode`; that is an event unless it is the present mode."""
        if mode == self.mode:
            return
        self.mode, self.event_age = mode, 0.0
        if mode == STICK:
            self.counts = self.counts._replace(sticks=self.counts.sticks + 1)
