"""Least squares on an FMU, with intervals and the parameters that the data leave open.

Positive parameters are estimated by their logarithm, so that steps and scales are relative. The
terms are those of nonlinear regression: Seber and Wild, Nonlinear Regression (1989), 5.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, lru_cache, partial
from math import nan

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq, least_squares

from slider_resonator.arrays import Array
from slider_resonator.device.interface import VARIABLES
from slider_resonator.errors import HarnessError
from slider_resonator.fitting.measurements import Measurements, Point
from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.run import run
from slider_resonator.steady.searches import SEARCHES


def predict(
    instance: Instance, parameters: Mapping[str, float], measurements: Measurements
) -> Array:
    """Return the numbers of the FMU in the order of `Measurements.measured`, shape (n,).

    A steady quantity is the FMU's output where that is valid, else it is found by shooting; where
    no such motion exists it is NaN. Raises FmuError and Refusal as `Instance.start` does.
    """
    numbers = [_steady(instance, parameters, point) for point in measurements.points]
    columns = []
    for one in measurements.runs:
        record = run(instance, parameters, one.schedule, outputs=list(one.outputs))
        columns += [
            record.outputs[name][np.isfinite(column)] for name, column in one.outputs.items()
        ]
    return np.concatenate([numbers, *columns])


def predict_between(
    instance: Instance, parameters: Mapping[str, float], points: Sequence[Point]
) -> list[Point]:
    """Return the points with the FMU's output as measured, without those where it is not valid."""
    outputs = [_output(instance, parameters, point) for point in points]
    found = zip(points, outputs, strict=True)
    return [replace(point, measured=one) for point, one in found if one is not None]


def _output(instance: Instance, parameters: Mapping[str, float], point: Point) -> float | None:
    """Return the output of the FMU for a steady quantity, None where it is not valid."""
    has_validity = "prediction_valid" in instance.fmu.outputs
    instance.start({**parameters, **point.values})
    with instance.explained():
        read = instance.read([point.quantity, *(["prediction_valid"] if has_validity else [])])
    return read[point.quantity] if read.get("prediction_valid") == 1.0 else None


def _steady(instance: Instance, parameters: Mapping[str, float], point: Point) -> float:
    output = _output(instance, parameters, point)
    if output is None:
        search_for = SEARCHES[point.quantity]
        output = getattr(search_for(instance, {**parameters, **point.values}), point.quantity)
    return nan if output is None else float(output)


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
class Free:
    """A parameter to be estimated between two bounds, in SI units.

    Those of `search_bounds` only confine the search: an interval that reaches one is unbounded.
    """

    name: str
    start: float
    low: float
    high: float
    search_bounds: tuple[float, ...] = ()

    @property
    def is_relative(self) -> bool:
        """Whether the logarithm is estimated: of a parameter that cannot be negative."""
        return self.low >= 0.0 and self.start > 0.0

    def internal(self, value: float) -> float:
        """Return the number that is estimated."""
        if self.is_relative:
            return float(np.log(max(value, 1e-300)))
        return value / self._scale

    def value(self, internal: float) -> float:
        """Return the parameter, in SI units."""
        value = float(np.exp(internal)) if self.is_relative else internal * self._scale
        return min(max(value, self.low), self.high)

    def slope(self, value: float) -> float:
        """Return the change of the parameter by that of the internal number, at a value."""
        return value if self.is_relative else self._scale

    @property
    def _scale(self) -> float:
        return abs(self.start) or VARIABLES[self.name].nominal or 1.0


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

    def without(self, index: int, value: float) -> "Problem":
        """Return the problem in which a free parameter is fixed to a value in SI units."""
        fixed = {**self.parameters, self.free[index].name: value}
        return Problem(fixed, (*self.free[:index], *self.free[index + 1 :]), self.measurements)


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

    @property
    def covariance(self) -> Array:
        """Covariance of the internal parameters, (p, p), for residuals of standard deviation 1."""
        return np.asarray(np.linalg.pinv(self.jacobian.T @ self.jacobian), np.float64)

    @property
    def correlation(self) -> Array:
        """Correlation of the estimates, (p, p)."""
        deviations = np.sqrt(np.diag(self.covariance))
        products = np.outer(deviations, deviations).clip(min=1e-300)
        return np.asarray(self.covariance / products)


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


REDUNDANCY = 2.0
"""Numbers to spare from which a series tells its own noise; others have that of all."""
LEAST_NOISE = 1e-6
"""Least noise, in root mean squares of the quantity: what rounding of the data may be."""


REWEIGHTINGS = 10
STEADY_NOISE = 0.01
"""Largest number of times that series are weighted by what they err by, and the relative change of
that up to which it is found."""


def search(instance: Instance, problem: Problem, start: Array) -> Minimum:
    """Return the minimum from a start, with each series weighted by what it errs by there.

    Arguments and errors are those of `minimise`.
    """
    data, evaluations = problem.measurements, 0
    is_weighted = len(data.measured) > len(problem.free) and not data.knows_deviations
    for _ in range(REWEIGHTINGS if is_weighted and len(data.series) > 1 else 0):
        rough = minimise(instance, problem, start, ROUGH)
        start, evaluations = rough.internal, evaluations + rough.evaluations
        noise = noise_of_series(rough)
        if np.ptp(np.log(noise / problem.measurements.noise)) < STEADY_NOISE:
            break
        problem = replace(problem, measurements=replace(data, noise=noise))
    found = minimise(instance, problem, start)
    return replace(found, evaluations=found.evaluations + evaluations)


def noise_of_series(best: Minimum) -> Array:
    """Return how much the numbers of each quantity and source err, by the residuals of a fit, (n,).

    It is a step of the estimation of variance components: sums of squares over redundancies
    (Foerstner, Zeitschrift fuer Vermessungswesen 104 (1979), 446-453).
    """
    jacobian, squares = best.jacobian, best.residuals**2
    tells = np.abs(jacobian).max(axis=1) > 0.0  # else there is no motion, or it tells nothing
    hat = np.einsum("ij,ji->i", jacobian, np.linalg.pinv(jacobian))
    noise = best.problem.measurements.noise * np.ones(len(hat))
    for rows in best.problem.measurements.series.values():
        own = rows[tells[rows]]
        if not len(own):
            continue
        redundancy = len(own) - hat[own].sum()
        if redundancy < REDUNDANCY:
            own, redundancy = np.arange(len(hat)), max(len(hat) - hat.sum(), 1.0)
        noise[rows] *= (squares[own].sum() / redundancy) ** 0.5
    return noise.clip(min=LEAST_NOISE)


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
    accuracy = PROFILE_ACCURACY * min(excess / max(least, 1e-300), 1.0)

    def value(distance: float) -> float:
        return one.value(float(best.internal[index]) + np.copysign(distance, change))

    @cache
    def beyond(distance: float) -> float:
        """Return how far the sum of squares is above the end, as its root and in its units."""
        nonlocal along
        if distance == 0.0:
            return -1.0
        rest = problem.without(index, value(distance))
        if rest.free:
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


NOTHING = 1e-6
"""Singular value, over the largest, below which differences of the outputs are rounding."""
ALLOWED = 1.0
"""Spread, a factor e of a positive parameter, from which a direction counts as open."""
TAKES_PART = 0.1
"""Share of a direction from which a parameter takes part in it."""


def open_directions(best: Minimum, scale: float) -> list[OpenDirection]:
    """Return what the data leave open, from the singular values of the slopes.

    `scale` is the standard deviation of a weighted residual, and 1 where deviations are known.
    """
    if not np.all(np.isfinite(best.jacobian)):
        raise HarnessError("the outputs of the FMU are not finite beside the solution")
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
