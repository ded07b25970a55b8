"""A contact mode with constant rates of both angles, followed by matrix exponentials.

With the sines of the drive and of the normal load as states, such a mode is linear: s' = A s. A
table of exp(k h A) gives the states on a whole grid at once, exp(u h A) by its series those between
two grid points. Neither the frequencies nor the resonances of the device occur: its accuracy is the
same for every damping.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.references.resolved.contact import LIFTED, STICK
from slider_resonator.references.resolved.equations import Equations
from slider_resonator.references.resolved.first_crossing import first_crossing
from slider_resonator.references.resolved.segment import Segment, SegmentResult

STEPS_PER_FASTEST_PERIOD = 128
"""So fine that no pair of close roots is missed; also the number of steps of a table."""

_ORDER = 12
"""Terms of the series of the exponential over a step of 0.05 rad: the rest is below 1e-24."""

_NOISE = 4e-15
_X, _V, _Y, _RATE, _SINE, _COSINE, _NORMAL_SINE, _NORMAL_COSINE, _FORCE, _FORCE_RATE = range(10)


@dataclass(frozen=True)
class _Modes:
    """The linear system of the modes that slide or stick, over the drive angle in rad.

    Its states are w x, X', w Y, Y', sine and cosine of the drive angle, sine and cosine of the
    angle of the normal load times the slip direction, the constant forces in N and their rate.
    ``rates`` is A h, shape (10, 10), ``series`` the terms of exp(A h), shape (_ORDER + 1, 10, 10),
    ``powers`` exp(k A h) of the step h, shape (steps + 1, 10, 10), and ``needed`` gives the force
    that the slider needs to stick.
    """

    step: float
    rates: Array
    series: Array
    powers: Array
    needed: Array

    def between(self, states: Array, shares: Array) -> Array:
        """Return the states a share of a step, (k, 1), after ``states``, (k, 10)."""
        terms = np.tensordot(states, self.series, axes=(1, 2))
        weights = shares ** np.arange(_ORDER + 1)
        later: Array = (weights[:, np.newaxis] @ terms)[:, 0]
        return later


def follow_constant_rates(segment: Segment) -> SegmentResult:
    """Follow a segment of a constant frequency ratio to its first event."""
    equations, mode = segment.equations, segment.mode
    frequency = equations.drive_frequency
    modes = _modes(equations, segment.frequency_ratio, mode == STICK)
    per_second = frequency / modes.step
    span, samples = segment.span * per_second, segment.samples * per_second
    margins = _margins(modes, equations, mode)
    kept: list[Array] = []
    done = sampled = chunks = event = 0
    state = np.array([0.0, *segment.state[1:], *[0.0] * 6])
    state[_Y] *= frequency
    while True:
        _turn(state, segment, done * modes.step)
        count = min(STEPS_PER_FASTEST_PERIOD, max(1, math.ceil(span - done)))
        size = len(state)
        states = (modes.powers[: count + 1].reshape(-1, size) @ state).reshape(-1, size)
        end = min(float(count), span - done)
        crossings = [
            (time, direction)
            for direction, row, offset in margins
            if (time := _crossing(modes, states, row, offset)) is not None and time <= end
        ]
        if crossings:
            end, event = min(crossings)
        stop = int(np.searchsorted(samples, done + end, side="right"))
        kept.append(_at(modes, states, samples[sampled:stop] - done))
        sampled = stop
        chunks += 1
        if event or end < count or done + count >= span:
            break
        done += count
        state = states[-1]
    last = _dimensional(_at(modes, states, np.array([end])), segment)[0]
    duration = segment.span if not event else (done + end) / per_second
    position, velocity, displacement, rate = last.tolist()
    return SegmentResult(
        duration=duration,
        state=(position, velocity, displacement, rate),
        event=event,
        samples=_dimensional(np.concatenate(kept), segment),
        steps=chunks,
        evaluations=chunks * STEPS_PER_FASTEST_PERIOD,
    )


def _turn(state: Array, segment: Segment, turned: float) -> None:
    """Set the angles and the forces of a state after the drive has turned by an angle in rad."""
    equations, mode = segment.equations, segment.mode
    theta = segment.theta + turned
    angle = segment.angle + segment.frequency_ratio * turned
    seconds = turned / equations.drive_frequency
    direction = 0 if mode == LIFTED else mode
    carried = 1 if mode == STICK else direction
    load = segment.load + segment.load_rate * seconds
    state[_SINE:] = (
        math.sin(theta),
        math.cos(theta),
        carried * math.sin(angle),
        carried * math.cos(angle),
        -load - direction * equations.friction_mean,
        -segment.load_rate / equations.drive_frequency,
    )


def _margins(modes: _Modes, equations: Equations, mode: int) -> list[tuple[int, Array, float]]:
    """Return direction, row and offset of what is positive until an event.

    In a slip that is the velocity in its direction, in a stick the friction left before the slider
    breaks loose in either.
    """
    if mode == LIFTED:
        return []
    row = np.zeros_like(modes.needed)
    if mode != STICK:
        row[_V] = mode
        return [(-mode, row, 0.0)]
    row[_NORMAL_SINE] = equations.friction_amplitude
    return [(event, row - event * modes.needed, equations.friction_mean) for event in (1, -1)]


def _crossing(modes: _Modes, states: Array, row: Array, offset: float) -> float | None:
    """Return after how many steps a margin turns negative, None if it does not."""
    values, slopes = states @ row + offset, states @ (row @ modes.rates)
    series = (row @ modes.series)[::-1]
    pieces: dict[int, Callable[[float], tuple[float, float]]] = {}

    def margin(time: float) -> tuple[float, float]:
        index = min(int(time), len(states) - 2)
        if index not in pieces:
            pieces[index] = _piece((series @ states[index]).tolist(), offset)
        return pieces[index](time - index)

    floor = _NOISE * float(np.abs(values).max())
    return first_crossing(np.arange(len(states), dtype=np.float64), values, slopes, margin, floor)


def _piece(terms: list[float], offset: float) -> Callable[[float], tuple[float, float]]:
    """Return a polynomial, highest term first, plus an offset, as value and slope."""

    def piece(share: float) -> tuple[float, float]:
        value = slope = 0.0
        for term in terms:
            slope = slope * share + value
            value = value * share + term
        return value + offset, slope

    return piece


def _at(modes: _Modes, states: Array, times: Array) -> Array:
    """Return the states after some numbers of steps, shape (k,), from those on the grid."""
    index = np.minimum(times.astype(np.int64), len(states) - 2)
    return modes.between(states[index], (times - index)[:, np.newaxis])


def _dimensional(states: Array, segment: Segment) -> Array:
    """Return position, velocity, Y and Y' in SI units, (k, 4)."""
    frequency = segment.equations.drive_frequency
    scales = np.array([frequency, 1.0, frequency, 1.0])
    motion: Array = states[:, : _RATE + 1] / scales
    motion[:, _X] += segment.state[0]
    return motion


@lru_cache(maxsize=64)
def _modes(equations: Equations, ratio: float, sticks: bool) -> _Modes:
    frequency = equations.drive_frequency
    needed = np.zeros(10)
    needed[_Y], needed[_RATE] = equations.coupling_stiffness / frequency, equations.coupling_damping
    needed[_SINE], needed[_COSINE] = equations.force_sine, equations.force_cosine
    needed[_FORCE] = 1.0
    rates = np.zeros((10, 10))
    rates[_Y, _RATE] = 1.0
    rates[_RATE, _SINE] = equations.base_acceleration / frequency
    rates[_RATE, _RATE] = -equations.damping_rate / frequency
    rates[_RATE, _Y] = -equations.stiffness_rate / frequency**2
    rates[_SINE, _COSINE], rates[_COSINE, _SINE] = 1.0, -1.0
    rates[_NORMAL_SINE, _NORMAL_COSINE], rates[_NORMAL_COSINE, _NORMAL_SINE] = ratio, -ratio
    rates[_FORCE, _FORCE_RATE] = 1.0
    if not sticks:
        rates[_X, _V] = 1.0
        rates[_V] = needed
        rates[_V, _NORMAL_SINE] = -equations.friction_amplitude
        rates[_V] /= equations.inertia * frequency
        rates[_RATE] -= rates[_V]
    turned = 2.0 * math.pi * frequency / equations.fastest_rate(ratio)
    step = turned / STEPS_PER_FASTEST_PERIOD
    terms = [np.eye(10)]
    for order in range(1, _ORDER + 1):
        terms.append(terms[-1] @ rates * (step / order))
    series = np.stack(terms)
    powers = np.stack([np.eye(10), series.sum(axis=0)])
    while len(powers) <= STEPS_PER_FASTEST_PERIOD:
        powers = np.concatenate([powers, powers[1:] @ powers[-1]])
    return _Modes(step, step * rates, series, powers, needed)
