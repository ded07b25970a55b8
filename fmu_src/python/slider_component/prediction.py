"""Steady velocity and blocking force for the present inputs, by averaged theory (20)-(22).

Under `averaging_order` 2 both are exact, by periodic motions of the full device; the theory is
where they start. It holds for any integer frequency ratio n, for lifting contact and for LuGre
friction: the mean friction of `mean_friction` balances the load. At any other ratio all phases are
met and the mean load counts.
"""

from contextlib import suppress
from dataclasses import replace
from functools import lru_cache
from math import copysign, cos, inf, pi, tau
from typing import NamedTuple

from .contact import VibratingLoad, turns_to_repeat
from .device import EPSILON, Device, System, Vibration
from .mean_friction import MeanFriction
from .parameters import Inputs
from .period_map import PeriodMap
from .steady_motion import periodic_motion
from .values import Refusal

ROUNDING = 8.0
"""Rounding error of a mean friction, in units of the last place of the largest friction."""

MAX_TURNS = 32
"""Largest number of turns of the drive after which the normal load may repeat."""


class Prediction(NamedTuple):
    """Steady velocity [m/s] and blocking force [N], and whether they apply.

    Friction `holds` a load below that of sliding.
    """

    steady_velocity: float
    blocking_force: float
    holds: bool
    valid: bool


@lru_cache(maxsize=8)
def prediction(device: Device, inputs: Inputs, normal_lead: float) -> Prediction:
    """The prediction of the averaging order of the device.

    By second order both are those of periodic motions of the full device, looked for from averages
    on, and valid only where such were found. `normal_lead` [rad] is psi - n theta, which earlier
    changes of the ratio make different from 0.
    """
    first = first_order(device, inputs, normal_lead)
    if device.averaging_order == 1:
        return first
    full, turns = replace(device, fidelity=2), turns_of_load(device, inputs.frequency_ratio)
    if device.resonator_mass == 0.0:
        # It moves nothing: one that settles within a period takes its place, so that the search
        # need not wait for it.
        full = replace(full, resonator_frequency=device.drive_frequency, damping_ratio=1.0)
    with suppress(ArithmeticError, ValueError, Refusal):
        if turns is not None and first.holds:
            period_map = PeriodMap(System(full, inputs), turns)
            psi = (normal_lead + inputs.frequency_ratio * period_map.section) % tau
            start = first.steady_velocity, inputs.load
            velocity = periodic_motion(period_map, psi, *start, blocked=False)
            force = periodic_motion(period_map, psi, 0.0, first.blocking_force, blocked=True)
            return Prediction(velocity, force, holds=True, valid=True)
    return first._replace(valid=False)


def turns_of_load(device: Device, ratio: float) -> int | None:
    """Number of turns of the drive after which the normal load repeats; None if it never does."""
    return turns_to_repeat(ratio if device.normal_amplitude > 0.0 else 0.0, MAX_TURNS)


def theory_range(device: Device) -> tuple[float, ...]:
    """Return numbers that are all finite where motion stays in the range of floating point.

    The square of the fast velocity, the drag over mu, and a bound on integrals of load and friction
    at the fast and the initial velocity and the initial bristle deflection.
    """
    velocity = 0.0
    with suppress(Refusal):
        velocity = Vibration(device).velocity
    mu, drag, bent = device.friction_coefficient, 0.0, 0.0
    if device.friction_law == 1:
        drag = device.bristle_damping * max(velocity, abs(device.initial_velocity)) / mu
        bent = abs(device.bristle_stiffness * device.initial_bristle_deflection) * (1.0 + drag)
    normal = device.normal_preload + device.normal_amplitude
    return velocity**2, drag, tau * normal * (1.0 + 2.0 * (mu * (1.0 + drag) + bent))


def first_order(device: Device, inputs: Inputs, normal_lead: float) -> Prediction:
    """Averaged theory at the present inputs (eqs 20-22 with both faces).

    Where the load exceeds full friction the velocity is the limit v_q of the theory, with its sign.
    Both results are 0 without vibration, and where undamped resonance leaves no steady vibration.
    In these cases, and where the vibration does not break the contact loose, they are not `valid`.
    """
    fast, holding, none = None, inf, Prediction(0.0, 0.0, holds=False, valid=False)
    with suppress(Refusal):
        fast = Vibration(device)
        holding = abs(Vibration(device, held=True).force)
    if fast is None or fast.velocity == 0.0:
        return none
    w, mu = device.drive_frequency, device.friction_coefficient
    delta = inputs.phase + normal_lead + inputs.frequency_ratio * fast.lag
    law = MeanFriction(device, fast.velocity)
    load = VibratingLoad(device.normal_load, inputs.frequency_ratio, delta, law.max_waves)
    sliding, backward = (law.mean(load, turning) for turning in (0.0, pi))
    if sliding == backward:
        # No friction: every velocity is steady without a load, and none with one.
        velocity = -copysign(fast.velocity, inputs.load) if inputs.load else 0.0
        return none._replace(steady_velocity=velocity)
    # The vibration alone must overcome friction: by its force on the pair and on a held slider.
    # One far shorter than mu / sigma_0 only bends the bristles.
    bend = abs(complex(law.stiffness, w * law.damping)) * fast.velocity / w
    grip = sliding * (min(mu, bend) / mu if law.bends else 1.0)
    holds = abs(inputs.load) < sliding
    valid = holds and min(abs(fast.force), holding) > grip
    # Friction and load fall through 0 at the angle of balance. Where they are 0 within rounding
    # over a range (even ratios, with flight while sliding turns) it is the end of the highest
    # velocity.
    normal = device.normal_preload + device.normal_amplitude
    noise = ROUNDING * EPSILON * law.faces * (mu + law.drag) * normal
    low, high = 0.0, pi
    for _ in range(52):  # halvings to the last digit
        middle = 0.5 * (low + high)
        above = law.mean(load, middle) + inputs.load > noise
        low, high = (middle, high) if above else (low, middle)
    velocity = fast.velocity * cos(0.5 * (low + high))
    return Prediction(velocity, -law.mean(load, 0.5 * pi), holds, valid)
