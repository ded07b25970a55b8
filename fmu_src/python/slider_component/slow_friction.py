"""Mean friction under fast vibration as a function of time and slow velocity.

The normal load counts with its phase near integer frequency ratios n, where that phase drifts by
(ratio - n) w (Appendix A for n = 1), and with its mean elsewhere. A load that lifts the contact has
harmonics, and counts with its phase near fractions too.
"""

from dataclasses import dataclass
from math import inf, pi, tau

from .constants import MAX_QUADRATURE_STEPS, MAX_SLOW_STEPS, PYTHON_SLOWDOWN
from .device import Device, System, Vibration
from .mean_friction import MAX_WAVES, MeanFriction, mean_friction
from .moment import Moment
from .vibrating_load import VibratingLoad, turns_to_repeat

NEAR = 0.1
"""Largest distance of the frequency ratio from an integer at which the phase counts as slow. Under
a lifting contact: largest distance of q times the ratio, times q, for q up to a few turns."""

WAVES = 10.0
"""Number of waves of the normal load over a turn that doubles the cost of a quadrature."""

FEW_WAVES = 8.0
"""Waves up to which a quadrature costs as much as without."""

MIN_STEPS = 16
"""Lower limit of the number of steps that is accepted."""

MIN_SHARE = 1e-9
"""Part of a beat up to which a kink ahead counts as the one just passed."""


@dataclass(frozen=True, slots=True)
class SlowFriction:
    """Mean friction over time and slow velocity, from drive and normal phase on.

    The normal load has `waves` waves in a turn of the drive, at `phase` [rad] in tau, which drifts
    by `drift` [rad/s] and repeats after `beat` [s].
    """

    system: System
    law: MeanFriction
    turns: int | None
    waves: float
    phase: float
    drift: float

    @property
    def beat(self) -> float:
        """Time [s] in which the phase of the load repeats; infinite if it does not drift."""
        return tau / ((self.turns or 1) * abs(self.drift)) if self.drift else inf

    @property
    def is_slow_load(self) -> bool:
        """Whether the load itself is slow: near ratio 0."""
        return self.turns is not None and self.waves == 0.0

    @property
    def max_steps(self) -> int:
        """How many steps of averaged motion one communication step may take."""
        many = self.system.device.lifts or abs(self.waves) > FEW_WAVES
        quadratures = self.law.is_expensive and many and self.turns is not None
        if not quadratures or self.waves == 0.0:
            return MAX_SLOW_STEPS // PYTHON_SLOWDOWN
        waves = min(abs(self.waves), MAX_WAVES)
        return max(MIN_STEPS, int(MAX_QUADRATURE_STEPS // PYTHON_SLOWDOWN / (1.0 + waves / WAVES)))

    def at(self, t: float, velocity: float) -> float:
        """Mean friction [N] of all faces after `t` [s] at a slow velocity [m/s]."""
        device, turning = self.system.device, self.law.turning(velocity)
        load = VibratingLoad(device, self.waves, self.phase + self.drift * t)
        return device.friction_faces * self.law.mean(load, turning)

    def power(self, velocity: float) -> float:
        """Mean power of friction [W] of all faces now, at a slow velocity [m/s]."""
        load = VibratingLoad(self.system.device, self.waves, self.phase)
        return self.system.device.friction_faces * self.law.power(load, velocity)

    def smooth_until(self, t: float, end: float) -> float:
        """The time [s] up to which friction is smooth from `t` on, `end` at most.

        A load that is slow itself has kinks where the contact lifts or touches down.
        """
        if not self.is_slow_load:
            return end
        window, chi = self.system.window, self.phase + self.drift * t
        lifted = window.is_lifted(chi, self.drift)
        ahead = window.time_to_switch(chi, self.drift, lifted)
        return min(end, t + max(ahead, MIN_SHARE * self.beat))


def slow_friction(system: System, fast: Vibration, now: Moment) -> SlowFriction:
    """The mean friction from the phases of `now` on."""
    device, ratio = system.device, system.inputs.frequency_ratio
    turns = turns_to_repeat(device, ratio, NEAR)
    waves = round(turns * ratio) / turns if turns else ratio
    phase = system.phase + now.psi - waves * now.theta + waves * fast.lag
    drift = (ratio - waves) * device.drive_frequency
    law = mean_friction(device, fast.velocity)
    return SlowFriction(system, law, turns, waves, phase, drift)


def full_friction(device: Device) -> float:
    """Mean friction [N] of sliding in one direction, but for the shape of a clipped load."""
    normal = max(device.normal_preload, device.normal_amplitude / pi)
    return device.friction_faces * device.friction_coefficient * normal
