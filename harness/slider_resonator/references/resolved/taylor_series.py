"""Taylor series of the motion within one contact mode, for both friction laws.

Time is the drive angle [rad], and displacements are multiplied by the drive frequency w, so that
all states are velocities. With the force over inertia and w, and the direction s of the motion::

    (w x)' = X'       X'' = needed - limit g       (w Y)' = Y'       Y'' = base - k Y - d Y' - X''

g = s with Coulomb friction; with LuGre friction g = W + damping |X'| (s - W), where W = s0 z / mu,
the stretch of the bristle, obeys W' = rate |X'| (s - W). |X'| = s X' is analytic up to a reversal.
"""

from dataclasses import dataclass
from functools import lru_cache
from math import cos, factorial, sin
from operator import mul

from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.contact import LIFTED, STICK
from slider_resonator.references.resolved.mode_sequence import Segment

ORDER = 24
"""Order of the series: over `LONGEST` rad of the fastest rate the rest is below rounding."""
LONGEST = 2.4
_INVERSE_FACTORIALS = [1.0 / factorial(order) for order in range(ORDER + 1)]

Series = list[float]
"""Coefficients of ascending powers of the drive angle, ORDER + 1 of them."""


@dataclass(frozen=True)
class MotionSeries:
    """The series of a motion: `states` are w x, X', w Y, Y' and, with LuGre friction, W.

    `needed` is the force that the slider needs to keep its velocity, `limit` the largest friction,
    both over inertia and drive frequency. `bends`: the bristle lacks the stretch of steady sliding.
    """

    states: list[Series]
    needed: Series
    limit: Series
    bends: bool


def motion_series(
    segment: Segment, theta: float, angle: float, now: HeldInputs, states: list[float]
) -> MotionSeries:
    """Return the series of the motion from `states` on, somewhere in a segment.

    The angles (rad) are those of drive and normal load, `now` are the inputs there.
    """
    equations, mode, direction = segment.equations, segment.mode, segment.direction
    frequency = equations.drive_frequency
    unit = 1.0 / (equations.inertia * frequency)
    damping, spring = unit * equations.coupling_damping, unit * equations.coupling_stiffness
    spring /= frequency
    sine, cosine = sin(theta), cos(theta)
    force = _sine_series(
        unit * (equations.force_sine * sine + equations.force_cosine * cosine),
        unit * (equations.force_sine * cosine - equations.force_cosine * sine),
        _INVERSE_FACTORIALS,
    )
    force[0] -= unit * now.load
    force[1] -= unit * now.load_rate / frequency
    limit = _normal_series(angle, now, unit * equations.friction_amplitude, frequency)
    limit[0] += unit * equations.friction_mean
    base_acceleration = equations.base_acceleration / frequency
    base = _sine_series(base_acceleration * sine, base_acceleration * cosine, _INVERSE_FACTORIALS)

    way, velocity, displacement, rate = ([state] for state in states[:4])
    stretch = states[4:]
    shortfall = [direction - stretch[0]] if stretch else [0.0]
    bends = abs(shortfall[0]) > 1e-15  # more than rounding
    if stretch and not bends:
        stretch = [float(direction), *[0.0] * ORDER]
    slides, closed = mode != STICK, mode not in (STICK, LIFTED)
    pull = force
    if closed and not bends:
        pull = [pushed - direction * held for pushed, held in zip(force, limit, strict=True)]
    path_rate = direction * equations.path_rate / frequency
    path_damping = direction * equations.path_damping
    damping_rate = equations.damping_rate / frequency
    stiffness_rate = equations.stiffness_rate / frequency**2
    grip: Series = []
    acceleration = 0.0
    for order in range(ORDER):
        swing = damping_rate * rate[order] + stiffness_rate * displacement[order]
        if slides:
            acceleration = damping * rate[order] + spring * displacement[order] + pull[order]
            if bends:
                moved = sum(map(mul, velocity, reversed(shortfall)))
                grip.append(stretch[order] + path_damping * moved)
                if closed:
                    acceleration -= sum(map(mul, limit, reversed(grip)))
                stretch.append(path_rate * moved / (order + 1))
                shortfall.append(-stretch[-1])
        way.append(velocity[order] / (order + 1))
        velocity.append(acceleration / (order + 1))
        displacement.append(rate[order] / (order + 1))
        rate.append((base[order] - swing - acceleration) / (order + 1))
    needed = force
    if mode == STICK:
        needed = [
            damping * u + spring * y + f for u, y, f in zip(rate, displacement, force, strict=True)
        ]
    rows = [way, velocity, displacement, rate]
    return MotionSeries([*rows, stretch] if stretch else rows, needed, limit, bends)


def _normal_series(angle: float, now: HeldInputs, amplitude: float, frequency: float) -> Series:
    """Return the series of `amplitude` sin(angle + ratio t + chirp t^2 / 2)."""
    sine, cosine = amplitude * sin(angle), amplitude * cos(angle)
    ratio, chirp = now.frequency_ratio, now.ratio_rate / frequency
    if not chirp:
        return _sine_series(sine, cosine, _powers(ratio))
    terms = [complex(cosine, sine), 1j * ratio * complex(cosine, sine)]
    for order in range(1, ORDER):
        following = 1j * (ratio * terms[order] + chirp * terms[order - 1]) / (order + 1)
        terms.append(following)
    return [term.imag for term in terms]


def _sine_series(value: float, slope: float, powers: Series) -> Series:
    """Return the series of a sine of this value and slope; `powers` are rate**k / k!."""
    cycle = (value, slope, -value, -slope) * (ORDER // 4 + 1)
    return list(map(mul, cycle, powers))


@lru_cache(maxsize=64)
def _powers(rate: float) -> Series:
    return [rate**order * one for order, one in enumerate(_INVERSE_FACTORIALS)]
