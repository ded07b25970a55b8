"""The normal load as a function of the drive angle, for averages over a turn of it."""

from __future__ import annotations

from copy import copy
from math import asin, ceil, cos, floor, pi, sin, tau

from .device import Device


class VibratingLoad:
    """N(n tau + delta) with lift-off, in N; at a ratio n that is no integer its mean instead."""

    __slots__ = ("_amplitude", "_constant", "_delta", "_dip", "_per_turn", "_preload", "_ratio")

    def __init__(self, device: Device, ratio: float, delta: float) -> None:
        self._preload, self._amplitude = device.normal_preload, device.normal_amplitude
        self._ratio, self._delta = ratio, delta
        lifts = self._amplitude > self._preload
        self._dip = asin(self._preload / self._amplitude) if lifts else 0.5 * pi
        self._per_turn = self._in_turn(pi + 2.0 * self._dip)
        self._constant: float | None = None
        if ratio == 0.0:
            self._constant = self._load(delta)
        elif ratio != round(ratio):
            self._constant = self._per_turn / tau

    def flattened(self) -> VibratingLoad:
        """The same load with its mean alone, for ratios other than 0."""
        flat = copy(self)
        flat._constant = self._per_turn / tau
        return flat

    @property
    def wave_number(self) -> float:
        """Waves of the load over a turn of the drive; 0 for a constant load."""
        return 0.0 if self._constant is not None else self._ratio

    def kinks(self, begin: float, end: float) -> list[float]:
        """Drive angles in (begin, end) [rad] at which the contact lifts or touches down."""
        if self._constant is not None or self._dip == 0.5 * pi:
            return []
        first, last = sorted((self._ratio * begin + self._delta, self._ratio * end + self._delta))
        found = []
        for kink in (-self._dip, pi + self._dip):
            turns = range(ceil((first - kink) / tau), floor((last - kink) / tau) + 1)
            found += [(kink + tau * turn - self._delta) / self._ratio for turn in turns]
        return [angle for angle in found if begin < angle < end]

    def at(self, angle: float) -> float:
        """Normal load [N] at drive angle `angle` [rad]."""
        if self._constant is not None:
            return self._constant
        return self._load(self._ratio * angle + self._delta)

    def integral(self, begin: float, end: float) -> float:
        """Integral over the drive angle from `begin` to `end` [N rad]."""
        if self._constant is not None:
            return self._constant * (end - begin)
        n, delta = self._ratio, self._delta
        return (self._up_to(n * end + delta) - self._up_to(n * begin + delta)) / n

    def _load(self, chi: float) -> float:
        return max(0.0, self._preload + self._amplitude * sin(chi))

    def _up_to(self, chi: float) -> float:
        """Integral of N over its own phase, from the touchdown at -dip up to `chi`."""
        turns = floor((chi + self._dip) / tau)
        within = min(chi + self._dip - turns * tau, pi + 2.0 * self._dip)
        return turns * self._per_turn + self._in_turn(within)

    def _in_turn(self, angle: float) -> float:
        return self._preload * angle + self._amplitude * (cos(self._dip) - cos(angle - self._dip))
