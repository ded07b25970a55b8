"""Motion in one contact mode as Taylor series in time: what exponentials cannot follow.

That is sliding while a LuGre bristle bends, and all motion where steady responses do not split off:
near resonance without damping, near critical damping, on soft resonators, under slow normal loads.
"""

from cmath import rect
from itertools import accumulate
from math import hypot, inf
from operator import mul, truediv

from .contact import LIFTED, STICK
from .device import EPSILON, System
from .first_zero import Watch
from .moment import Moment, Place

ORDER = 22
"""Order of the series: close to the cheapest one at any tolerance."""

_COUNT = range(1, ORDER + 2)
"""1 + the index of each coefficient."""

_STEPS = tuple(1.0 / count for count in range(1, ORDER + 1))
"""By which integration multiplies each coefficient."""

ROUNDING = 2.0 * EPSILON
"""Tolerance of a series of Coulomb friction."""


class Series:
    """Motion from `now` on in `direction`, or at rest or in flight by the contact mode.

    Friction is that of a bristle that `bends` (eq. 8), or else Coulomb's. With s the direction and
    g = sigma_0 z the former is F = faces N (g + sigma_1 z'), z' = v (1 - s g / mu). At its `reach`
    [s] the last terms are `tolerance` times the scale of velocities or, if that is less, times ten
    times the velocity itself.
    """

    def __init__(
        self,
        system: System,
        now: Moment,
        direction: int,
        bends: bool = False,
        tolerance: float = ROUNDING,
    ) -> None:
        rests = not direction and now.mode == STICK
        mobility = (system.held if rests else system.free).mobility
        w, q, coupling = system.drive_frequency, system.normal_frequency, system.coupling
        sign = 0 if now.mode == LIFTED else direction
        stiffness, damping = system.stick.stiffness, 2.0 * system.stick.decay
        drive, chi = -1j * rect(1.0, now.theta), now.psi + system.phase
        pulls = _sinusoid(system.direct * drive, w)
        pulls[0] -= system.load
        bases = _sinusoid(system.base_acceleration * drive, w)
        limit = _sinusoid(-1j * system.friction_amplitude * rect(1.0, chi), q)
        limit[0] += system.friction_preload
        displacement, rate = now.displacement, now.rate
        v, y, u = [now.velocity], [displacement], [rate]
        needed, force, shares = list[float](), list[float](), list[float]()
        mu, bristle = system.device.friction_coefficient, now.bristle
        hardness, drag = system.device.bristle_stiffness, system.device.bristle_damping
        unbent = [(mu - direction * bristle) / mu] if bends else []
        for k, step in enumerate(_STEPS):
            pull = pulls[k] + system.damper * rate + system.spring * displacement
            needed.append(pull)
            friction = sign * limit[k]
            if bends:
                bending = sum(map(mul, v, reversed(unbent)))
                shares.append((bristle + drag * bending) / mu)
                bristle = hardness * bending * step
                unbent.append(-direction * bristle / mu)
                friction = sum(map(mul, limit, reversed(shares)))
            force.append(friction)
            acceleration = (pull - friction) * mobility
            v.append(acceleration * step)
            swing = bases[k] - damping * rate - stiffness * displacement - coupling * acceleration
            displacement, rate = rate * step, swing * step
            y.append(displacement)
            u.append(rate)
        self._velocity, self._displacement, self._rate, self._force = v, y, u, force
        self._position = [0.0, *map(truediv, v, _COUNT)]
        self.direction, self.rests, self._limit, self._needed = direction, rests, limit, needed
        # The scale of velocities [m/s] is the sum of that of the drive, of what friction and load
        # change in a radian of it, and of those of slider and resonator.
        forces = system.friction_preload + system.friction_amplitude + abs(system.load)
        swing = hypot(now.rate, system.stick.frequency * now.displacement)
        scale = (abs(system.drive) + forces) / (system.total_mass * w)
        scale += abs(now.velocity) + system.mass_fraction * swing
        of_rate = scale / (system.mass_fraction or 1.0)
        self.reach = min(_reach(v, tolerance, scale), _reach(u, tolerance, of_rate))
        if rests:
            scale *= tolerance * system.total_mass * w
            self.reach = min(self.reach, *(_reach_of_last(c, scale) for c in (limit, needed)))

    def watches(self, horizon: float) -> tuple[Watch, ...]:
        """As of `ClosedForm`."""
        if self.rests:
            pairs = list(zip(self._limit, self._needed, strict=False))
            sizes = [abs(limit) + abs(needed) for limit, needed in pairs]
            spare = [limit - needed for limit, needed in pairs], [sum(pair) for pair in pairs]
            return tuple(_watch(side, sizes, horizon) for side in spare)
        if self.direction == 0:
            return ()
        watched = [self.direction * c for c in self._velocity]
        return (_watch(watched, list(map(abs, watched)), horizon),)

    def at(self, t: float) -> Place:
        """As of `ClosedForm`."""
        series = self._velocity, self._displacement, self._rate, self._position
        velocity, displacement, rate, travelled = (_value(c, t) for c in series)
        return velocity, displacement, rate, travelled

    def work(self, t: float, travelled: float) -> float:
        """As of `ClosedForm`."""
        force, velocity = self._force, self._velocity
        powers = (sum(map(mul, force, reversed(velocity[: k + 1]))) for k in range(ORDER))
        return _value([0.0, *map(truediv, powers, _COUNT)], t)


def _sinusoid(amplitude: complex, frequency: float) -> list[float]:
    """The series of Re(amplitude exp(i frequency t))."""
    z = complex(0.0, frequency)
    terms = accumulate(_STEPS, lambda c, step: c * z * step, initial=amplitude)
    return [term.real for term in terms]


def _watch(coefficients: list[float], sizes: list[float], horizon: float) -> Watch:
    """A series as a signal up to `horizon` [s]; its rounding errors grow with `sizes`."""
    slope = list(map(mul, coefficients[1:], _COUNT))
    bound = _value([abs(c) * count for c, count in zip(slope[1:], _COUNT, strict=False)], horizon)

    def signal(t: float) -> tuple[float, float, float]:
        return _value(coefficients, t), _value(slope, t), bound

    return Watch(signal, 4.0 * EPSILON * _value(sizes, horizon), 1.0 / horizon)


def _value(coefficients: list[float], t: float) -> float:
    total = 0.0
    for c in reversed(coefficients):
        total = total * t + c
    return total


def _reach(coefficients: list[float], tolerance: float, scale: float) -> float:
    """How far the series of a velocity holds [s]; see Series."""
    reach = _reach_of_last(coefficients, tolerance * scale)
    size = max(_value(list(map(abs, coefficients)), reach), 1e-200)  # less is not measured
    return _reach_of_last(coefficients, tolerance * min(scale, 10.0 * size))


def _reach_of_last(coefficients: list[float], tolerance: float) -> float:
    """Where the last two terms of a series are `tolerance` [s]."""
    last = len(coefficients) - 1
    sizes = [(k, abs(coefficients[k])) for k in (last - 1, last)]
    return min([(tolerance / size) ** (1.0 / k) for k, size in sizes if size > 0.0], default=inf)
