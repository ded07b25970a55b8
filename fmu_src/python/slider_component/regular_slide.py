"""Sliding or flight in forms that stay regular everywhere: at resonance without damping, at and
above critical damping, and for slow, constant or reversed normal loads.

The slider follows from the momentum of the pair and the motion of the resonator.
"""

from __future__ import annotations

from cmath import rect
from math import inf

from .first_zero import Watch
from .forced_oscillator import ForcedOscillator, Sample
from .motion import EPSILON, State
from .oscillator import double_integral, integral
from .plant import Plant


class RegularSlide:
    """Motion with friction s (F0 + F1 sin(chi)), s = 1, -1, or 0 in flight.

    The velocity is watched in `direction`, unless that is 0.
    """

    __slots__ = (
        "_deceleration",
        "_direction",
        "_fraction",
        "_own_bound",
        "_pair",
        "_pair_bound",
        "_plant",
        "_resonator",
        "_start",
    )

    def __init__(
        self, plant: Plant, sign: int, state: State, theta: float, chi: float, direction: int
    ) -> None:
        resisting = sign * plant.friction_preload + plant.load
        w, q = plant.drive_frequency, plant.normal_frequency
        drive_turn = -1j * rect(1.0, theta)
        friction = -1j * sign * plant.friction_amplitude * rect(1.0, chi)
        self._plant = plant
        self._direction = direction
        self._start = state
        self._fraction = plant.mass_fraction
        self._deceleration = resisting / plant.total_mass
        self._pair = ((w, plant.drive * drive_turn), (q, -friction / plant.total_mass))
        self._pair_bound = sum(abs(a * f) for f, a in self._pair)
        own = abs(plant.holding_drive) * w + plant.friction_amplitude * abs(q)
        self._own_bound = own / plant.slider_mass
        self._resonator = ForcedOscillator(
            plant.slip,
            resisting / plant.slider_mass,
            ((w, plant.relative_drive * drive_turn), (q, friction / plant.slider_mass)),
            state.displacement,
            state.rate,
            max(w, abs(q)),
        )

    def watches(self, horizon: float) -> tuple[Watch, ...]:
        """The velocity in the direction to watch."""
        if self._direction == 0:
            return ()
        plant = self._plant
        fastest = max(plant.drive_frequency, abs(plant.normal_frequency))
        horizon, rate = inf, 0.0
        if self._fraction:
            fastest = max(fastest, plant.slip.frequency)
            horizon, rate = self._resonator.horizon, self._resonator.reach()[1]
        swing = sum(abs(a) / max(abs(f), 0.02 * fastest) for f, a in self._pair)
        scale = abs(self._start.velocity) + swing
        if rate < inf:
            scale += self._fraction * rate
        return (Watch(self._velocity_ahead, 2.0 * EPSILON * scale, fastest, horizon),)

    def travel(self, t: float) -> float:
        """Displacement of the slider after `t` [s], in m."""
        start = self._start
        travel = start.velocity * t - 0.5 * self._deceleration * t * t
        travel += sum((a * double_integral(f, t)).real for f, a in self._pair)
        if self._fraction:
            moved = self._resonator.sample(t).displacement - start.displacement
            travel -= self._fraction * (moved - start.rate * t)
        return travel

    def state(self, t: float) -> State:
        """State after `t` [s]."""
        sample = self._resonator.sample(t)
        return State(self._velocity(t, sample.rate), sample.displacement, sample.rate)

    def _velocity(self, t: float, rate: float) -> float:
        start = self._start
        velocity = start.velocity - self._deceleration * t
        velocity += sum((a * integral(f, t)).real for f, a in self._pair)
        return velocity - self._fraction * (rate - start.rate)

    def _velocity_ahead(self, t: float) -> tuple[float, float, float]:
        acceleration, bound, rate = -self._deceleration, self._pair_bound, 0.0
        for f, a in self._pair:
            acceleration += (a * rect(1.0, f * t)).real
        if self._fraction:
            sample = self._resonator.sample(t)
            rate = sample.rate
            acceleration -= self._fraction * sample.acceleration
            bound = self._bound(sample)
        return self._direction * self._velocity(t, rate), self._direction * acceleration, bound

    def _bound(self, sample: Sample) -> float:
        """Bound on the second derivative of the velocity [m/s^3].

        The smaller one of the bounds from the momentum of the pair and from the force between
        slider and resonator, which is better for a light resonator.
        """
        plant = self._plant
        by_pair = self._pair_bound + self._fraction * sample.jerk_bound
        between = plant.spring * sample.rate_bound + plant.damper * sample.acceleration_bound
        return min(by_pair, self._own_bound + between / plant.slider_mass)
