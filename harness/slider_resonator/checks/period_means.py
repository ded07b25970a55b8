"""Means over whole drive periods, and counts, at every communication point of a trajectory."""

from __future__ import annotations

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.checks.measures.tube import Tube
from slider_resonator.references.resolved.contact import STICK
from slider_resonator.references.resolved.trajectory import Trajectory

COINCIDENCE = 1e-6
"""Share of a drive period within which an event and a communication point coincide."""

_ENDED = 1e-9
"""Share of a drive period that may be missing from one that counts as ended."""


def period_ends(times: Array, period: float) -> Array:
    """Return begin and end (s) of the last whole drive period (s) before each time, shape (n, 2).

    Before the first is over they are the start, 0 s, and the time itself.
    """
    ended = _ended(times, period)
    whole = np.minimum(np.column_stack([ended - 1.0, ended]) * period, times[:, None])
    running = np.column_stack([np.zeros_like(times), times])
    return np.where(ended[:, None] >= 1.0, whole, running)


def _ended(times: Array, period: float) -> Array:
    """Return how many drive periods (s) have ended by each time, shape (n,)."""
    return np.floor(times / period + _ENDED)


def _lengths(times: Array, period: float) -> Array:
    """Return what lies between the `period_ends` (s), shape (n,)."""
    return np.where(_ended(times, period) >= 1.0, period, times)


def mean_velocities(run: Trajectory, times: Array, period: float) -> Array:
    """Return the mean velocity (m/s) over the last whole drive period (s), shape (n,).

    Before the first is over it is the mean since the start, and at the start the velocity. The
    trajectory must have samples at the `period_ends`.
    """
    ends, lengths = period_ends(times, period), _lengths(times, period)
    position = run.position[np.searchsorted(run.time, ends)]
    at_start = run.velocity[np.searchsorted(run.time, times)]
    means = np.diff(position, axis=1)[:, 0] / np.where(lengths > 0.0, lengths, 1.0)
    return np.where(lengths > 0.0, means, at_start)


def stick_fractions(run: Trajectory, times: Array, period: float) -> Array:
    """Return the share of the last whole drive period (s) spent sticking, shape (n,).

    Before the first is over it is the share since the start, at the start 1 at rest and else 0.
    """
    edges = np.append(0.0, run.event_times)
    stuck = np.diff(edges) * (run.modes[:-1] == STICK)
    before = np.append(0.0, np.cumsum(stuck))

    def stick_time(at: Array) -> Array:
        last = np.searchsorted(edges, at, side="right") - 1
        return np.asarray(before[last] + (at - edges[last]) * (run.modes[last] == STICK))

    ends, lengths = period_ends(times, period), _lengths(times, period)
    shares = np.diff(stick_time(ends), axis=1)[:, 0] / np.where(lengths > 0.0, lengths, 1.0)
    return np.where(lengths > 0.0, shares, float(run.modes[0] == STICK))


def reversal_counts(run: Trajectory, times: Array, period: float) -> Tube:
    """Return how many reversals there were up to each time; where they coincide, either number."""
    counts = [
        np.searchsorted(run.reversal_times, times + shift * period, side="right").astype(float)
        for shift in (0.0, -COINCIDENCE, COINCIDENCE)
    ]
    return Tube(*counts)


def last_events(run: Trajectory, times: Array, period: float) -> Tube:
    """Return the time of the last event before each time, in drive periods (s).

    Events are changes of the contact mode and reversals. Where an event and a time coincide to
    `COINCIDENCE`, the tube allows either order.
    """
    events = np.union1d(np.append(0.0, run.event_times), run.reversal_times)

    def last_before(at: Array) -> Array:
        return events[np.searchsorted(events, np.maximum(at, 0.0), side="right") - 1]

    margin = COINCIDENCE * period
    bounds = [last_before(times + shift) for shift in (0.0, -margin, margin)]
    return Tube(*(bound / period for bound in bounds))
