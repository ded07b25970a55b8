"""LuGre friction (eq. 8): from one reversal to the next along the bristle's path.

With s the direction of sliding, g = sigma_0 z the friction of the bristle and g_r its value where a
series starts, the bristle is a function of the path d = |x - x_r| alone:

    g = s mu + (g_r - s mu) E,    E = exp(-sigma_0 d / mu),    E' = -(sigma_0 / mu) |v| E
    F = faces N (g_r + (mu - s g_r) (s (1 - E) + E sigma_1 v / mu))

so no stiff state remains, and deep presliding, where g_r and 1 - E are small, loses no digits.
Taylor series follow the motion while E matters. After it has decayed the bristle is fully bent,
friction is Coulomb's, and closed forms take over. The cost does not grow with the stiffness. There
is no sticking: presliding is resolved as an oscillation on the bristles.
"""

from __future__ import annotations

from cmath import rect
from math import expm1, inf
from operator import mul, truediv

from .contact import BACKWARD, FORWARD, LIFTED, direction_of
from .device import EPSILON, System, velocity_scale
from .first_zero import Watch
from .moment import Moment
from .sliding import End, Motion, slide

TOLERANCE_SHARE = 0.01
"""Share of the tolerance for the error of one series, and for the bend that a bristle still lacks
when closed forms take over."""

ORDER = 22
"""Order of the series: close to the cheapest one at any tolerance."""

_COUNT = range(1, ORDER + 2)
"""1 + the index of each coefficient."""

_STEPS = tuple(1.0 / count for count in range(1, ORDER + 1))
"""By which integration multiplies each coefficient."""

MUCH_SMALLER = 0.1
"""Share of the scale of velocities below which a velocity is measured by itself: its series is cut
shorter to keep the tolerance relative to it."""

FIRST_TERMS = 5
"""Terms of a series by which its velocity is measured."""

NEGLIGIBLE_MOTION = 1e-200
"""Motion [m/s] below which a series is not cut shorter."""

MAX_SHRINKS = 10
"""How often a series is cut shorter."""


class LuGre:
    """A friction law, with the methods of `Coulomb`."""

    def mode(self, system: System, now: Moment) -> int:
        """Contact mode under the held inputs."""
        return LIFTED if system.is_lifted(now.psi) else direction_of(now.velocity)

    def force(self, system: System, now: Moment, mode: int) -> float:
        """Friction force [N] on the slider in contact mode `mode` (eq. 8), positive against +X."""
        if mode == LIFTED:
            return 0.0
        mu = system.device.friction_coefficient
        drag = now.velocity - abs(now.velocity) * now.bristle / mu
        share = (now.bristle + system.device.bristle_damping * drag) / mu
        return system.friction_limit(now.psi) * share

    def begin(self, system: System, now: Moment) -> tuple[Motion, int, float]:
        """As of `Coulomb`. The direction is that of the velocity or, at rest, of the force."""
        direction = BACKWARD if now.velocity < 0.0 else FORWARD
        motion, reach = _motion(system, now, direction)
        if now.velocity == 0.0 and not _departs(motion, reach):
            direction = BACKWARD
            motion, reach = _motion(system, now, direction)
        return motion, direction, reach

    def succeed(self, system: System, now: Moment, end: End) -> None:
        """As of `Coulomb`."""
        lifted = (now.mode == LIFTED) != end.switches
        now.bristle = bristle_after(system, now.bristle, end.travelled)
        now.mode = LIFTED if lifted else direction_of(now.velocity)
        if end.switches:
            now.event_age = 0.0


def bristle_after(system: System, friction: float, travel: float) -> float:
    """sigma_0 z after `travel` [m] in one direction (its sign), from `friction` on."""
    mu = system.device.friction_coefficient
    limit = mu if travel >= 0.0 else -mu
    return friction - (limit - friction) * expm1(
        -system.device.bristle_stiffness * abs(travel) / mu
    )


def _motion(system: System, now: Moment, direction: int) -> tuple[Motion, float]:
    """Motion in `direction`, in closed form where the bristle is fully bent, and its reach [s]."""
    tolerance = TOLERANCE_SHARE * system.device.tolerance
    mu = system.device.friction_coefficient
    if now.mode == LIFTED or abs(mu - direction * now.bristle) <= tolerance * mu:
        return slide(system, now, direction), inf
    scale = velocity_scale(system, now.velocity, now.displacement, now.rate)
    series = BristleSeries(system, direction, now, tolerance, scale)
    return series, series.reach


def _departs(motion: Motion, reach: float) -> bool:
    """Whether a slider at rest begins to move in the direction of `motion`, or not at all."""
    if isinstance(motion, BristleSeries):
        return motion.departs()
    (watch,) = motion.watches(reach)
    return watch.signal(0.0)[1] >= 0.0


class BristleSeries:
    """Motion in contact while a bristle bends, in direction `sign`, as a Taylor series in time.

    At its `reach` [s] the last terms of the series are `tolerance` times `scale` [m/s] or, if that
    is much less, times the velocity itself.
    """

    __slots__ = ("_displacement", "_position", "_rate", "_sign", "_velocity", "reach")

    def __init__(
        self, system: System, sign: int, now: Moment, tolerance: float, scale: float
    ) -> None:
        w, q = system.drive_frequency, system.normal_frequency
        device, mu = system.device, system.device.friction_coefficient
        bending, share = (mu - sign * now.bristle) / mu, now.bristle / mu
        drag, rate_factor = device.bristle_damping / mu, -sign * device.bristle_stiffness / mu
        mass, spring, damper = system.slider_mass, system.spring, system.damper
        stiffness, damping = system.stick.stiffness, 2.0 * system.stick.decay
        held, base = system.holding_drive, system.base_acceleration
        drive = -1j * rect(1.0, now.theta)
        normal = -1j * system.friction_amplitude * rect(1.0, now.psi + system.phase)
        v, y, u = [now.velocity], [now.displacement], [now.rate]
        limit, decay, bent = [system.friction_preload + normal.real], [1.0], []
        lost, load, resonates = 0.0, system.load, system.resonator_amplitude is None
        for k, step in enumerate(_STEPS):
            rate, displacement = u[k], y[k]
            product = sum(map(mul, v, reversed(decay)))
            bent.append(drag * product + sign * lost)
            force = share * limit[k] + bending * sum(map(mul, limit, reversed(bent)))
            pull = (held * drive).real + damper * rate + spring * displacement
            acceleration = (pull - load - force) / mass
            v.append(acceleration * step)
            if resonates:
                swing = base * drive.real - damping * rate - stiffness * displacement
                u.append((swing - acceleration) * step)
                y.append(rate * step)
            else:
                u.append(0.0)
                y.append(0.0)
            faded = rate_factor * product * step
            decay.append(faded)
            lost, load = -faded, 0.0
            drive *= complex(0.0, w * step)
            normal *= complex(0.0, q * step)
            limit.append(normal.real)
        self._sign = sign
        self._velocity, self._displacement, self._rate = v, y, u
        self._position = [0.0, *map(truediv, v, _COUNT)]
        self.reach = _reach(v, tolerance, scale)
        if resonates:
            weight = system.mass_fraction or 1.0
            self.reach = min(self.reach, _reach(u, tolerance, scale / weight))

    def departs(self) -> bool:
        """Whether the motion begins in direction `sign`, or stays at rest."""
        first = next((c for c in self._velocity if c != 0.0), 0.0)
        return self._sign * first >= 0.0

    def watches(self, horizon: float) -> tuple[Watch, ...]:
        """The velocity in the direction of sliding, up to `horizon` [s]."""
        velocity = [self._sign * c for c in self._velocity]
        slope = list(map(mul, velocity[1:], _COUNT))
        bound = _value(list(map(mul, map(abs, slope[1:]), _COUNT)), horizon)
        scale = _value(list(map(abs, velocity)), horizon)

        def signal(t: float) -> tuple[float, float, float]:
            return _value(velocity, t), _value(slope, t), bound

        return (Watch(signal, 4.0 * EPSILON * scale, 1.0 / horizon),)

    def travel(self, t: float) -> float:
        """See Motion."""
        return _value(self._position, t)

    def at(self, t: float) -> tuple[float, float, float]:
        """See Motion."""
        return _value(self._velocity, t), _value(self._displacement, t), _value(self._rate, t)


def _value(coefficients: list[float], t: float) -> float:
    total = 0.0
    for c in reversed(coefficients):
        total = total * t + c
    return total


def _reach(coefficients: list[float], tolerance: float, scale: float) -> float:
    """How far the series of a velocity holds [s]; see BristleSeries."""
    reach = _reach_of_last(coefficients, tolerance * scale)
    for _ in range(MAX_SHRINKS):
        size = _value(list(map(abs, coefficients[:FIRST_TERMS])), reach)
        if not NEGLIGIBLE_MOTION < size < MUCH_SMALLER * scale:
            break
        scale = size
        reach = _reach_of_last(coefficients, tolerance * scale)
    return reach


def _reach_of_last(coefficients: list[float], tolerance: float) -> float:
    """Where the last two terms of a series are `tolerance` [s]."""
    last = len(coefficients) - 1
    reach = inf
    for k in (last - 1, last):
        size = abs(coefficients[k])
        if size > 0.0:
            reach = min(reach, (tolerance / size) ** (1.0 / k))
    return reach
