"""The normal load as a function of the drive angle, for averages over a turn of it."""

from math import ceil, floor, inf, pi, tau

from .contact import NormalLoad

MAX_TURNS_TO_REPEAT = 4
"""Largest number of turns of the drive after which a clipped load may repeat for its phase to
count. The more turns, the weaker are the harmonics of the clipping that meet the drive; beyond, the
mean counts."""

EXACT = 1e-12
"""Distance of a ratio from a fraction up to which it is due to rounding."""


def turns_to_repeat(ratio: float, max_turns: int, near: float = 0.0) -> int | None:
    """Smallest number of turns q of the drive after which a load repeats; None above `max_turns`.

    Then q ratio is an integer, but for rounding or a distance of at most `near` / q.
    """
    for turns in range(1, max_turns + 1):
        if abs(turns * ratio - round(turns * ratio)) <= max(near / turns, EXACT):
            return turns
    return None


def max_turns(load: NormalLoad) -> int:
    """Turns after which a load may repeat for its phase to count in averages.

    Without flight it is a sine: over several turns it would average out.
    """
    return MAX_TURNS_TO_REPEAT if load.lifts else 1


class VibratingLoad:
    """N(n tau + delta) in N, as a function of the drive angle within a turn.

    It has `waves` waves over a turn of the drive. Averages are taken over the turns after which it
    repeats, see `turns_to_repeat`; if it never does, or has more than `max_waves`, its mean counts.
    """

    def __init__(
        self, load: NormalLoad, waves: float, delta: float, max_waves: float = inf
    ) -> None:
        turns = turns_to_repeat(waves, max_turns(load))
        # The phase of the load [rad] at the begin of each of its turns.
        self._phases = [delta + waves * tau * turn for turn in range(turns or 1)]
        self._load, self.waves = load, waves
        if abs(waves) <= EXACT:  # the integral below would lose its digits to 1 / n
            self._flatten(self.at(0.0))
        elif turns is None or abs(waves) > max_waves:
            self._flatten(load.mean)

    def _flatten(self, load: float) -> None:
        """Become a constant load [N]: a wave without amplitude."""
        self._load, self.waves, self._phases = NormalLoad(load, 0.0), 1.0, [0.0]

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
