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
    fast = FastMotion(
        abs(force) / (device.total_mass * device.drive_frequency), device.drive_frequency
    )
    law = friction_law_of(device.friction_law).averaged
    bristle = bristle_of(device)
    delta = inputs.phase + normal_lead - inputs.frequency_ratio * argument(force)
    load = VibratingLoad(device, inputs.frequency_ratio, delta)
    faces, opposing = device.friction_faces, inputs.load

    def friction(turning: float) -> float:
        return faces * law.mean(bristle, fast, load, turning)

    first, middle, last = friction(0.0), friction(0.5 * pi), friction(pi)
    if first == last:
        # No friction: every velocity is steady without a load, and none with one.
        fastest = -copysign(fast.velocity, inputs.load) if inputs.load else 0.0
        return Averaged(fastest, 0.0, valid=False)
    stays = abs(opposing) < first

    def excess(turning: float) -> float:
        return friction(turning) + opposing

    def closed_excess(turning: float) -> float:
        plain, sine, cosine = law.means(bristle, fast, round(inputs.frequency_ratio), turning)
        swing = cos(delta) * sine + sin(delta) * cosine
        face = device.normal_preload * plain + device.normal_amplitude * swing
        return faces * face + opposing

    has_closed_form = not law.is_expensive and load.wave_number != 0.0 and not load.lifts
    damping = law.drag(bristle, fast.velocity)
    normal = device.normal_preload + device.normal_amplitude
    noise = ROUNDING * EPSILON * faces * (bristle.coefficient + damping) * normal
    near = closed_excess if has_closed_form else excess
    balance = Balance(excess, near, noise, rises=damping > bristle.coefficient)
    turning = balanced_turning(
        balance,
        Point(0.0, first + opposing),
        Point(0.5 * pi, middle + opposing),
        Point(pi, last + opposing),
    )
    valid = stays and _breaks_loose(device, law, fast, abs(force), first)
    return Averaged(fast.velocity * cos(turning), -middle, valid)


def _breaks_loose(
    device: Device, law: AveragedFriction, fast: FastMotion, force: float, friction: float
) -> bool:
    """Whether the vibration alone overcomes the mean `friction` [N] of sliding.

    The amplitude `force` [N] of its force on the pair must, and so must that of its force on a held
    slider.
    """
    bristle = bristle_of(device)
    grip = law.grip(bristle, fast.velocity / fast.frequency, fast.frequency)
    return min(force, held_amplitude(device)) > friction * (grip / bristle.coefficient)
