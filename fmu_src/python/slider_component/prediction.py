"""Steady velocity and blocking force for the present inputs, by averaged theory (20)-(22).

There mean friction balances the load, at any integer frequency ratio n, for lifting contact and for
LuGre friction; at any other ratio all phases are met and the mean load counts. From there on
`averaging_order` 2 finds both exactly, by periodic motions of the full device.
"""

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from functools import lru_cache
from math import copysign, cos, inf, pi, tau
from operator import mul
from typing import NamedTuple

from .contact import VibratingLoad, turns_to_repeat
from .device import EPSILON, Device, System, Vibration
from .mean_friction import MeanFriction
from .moment import Moment
from .parameters import Inputs
from .period_map import Numbers, PeriodMap
from .slow_equation import NoRatesError
from .values import MAX_SEGMENTS, Budget, Refusal

MAX_TURNS = 32
"""Largest number of turns of the drive after which the normal load may repeat."""

BESIDE = 1e-6
"""Change of an unknown by which derivatives are taken; unknowns are over their scales."""

NEAR = 1e-3
"""Change from which on the last derivatives serve to the end."""

CONVERGED = 1e-10
"""Change at which the iteration ends: the next one would be rounding."""


class Averages(NamedTuple):
    """Steady velocity [m/s] and blocking force [N], and whether they are `valid`: they apply.

    Friction `holds` a load below that of sliding.
    """

    steady_velocity: float
    blocking_force: float
    holds: bool
    valid: bool


@lru_cache(maxsize=16)
def prediction(
    device: Device, inputs: Inputs, normal_lead: float, blocked: bool
) -> tuple[float, bool]:
    """The steady velocity, or the `blocked` force, by the averaging order; whether it is valid.

    By second order it is that of a periodic motion of the full device, looked for from averages on,
    and valid only where one was found. `normal_lead` [rad] is psi - n theta, which earlier changes
    of the ratio make different from 0.
    """
    first = first_order(device, inputs, normal_lead)
    value = first.blocking_force if blocked else first.steady_velocity
    if device.averaging_order == 1:
        return value, first.valid
    full, turns = replace(device, fidelity=2), turns_of_load(device, inputs.frequency_ratio)
    if device.resonator_mass == 0.0:
        # It moves nothing: one that settles within a period takes its place, so that the search
        # need not wait for it.
        full = replace(full, resonator_frequency=device.drive_frequency, damping_ratio=1.0)
    with suppress(ArithmeticError, ValueError, Refusal):
        if turns is not None and first.holds:
            period_map = PeriodMap(System(full, inputs), turns)
            psi = (normal_lead + inputs.frequency_ratio * period_map.section) % tau
            start = (0.0, value) if blocked else (value, inputs.load)
            return periodic_motion(period_map, psi, *start, blocked), True
    return value, False


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


@lru_cache(maxsize=8)  # for both quantities
def first_order(device: Device, inputs: Inputs, normal_lead: float) -> Averages:
    """Averaged theory at the present inputs (eqs 20-22 with both faces).

    Where the load exceeds full friction the velocity is the limit v_q of the theory, with its sign.
    Both are 0 without vibration, and where undamped resonance leaves no steady one. In these cases,
    and where the vibration does not break the contact loose, they are not `valid`.
    """
    fast, holding, none = None, inf, Averages(0.0, 0.0, holds=False, valid=False)
    with suppress(Refusal):
        fast = Vibration(device)
        holding = abs(Vibration(device, held=True).force)
    if fast is None or fast.velocity == 0.0:
        return none
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
    w, mu = fast.frequency, law.coefficient
    bend = abs(complex(law.stiffness, w * law.damping)) * fast.velocity / w
    grip = sliding * (min(mu, bend) / mu if law.bends else 1.0)
    holds = abs(inputs.load) < sliding
    valid = holds and min(abs(fast.force), holding) > grip
    # Friction and load fall through 0 at the angle of balance. Where they are 0 within rounding
    # over a range (even ratios, with flight while sliding turns) it is the end of the highest
    # velocity.
    normal = device.normal_preload + device.normal_amplitude
    noise = 8.0 * EPSILON * law.faces * (mu + law.drag) * normal
    low, high = 0.0, pi
    for _ in range(52):  # halvings to the last digit
        middle = 0.5 * (low + high)
        above = law.mean(load, middle) + inputs.load > noise
        low, high = (middle, high) if above else (low, middle)
    velocity = fast.velocity * cos(0.5 * (low + high))
    return Averages(velocity, -law.mean(load, 0.5 * pi), holds, valid)


def periodic_motion(
    period_map: PeriodMap, psi: float, velocity: float, load: float, blocked: bool
) -> float:
    """The mean velocity [m/s] of the steady motion under a load [N], or the load that blocks it.

    Blocked motion has no travel; the given load is a guess. The search begins at a slow velocity
    [m/s], the steady vibration without friction, and normal phase `psi` [rad] at the section. All
    its maps draw from one budget. Raises NoRatesError where none is found, where it is not stable,
    and where the blocked slider never reverses: it sticks, under other loads, too.
    """
    device, speed = period_map.motion.system.device, period_map.speed
    # A host that reads an output does not expect to wait as for a step.
    budget = Budget(period_map.period, 0.0, MAX_SEGMENTS // 10)
    vibrating = Moment(0.0, *period_map.vibration.swing(period_map.section), 0.0, psi=psi)
    vibrating.bristle = device.friction_coefficient
    _, *fast, _ = period_map.numbers(vibrating)
    # The slow velocity, the fast states and, if unknown, the load, by the force that stops v_q in a
    # period. A period of periodic motion changes none of the former, nor, if blocked, the position.
    force = device.total_mass * speed / period_map.period
    scales = [*period_map.scale[:-1], force]
    start = [velocity, *fast, *([load] if blocked else [])]
    unknowns = [x / s for x, s in zip(start, scales, strict=False)]

    def changes(unknowns: Numbers) -> tuple[list[float], Moment]:
        """What a period changes, over the scales, and its end."""
        slow, *fast = (u * s for u, s in zip(unknowns, scales, strict=False))
        loaded = period_map.under_load(fast.pop() if blocked else load)
        begin = loaded.place(vibrating, slow, fast)
        (_, end), _ = loaded.sections(begin, 1, budget)
        first, last = loaded.numbers(begin), loaded.numbers(end)
        changed = [(b - a) / s for a, b, s in zip(first, last, period_map.scale, strict=True)]
        return changed if blocked else changed[:-1], end

    # Two periods of motion bring near what is looked for, under strong friction.
    for _ in range(2):
        changed, _ = changes(unknowns)
        if blocked:
            changed[0], changed[-1] = changed[0] - changed[-1], 0.0
        unknowns = [u + c for u, c in zip(unknowns, changed, strict=True)]
    largest = inf
    for _ in range(24):
        now, end = changes(unknowns)
        if largest > NEAR:
            columns = []
            for j in range(len(unknowns)):
                beside = [u + BESIDE * (i == j) for i, u in enumerate(unknowns)]
                differences = zip(changes(beside)[0], now, strict=True)
                columns.append([(b - a) / BESIDE for b, a in differences])
            jacobian = list(zip(*columns, strict=True))
        elif largest <= CONVERGED and blocked and end.reversals > 0:
            return unknowns[-1] * force
        elif largest <= CONVERGED and not blocked and _is_stable(jacobian):
            return end.position / period_map.period
        step = solved(jacobian, [-e for e in now])
        largest = max(map(abs, step))
        share = min(1.0, 0.2 / largest) if largest > 0.0 else 1.0  # from afar by small changes
        unknowns = [u + share * s for u, s in zip(unknowns, step, strict=True)]
    raise NoRatesError


def solved(matrix: Sequence[Numbers], right: Numbers) -> Numbers:
    """The solution x of `matrix` x = `right`. Raises NoRatesError for a singular matrix."""
    rows = [[*row, value] for row, value in zip(matrix, right, strict=True)]
    for k in range(len(rows)):
        pivot = max(range(k, len(rows)), key=lambda i: abs(rows[i][k]))
        rows[k], rows[pivot] = rows[pivot], rows[k]
        if not 0.0 < abs(rows[k][k]) < inf:
            raise NoRatesError
        for i in range(len(rows)):
            if i != k:
                factor = rows[i][k] / rows[k][k]
                rows[i] = [a - factor * b for a, b in zip(rows[i], rows[k], strict=True)]
    return [row[-1] / row[k] for k, row in enumerate(rows)]


def _is_stable(jacobian: Sequence[Numbers]) -> bool:
    """Whether the linear map of a period has halved in 2^24 periods, unlike rounding alone."""
    power = [[x + (i == j) for j, x in enumerate(row)] for i, row in enumerate(jacobian)]
    for _ in range(24):
        power = [[sum(map(mul, row, c)) for c in zip(*power, strict=True)] for row in power]
    return all(abs(x) < 0.5 for row in power for x in row)
