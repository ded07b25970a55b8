"""Least squares on an FMU, with intervals and the parameters that the data leave open.

Positive parameters are estimated by their logarithm, so that steps and scales are relative. The
terms are those of nonlinear regression: Seber and Wild, Nonlinear Regression (1989), 5.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cache, cached_property, lru_cache, partial
from math import nan

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq, least_squares

from slider_resonator.arrays import Array
from slider_resonator.fitting.free import Free
from slider_resonator.fitting.measurements import Measurements, Point
from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.run import run
from slider_resonator.steady.searches import SEARCHES


def predict(
    instance: Instance, parameters: Mapping[str, float], measurements: Measurements
) -> Array:
    """Return the numbers of the FMU at the points of the measurements, shape (n,).

    A steady quantity is the FMU's output where that is valid, else it is found by shooting; where
    no such motion is found it is NaN. Raises FmuError and Refusal as `Instance.start` does.
    """
    points, series = measurements.points, measurements.series
    found, runs = np.empty(len(points)), {}
    for source, schedule in measurements.runs.items():
        outputs = [name for name, of in series if of == source]
        runs[source] = run(instance, parameters, schedule, outputs=outputs).outputs
    for (name, source), rows in series.items():
        if source in runs:
            times = measurements.runs[source].times
            found[rows] = runs[source][name][np.searchsorted(times, measurements.times[rows])]
        else:
            found[rows] = [_steady(instance, parameters, points[row]) for row in rows.tolist()]
    return found


def _steady(instance: Instance, parameters: Mapping[str, float], point: Point) -> float:
    """Return a steady quantity, as `predict` does."""
    values = {**parameters, **point.values}
    known = [name for name in ("prediction_valid", point.quantity) if name in instance.fmu.outputs]
    instance.start(values)
    with instance.explained():
        read = instance.read(known)
    if read.get("prediction_valid") == 1.0:
        return read[point.quantity]
    found = SEARCHES[point.quantity](instance, values).value
    return nan if found is None else found


NO_MOTION = 10.0
"""Residual, in root mean squares of the quantity, of a point at which the FMU has no motion."""
DIFFERENCE = 1e-4
"""Step of differences, in units of a parameter: error 1e-4, 1e-8 of central ones, of rounding 1e-6.

Searches take one-sided ones. Central ones at a minimum show what the data leave open.
"""
ACCURACY, ROUGH = 1e-10, 1e-3
"""Relative change of a sum of squares at which a search ends; at a rough one another follows."""
PROFILE_ACCURACY = 0.01
"""Share of the width of an interval to which its end is found."""
MAX_DISTANCE = 1e6
"""Distance of an end from the estimate, in units of a parameter, beyond which it is not sought."""


@dataclass(frozen=True)
class Problem:
    """What is fitted: a device, its free parameters, and the measurements."""

    parameters: Mapping[str, float]
    free: tuple[Free, ...]
    measurements: Measurements

    @property
    def start(self) -> Array:
        """The internal parameters (p,) of the device before the fit."""
        return np.array([one.internal(one.start) for one in self.free])

    def values(self, internal: Array) -> dict[str, float]:
        """Return all parameters in SI units, from the internal free ones (p,)."""
        found = zip(self.free, internal.tolist(), strict=True)
        return {**self.parameters, **{one.name: one.value(number) for one, number in found}}

    def residuals(self, instance: Instance) -> Callable[[Array], Array]:
        """Return the function from internal parameters (p,) to weighted residuals (n,)."""
        measured, scales = self.measurements.measured, self.measurements.scales
        no_motion = NO_MOTION * self.measurements.sizes / scales

        @lru_cache(maxsize=2)  # slopes begin where a step has ended
        def at(internal: tuple[float, ...]) -> Array:
            found = predict(instance, self.values(np.array(internal)), self.measurements)
            weighted = (found - measured) / scales
            return np.where(np.isfinite(weighted), weighted, no_motion)

        return lambda internal: at(tuple(internal.tolist()))


NOTHING = 1e-6
"""Singular value, over the largest, below which differences of the outputs are rounding."""
REDUNDANCY = 2.0
"""Numbers to spare from which a series tells its own noise; others have that of all."""


@dataclass(frozen=True)
class Minimum:
    """The least squares from one start: internal parameters (p,), residuals (n,), slopes (n, p).

    `at_bound` (p,) is -1 and 1 for a parameter at its lower and upper bound, else 0.
    """

    problem: Problem
    internal: Array
    residuals: Array
    jacobian: Array
    evaluations: int
    at_bound: NDArray[np.intp]

    @property
    def sum_of_squares(self) -> float:
        """Weighted sum of squares."""
        return float(self.residuals @ self.residuals)

    def deviance(self, rounding: float) -> float:
        """Return -2 log likelihood, up to a constant of the data, with unknown noise as found.

        `rounding` is the error, in root mean squares of the quantity, that counts as none.
        """
        data = self.problem.measurements
        if data.knows_deviations:
            return self.sum_of_squares
        variances = (data.scales / data.sizes) ** 2 * np.mean(self.residuals**2)
        return float(np.log(np.maximum(variances, rounding**2)).sum())

    @cached_property
    def inverse(self) -> Array:
        """Changes of the internal parameters by those of weighted numbers, (p, n)."""
        return np.asarray(np.linalg.pinv(self.jacobian, rcond=NOTHING), np.float64)

    @property
    def covariance(self) -> Array:
        """Covariance of the internal parameters, (p, p), for residuals of standard deviation 1."""
        return np.asarray(self.inverse @ self.inverse.T)

    @property
    def correlation(self) -> Array:
        """Correlation of the estimates, (p, p)."""
        deviations = np.sqrt(np.diag(self.covariance))
        products = np.outer(deviations, deviations).clip(min=1e-300)
        return np.asarray(self.covariance / products)

    @property
    def noises(self) -> list[tuple[NDArray[np.intp], NDArray[np.intp], float]]:
        """Numbers of the same noise, those that tell it, and how many of these are to spare.

        Each series has a noise of its own; those that do not tell theirs share that of all.
        """
        hat = np.einsum("ij,ji->i", self.jacobian, self.inverse)
        tells = np.abs(self.jacobian).max(axis=1) > 0.0  # else no motion, or it tells nothing
        found, others = [], [np.empty(0, np.intp)]
        for rows in self.problem.measurements.series.values():
            own = rows[tells[rows]]
            redundancy = len(own) - float(hat[own].sum())
            if redundancy >= REDUNDANCY:
                found.append((rows, own, redundancy))
            elif len(own):
                others.append(rows)
        spare = max(len(hat) - float(hat.sum()), 1.0)
        return [*found, (np.concatenate(others), np.arange(len(hat)), spare)]

    @property
    def degrees_of_freedom(self) -> Array:
        """Those of the estimated variance of each internal parameter, (p,).

        They follow from the series that tell it, by Satterthwaite, Biometrics 2 (1946), 110-114.
        """
        if self.problem.measurements.knows_deviations:
            return np.full(len(self.internal), np.inf)
        shares = [np.sum(self.inverse[:, rows] ** 2, axis=1) for rows, _, _ in self.noises]
        spread = sum(share**2 / one[2] for share, one in zip(shares, self.noises, strict=True))
        return np.asarray(sum(shares) ** 2 / np.maximum(spread, 1e-300)).clip(min=1.0)


def minimise(
    instance: Instance, problem: Problem, start: Array, accuracy: float = ACCURACY
) -> Minimum:
    """Return the least squares from a start (p,), internal parameters.

    Raises FmuError and Refusal as `Instance.start` does, also where a step leads to parameters that
    the FMU refuses: their bounds must exclude them.
    """
    residuals = problem.residuals(instance)
    low = np.array([one.internal(one.low) for one in problem.free])
    high = np.array([one.internal(one.high) for one in problem.free])
    slopes = partial(_slopes, residuals, low, high)
    found = least_squares(
        residuals,
        np.clip(start, low, high),
        slopes,
        bounds=(low, high),
        x_scale="jac",
        xtol=1e-10,
        ftol=accuracy,
        gtol=1e-12,
        max_nfev=60,
    )
    is_rough = accuracy > ACCURACY
    jacobian = np.asarray(found.jac) if is_rough else slopes(found.x, back=1.0)
    evaluations = int(found.nfev) + len(found.x) * (int(found.njev or 0) + 2 * (not is_rough))
    return Minimum(problem, found.x, found.fun, jacobian, evaluations, found.active_mask)


def _slopes(
    residuals: Callable[[Array], Array], low: Array, high: Array, at: Array, back: float = 0.0
) -> Array:
    """Return the slopes between a step `back` from `at` and one forward, in the bounds, (n, p)."""
    columns = []
    for step in DIFFERENCE * np.eye(len(at)):
        before = np.maximum(at - np.where(at + step > high, 1.0, back) * step, low)
        after = np.minimum(at + step, high)
        columns.append((residuals(after) - residuals(before)) / (after - before).sum())
    return np.column_stack(columns)


LEAST_NOISE = 1e-6
"""Least noise, in root mean squares of the quantity: what rounding of the data may be."""


REWEIGHTINGS = 10
STEADY_NOISE = 0.01
"""Largest number of times that series are weighted by what they err by, and the relative change of
that up to which it is found."""


def search(instance: Instance, problem: Problem, start: Array) -> Minimum:
    """Return the minimum from a start, with each series weighted by what it errs by there.

    That is estimated as variance components are: sums of squares over redundancies (Foerstner,
    Zeitschrift fuer Vermessungswesen 104 (1979), 446-453). Arguments and errors are those of
    `minimise`.
    """
    data, evaluations = problem.measurements, 0
    is_weighted = len(data.measured) > len(problem.free) and not data.knows_deviations
    for _ in range(REWEIGHTINGS if is_weighted and len(data.series) > 1 else 0):
        rough = minimise(instance, problem, start, ROUGH)
        start, evaluations = rough.internal, evaluations + rough.evaluations
        noise = problem.measurements.noise * np.ones(len(rough.residuals))
        for rows, own, redundancy in rough.noises:
            noise[rows] *= (np.sum(rough.residuals[own] ** 2) / redundancy) ** 0.5
        noise = noise.clip(min=LEAST_NOISE)
        if np.ptp(np.log(noise / problem.measurements.noise)) < STEADY_NOISE:
            break
        problem = replace(problem, measurements=replace(data, noise=noise))
    found = minimise(instance, problem, start)
    return replace(found, evaluations=found.evaluations + evaluations)


def profile_end(
    instance: Instance, best: Minimum, index: int, change: float, excess: float
) -> float | None:
    """Return the end of a profile interval of a parameter, in SI units, None if it is unbounded.

    It is where the least sum of squares over the other parameters is `excess` above that of `best`;
    `change` is the end that the linear approximation gives, as a change of the internal parameter.
    At a bound the interval ends, unless the bound only confines the search.
    """
    problem, one = best.problem, best.problem.free[index]
    covariance, least = best.covariance, best.sum_of_squares
    along = np.delete(covariance[:, index] / covariance[index, index], index)
    others = np.delete(best.internal, index)
    other_free = (*problem.free[:index], *problem.free[index + 1 :])
    accuracy = PROFILE_ACCURACY * min(excess / max(least, 1e-300), 1.0)

    def value(distance: float) -> float:
        return one.value(float(best.internal[index]) + np.copysign(distance, change))

    @cache
    def beyond(distance: float) -> float:
        """Return how far the sum of squares is above the end, as its root and in its units."""
        nonlocal along
        if distance == 0.0:
            return -1.0
        fixed = {**problem.parameters, one.name: value(distance)}
        rest = Problem(fixed, other_free, problem.measurements)
        if other_free:
            moved = np.copysign(distance, change)
            nearest = minimise(instance, rest, others + moved * along, accuracy)
            along, found = (nearest.internal - others) / moved, nearest.sum_of_squares
        else:
            residuals = rest.residuals(instance)(np.empty(0))
            found = float(residuals @ residuals)
        above = float(np.sqrt(max(found - least, 0.0) / excess)) - 1.0
        return above if abs(above) > PROFILE_ACCURACY else 0.0

    inner, outer = 0.0, abs(change)
    while beyond(outer) < 0.0:
        end = value(outer)
        if end in one.search_bounds or outer > MAX_DISTANCE:
            return None
        if end in (one.low, one.high):
            return end
        inner, outer = outer, outer * (1.1 - beyond(outer))
    return value(float(brentq(beyond, inner, outer, rtol=PROFILE_ACCURACY, xtol=1e-15)))


@dataclass(frozen=True)
class OpenDirection:
    """A change of parameters that the data do not tell apart from none.

    `factors` are changes of the internal parameters by name, the largest of size 1; `spread` is how
    far along them the data allow, infinite where they say nothing.
    """

    factors: Mapping[str, float]
    spread: float


ALLOWED = 1.0
"""Spread, a factor e of a positive parameter, from which a direction counts as open."""
TAKES_PART = 0.1
"""Share of a direction from which a parameter takes part in it."""


def open_directions(best: Minimum, scale: float) -> list[OpenDirection]:
    """Return what the data leave open, from the singular values of the slopes.

    `scale` is the standard deviation of a weighted residual, and 1 where deviations are known.
    """
    _, sizes, directions = np.linalg.svd(best.jacobian, full_matrices=False)
    found = []
    for size, direction in zip(sizes, directions, strict=True):
        nothing = size <= NOTHING * max(sizes[0], 1e-300)
        spread = float("inf") if nothing else scale / size
        if spread > ALLOWED:
            largest = direction[np.argmax(np.abs(direction))]
            factors = {
                one.name: float(part / largest)
                for one, part in zip(best.problem.free, direction, strict=True)
                if abs(part / largest) > TAKES_PART
            }
            found.append(OpenDirection(factors, spread))
    return found
