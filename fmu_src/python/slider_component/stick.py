"""Sticking: the slider rests, the resonator swings against it, and the force needed to hold the
slider is compared with what friction can supply."""

from __future__ import annotations

from cmath import rect
from math import inf

from .first_zero import Signal, Watch
from .forced_oscillator import ForcedOscillator
from .motion import EPSILON, State
from .plant import Plant


class Stick:
    """Motion while |needed force| stays within the limit F0 + F1 sin(chi)."""

    __slots__ = ("_direct", "_normal", "_plant", "_resonator", "_start")

    def __init__(self, plant: Plant, state: State, theta: float, chi: float) -> None:
        drive_turn = -1j * rect(1.0, theta)
        self._plant = plant
        self._start = state
        self._direct = plant.holding_drive * drive_turn
        self._normal = -1j * plant.friction_amplitude * rect(1.0, chi)
        self._resonator = ForcedOscillator(
            plant.stick,
            0.0,
            ((plant.drive_frequency, plant.base_acceleration * drive_turn),),
            state.displacement,
            state.rate,
            max(plant.drive_frequency, abs(plant.normal_frequency)),
        )

    def watches(self, horizon: float) -> tuple[Watch, ...]:
        """Forward margin (limit - needed force), then backward margin (limit + needed force).

        None where the needed force is 0, or always below the smallest limit.
        """
        plant = self._plant
        reach = abs(plant.load) + abs(self._direct)
        fastest = max(plant.drive_frequency, abs(plant.normal_frequency))
        horizon = inf
        if plant.spring:
            displacement, rate = self._resonator.reach()
            if displacement < inf:
                reach += plant.spring * displacement + plant.damper * rate
            else:
                reach = inf
            horizon = self._resonator.horizon
            fastest = max(fastest, plant.stick.frequency)
        limit = plant.friction_preload + plant.friction_amplitude
        if reach == 0.0 or reach < 0.999999 * (plant.friction_preload - plant.friction_amplitude):
            return ()
        noise = 4.0 * EPSILON * (limit + min(reach, 1e3 * limit))
        return tuple(
            Watch(self._margin(direction), noise, fastest, horizon) for direction in (1.0, -1.0)
        )

    def travel(self, t: float) -> float:
        """Displacement of the slider after `t` [s]: none."""
        return 0.0

    def state(self, t: float) -> State:
        """State after `t` [s]."""
        sample = self._resonator.sample(t)
        return State(0.0, sample.displacement, sample.rate)

    def _margin(self, direction: float) -> Signal:
        plant = self._plant
        w, q = plant.drive_frequency, plant.normal_frequency
        direct, normal = self._direct, self._normal
        preload, load = plant.friction_preload, plant.load
        spring, damper = plant.spring, plant.damper
        fixed_bound = abs(normal) * q * q + abs(direct) * w * w
        resonator = self._resonator if spring else None

        def margin(t: float) -> tuple[float, float, float]:
            held = direct * rect(1.0, w * t)
            limit = normal * rect(1.0, q * t)
            needed, change, bound = held.real - load, -w * held.imag, fixed_bound
            if resonator is not None:
                sample = resonator.sample(t)
                needed += spring * sample.displacement + damper * sample.rate
                change += spring * sample.rate + damper * sample.acceleration
                bound += spring * sample.acceleration_bound + damper * sample.jerk_bound
            return (
                preload + limit.real - direction * needed,
                -q * limit.imag - direction * change,
                bound,
            )

        return margin
