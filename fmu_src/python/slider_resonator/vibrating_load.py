"""The normal load as a function of the drive angle, for averages over a turn of it."""

from __future__ import annotations

from math import asin, cos, floor, pi, sin, tau

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
