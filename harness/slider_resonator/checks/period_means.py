"""Means over whole drive periods, and counts, at every communication point of a trajectory."""

from collections.abc import Callable

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.checks.measures import Tube
from slider_resonator.device.drive_periods import DrivePeriods
from slider_resonator.references.resolved.contact import STICK
from slider_resonator.references.resolved.trajectory import Trajectory

COINCIDENCE = 1e-6
"""Share of a drive period within which an event and a communication point coincide."""


def mean_velocities(run: Trajectory, times: Array, periods: DrivePeriods) -> Array:
    """Return the mean velocity (m/s) over the last whole drive period, shape (n,).

    Before the first is over it is the mean since the start, and at the start the velocity. The
    trajectory must have samples at the `ends` of periods.
    """
    ends, lengths = periods.ends(times), periods.lengths(times)
    position = run.position[np.searchsorted(run.time, ends)]
    at_start = run.velocity[np.searchsorted(run.time, times)]
    means = np.diff(position, axis=1)[:, 0] / np.where(lengths > 0.0, lengths, 1.0)
    return np.where(lengths > 0.0, means, at_start)


def stick_fractions(run: Trajectory, times: Array, periods: DrivePeriods) -> Array:
    """Return the share of the last whole drive period spent sticking, shape (n,).

    Before the first is over it is the share since the start, at the start 1 at rest and else 0.
    """
    edges = np.append(0.0, run.event_times)
    stuck = np.diff(edges) * (run.modes[:-1] == STICK)
    before = np.append(0.0, np.cumsum(stuck))

    def stick_time(at: Array) -> Array:
        last = np.searchsorted(edges, at, side="right") - 1
        return np.asarray(before[last] + (at - edges[last]) * (run.modes[last] == STICK))

    ends, lengths = periods.ends(times), periods.lengths(times)
    shares = np.diff(stick_time(ends), axis=1)[:, 0] / np.where(lengths > 0.0, lengths, 1.0)
    return np.where(lengths > 0.0, shares, float(run.modes[0] == STICK))


def quadrature(events: Array, begin: float, end: float) -> tuple[Array, Array]:
    """Return nodes and weights (s) between two times (s), each of shape (n,).

    By Gauss, with 12 nodes on each of 16 panels between two events (s), which are narrower after
    an event: a bristle bends in a short time.
    """
    inside = events[(events > begin) & (events < end)]
    events = np.concatenate([[begin], np.unique(inside), [end]])
    shares = np.concatenate([[0.0], np.geomspace(1e-5, 1.0, 16)])
    edges = events[:-1, None] + np.diff(events)[:, None] * shares
    half = 0.5 * np.diff(edges, axis=1)[:, :, None]
    nodes, weights = np.polynomial.legendre.leggauss(12)
    return (edges[:, :-1, None] + half * (1.0 + nodes)).ravel(), (half * weights).ravel()


def reversal_counts(run: Trajectory, times: Array, periods: DrivePeriods) -> Tube:
    """Return how many reversals there were up to each time; where they coincide, either number."""

    def count(at: Array) -> Array:
        return np.searchsorted(run.reversal_times, at, side="right").astype(float)

    return _around(count, times, periods)


def _around(measure: Callable[[Array], Array], times: Array, periods: DrivePeriods) -> Tube:
    """Return a measure at times (s), with that before and after each where an event coincides."""
    margin = COINCIDENCE * periods.period
    return Tube(*(measure(times + shift) for shift in (0.0, -margin, margin)))


def last_events(run: Trajectory, times: Array, periods: DrivePeriods) -> Tube:
    """Return the time of the last event before each time, in drive periods.

    Events are changes of the contact mode and reversals. Where an event and a time coincide to
    `COINCIDENCE`, the tube allows either order.
    """
    events = np.union1d(np.append(0.0, run.event_times), run.reversal_times)

    def last_before(at: Array) -> Array:
        before = np.searchsorted(events, np.maximum(at, 0.0), side="right") - 1
        return np.asarray(events[before] / periods.period)

    return _around(last_before, times, periods)
