"""The normal load as a function of the drive angle, for averages over a turn of it."""

from copy import copy
from math import asin, ceil, cos, floor, pi, sin, tau

from .device import Device

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


def max_turns(device: Device) -> int:
    """Turns after which a load may repeat for its phase to count in averages.

    Without flight it is a sine: over several turns it would average out.
    """
    return MAX_TURNS_TO_REPEAT if device.lifts else 1


class VibratingLoad:
    """N(n tau + delta) with lift-off, in N, as a function of the drive angle within a turn.

    It has `waves` waves over a turn of the drive. Averages are taken over the turns after which it
    repeats, see `turns_to_repeat`; if it never does, over all angles.
    """

    def __init__(self, device: Device, ratio: float, delta: float) -> None:
        self._preload, self._amplitude = device.normal_preload, device.normal_amplitude
        turns = turns_to_repeat(ratio, max_turns(device))
        # The phase of the load [rad] at the begin of each of its turns.
        self._phases = [delta + ratio * tau * turn for turn in range(turns or 1)]
        self.waves = ratio
        self._dip = asin(self._preload / self._amplitude) if device.lifts else 0.5 * pi
        self._per_turn = self._in_turn(pi + 2.0 * self._dip)
        if abs(ratio) <= EXACT:  # the integral below would lose its digits to 1 / n
            self._flatten(self.at(0.0))
        elif turns is None:
            self._flatten(self._per_turn / tau)

    def flattened(self) -> "VibratingLoad":
        """The same load with its mean alone, for ratios other than 0."""
        flat = copy(self)
        flat._flatten(self._per_turn / tau)
        return flat

    def kinks(self, begin: float, end: float) -> list[float]:
        """Drive angles in (begin, end) [rad] at which the contact lifts or touches down."""
        if self._dip == 0.5 * pi:
            return []
        found = []
        for phase in self._phases:
            first, last = sorted((self.waves * begin + phase, self.waves * end + phase))
            for kink in (-self._dip, pi + self._dip):
                turns = range(ceil((first - kink) / tau), floor((last - kink) / tau) + 1)
                found += [(kink + tau * turn - phase) / self.waves for turn in turns]
        return [angle for angle in found if begin < angle < end]

    def at(self, angle: float) -> float:
        """Normal load [N] at drive angle `angle` [rad]."""
        total = 0.0
        for phase in self._phases:
            load = self._preload + self._amplitude * sin(self.waves * angle + phase)
            total += load if load > 0.0 else 0.0
        return total / len(self._phases)

    def integral(self, begin: float, end: float) -> float:
        """Integral over the drive angle from `begin` to `end` [N rad]."""
        n = self.waves
        parts = [self._up_to(n * end + p) - self._up_to(n * begin + p) for p in self._phases]
        return sum(parts) / (n * len(parts))

    def _flatten(self, load: float) -> None:
        """Become a constant load [N]: a wave without amplitude."""
        self._preload, self._amplitude, self._dip, self._per_turn = load, 0.0, 0.5 * pi, tau * load
        self.waves, self._phases = 1.0, [0.0]

    def _up_to(self, chi: float) -> float:
        """Integral of N over its own phase, from the touchdown at -dip up to `chi`."""
        turns = floor((chi + self._dip) / tau)
        within = min(chi + self._dip - turns * tau, pi + 2.0 * self._dip)
        return turns * self._per_turn + self._in_turn(within)

    def _in_turn(self, angle: float) -> float:
        return self._preload * angle + self._amplitude * (cos(self._dip) - cos(angle - self._dip))
