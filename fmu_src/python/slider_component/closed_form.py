"""Motion in one contact mode, inputs held, as a sum of exponentials: sliding, flight and rest.

The slider follows from the momentum of the pair and the motion of the resonator. With the rates z
of drive, normal load and free resonator, and friction s (F0 + F1 sin(chi)),

    v(t) = k0 + k1 t + sum of Re(v_z exp(z t)),    Y(t) = offset + sum of Re(y_z exp(z t))

`series` has the same motions where the steady responses do not split off without losing digits.
"""

from cmath import exp, rect, sinh
from math import inf

from .contact import LIFTED, STICK
from .device import EPSILON, System
from .first_zero import Watch
from .moment import Moment, Place


def _watch(k0: float, k1: float, terms: list[tuple[complex, complex]], fastest: float) -> Watch:
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
            growth = (exp(z * t) - 1.0) / z
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
            return (_watch(side * self._k0, side * self._k1, terms, system.fastest),)
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
            _watch(system.friction_preload + load, 0.0, forward, fastest),
            _watch(system.friction_preload - load, 0.0, [limit, *needed], fastest),
        )


def _integral(z: complex, t: float) -> complex:
    """Integral of exp(z t) from 0 to `t`."""
    half = 0.5 * t * z
    return t * exp(half) * sinh(half) / half if half else complex(t)
