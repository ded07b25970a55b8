"""Motion in one contact mode, inputs held: sliding, flight and sticking in closed form.

The slider follows from the momentum of the pair and the motion of the resonator. Each motion says
where it is after a time, and what to watch: signals that are positive while the mode lasts.
"""

from __future__ import annotations

from cmath import exp, rect
from cmath import phase as argument
from math import acos, inf, sin, tau
from typing import NamedTuple, Protocol

from .contact import LIFTED
from .device import EPSILON, System
from .first_zero import Watch
from .moment import Moment
from .oscillator import ForcedMotion, divided, divided_twice


class Motion(Protocol):
    """Motion from a given moment on, inputs held, contact mode unchanged."""

    def watches(self, horizon: float) -> tuple[Watch, ...]:
        """Signals that are positive while the mode lasts, up to `horizon` [s]."""
        ...

    def travel(self, t: float) -> float:
        """Displacement of the slider after `t` [s], in m."""
        ...

    def at(self, t: float) -> tuple[float, float, float]:
        """Velocity of the slider [m/s], displacement [m] and rate [m/s] of the resonator."""
        ...


class End(NamedTuple):
    """How a leg ends.

    After a displacement `travelled` [m] of a slider that `rests` or not; `zero_of` is the index of
    the watched signal whose zero ends it, or None; it `switches` where the contact lifts or touches
    down.
    """

    travelled: float
    rests: bool
    zero_of: int | None
    switches: bool


def slide(system: System, now: Moment, direction: int) -> Motion:
    """Sliding in `direction` under full friction, or flight in contact mode LIFTED.

    The velocity is watched in `direction`, unless that is 0.
    """
    sign = 0 if now.mode == LIFTED else direction
    form = RegularSlide if system.split is None else SplitSlide
    return form(system, sign, now, direction)


class SplitSlide:
    """Motion with friction s (F0 + F1 sin(chi)), s = `sign` 1, -1, or 0 in flight.

    As a sum of exponentials at the rates z of drive, normal load and free resonator:
    v(t) = k0 + k1 t + sum of Re(v_z exp(z t)), and Y(t) = offset + sum of Re(y_z exp(z t)).
    """

    __slots__ = ("_direction", "_k0", "_k1", "_offset", "_split", "_sys", "_v", "_y")

    def __init__(self, system: System, sign: int, now: Moment, direction: int) -> None:
        split = system.split
        assert split is not None
        turn, chi = rect(1.0, now.theta), now.psi + system.phase
        v_drive, y_drive = split.velocity_drive * turn, split.resonator_drive * turn
        v_normal = y_normal = v_free = y_free = 0j
        resisting = sign * system.friction_preload + system.load
        if system.normal_frequency == 0.0:
            resisting += sign * system.friction_amplitude * sin(chi)
        elif sign != 0:
            turn = rect(sign, chi)
            v_normal, y_normal = split.velocity_normal * turn, split.resonator_normal * turn
            if split.normal == split.drive:
                v_drive, y_drive = v_drive + v_normal, y_drive + y_normal
                v_normal = y_normal = 0j
        self._offset = offset = resisting * split.compliance
        if split.free:
            forced = split.drive * y_drive + split.normal * y_normal
            y = now.displacement - offset - (y_drive + y_normal).real
            u = now.rate - forced.real
            y_free = complex(y, (split.free.real * y - u) / split.free.imag)
            v_free = split.velocity_free * y_free
        self._k0 = now.velocity - (v_drive + v_normal + v_free).real
        self._k1 = -resisting / system.total_mass
        self._v, self._y = (v_drive, v_normal, v_free), (y_drive, y_normal, y_free)
        self._sys, self._split, self._direction = system, split, direction

    def watches(self, horizon: float) -> tuple[Watch, ...]:
        """The velocity in the direction to watch."""
        direction, split = self._direction, self._split
        if direction == 0:
            return ()
        k0, k1, (v_drive, v_normal, v_free) = self._k0, self._k1, self._v
        z_drive, z_normal, z_free = split.drive, split.normal, split.free
        drive, normal, free = abs(v_drive), abs(v_normal), abs(v_free)
        bound = drive * split.squares[0] + normal * split.squares[1] + free * split.squares[2]
        noise = 2.0 * EPSILON * (abs(k0) + drive + normal + free)
        expected = 0.0
        if drive > abs(k0):
            # Where the drive alone would stop the slider: its cosine falls through -k0 in its first
            # half turn, and rises through it before.
            stop = direction * acos(-k0 / drive) - argument(v_drive)
            expected = stop % tau / z_drive.imag
        if direction < 0:
            k0, k1, v_drive, v_normal, v_free = -k0, -k1, -v_drive, -v_normal, -v_free

        def signal(t: float) -> tuple[float, float, float]:
            forced, own = v_drive * exp(z_drive * t), v_free * exp(z_free * t)
            swing, change = forced + own, z_drive * forced + z_free * own
            if v_normal:
                forced = v_normal * exp(z_normal * t)
                swing += forced
                change += z_normal * forced
            return k0 + k1 * t + swing.real, k1 + change.real, bound

        return (Watch(signal, noise, self._sys.fastest, inf, expected),)

    def travel(self, t: float) -> float:
        """See Motion."""
        split, (v_drive, v_normal, _), y_free = self._split, self._v, self._y[2]
        total = (v_drive / split.drive * (exp(split.drive * t) - 1.0)).real
        if v_normal:
            total += (v_normal / split.normal * (exp(split.normal * t) - 1.0)).real
        total -= self._sys.mass_fraction * (y_free * (exp(split.free * t) - 1.0)).real
        return (self._k0 + 0.5 * self._k1 * t) * t + total

    def at(self, t: float) -> tuple[float, float, float]:
        """See Motion."""
        split, (v_drive, v_normal, v_free) = self._split, self._v
        y_drive, y_normal, y_free = self._y
        drive, free = exp(split.drive * t), exp(split.free * t)
        y_drive, y_free = y_drive * drive, y_free * free
        velocity, displacement = v_drive * drive + v_free * free, y_drive + y_free
        rate = split.drive * y_drive + split.free * y_free
        if v_normal:
            normal = exp(split.normal * t)
            velocity += v_normal * normal
            displacement += y_normal * normal
            rate += split.normal * y_normal * normal
        velocity_now = self._k0 + self._k1 * t + velocity.real
        return velocity_now, self._offset + displacement.real, rate.real


class RegularSlide:
    """The same in forms that stay regular: where the exponentials do not split."""

    __slots__ = ("_bounds", "_deceleration", "_direction", "_pair", "_resonator", "_start", "_sys")

    def __init__(self, system: System, sign: int, now: Moment, direction: int) -> None:
        resisting = sign * system.friction_preload + system.load
        w, q = system.drive_frequency, system.normal_frequency
        drive_turn = -1j * rect(1.0, now.theta)
        friction = -1j * sign * system.friction_amplitude * rect(1.0, now.psi + system.phase)
        self._sys, self._direction = system, direction
        self._start = now.velocity, now.displacement, now.rate
        self._deceleration = resisting / system.total_mass
        self._pair = ((w, system.drive * drive_turn), (q, -friction / system.total_mass))
        own = abs(system.holding_drive) * w + system.friction_amplitude * abs(q)
        self._bounds = sum(abs(a * f) for f, a in self._pair), own / system.slider_mass
        mass = system.slider_mass
        forcing = (
            (0.0, complex(resisting / mass)),
            (w, system.relative_drive * drive_turn),
            (q, friction / mass),
        )
        self._resonator = ForcedMotion(system.slip, forcing, now.displacement, now.rate)

    def watches(self, horizon: float) -> tuple[Watch, ...]:
        """The velocity in the direction to watch."""
        if self._direction == 0:
            return ()
        system, resonator = self._sys, self._resonator
        fastest = max(system.drive_frequency, abs(system.normal_frequency))
        size = abs(self._start[0])
        size += sum(abs(a) / max(abs(f), 0.02 * fastest) for f, a in self._pair)
        if system.mass_fraction:
            fastest = max(fastest, system.slip.frequency)
            size += system.mass_fraction * resonator.reach
        return (Watch(self._signal, 2.0 * EPSILON * size, fastest, resonator.horizon),)

    def travel(self, t: float) -> float:
        """See Motion."""
        v, y, u = self._start
        total = v * t - 0.5 * self._deceleration * t * t
        total += sum((a * divided_twice(0j, 0j, complex(0.0, f), t)).real for f, a in self._pair)
        fraction = self._sys.mass_fraction
        if fraction:
            total -= fraction * (self._resonator.at(t)[0] - y - u * t)
        return total

    def at(self, t: float) -> tuple[float, float, float]:
        """See Motion."""
        displacement, rate = self._resonator.at(t)
        return self._velocity(t, rate), displacement, rate

    def _velocity(self, t: float, rate: float) -> float:
        v, _, u = self._start
        pushed = sum((a * divided(0j, complex(0.0, f), t)).real for f, a in self._pair)
        return v - self._deceleration * t + pushed - self._sys.mass_fraction * (rate - u)

    def _signal(self, t: float) -> tuple[float, float, float]:
        system = self._sys
        _, rate, own, rate_bound, own_bound, jerk_bound = self._resonator.ahead(t)
        acceleration = -self._deceleration - system.mass_fraction * own
        for f, a in self._pair:
            acceleration += (a * rect(1.0, f * t)).real
        # By the momentum of the pair, or by the force between slider and resonator, which is better
        # for a light resonator.
        between = system.spring * rate_bound + system.damper * own_bound
        bound = min(
            self._bounds[0] + system.mass_fraction * jerk_bound,
            self._bounds[1] + between / system.slider_mass,
        )
        return self._direction * self._velocity(t, rate), self._direction * acceleration, bound


class Stick:
    """Rest: the resonator swings against the slider, while |needed force| <= F0 + F1 sin(chi)."""

    __slots__ = ("_direct", "_normal", "_resonator", "_rests", "_sys")

    def __init__(self, system: System, now: Moment) -> None:
        turn = -1j * rect(1.0, now.theta)
        self._sys = system
        self._direct = system.holding_drive * turn
        self._normal = -1j * system.friction_amplitude * rect(1.0, now.psi + system.phase)
        forcing = ((system.drive_frequency, system.base_acceleration * turn),)
        self._resonator = ForcedMotion(system.stick, forcing, now.displacement, now.rate)
        resonates = system.spring and self._resonator.reach
        self._rests = not (self._direct or resonates or system.load)

    def watches(self, horizon: float) -> tuple[Watch, ...]:
        """Forward margin (limit - needed force), then backward margin (limit + needed force).

        None where nothing pulls.
        """
        if self._rests:
            return ()
        system, resonator = self._sys, self._resonator
        fastest = max(system.drive_frequency, abs(system.normal_frequency), system.stick.frequency)
        limit = system.friction_preload + system.friction_amplitude
        pull = abs(system.load) + abs(self._direct)
        pull += system.spring * resonator.reach / system.stick.frequency
        pull += system.damper * resonator.reach
        noise = 4.0 * EPSILON * (limit + min(pull, 1e3 * limit))

        def margin(t: float, side: float) -> tuple[float, float, float]:
            w, q = system.drive_frequency, system.normal_frequency
            held, limit = self._direct * rect(1.0, w * t), self._normal * rect(1.0, q * t)
            needed, change = held.real - system.load, -w * held.imag
            bound = abs(limit) * q * q + abs(held) * w * w
            if system.spring:
                y, rate, acceleration, _, second, third = resonator.ahead(t)
                needed += system.spring * y + system.damper * rate
                change += system.spring * rate + system.damper * acceleration
                bound += system.spring * second + system.damper * third
            value = system.friction_preload + limit.real - side * needed
            return value, -q * limit.imag - side * change, bound

        horizon = resonator.horizon if system.spring else inf
        return (
            Watch(lambda t: margin(t, 1.0), noise, fastest, horizon),
            Watch(lambda t: margin(t, -1.0), noise, fastest, horizon),
        )

    def travel(self, t: float) -> float:
        """See Motion: none."""
        return 0.0

    def at(self, t: float) -> tuple[float, float, float]:
        """See Motion."""
        return 0.0, *self._resonator.at(t)
