"""Averaged motion under fast vibration, for any frequency ratio and for lifting contact.

The fast velocity of the slider is V - v_q cos(tau) with tau = theta - theta_1, so that it slides
forward while tau is in (Theta, 2 pi - Theta), cos(Theta) = V / v_q. With n = frequency_ratio an
integer, the normal load is N(n tau + delta) and the mean friction is an elementary integral over
those two arcs (eq. 4 for n = 1 without flight). At any other ratio all phases are met and the
mean load counts. Friction averaged so is accurate to the order of 1 / Omega.
"""

from __future__ import annotations

from cmath import phase as argument
from dataclasses import dataclass
from math import copysign, cos, pi, sin, tau

from .averaged_friction import AveragedFriction, FastMotion
from .balance import Balance, Point, balanced_turning
from .bristle import bristle_of
from .device import Device, Inputs
from .friction_laws import friction_law_of
from .motion import EPSILON
from .plant import equivalent_force, held_amplitude
from .refusal import Refusal
from .vibrating_load import VibratingLoad


@dataclass(frozen=True, slots=True)
class Averaged:
    """Steady velocity [m/s] and blocking force [N] by averaged theory, and whether they apply."""

    steady_velocity: float
    blocking_force: float
    valid: bool


ROUNDING = 8.0
"""Rounding error of a mean friction, in units of the last place of the largest friction."""

NO_VIBRATION = Averaged(0.0, 0.0, False)


def theory_range(device: Device) -> tuple[float, ...]:
    """Return numbers that are all finite where `averaged` stays in the range of floating point.

    The fast velocity [m/s]; the drag over mu at the fast or the initial velocity, whichever is
    larger; and a bound on integrals of load and friction [N], with the initial bristle deflection.
    """
    try:
        force = equivalent_force(device)
    except Refusal:
        force = 0j
    velocity = abs(force) / (device.total_mass * device.drive_frequency)
    mu = device.friction_coefficient
    fastest = max(velocity, abs(device.initial_velocity))
    bristle, bent = bristle_of(device), 0.0
    drag = friction_law_of(device.friction_law).averaged.drag(bristle, fastest)
    if device.friction_law != 0:
        bent = abs(bristle.stiffness * device.initial_bristle_deflection) * (1.0 + drag / mu)
    normal = device.normal_preload + device.normal_amplitude
    strongest = tau * normal * (1.0 + device.friction_faces * (mu + drag + bent))
    return velocity, drag / mu if drag else 0.0, strongest


def averaged(device: Device, inputs: Inputs, normal_lead: float) -> Averaged:
    """Averaged theory at the present inputs (eqs 20-22 with both faces).

    `normal_lead` [rad] is psi - n theta, which earlier changes of the ratio make different from 0.
    Where the load exceeds full friction the velocity is the limit v_q of the theory, with its sign.
    Both results are 0 without vibration, and where undamped resonance leaves no steady vibration.
    In these cases, and where the vibration does not break the contact loose, they are not `valid`.
    """
    try:
        force = equivalent_force(device)
    except Refusal:
        return NO_VIBRATION
    if force == 0.0:
        return NO_VIBRATION
    w, ratio, opposing = device.drive_frequency, inputs.frequency_ratio, inputs.load
    fast = FastMotion(abs(force) / (device.total_mass * w), w)
    delta = inputs.phase + normal_lead - ratio * argument(force)
    sliding = _Sliding(device, fast, VibratingLoad(device, ratio, delta), round(ratio), delta)
    first, middle, last = (sliding.friction(angle) for angle in (0.0, 0.5 * pi, pi))
    if first == last:
        # No friction: every velocity is steady without a load, and none with one.
        fastest = -copysign(fast.velocity, opposing) if opposing else 0.0
        return Averaged(fastest, 0.0, valid=False)
    turning = balanced_turning(
        sliding.balance(opposing),
        Point(0.0, first + opposing),
        Point(0.5 * pi, middle + opposing),
        Point(pi, last + opposing),
    )
    valid = abs(opposing) < first and _breaks_loose(device, fast, abs(force), first)
    return Averaged(fast.velocity * cos(turning), -middle, valid)


@dataclass(frozen=True, slots=True)
class _Sliding:
    """A vibrating slider under a normal load of `n` waves in a turn, at phase `delta` [rad]."""

    device: Device
    fast: FastMotion
    load: VibratingLoad
    n: int
    delta: float

    @property
    def law(self) -> AveragedFriction:
        return friction_law_of(self.device.friction_law).averaged

    def friction(self, turning: float) -> float:
        """Mean friction [N] when sliding turns forward at tau = `turning` [rad]."""
        bristle = bristle_of(self.device)
        return self.device.friction_faces * self.law.mean(bristle, self.fast, self.load, turning)

    def friction_in_closed_form(self, turning: float) -> float:
        """The same without flight, from the means: it takes less time."""
        device = self.device
        plain, sine, cosine = self.law.means(bristle_of(device), self.fast, self.n, turning)
        swing = cos(self.delta) * sine + sin(self.delta) * cosine
        face = device.normal_preload * plain + device.normal_amplitude * swing
        return device.friction_faces * face

    def balance(self, opposing: float) -> Balance:
        """The excess of friction and a load `opposing` [N]."""
        device, law, bristle = self.device, self.law, bristle_of(self.device)
        drag = law.drag(bristle, self.fast.velocity)
        normal = device.normal_preload + device.normal_amplitude
        noise = ROUNDING * EPSILON * device.friction_faces * (bristle.coefficient + drag) * normal
        closed = not law.is_expensive and self.load.wave_number != 0.0 and not self.load.lifts
        near = self.friction_in_closed_form if closed else self.friction
        return Balance(
            lambda turning: self.friction(turning) + opposing,
            lambda turning: near(turning) + opposing,
            noise,
            rises=drag > bristle.coefficient,
        )


def _breaks_loose(device: Device, fast: FastMotion, force: float, friction: float) -> bool:
    """Whether the vibration alone overcomes the mean `friction` [N] of sliding.

    The amplitude `force` [N] of its force on the pair must, and so must that of its force on a held
    slider.
    """
    law, bristle = friction_law_of(device.friction_law).averaged, bristle_of(device)
    grip = law.grip(bristle, fast.velocity / fast.frequency, fast.frequency)
    return min(force, held_amplitude(device)) > friction * (grip / bristle.coefficient)
