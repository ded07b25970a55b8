"""The contact and its normal load: when it lifts and touches down.

For averages the load is a function of the drive angle: `VibratingLoad`.
"""

from math import asin, ceil, cos, floor, inf, pi, sin, tau

BACKWARD, STICK, FORWARD, LIFTED = -1, 0, 1, 2
"""Contact modes: the direction of sliding, rest, or flight."""

EXACT = 1e-12
"""Relative difference of numbers, distance of a ratio from a fraction or of a phase [rad] from a
boundary that is due to rounding. The shortest flight that these can describe is 3e-8 rad long."""

MAX_TURNS_TO_REPEAT = 4
"""Most turns of the drive after which a clipped load may repeat for its phase to count beside its
mean: the more turns, the weaker are the harmonics of the clipping that meet the drive."""


def direction_of(velocity: float) -> int:
    """BACKWARD, FORWARD, or STICK at rest."""
    return (velocity > 0.0) - (velocity < 0.0)


class NormalLoad:
    """N = max(0, preload + amplitude sin(chi)) [N].

    If the amplitude is larger, it `lifts` the contact at chi = pi + `dip` and touches down at
    2 pi - `dip`. Its `mean` is that over a turn [N]. In averages its phase counts if it repeats
    after `max_turns` of the drive: without flight it is a sine, and averages out over several.
    """

    def __init__(self, preload: float, amplitude: float) -> None:
        self.preload, self.amplitude, self.lifts = preload, amplitude, amplitude > preload
        self.dip = asin(preload / amplitude) if self.lifts else 0.5 * pi
        self.max_turns = MAX_TURNS_TO_REPEAT if self.lifts else 1
        self.mean = (preload * (pi + 2.0 * self.dip) + 2.0 * amplitude * cos(self.dip)) / tau

    def at(self, chi: float) -> float:
        """The load [N] at phase `chi` [rad]."""
        return max(0.0, self.preload + self.amplitude * sin(chi))

    def integral(self, chi: float) -> float:
        """Integral [N rad] from the touchdown at -`dip` up to `chi` [rad]."""
        turns = floor((chi + self.dip) / tau)
        within = min(chi + self.dip - turns * tau, pi + 2.0 * self.dip)
        sine = cos(self.dip) - cos(within - self.dip)
        return turns * tau * self.mean + self.preload * within + self.amplitude * sine

    def is_lifted(self, chi: float, frequency: float) -> bool:
        """Whether the contact is lifted at phase `chi` [rad]. With no load at all it always is.

        On a boundary this depends on the direction in which the phase moves: `frequency` [rad/s] is
        its rate. At rate 0 the contact is lifted where the normal load is 0.
        """
        if not self.lifts:
            return self.preload == self.amplitude == 0.0
        height, slope = self.preload + self.amplitude * sin(chi), self.amplitude * cos(chi)
        if abs(height) <= EXACT * abs(slope):
            return slope * frequency < 0.0 or frequency == 0.0
        return height < 0.0

    def time_to_switch(self, chi: float, frequency: float, lifted: bool) -> float:
        """Time [s] until the contact lifts, or touches down when `lifted`; infinite if never."""
        if frequency == 0.0 or not self.lifts:
            return inf
        boundary = -self.dip if lifted == (frequency > 0.0) else pi + self.dip
        ahead = (boundary - chi if frequency > 0.0 else chi - boundary) % tau
        return 0.0 if tau - ahead < EXACT else ahead / abs(frequency)


def turns_to_repeat(ratio: float, max_turns: int, near: float = 0.0) -> int | None:
    """Smallest number of turns q of the drive after which a load repeats; None above `max_turns`.

    Then q ratio is an integer, but for rounding or a distance of at most `near` / q.
    """
    for turns in range(1, max_turns + 1):
        if abs(turns * ratio - round(turns * ratio)) <= max(near / turns, EXACT):
            return turns
    return None


class VibratingLoad:
    """N(n tau + delta) in N, as a function of the drive angle within a turn.

    It has `waves` waves over a turn of the drive. Averages are taken over the turns after which it
    repeats, see `turns_to_repeat`; if it never does, or has more than `most`, its mean counts.
    """

    def __init__(self, load: NormalLoad, waves: float, delta: float, most: float = inf) -> None:
        turns = turns_to_repeat(waves, load.max_turns)
        # The phase of the load [rad] at the begin of each of its turns.
        self._phases = [delta + waves * tau * turn for turn in range(turns or 1)]
        self._load, self.waves = load, waves
        constant = abs(waves) <= EXACT  # the integral below would lose its digits to 1 / n
        if constant or turns is None or abs(waves) > most:
            mean = self.at(0.0) if constant else load.mean
            self._load, self.waves, self._phases = NormalLoad(mean, 0.0), 1.0, [0.0]

    def kinks(self, begin: float, end: float) -> list[float]:
        """Drive angles in (begin, end) [rad] at which the contact lifts or touches down."""
        found, dip = [], self._load.dip
        for phase in self._phases if self._load.lifts else []:
            first, last = sorted((self.waves * begin + phase, self.waves * end + phase))
            for kink in (-dip, pi + dip):
                turns = range(ceil((first - kink) / tau), floor((last - kink) / tau) + 1)
                found += [(kink + tau * turn - phase) / self.waves for turn in turns]
        return [angle for angle in found if begin < angle < end]

    def at(self, angle: float) -> float:
        """Normal load [N] at drive angle `angle` [rad]."""
        loads = (self._load.at(self.waves * angle + phase) for phase in self._phases)
        return sum(loads) / len(self._phases)

    def integral(self, begin: float, end: float) -> float:
        """Integral over the drive angle from `begin` to `end` [N rad]."""
        n, up_to = self.waves, self._load.integral
        parts = [up_to(n * end + phase) - up_to(n * begin + phase) for phase in self._phases]
        return sum(parts) / (n * len(parts))
