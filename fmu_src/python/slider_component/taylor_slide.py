"""Sliding while a bristle bends: LuGre friction as a Taylor series in time.

With s the direction of sliding, g = sigma_0 z the friction of the bristle and g_r its value where
this series starts, the bristle is a function of the path d = |x - x_r| alone (eq. 8):

    g = s mu + (g_r - s mu) E,    E = exp(-sigma_0 d / mu),    E' = -(sigma_0 / mu) |v| E
    F = faces N (g_r + (mu - s g_r) (s (1 - E) + E sigma_1 v / mu))

so no stiff state remains, and deep presliding, where g_r and 1 - E are small, loses no digits. The
Taylor coefficients of all factors follow by recurrence.
"""

from __future__ import annotations

from cmath import rect
from math import inf
from operator import mul, truediv

from .bristle import Bristle
from .first_zero import Watch
from .motion import EPSILON, State
from .plant import Plant

ORDER = 22
"""Order of the series: close to the cheapest one at any tolerance."""

_COUNT = range(1, ORDER + 2)
"""1 + the index of each coefficient."""

_STEPS = tuple(1.0 / count for count in range(1, ORDER + 1))
"""By which integration multiplies each coefficient."""

SMALL = 1e-3
"""Share of a motion that the last terms of its series may have."""

NEGLIGIBLE_MOTION = 1e-200
"""Motion [m/s] below which a series is not cut shorter."""

MAX_SHRINKS = 4
"""How often a series is cut shorter to reach that share."""


class TaylorSlide:
    """Motion in contact from `state` on, in direction `sign`, up to `reach` [s].

    `friction` is sigma_0 z at the start. At `reach` the last terms of the series are `tolerance`
    [m/s].
    """

    __slots__ = ("_displacement", "_position", "_rate", "_sign", "_velocity", "reach")

    def __init__(
        self,
        plant: Plant,
        bristle: Bristle,
        sign: int,
        state: State,
        friction: float,
        theta: float,
        chi: float,
        tolerance: float,
    ) -> None:
        w, q = plant.drive_frequency, plant.normal_frequency
        mu = bristle.coefficient
        bend, share = mu - sign * friction, friction / mu
        drag, rate_factor = bristle.damping / mu, -sign * bristle.stiffness / mu
        mass, spring, damper = plant.slider_mass, plant.spring, plant.damper
        stiffness, damping = plant.stick.stiffness, 2.0 * plant.stick.decay
        held_real, held_imag = plant.holding_drive.real, plant.holding_drive.imag
        base = plant.base_acceleration
        drive, normal = -1j * rect(1.0, theta), -1j * plant.friction_amplitude * rect(1.0, chi)
        # As real numbers, which Python multiplies faster than complex ones.
        drive_real, drive_imag = drive.real, drive.imag
        normal_real, normal_imag = normal.real, normal.imag
        v, y, u = [state.velocity], [state.displacement], [state.rate]
        limit, decay, bent = [plant.friction_preload + normal_real], [1.0], []
        bending, lost, load = bend / mu, 0.0, plant.load
        resonates = plant.resolves_resonator
        for k, step in enumerate(_STEPS):
            rate, displacement = u[k], y[k]
            product = sum(map(mul, v, reversed(decay)))
            bent.append(drag * product + sign * lost)
            force = share * limit[k] + bending * sum(map(mul, limit, reversed(bent)))
            pull = held_real * drive_real - held_imag * drive_imag
            acceleration = (pull + damper * rate + spring * displacement - load - force) / mass
            v.append(acceleration * step)
            if resonates:
                swing = base * drive_real - damping * rate - stiffness * displacement
                u.append((swing - acceleration) * step)
                y.append(rate * step)
            else:
                u.append(0.0)
                y.append(0.0)
            faded = rate_factor * product * step
            decay.append(faded)
            lost, load = -faded, 0.0
            turned = w * step
            drive_real, drive_imag = -drive_imag * turned, drive_real * turned
            turned = q * step
            normal_real, normal_imag = -normal_imag * turned, normal_real * turned
            limit.append(normal_real)
        self._sign = sign
        self._velocity, self._displacement, self._rate = v, y, u
        self._position = [0.0, *map(truediv, v, _COUNT)]
        self.reach = _reach(v, tolerance)
        if resonates:
            weight = plant.mass_fraction or 1.0
            self.reach = min(self.reach, _reach(u, tolerance / weight))
        self._cut_off_slow_motion(tolerance)

    def _cut_off_slow_motion(self, tolerance: float) -> None:
        """Shorten the series of a motion far below the tolerance.

        Otherwise its last terms would exceed the motion itself, and its first zero would be hard to
        find.
        """
        v = self._velocity
        for _ in range(MAX_SHRINKS):
            small = SMALL * (abs(v[0]) + abs(v[1]) * self.reach)
            if not NEGLIGIBLE_MOTION < small < tolerance:
                break
            self.reach = min(self.reach, _reach(v, small))

    def departs(self) -> bool:
        """Whether the motion begins in direction `sign`, or stays at rest."""
        first = next((c for c in self._velocity if c != 0.0), 0.0)
        return self._sign * first >= 0.0

    def watches(self, horizon: float) -> tuple[Watch, ...]:
        """The velocity in the direction of sliding, up to `horizon` [s]."""
        velocity = [self._sign * c for c in self._velocity]
        slope = list(map(mul, velocity[1:], _COUNT))
        curvature = list(map(mul, map(abs, slope[1:]), _COUNT))
        bound = _value(curvature, horizon)
        scale = _value(list(map(abs, velocity)), horizon)

        def signal(t: float) -> tuple[float, float, float]:
            return _value(velocity, t), _value(slope, t), bound

        return (Watch(signal, 4.0 * EPSILON * scale, 1.0 / horizon, inf),)

    def travel(self, t: float) -> float:
        """Displacement of the slider after `t` [s], in m."""
        return _value(self._position, t)

    def state(self, t: float) -> State:
        """State after `t` [s]."""
        return State(
            _value(self._velocity, t), _value(self._displacement, t), _value(self._rate, t)
        )


def _value(coefficients: list[float], t: float) -> float:
    total = 0.0
    for c in reversed(coefficients):
        total = total * t + c
    return total


def _reach(coefficients: list[float], tolerance: float) -> float:
    """How far a series holds [s]: where its last two terms are `tolerance`."""
    last = len(coefficients) - 1
    reach = inf
    for k in (last - 1, last):
        size = abs(coefficients[k])
        if size > 0.0:
            reach = min(reach, (tolerance / size) ** (1.0 / k))
    return reach
