"""Sliding or flight as a sum of exponentials: the fast form, for most devices.

Velocity is v(t) = k0 + k1 t + Re(ve exp(i w t) + vq exp(i q t) + vh exp(lambda t)): the particular
solutions at drive and normal frequency are split off from the free oscillation. That loses digits
near resonance and for slow normal loads; `split` answers None there and `regular_slide` serves.
"""

from __future__ import annotations

from cmath import exp, rect
from dataclasses import dataclass
from math import inf, sin

from .first_zero import Signal, Watch
from .motion import EPSILON, State
from .oscillator import SLOW, resonates, transfer
from .plant import Plant


@dataclass(frozen=True, slots=True)
class Split:
    """Complex amplitudes per unit exp(i theta_0) and, for s = 1, per unit exp(i chi_0).

    Displacement of the resonator (`resonator_*`), velocity of the slider (`velocity_*`).
    """

    plant: Plant
    eigenvalue: complex
    fastest: float
    resonator_drive: complex
    velocity_drive: complex
    resonator_normal: complex
    velocity_normal: complex


def split(plant: Plant) -> Split | None:
    """The amplitudes, or None where splitting would lose digits."""
    eigenvalue = plant.slip.eigenvalue
    w, q = plant.drive_frequency, plant.normal_frequency
    if (
        eigenvalue is None
        or 0.0 < abs(q) < SLOW * w
        or (
            plant.resolves_resonator
            and (
                plant.slip.frequency < SLOW * max(w, abs(q))
                or any(resonates(plant.slip, f) for f in (w, q))
            )
        )
    ):
        return None
    fraction = plant.mass_fraction
    follows = plant.resolves_resonator
    resonator_drive = plant.relative_drive * transfer(plant.slip, w) if follows else 0j
    velocity_drive = (plant.drive + fraction * w * w * resonator_drive) / complex(0.0, w)
    resonator_normal = velocity_normal = 0j
    if q != 0.0:
        push = plant.friction_amplitude / plant.slider_mass
        resonator_normal = push * transfer(plant.slip, q) if follows else 0j
        velocity_normal = (
            fraction * q * q * resonator_normal - plant.friction_amplitude / plant.total_mass
        ) / complex(0.0, q)
    turn = complex(0.0, -1.0)
    return Split(
        plant,
        eigenvalue,
        max(w, abs(q), abs(eigenvalue)),
        turn * resonator_drive,
        turn * velocity_drive,
        turn * resonator_normal,
        turn * velocity_normal,
    )


class SplitSlide:
    """Motion with friction s (F0 + F1 sin(chi)), s = 1, -1, or 0 in flight.

    The velocity is watched in `direction`, unless that is 0.
    """

    __slots__ = (
        "_constant",
        "_direction",
        "_displacement",
        "_eigenvalue",
        "_k0",
        "_k1",
        "_resonator_drive",
        "_resonator_free",
        "_resonator_normal",
        "_split",
        "_velocity",
        "_velocity_drive",
        "_velocity_free",
        "_velocity_normal",
    )

    def __init__(
        self, split: Split, sign: int, state: State, theta: float, chi: float, direction: int
    ) -> None:
        plant = split.plant
        w, q = plant.drive_frequency, plant.normal_frequency
        drive_turn = rect(1.0, theta)
        friction = sign * plant.friction_preload
        if q == 0.0:
            friction += sign * plant.friction_amplitude * sin(chi)
            normal_turn = 0j
        else:
            normal_turn = rect(float(sign), chi)
        ae = split.resonator_drive * drive_turn
        aq = split.resonator_normal * normal_turn
        ve = split.velocity_drive * drive_turn
        vq = split.velocity_normal * normal_turn
        constant = (friction + plant.load) / (plant.slider_mass * plant.slip.stiffness)
        eigenvalue = split.eigenvalue
        free = vh = 0j
        if plant.resolves_resonator:
            displacement = state.displacement - constant - (ae + aq).real
            rate = state.rate + w * ae.imag + q * aq.imag
            free = complex(displacement, -(rate - eigenvalue.real * displacement) / eigenvalue.imag)
            vh = -plant.mass_fraction * eigenvalue * free
        self._split = split
        self._direction = direction
        self._eigenvalue = eigenvalue
        self._velocity = state.velocity
        self._constant = constant
        self._resonator_drive = ae
        self._resonator_normal = aq
        self._resonator_free = free
        self._velocity_drive = ve
        self._velocity_normal = vq
        self._velocity_free = vh
        self._k0 = state.velocity - (ve + vq + vh).real
        self._k1 = -(friction + plant.load) / plant.total_mass

    def watches(self, horizon: float) -> tuple[Watch, ...]:
        """The velocity in the direction to watch."""
        sign = self._direction
        if sign == 0:
            return ()
        plant = self._split.plant
        w, q = plant.drive_frequency, plant.normal_frequency
        ve, vq, vh = sign * self._velocity_drive, sign * self._velocity_normal, self._velocity_free
        k0, k1, vh = sign * self._k0, sign * self._k1, sign * vh
        eigenvalue = self._eigenvalue
        noise = 2.0 * EPSILON * (abs(k0) + abs(ve) + abs(vq) + abs(vh))
        signal = (
            _two_frequencies(k0, k1, ve + vq, w, vh, eigenvalue)
            if q in (w, 0.0)
            else _three_frequencies(k0, k1, ve, w, vq, q, vh, eigenvalue)
        )
        return (Watch(signal, noise, self._split.fastest, inf),)

    def travel(self, t: float) -> float:
        """Displacement of the slider after `t` [s], in m."""
        plant = self._split.plant
        w, q = plant.drive_frequency, plant.normal_frequency
        total = self._velocity_drive * (rect(1.0, w * t) - 1.0) / complex(0.0, w)
        if q != 0.0:
            total += self._velocity_normal * (rect(1.0, q * t) - 1.0) / complex(0.0, q)
        eigenvalue = self._eigenvalue
        total += self._velocity_free * (exp(eigenvalue * t) - 1.0) / eigenvalue
        return (self._k0 + 0.5 * self._k1 * t) * t + total.real

    def state(self, t: float) -> State:
        """State after `t` [s]."""
        plant = self._split.plant
        w, q = plant.drive_frequency, plant.normal_frequency
        drive, normal = rect(1.0, w * t), rect(1.0, q * t)
        free = exp(self._eigenvalue * t)
        ae = self._resonator_drive * drive
        aq = self._resonator_normal * normal
        ah = self._resonator_free * free
        velocity = (
            self._k0
            + self._k1 * t
            + (
                self._velocity_drive * drive
                + self._velocity_normal * normal
                + self._velocity_free * free
            ).real
        )
        return State(
            velocity,
            self._constant + (ae + aq + ah).real,
            (self._eigenvalue * ah).real - w * ae.imag - q * aq.imag,
        )


def _two_frequencies(
    k0: float, k1: float, ve: complex, w: float, vh: complex, eigenvalue: complex
) -> Signal:
    bound = abs(ve) * w * w
    square = abs(eigenvalue) ** 2

    def signal(t: float) -> tuple[float, float, float]:
        e = ve * rect(1.0, w * t)
        h = vh * exp(eigenvalue * t)
        return (
            k0 + k1 * t + e.real + h.real,
            k1 - w * e.imag + (eigenvalue * h).real,
            bound + square * abs(h),
        )

    return signal


def _three_frequencies(
    k0: float,
    k1: float,
    ve: complex,
    w: float,
    vq: complex,
    q: float,
    vh: complex,
    eigenvalue: complex,
) -> Signal:
    bound = abs(ve) * w * w + abs(vq) * q * q
    square = abs(eigenvalue) ** 2

    def signal(t: float) -> tuple[float, float, float]:
        e = ve * rect(1.0, w * t)
        n = vq * rect(1.0, q * t)
        h = vh * exp(eigenvalue * t)
        return (
            k0 + k1 * t + e.real + n.real + h.real,
            k1 - w * e.imag - q * n.imag + (eigenvalue * h).real,
            bound + square * abs(h),
        )

    return signal
