"""When the contact lifts and touches down: N = max(0, N0 + dN sin(chi)) with dN > N0."""

from math import inf, tau
from typing import NamedTuple

BACKWARD, STICK, FORWARD, LIFTED = -1, 0, 1, 2
"""Contact modes: the direction of sliding, rest, or flight."""

REACHED = 1e-12
"""Distance [rad] from a boundary within which it counts as reached: rounding. The shortest flight
that floating point numbers can describe is 3e-8 rad long."""


def direction_of(velocity: float) -> int:
    """BACKWARD, FORWARD, or STICK at rest."""
    return (velocity > 0.0) - (velocity < 0.0)


class Window(NamedTuple):
    """The range of chi [rad] in which the contact is lifted.

    Empty if it never is, a whole turn if there is no normal load at all.
    """

    first: float
    last: float

    def is_lifted(self, chi: float, frequency: float) -> bool:
        """Whether the contact is lifted at normal phase `chi` [rad].

        On a boundary this depends on the direction in which the phase moves: `frequency` [rad/s] is
        its rate. At rate 0 the contact is lifted where the normal load is 0.
        """
        width = self.last - self.first
        if width <= 0.0 or width >= tau:
            return width > 0.0
        inside = (chi - self.first) % tau
        if tau - inside < REACHED:
            inside -= tau
        first = REACHED if frequency < 0.0 else -REACHED
        last = width - REACHED if frequency > 0.0 else width + REACHED
        return first < inside < last

    def time_to_switch(self, chi: float, frequency: float, lifted: bool) -> float:
        """Time [s] until the contact lifts, or touches down when `lifted`; infinite if never.

        `frequency` [rad/s] is that of the normal load and may be negative.
        """
        if frequency == 0.0 or not 0.0 < self.last - self.first < tau:
            return inf
        first, last = self if frequency > 0.0 else (self.last, self.first)
        ahead = (last if lifted else first) - chi
        ahead = (ahead if frequency > 0.0 else -ahead) % tau
        return 0.0 if tau - ahead < REACHED else ahead / abs(frequency)
