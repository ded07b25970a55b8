"""The contact and its normal load: when it lifts and touches down."""

from math import asin, cos, floor, inf, pi, sin, tau

BACKWARD, STICK, FORWARD, LIFTED = -1, 0, 1, 2
"""Contact modes: the direction of sliding, rest, or flight."""

REACHED = 1e-12
"""Distance [rad] from a boundary within which it counts as reached: rounding. The shortest flight
that floating point numbers can describe is 3e-8 rad long."""


def direction_of(velocity: float) -> int:
    """BACKWARD, FORWARD, or STICK at rest."""
    return (velocity > 0.0) - (velocity < 0.0)


class NormalLoad:
    """N = max(0, preload + amplitude sin(chi)) [N].

    If the amplitude is larger, it `lifts` the contact at chi = pi + `dip` and touches down at
    2 pi - `dip`.
    """

    def __init__(self, preload: float, amplitude: float) -> None:
        self.preload, self.amplitude, self.lifts = preload, amplitude, amplitude > preload
        self.dip = asin(preload / amplitude) if self.lifts else 0.5 * pi

    def at(self, chi: float) -> float:
        """The load [N] at phase `chi` [rad]."""
        return max(0.0, self.preload + self.amplitude * sin(chi))

    def integral(self, chi: float) -> float:
        """Integral [N rad] from the touchdown at -`dip` up to `chi` [rad]."""
        turns = floor((chi + self.dip) / tau)
        within = min(chi + self.dip - turns * tau, pi + 2.0 * self.dip)
        return turns * self._up_to(pi + 2.0 * self.dip) + self._up_to(within)

    @property
    def mean(self) -> float:
        """Mean load [N]."""
        return self._up_to(pi + 2.0 * self.dip) / tau

    def is_lifted(self, chi: float, frequency: float) -> bool:
        """Whether the contact is lifted at phase `chi` [rad]. With no load at all it always is.

        On a boundary this depends on the direction in which the phase moves: `frequency` [rad/s] is
        its rate. At rate 0 the contact is lifted where the normal load is 0.
        """
        if not self.lifts:
            return self.preload == self.amplitude == 0.0
        height, slope = self.preload + self.amplitude * sin(chi), self.amplitude * cos(chi)
        if abs(height) <= REACHED * abs(slope):
            return slope * frequency < 0.0 or frequency == 0.0
        return height < 0.0

    def time_to_switch(self, chi: float, frequency: float, lifted: bool) -> float:
        """Time [s] until the contact lifts, or touches down when `lifted`; infinite if never.

        `frequency` [rad/s] is that of the normal load and may be negative.
        """
        if frequency == 0.0 or not self.lifts:
            return inf
        boundary = -self.dip if lifted == (frequency > 0.0) else pi + self.dip
        ahead = (boundary - chi if frequency > 0.0 else chi - boundary) % tau
        return 0.0 if tau - ahead < REACHED else ahead / abs(frequency)

    def _up_to(self, angle: float) -> float:
        sine = cos(self.dip) - cos(angle - self.dip)
        return self.preload * angle + self.amplitude * sine
