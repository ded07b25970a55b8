"""Averaged Coulomb friction under fast vibration, for any frequency ratio and for lifting contact.

The fast velocity of the slider is V - v_q cos(tau) with tau = theta - theta_1, so that it slides
forward while tau is in (Theta, 2 pi - Theta), cos(Theta) = V / v_q. With n = frequency_ratio an
integer, the normal load is N(n tau + delta) and the mean friction is an elementary integral over
those two arcs (eq. 4 for n = 1 without flight). At any other ratio all phases are met and the
mean load counts. Friction averaged so is accurate to the order of 1 / Omega.
"""

from __future__ import annotations

from cmath import phase as argument
from dataclasses import dataclass
from math import asin, cos, floor, pi, tau

from .device import Device, Inputs
from .plant import equivalent_force
from .refusal import Refusal


@dataclass(frozen=True, slots=True)
class Averaged:
    """Steady velocity [m/s] and blocking force [N] by averaged theory."""

    steady_velocity: float
    blocking_force: float


NO_VIBRATION = Averaged(0.0, 0.0)


def averaged(device: Device, inputs: Inputs, normal_lead: float) -> Averaged:
    """Averaged theory at the present inputs (eqs 20-22 with both faces).

    `normal_lead` [rad] is psi - n theta: what earlier changes of the ratio have left of it. Where
    the load exceeds full friction the velocity is the limit v_q of the theory, with its sign; both
    are 0 without vibration, and where undamped resonance leaves no steady vibration.
    """
    try:
        force = equivalent_force(device)
    except Refusal:
        return NO_VIBRATION
    if force == 0.0:
        return NO_VIBRATION
    fast_velocity = abs(force) / (device.total_mass * device.drive_frequency)
    delta = inputs.phase + normal_lead - inputs.frequency_ratio * argument(force)
    friction = _MeanFriction(device, inputs.frequency_ratio, delta)
    blocking = -friction.at(0.5 * pi)
    low, high = 0.0, pi
    for _ in range(60):
        middle = 0.5 * (low + high)
        if friction.at(middle) + inputs.load > 0.0:
            low = middle
        else:
            high = middle
    return Averaged(fast_velocity * cos(0.5 * (low + high)), blocking)


class _MeanFriction:
    """Mean friction [N] as a function of Theta in [0, pi], where it never rises."""

    def __init__(self, device: Device, ratio: float, delta: float) -> None:
        self._scale = device.friction_faces * device.friction_coefficient / tau
        self._preload = device.normal_preload
        self._amplitude = device.normal_amplitude
        self._ratio = ratio
        self._delta = delta
        lifts = device.normal_amplitude > device.normal_preload
        self._dip = asin(device.normal_preload / device.normal_amplitude) if lifts else 0.5 * pi
        self._per_turn = self._load_integral_in_turn(pi + 2.0 * self._dip)

    def at(self, turning: float) -> float:
        """Mean friction [N] when sliding turns forward at tau = `turning` [rad]."""
        n, delta = self._ratio, self._delta
        if n == 0.0 or n != round(n):
            mean = self._per_turn / tau if n != 0.0 else self._load(delta)
            return self._scale * mean * (tau - 4.0 * turning)
        entry, exit_ = (
            self._integral(n * turning + delta),
            self._integral(n * (tau - turning) + delta),
        )
        before = self._integral(-n * turning + delta)
        return self._scale * (exit_ - 2.0 * entry + before) / n

    def _load(self, chi: float) -> float:
        return max(0.0, self._preload + self._amplitude * cos(chi - 0.5 * pi))

    def _integral(self, chi: float) -> float:
        """Integral of N over its phase, from the last-but-any touchdown up to `chi`."""
        turns = floor((chi + self._dip) / tau)
        within = min(chi + self._dip - turns * tau, pi + 2.0 * self._dip)
        return turns * self._per_turn + self._load_integral_in_turn(within)

    def _load_integral_in_turn(self, angle: float) -> float:
        return self._preload * angle + self._amplitude * (cos(self._dip) - cos(angle - self._dip))
