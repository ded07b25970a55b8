"""The resolved motion of a device: Taylor series of each contact mode, events to rounding."""

from collections.abc import Sequence
from itertools import accumulate, repeat
from operator import mul

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.phase import Elapsed, advanced
from slider_resonator.references.resolved.contact import LIFTED, STICK
from slider_resonator.references.resolved.mode_sequence import ModeSequence, Segment, SegmentResult
from slider_resonator.references.resolved.polynomial_roots import first_fall
from slider_resonator.references.resolved.taylor_series import (
    LONGEST,
    ORDER,
    MotionSeries,
    Series,
    motion_series,
)
from slider_resonator.references.resolved.trajectory import Trajectory

_NOISE = 2e-15
"""Rounding error of a sum, as a share of its largest term."""


def simulate(device: Device, held: Sequence[HeldInputs], times: Array) -> Trajectory:
    """Return the motion of a device under held inputs at ``times`` (shape (n,), s).

    ``times`` ascend within ``[held[0].start, held[-1].stop]``; theta and psi are 0 at the first
    start. A sample on a boundary between inputs belongs to the inputs before it. Counts cover the
    whole span of the inputs; ``evaluations`` counts Taylor series. Raises ValueError for a device
    that the equations do not cover; RuntimeError for a contact that cannot be resolved in floating
    point numbers, and for a motion that leaves these.
    """
    return ModeSequence(device, follow_series, times).run(held)


def follow_series(segment: Segment) -> SegmentResult:
    """Follow a segment of either friction law; RuntimeError where it leaves the finite numbers."""
    equations, frequency = segment.equations, segment.equations.drive_frequency
    units = [1.0 / frequency, 1.0, 1.0 / frequency, 1.0]
    if equations.path_rate:
        units.append(1.0 / equations.path_rate)
    # The displacement counts from the start of the segment: a large position costs no digits.
    states = [0.0, *(one / unit for one, unit in zip(segment.state[1:], units[1:], strict=True))]
    longest = LONGEST * frequency / equations.fastest_rate(segment.now, segment.span)
    span, times = segment.span * frequency, segment.samples * frequency
    elapsed = Elapsed()
    now, theta, angle = segment.now, segment.theta, segment.angle
    kept = [np.empty((0, len(units)))]
    sampled = steps = event = 0
    while not event and (remaining := elapsed.until(span)) > 0.0:
        if now.vary:
            now = segment.now.later(elapsed.total / frequency)
        series = motion_series(segment, theta, angle, now, states)
        step = min(remaining, longest, _step_of(series) if series.bends else longest)
        if not step > 0.0:
            raise RuntimeError(
                f"the Taylor step from velocity {states[1]!r} m/s is {step!r} rad of the drive: "
                "the motion has left the finite numbers"
            )
        share, event = _first_event(segment, series, step)
        step *= share
        powers = _powers(step)
        states = [sum(map(mul, row, powers)) for row in series.states]
        local = elapsed.until(times[sampled:])
        local = local[: np.searchsorted(local, step, side="right")]
        if len(local):
            rows: Array = np.polynomial.polynomial.polyval(local, np.array(series.states).T)
            kept.append(rows.T)
            sampled += len(local)
        steps += 1
        elapsed.add(step)
        theta = advanced(theta, step)
        ratio = now.frequency_ratio + 0.5 * now.ratio_rate / frequency * step
        angle = advanced(angle, ratio * step)
    samples = np.concatenate(kept) * units
    samples[:, 0] += segment.state[0]
    way, *others = (state * unit for state, unit in zip(states, units, strict=True))
    return SegmentResult(
        duration=elapsed.total / frequency if event else segment.span,
        state=(segment.state[0] + way, *others),
        event=event,
        samples=samples,
        steps=steps,
        evaluations=steps,
    )


def _step_of(series: MotionSeries) -> float:
    """Return the step (rad) in which the last terms of velocity and stretch are negligible."""
    steps = [LONGEST]
    for row in (series.states[1], series.states[4]):
        first = next((order for order, term in enumerate(row) if term), ORDER)
        for order in (ORDER - 1, ORDER):
            if order > first and row[order]:
                share = 1e-16 * abs(row[first] / row[order])
                steps.append(share ** (1.0 / (order - first)))
    return min(steps)


def _first_event(segment: Segment, series: MotionSeries, step: float) -> tuple[float, int]:
    """Return the share of a step up to its first event, and its direction; 1 and 0 without one."""
    mode, direction = segment.mode, segment.direction
    if mode == LIFTED and not segment.equations.path_rate:
        return 1.0, 0
    powers = np.array(_powers(step))
    if mode != STICK:
        noise = _velocity_noise(segment, series, step)
        share = first_fall(direction * np.array(series.states[1]) * powers, noise)
        return (1.0, 0) if share is None else (share, -direction)
    limit, needed = np.array(series.limit) * powers, np.array(series.needed) * powers
    noise = _NOISE * _force_size(segment, series, step, 1.0)
    found = [
        (share, event)
        for event in (1, -1)
        if (share := first_fall(limit - event * needed, noise)) is not None
    ]
    return min(found, default=(1.0, 0))


def _velocity_noise(segment: Segment, series: MotionSeries, step: float) -> float:
    """Return the rounding error of the velocity in a step, m/s."""
    equations, size = segment.equations, _size(series.states[1], step)
    grip = 0.0 if segment.mode == LIFTED else 1.0
    if grip and equations.path_rate:
        # What the bristle holds in presliding is far below its limit, and so is its rounding.
        grip = min(1.0, _size(series.states[4], step) + equations.path_damping * size)
    return _NOISE * (size + min(1.0, step) * _force_size(segment, series, step, grip))


def _force_size(segment: Segment, series: MotionSeries, step: float, grip: float) -> float:
    """Return the size of the forces on the slider, over inertia and frequency.

    `grip` is the share of its limit that friction reaches.
    """
    equations, frequency = segment.equations, segment.equations.drive_frequency
    coupling = equations.coupling_damping + equations.coupling_stiffness / frequency
    swing = coupling * max(_size(row, step) for row in series.states[2:4])
    outer = abs(equations.force_sine) + abs(equations.force_cosine) + abs(segment.now.load)
    held = grip * (equations.friction_mean + equations.friction_amplitude)
    return (swing + outer + held) / (equations.inertia * frequency)


def _size(row: Series, step: float) -> float:
    """Return the size of a series in a step, by its first terms."""
    return abs(row[0]) + abs(row[1] * step) + abs(row[2] * step * step)


def _powers(step: float) -> Series:
    return list(accumulate(repeat(step, ORDER), mul, initial=1.0))
