"""Sliding or flight as a sum of exponentials: the fast form, for most devices.

Velocity is v(t) = k0 + k1 t + Re(ve exp(i w t) + vq exp(i q t) + vh exp(lambda t)): the particular
solutions at drive and normal frequency are split off from the free oscillation. That loses digits
near resonance and for slow normal loads; `split` returns None there, and `regular_slide` is used.
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

    Displacement of the resonator (`resonator_*`), velocity of the slider (`velocity_*`);
    `velocity_free` is that per displacement of the free resonator [1/s], `compliance` the
    displacement per constant force [m/N]. Where the split `merges`, drive and normal load swing at
    one frequency, or the normal load is constant: one term of v(t) then stands for both.
    """

    plant: Plant
    eigenvalue: complex
    resolves_resonator: bool
    fastest: float
    merges: bool
    compliance: float
    velocity_free: complex
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
        follows,
        max(w, abs(q), abs(eigenvalue)),
        q in (w, 0.0),
        1.0 / (plant.slider_mass * plant.slip.stiffness),
        -fraction * eigenvalue,
        turn * resonator_drive,
        turn * velocity_drive,
        turn * resonator_normal,
        turn * velocity_normal,
    )


class SplitSlide:
    """Motion with friction s (F0 + F1 sin(chi)), s = 1, -1, or 0 in flight.

    The velocity is watched in `direction`, unless that is 0. Where the split merges, the terms of
    the drive stand for the normal load too.
    """

    __slots__ = (
        "_constant",
        "_k0",
        "_k1",
        "_resonator_drive",
        "_resonator_free",
        "_resonator_normal",
        "_split",
        "_turns",
        "_velocity_drive",
        "_velocity_free",
        "_velocity_normal",
        "_watches",
    )

    def __init__(
        self, split: Split, sign: int, state: State, theta: float, chi: float, direction: int
    ) -> None:
        plant = split.plant
        w, q = plant.drive_frequency, plant.normal_frequency
        drive_turn = rect(1.0, theta)
        ae, ve = split.resonator_drive * drive_turn, split.velocity_drive * drive_turn
        aq = vq = free = vh = 0j
        resisting = sign * plant.friction_preload + plant.load
        if q == 0.0:
            resisting += sign * plant.friction_amplitude * sin(chi)
        else:
            normal_turn = rect(sign, chi)
            if split.merges:
                ae += split.resonator_normal * normal_turn
                ve += split.velocity_normal * normal_turn
            else:
                aq, vq = split.resonator_normal * normal_turn, split.velocity_normal * normal_turn
        self._constant = constant = resisting * split.compliance
        if split.resolves_resonator:
            eigenvalue = split.eigenvalue
            displacement = state.displacement - constant - (ae + aq).real
            rate = state.rate + w * ae.imag + q * aq.imag
            free = complex(displacement, (eigenvalue.real * displacement - rate) / eigenvalue.imag)
            vh = split.velocity_free * free
        self._split = split
        self._resonator_drive = ae
        self._resonator_normal = aq
        self._resonator_free = free
        self._velocity_drive = ve
        self._velocity_normal = vq
        self._velocity_free = vh
        self._k0 = k0 = state.velocity - (ve + vq + vh).real
        self._k1 = k1 = -resisting / plant.total_mass
        self._turns = (0.0, 1.0 + 0j, 1.0 + 0j, 1.0 + 0j)
        self._watches: tuple[Watch, ...] = ()
        if direction != 0:
            drive, normal, decaying = abs(ve), abs(vq), abs(vh)
            noise = 2.0 * EPSILON * (abs(k0) + drive + normal + decaying)
            if direction < 0:
                k0, k1, ve, vq, vh = -k0, -k1, -ve, -vq, -vh
            bound = drive * w * w + normal * q * q
            signal = (
                _two_frequencies(k0, k1, ve, bound, vh, decaying, split)
                if split.merges
                else _three_frequencies(k0, k1, ve, vq, bound, vh, split)
            )
            self._watches = (Watch(signal, noise, split.fastest, inf),)

    def watches(self, horizon: float) -> tuple[Watch, ...]:
        """The velocity in the direction to watch."""
        return self._watches

    def _turns_at(self, t: float) -> tuple[float, complex, complex, complex]:
        """`t`, exp(i w t), exp(i q t) and exp(lambda t), cached for the last `t`."""
        turns = self._turns
        if turns[0] == t:
            return turns
        split = self._split
        plant = split.plant
        drive = rect(1.0, plant.drive_frequency * t)
        normal = drive if split.merges else rect(1.0, plant.normal_frequency * t)
        self._turns = turns = (t, drive, normal, exp(split.eigenvalue * t))
        return turns

    def travel(self, t: float) -> float:
        """Displacement of the slider after `t` [s], in m."""
        split = self._split
        plant = split.plant
        _, drive, normal, free = self._turns_at(t)
        total = (self._velocity_drive * (drive - 1.0)).imag / plant.drive_frequency
        if not split.merges:
            total += (self._velocity_normal * (normal - 1.0)).imag / plant.normal_frequency
        total -= plant.mass_fraction * (self._resonator_free * (free - 1.0)).real
        return (self._k0 + 0.5 * self._k1 * t) * t + total

    def state(self, t: float) -> State:
        """State after `t` [s]."""
        split = self._split
        plant = split.plant
        _, drive, normal, free = self._turns_at(t)
        ae, ah = self._resonator_drive * drive, self._resonator_free * free
        forced = self._velocity_drive * drive + self._velocity_free * free
        displacement = self._constant + ae.real + ah.real
        rate = (split.eigenvalue * ah).real - plant.drive_frequency * ae.imag
        if not split.merges:
            forced += self._velocity_normal * normal
            aq = self._resonator_normal * normal
            displacement += aq.real
            rate -= plant.normal_frequency * aq.imag
        return State(self._k0 + self._k1 * t + forced.real, displacement, rate)


def _two_frequencies(
    k0: float, k1: float, ve: complex, bound: float, vh: complex, decaying: float, split: Split
) -> Signal:
    w, eigenvalue = split.plant.drive_frequency, split.eigenvalue
    square, turning = split.plant.slip.stiffness, complex(0.0, w)
    at_start = (
        k0 + (ve + vh).real,
        k1 - w * ve.imag + (eigenvalue * vh).real,
        bound + square * decaying,
    )

    def signal(t: float) -> tuple[float, float, float]:
        if t == 0.0:
            return at_start
        e = ve * rect(1.0, w * t)
        h = vh * exp(eigenvalue * t)
        return (
            k0 + k1 * t + (e + h).real,
            k1 + (turning * e + eigenvalue * h).real,
            bound + square * abs(h),
        )

    return signal


def _three_frequencies(
    k0: float, k1: float, ve: complex, vq: complex, bound: float, vh: complex, split: Split
) -> Signal:
    eigenvalue, square = split.eigenvalue, split.plant.slip.stiffness
    w, q = split.plant.drive_frequency, split.plant.normal_frequency
    turning, turning_normal = complex(0.0, w), complex(0.0, q)

    def signal(t: float) -> tuple[float, float, float]:
        e = ve * rect(1.0, w * t)
        n = vq * rect(1.0, q * t)
        h = vh * exp(eigenvalue * t)
        return (
            k0 + k1 * t + (e + n + h).real,
            k1 + (turning * e + turning_normal * n + eigenvalue * h).real,
            bound + square * abs(h),
        )

    return signal
