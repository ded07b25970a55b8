"""A segment of motion: inputs held, contact mode unchanged, in closed form or as Taylor series.

The slider follows from the momentum of the pair and the motion of the resonator. With the rates z
of drive, normal load and free resonator, and friction s (F0 + F1 sin(chi)), sliding, flight and
rest are sums of exponentials:

    v(t) = k0 + k1 t + sum of Re(v_z exp(z t)),    Y(t) = offset + sum of Re(y_z exp(z t))

Taylor series follow what these cannot: sliding while a LuGre bristle bends, and all motion where
steady responses do not split off without losing digits, that is near resonance without damping,
near critical damping, on soft resonators, under slow normal loads.
"""

from cmath import exp, rect, sinh
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


class ClosedForm:
    """Motion from `now` on: rest, sliding in `direction` under full friction, or flight.

    It holds up to its `reach` [s]; its velocity is watched in `direction` unless that is 0.
    """

    reach = inf

    def __init__(self, system: System, now: Moment, direction: int) -> None:
        self.rests = not direction and now.mode == STICK
        mode = system.held if self.rests else system.free
        assert mode.responses is not None
        (p, v, y), (q, w, x) = mode.responses
        sign, chi = 0 if now.mode == LIFTED else direction, now.psi + system.phase
        turn, turned = rect(1.0, now.theta), rect(sign, chi)
        constant, swinging = sign * system.friction_preload, system.friction_amplitude * turned
        if not system.normal_frequency:
            constant, swinging = constant + swinging.imag, 0j
        terms = [(p, v * turn, y * turn)]
        if swinging and q == p:
            terms = [(p, v * turn + w * turned, y * turn + x * turned)]
        elif swinging:
            terms.append((q, w * turned, x * turned))
        resisting = constant + system.load
        offset = resisting * mode.compliance
        k0, displacement, rate = now.velocity, now.displacement - offset, now.rate
        for z, v, y in terms:
            k0 -= v.real
            displacement -= y.real
            rate += z.imag * y.imag
        if system.is_full:
            for z, y in mode.oscillator.free(displacement, rate):
                v = -mode.mass_fraction * z * y
                k0 -= v.real
                terms.append((z, v, y))
        self.direction, self._system = direction, system
        self._k0, self._k1, self._offset = k0, -resisting * mode.pair_mobility, offset
        self._terms, self._turn, self._chi = terms, turn, chi
        self._constant, self._swinging = constant, swinging

    def at(self, t: float) -> Place:
        """Where the motion is after `t` [s]."""
        k0, k1 = self._k0, self._k1
        swing = passed = moved = turning = 0j
        for z, v, y in self._terms:
            turn = exp(z * t)
            y *= turn
            swing += v * turn
            passed += v / z * (turn - 1.0)
            moved += y
            turning += z * y
        travelled = (k0 + 0.5 * k1 * t) * t + passed.real
        return k0 + k1 * t + swing.real, self._offset + moved.real, turning.real, travelled

    def work(self, t: float, travelled: float) -> float:
        """Work of friction [J] in the first `t` [s], in which the slider has `travelled` [m].

        The friction is constant + Im(swinging exp(i q t)), q being the frequency of the load.
        """
        work = self._constant * travelled
        if self._swinging:
            z = complex(0.0, self._system.normal_frequency)
            growth = _integral(z, t)
            swung = self._k0 * growth + self._k1 * (t * exp(z * t) - growth) / z
            for rate, v, _ in self._terms:
                swung += 0.5 * v * _integral(z + rate, t)
                swung += 0.5 * v.conjugate() * _integral(z + rate.conjugate(), t)
            work += (self._swinging * swung).imag
        return work

    def watches(self, horizon: float) -> tuple[Watch, ...]:
        """Signals that are positive while the mode lasts, up to `horizon` [s].

        The velocity in the direction of sliding; at rest the spare friction forwards and backwards,
        unless forces stay below its smallest limit.
        """
        system, side = self._system, self.direction
        if side:
            terms = [(z, side * v) for z, v, _ in self._terms]
            return (_watch_sum(side * self._k0, side * self._k1, terms, system.fastest),)
        if not self.rests:
            return ()
        load, w, q = system.load, system.drive_frequency, system.normal_frequency
        needed = [(complex(0.0, w), -1j * system.direct * self._turn)]
        needed += [(z, (system.spring + system.damper * z) * y) for z, _, y in self._terms]
        pull = abs(load) + sum(abs(a) for _, a in needed)
        if pull == 0.0 or pull < 0.999999 * (system.friction_preload - system.friction_amplitude):
            return ()  # Forces cannot reach the smallest limit of friction, beyond rounding.
        fastest = max(w, abs(q), system.stick.frequency)
        limit = complex(0.0, q), -1j * system.friction_amplitude * rect(1.0, self._chi)
        forward = [limit, *((z, -a) for z, a in needed)]
        return (
            _watch_sum(system.friction_preload + load, 0.0, forward, fastest),
            _watch_sum(system.friction_preload - load, 0.0, [limit, *needed], fastest),
        )


def _watch_sum(k0: float, k1: float, terms: list[tuple[complex, complex]], fastest: float) -> Watch:
    """A watch of k0 + k1 t + sum of Re(v exp(z t)), of frequencies up to `fastest`."""
    size = abs(k0) + sum(abs(v) for _, v in terms)
    parts = [(z, v, z * v, abs(z * z * v)) for z, v in terms]

    def signal(t: float) -> tuple[float, float, float]:
        value, slope, bound = k0 + k1 * t, k1, 0.0
        for z, swing, change, bend in parts:
            turn = exp(z * t)
            value += (swing * turn).real
            slope += (change * turn).real
            bound += bend * abs(turn)
        return value, slope, bound

    return Watch(signal, 2.0 * EPSILON * size, fastest)


def _integral(z: complex, t: float) -> complex:
    """Integral of exp(z t) from 0 to `t`."""
    half = 0.5 * t * z
    return t * exp(half) * sinh(half) / half if half else complex(t)


class Series:
    """Motion from `now` on in `direction`, or at rest or in flight by the contact mode.

    Friction is that of a bristle (eq. 8) to a tolerance `bending`, or Coulomb's if that is 0. With
    s the direction and g = sigma_0 z the former is F = faces N (g + sigma_1 z'), z' = v (1 - s g /
    mu). At its `reach` [s] the last terms are the tolerance times the scale of velocities or, if
    that is less, times ten times the velocity itself.
    """

    def __init__(self, system: System, now: Moment, direction: int, bending: float = 0.0) -> None:
        bends, tolerance = bending > 0.0, bending or 2.0 * EPSILON
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
                bend = sum(map(mul, v, reversed(unbent)))
                shares.append((bristle + drag * bend) / mu)
                bristle = hardness * bend * step
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
            noise = 4.0 * EPSILON * _value([abs(one) + abs(two) for one, two in pairs], horizon)
            spare = [limit - needed for limit, needed in pairs], [sum(pair) for pair in pairs]
            return tuple(_watch_series(side, noise, horizon) for side in spare)
        watched = [self.direction * c for c in self._velocity]
        reach = self.reach if self.reach < inf else horizon  # that may be next to nothing
        noise = 4.0 * EPSILON * _value(list(map(abs, watched)), reach)
        return (_watch_series(watched, noise, horizon),) if self.direction else ()

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


def _watch_series(coefficients: list[float], noise: float, horizon: float) -> Watch:
    """A series as a signal up to `horizon` [s]."""
    slope = list(map(mul, coefficients[1:], _COUNT))
    bound = _value([abs(c) * count for c, count in zip(slope[1:], _COUNT, strict=False)], horizon)

    def signal(t: float) -> tuple[float, float, float]:
        return _value(coefficients, t), _value(slope, t), bound

    return Watch(signal, noise, 1.0 / horizon)


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


Segment = ClosedForm | Series
"""Either has the same methods."""


def motion(system: System, now: Moment, direction: int) -> Segment:
    """Sliding in `direction` under full friction, flight in contact mode LIFTED, or rest."""
    mode = system.free if direction or now.mode == LIFTED else system.held
    return (Series if mode.responses is None else ClosedForm)(system, now, direction)
