"""Steady velocity and blocking force for the present inputs, by averaged theory (20)-(22).

Under `averaging_order` 2 both are exact, by periodic motions of the full device; the theory is
where they start. It holds for any integer frequency ratio n, for lifting contact and for LuGre
friction: the mean friction of `mean_friction` balances the load. At any other ratio all phases are
met and the mean load counts.
"""

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import lru_cache, partial
from math import copysign, cos, pi, tau

from .device import EPSILON, Device, System, held_amplitude, vibration
from .mean_friction import MeanFriction
from .parameters import Inputs
from .period_map import PeriodMap
from .steady_motion import PeriodicMotion
from .values import Refusal
from .vibrating_load import VibratingLoad, turns_to_repeat

BISECTIONS = 52
"""Halvings of [0, pi] in which the angle of balance is found."""

ROUNDING = 8.0
"""Rounding error of a mean friction, in units of the last place of the largest friction."""


@dataclass(frozen=True, slots=True)
class Prediction:
    """Steady velocity [m/s] and blocking force [N], and whether they apply.

    Friction `holds` a load below that of sliding.
    """

    steady_velocity: float
    blocking_force: float
    holds: bool
    valid: bool


MAX_TURNS = 32
"""Largest number of turns of the drive after which the normal load may repeat."""


@lru_cache(maxsize=8)
def prediction(device: Device, inputs: Inputs, normal_lead: float) -> Prediction:
    """The prediction of the averaging order of the device; `normal_lead` [rad] as below.

    By second order both are those of periodic motions of the full device, and valid only where such
    were found. They are looked for from averages on. Where bristles damp less than they hold, so
    that one velocity alone balances a load, those of Coulomb friction are near, and cost least.
    """
    first = partial(first_order, inputs=inputs, normal_lead=normal_lead)
    if device.averaging_order == 2 and device.friction_law == 1 and _damps_little(device):
        start = first(replace(device, friction_law=0))
        if found := _second_order(device, inputs, normal_lead, start):
            return found
    start = first(device)
    if device.averaging_order == 1:
        return start
    found = _second_order(device, inputs, normal_lead, start)
    return found or replace(start, valid=False)


def _damps_little(device: Device) -> bool:
    with suppress(Refusal):
        return MeanFriction(device, vibration(device).velocity).damping_share <= 1.0
    return False


def _second_order(
    device: Device, inputs: Inputs, normal_lead: float, start: Prediction
) -> Prediction | None:
    """The prediction by periodic motions from averages on, None where these find none."""
    turns = turns_of_load(device, inputs.frequency_ratio)
    if turns is None or not start.holds:
        return None
    full = replace(device, fidelity=2)
    if device.resonator_mass == 0.0:
        # It moves nothing: one that settles within a period takes its place, so that the search
        # need not wait for it.
        w = device.drive_frequency
        full = replace(full, resonator_frequency=w, damping_ratio=1.0)
    try:
        period_map = PeriodMap(System(full, inputs), turns)
        psi = (normal_lead + inputs.frequency_ratio * period_map.section) % tau
        steady = PeriodicMotion(period_map, psi, inputs.load, blocked=False)
        blocked = PeriodicMotion(period_map, psi, start.blocking_force, blocked=True)
        velocity, force = steady.found(start.steady_velocity), blocked.found(0.0)
        return Prediction(velocity, force, holds=True, valid=True)
    except (ArithmeticError, ValueError, Refusal):
        return None


def turns_of_load(device: Device, ratio: float) -> int | None:
    """Number of turns of the drive after which the normal load repeats; None if it never does."""
    return turns_to_repeat(ratio if device.normal_amplitude > 0.0 else 0.0, MAX_TURNS)


def theory_range(device: Device) -> tuple[float, ...]:
    """Return numbers that are all finite where motion stays in the range of floating point.

    The square of the fast velocity [m^2/s^2]; the drag over mu at the fast or the initial velocity,
    whichever is larger; and a bound on integrals of load and friction [N], with the initial bristle
    deflection.
    """
    velocity = 0.0
    with suppress(Refusal):
        velocity = vibration(device).velocity
    mu, drag, bent = device.friction_coefficient, 0.0, 0.0
    if device.friction_law == 1:
        drag = device.bristle_damping * max(velocity, abs(device.initial_velocity))
        bent = abs(device.bristle_stiffness * device.initial_bristle_deflection)
        bent *= 1.0 + drag / mu
    normal = device.normal_preload + device.normal_amplitude
    strongest = tau * normal * (1.0 + device.friction_faces * (mu + drag + bent))
    return velocity * velocity, drag / mu if drag else 0.0, strongest


def first_order(device: Device, inputs: Inputs, normal_lead: float) -> Prediction:
    """Averaged theory at the present inputs (eqs 20-22 with both faces).

    `normal_lead` [rad] is psi - n theta, which earlier changes of the ratio make different from 0.
    Where the load exceeds full friction the velocity is the limit v_q of the theory, with its sign.
    Both results are 0 without vibration, and where undamped resonance leaves no steady vibration.
    In these cases, and where the vibration does not break the contact loose, they are not `valid`.
    """
    fast = None
    with suppress(Refusal):
        fast = vibration(device)
    if fast is None or fast.velocity == 0.0:
        return Prediction(0.0, 0.0, holds=False, valid=False)
    ratio, faces = inputs.frequency_ratio, device.friction_faces
    delta = inputs.phase + normal_lead + ratio * fast.lag
    law, load = MeanFriction(device, fast.velocity), VibratingLoad(device, ratio, delta)

    def friction(turning: float) -> float:
        return faces * law.mean(load, turning)

    sliding = friction(0.0)
    if sliding == friction(pi):
        # No friction: every velocity is steady without a load, and none with one.
        fastest = -copysign(fast.velocity, inputs.load) if inputs.load else 0.0
        return Prediction(fastest, 0.0, holds=False, valid=False)
    normal = device.normal_preload + device.normal_amplitude
    noise = ROUNDING * EPSILON * faces * (law.coefficient + law.drag) * normal
    # The vibration alone must overcome friction: by its force on the pair and on a held slider.
    grip = sliding * (law.grip / law.coefficient)
    force = fast.velocity * device.total_mass * device.drive_frequency
    holds = abs(inputs.load) < sliding
    valid = holds and min(force, held_amplitude(device)) > grip
    turning = _balance(lambda turning: friction(turning) + inputs.load, noise)
    return Prediction(fast.velocity * cos(turning), -friction(0.5 * pi), holds, valid)


def _balance(excess: Callable[[float], float], noise: float) -> float:
    """The angle Theta [rad] at which the excess of friction and load falls through 0.

    Where it is 0 within its `noise` over a range (even ratios, with flight while sliding turns) it
    is the end of the highest velocity; where it stays above or below 0, pi or 0.
    """
    low, high = 0.0, pi
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if excess(middle) > noise else (low, middle)
    return 0.5 * (low + high)
