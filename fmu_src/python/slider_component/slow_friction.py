"""Mean friction under fast vibration as a function of the slow velocity and the slow phase.

The normal load counts with its phase near integer frequency ratios n, where that phase drifts by
(ratio - n) w (Appendix A for n = 1), and with its mean elsewhere. A load that lifts the contact has
harmonics, and counts with its phase near fractions too.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, lru_cache, partial
from math import acos, cos, inf, pi, sin, tau
from typing import NamedTuple

from .averaged_coulomb import AVERAGED_COULOMB
from .averaged_friction import AveragedFriction, FastMotion
from .contact import is_lifted, time_to_switch
from .fast_vibration import FastVibration
from .friction_table import MAX_WAVES_TABULATED, friction_table
from .held import Held
from .slow_phase import slow_phase_of
from .vibrating_load import VibratingLoad

Friction = Callable[[float, float], float]
"""Time t [s] from now and slow velocity [m/s] -> mean friction [N] of all faces."""


class SlowFriction(NamedTuple):
    """The mean friction `at` a time and velocity; it depends on time where `drift` is not 0.

    `drift` [rad/s] is that of the phase of the normal load, which repeats after `beat` [s];
    where the load itself is slow, `to_kink(t)` is the time [s] from `t` until the contact lifts or
    touches down. `is_expensive`: each value costs a quadrature.
    """

    at: Friction
    drift: float
    beat: float
    to_kink: Callable[[float], float] | None = None
    is_expensive: bool = False


def slow_friction(
    held: Held, friction: AveragedFriction, fast: FastVibration, theta: float, psi: float
) -> SlowFriction:
    """The mean friction from drive phase `theta` and normal phase `psi` [rad] on."""
    device = held.device
    turns, waves, drift = slow_phase_of(device, held.inputs.frequency_ratio)
    phase = held.inputs.phase + psi - waves * theta + waves * fast.lag
    motion = FastMotion(fast.velocity, device.drive_frequency)
    # Without vibration a bristle is always fully bent: friction is Coulomb's.
    averaged = friction if fast.velocity else AVERAGED_COULOMB
    law = _MeanFriction(held, averaged, motion, phase, drift)
    beat = tau / ((turns or 1) * abs(drift)) if drift else inf
    if waves == 0.0:
        return SlowFriction(law.under_mean_load(waves), drift, beat, law.to_kink)
    if turns is None:
        return SlowFriction(law.under_mean_load(waves), drift, beat)
    lifts = device.normal_amplitude > device.normal_preload
    if lifts or (averaged.is_expensive and abs(waves) > MAX_WAVES_TABULATED):
        any_load, is_expensive = law.under_any_load(waves), averaged.is_expensive
        return SlowFriction(any_load, drift, beat, is_expensive=is_expensive)
    return SlowFriction(law.under_sine(int(waves)), drift, beat)


@dataclass(frozen=True, slots=True)
class _MeanFriction:
    """The mean friction of a law under a normal load of `phase` [rad], drifting by `drift`."""

    held: Held
    friction: AveragedFriction
    fast: FastMotion
    phase: float
    drift: float

    def under_sine(self, n: int) -> Friction:
        """Mean friction from the means under a sine of n waves in a turn of the drive."""
        device, means_at = self.held.device, self._means(n)
        preload = device.friction_faces * device.normal_preload
        swing = device.friction_faces * device.normal_amplitude
        fast_velocity, phase, drift = self.fast.velocity, self.phase, self.drift

        def friction(t: float, velocity: float) -> float:
            plain, sine, cosine = means_at(_turning(velocity, fast_velocity))
            delta = phase + drift * t
            return preload * plain + swing * (cos(delta) * sine + sin(delta) * cosine)

        return friction

    def under_mean_load(self, waves: float) -> Friction:
        """Mean friction under the mean load, where the load averages out or is slow itself."""
        means_at, scale = self._means(1), self.held.device.friction_faces / tau

        def friction(t: float, velocity: float) -> float:
            load = self._load(waves, t).integral(0.0, tau)
            return scale * load * means_at(_turning(velocity, self.fast.velocity))[0]

        return friction

    def under_any_load(self, waves: float) -> Friction:
        """Mean friction as the mean under a load of any shape."""
        faces, mean, bristle = (
            self.held.device.friction_faces,
            self.friction.mean,
            self.held.bristle,
        )

        def friction(t: float, velocity: float) -> float:
            turning = _turning(velocity, self.fast.velocity)
            return faces * mean(bristle, self.fast, self._load(waves, t), turning)

        return friction

    def to_kink(self, t: float) -> float:
        """See SlowFriction."""
        window, chi = self.held.window, self.phase + self.drift * t
        return time_to_switch(window, chi, self.drift, is_lifted(window, chi, self.drift))

    def _load(self, waves: float, t: float) -> VibratingLoad:
        return VibratingLoad(self.held.device, waves, self.phase + self.drift * t)

    def _means(self, n: int) -> Callable[[float], tuple[float, float, float]]:
        """The means at Theta [rad], tabulated where they are expensive."""
        bristle = self.held.bristle
        if self.friction.is_expensive:
            # Made when it is first asked for: motion along orbits seldom does.
            table = cache(partial(_table, self.friction, bristle, self.fast, n))
            return lambda turning: table().at(turning)
        means, fast = self.friction.means, self.fast
        return lambda turning: means(bristle, fast, n, turning)


_table = lru_cache(maxsize=4)(friction_table)


def _turning(velocity: float, fast_velocity: float) -> float:
    """Angle tau at which sliding turns forward [rad]; 0 or pi where it never reverses."""
    if abs(velocity) >= fast_velocity:
        return 0.0 if velocity > 0.0 else pi
    return acos(velocity / fast_velocity)
