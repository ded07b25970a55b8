"""Fit parameters of a device to measurements, on isolated FMUs."""

from collections.abc import Callable, Container, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import partial
from math import inf
from pathlib import Path
from typing import Any

import numpy as np
from scipy.special import stdtrit

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.interface import PARAMETERS, VARIABLES
from slider_resonator.errors import FmuError, HarnessError
from slider_resonator.fitting.estimation import (
    LEAST_NOISE,
    Minimum,
    Problem,
    open_directions,
    predict,
    profile_end,
    search,
)
from slider_resonator.fitting.free import free_parameters
from slider_resonator.fitting.measurements import Measurements
from slider_resonator.fitting.notes import data_notes, misfit_notes, miss_notes
from slider_resonator.fitting.result import AS_STATED, Fit, FittedParameter
from slider_resonator.fmu.isolation.process import FmuDied, Task
from slider_resonator.fmu.isolation.tasks import LocalProcesses, run_all_tasks
from slider_resonator.output.progress import Progress, counted, no_progress
from slider_resonator.output.readable import number_of

STARTS = 5
REACH = 3.0
REACH_OF_FREQUENCY = 1.1
"""Factors up to which other starts lie beside the first; a resonance farther off is not felt."""
SEED = 1
LEVEL = 0.95
SAME = 1e-6
"""Relative difference of sums of squares up to which two minima are equally likely."""
APART = 0.01
"""Distance of two minima, in units of a parameter, from which they are two solutions."""
NO_INTERVALS = (
    "no intervals: they mean nothing where the fit misses over half of the data; for noise of that "
    "size, state standard deviations"
)
MET = 1e-4
"""Error, in root mean squares of the quantity, up to which as many parameters meet a number."""


Runner = Callable[[str, Sequence[Task]], list[Any]]
"""Runs tasks, of which the label says what they do, and returns their results."""


def fit(
    measurements: Measurements,
    names: Sequence[str],
    values: Mapping[str, float],
    run: Runner,
    *,
    bounds: Mapping[str, Any] | None = None,
    starts: int = STARTS,
) -> Fit:
    """Estimate parameters of a device by weighted least squares from several starts.

    `values` are the parameters of the device that differ from table 1, from which the first start
    begins, and the inputs of steady measurements that do not say them. Each start, and each end of
    an interval, is a task for `run`. Raises HarnessError for too few numbers, FmuError where the
    FMU fails.
    """
    problem = _problem(measurements, names, values, bounds or {})
    notes = data_notes(problem.measurements, problem.parameters)
    free, spare = problem.free, len(measurements.measured) - len(names)
    is_known = measurements.knows_deviations
    tasks = [partial(search, problem=problem, start=one) for one in _starts(problem, starts)]
    try:
        searched: list[Minimum] = run("searching", tasks)
    except FmuError as error:
        raise FmuError("; ".join([str(error), *notes])) from error
    best, *others = _solutions(searched, problem.start, spare)
    agreeing = sum(_distance(one.internal, best.internal) < APART for one in searched)
    problem, measurements = best.problem, best.problem.measurements
    scale = (best.sum_of_squares / spare) ** 0.5 if spare else None
    unit = 1.0 if is_known else scale or 0.0
    is_as_stated = scale is None or (is_known and scale <= AS_STATED)
    directions = open_directions(best, unit)
    left_open = {name for one in directions for name in one.factors}
    found = problem.values(best.internal)
    (predicted,) = run("comparing", [partial(predict, parameters=found, measurements=measurements)])
    misses = [] if is_as_stated else miss_notes(measurements, predicted)
    is_near = len(misses) < len({*measurements.quantities.tolist()})
    fitted = _estimates(best, unit if is_near else 0.0, left_open, run)
    off = np.abs(predicted - measurements.measured)
    unmet = () if spare else np.flatnonzero(~(off <= MET * measurements.sizes)).tolist()
    notes += misses
    if not is_near:
        notes.append(NO_INTERVALS)
    if spare:
        notes += misfit_notes(measurements, predicted, best.jacobian)
    if not directions:
        for one in [] if unmet else others:
            pairs = zip(free, one.internal.tolist(), strict=True)
            said = ", ".join(f"{which.name} = {which.value(x):.6g}" for which, x in pairs)
            notes.append(f"the data are met as well, or almost, by {said}; bounds decide")
    return Fit(
        fitted,
        Device.from_mapping(found),
        tuple(directions),
        correlation=best.correlation,
        measured=measurements.measured,
        predicted=predicted,
        residuals=(predicted - measurements.measured) / (measurements.scales * (unit or 1.0)),
        scale=scale,
        starts=starts,
        starts_agreeing=agreeing,
        evaluations=sum(one.evaluations for one in searched),
        measurements=measurements,
        unmet=tuple(unmet),
        notes=tuple(notes),
    )


def _problem(
    measurements: Measurements,
    names: Sequence[str],
    values: Mapping[str, float],
    bounds: Mapping[str, Any],
) -> Problem:
    """Return what is to be fitted; arguments and errors are those of `fit`."""
    parameters = {name: value for name, value in values.items() if name in PARAMETERS}
    inputs = {name: value for name, value in values.items() if name not in PARAMETERS}
    free = free_parameters(names, parameters, bounds)
    for source, given in measurements.given:
        if twice := sorted(given.intersection(names)):
            raise HarnessError(
                f"{twice[0]} is free, and a column of {source}; must be one of them: leave it out "
                "of the free parameters, or take the column out"
            )
    count = len(measurements.measured)
    if count < len(free):
        raise HarnessError(
            f"{number_of(count, 'measured number')} for "
            f"{number_of(len(free), 'free parameter')}; must be at least as many"
        )
    return Problem(parameters, free, measurements.under(inputs))


def _estimates(
    best: Minimum, unit: float, left_open: Container[str], run: Runner
) -> tuple[FittedParameter, ...]:
    """Return the estimates, with intervals except of those that are left open.

    `unit` is the standard deviation of the weighted residuals, 0 where nothing tells.
    """
    free, internal = best.problem.free, best.internal.tolist()
    deviations = np.sqrt(np.diag(best.covariance))
    widths = stdtrit(best.degrees_of_freedom, 0.5 + LEVEL / 2) * unit
    bounded = [i for i, one in enumerate(free) if unit and one.name not in left_open]
    tasks = [
        partial(profile_end, best=best, index=i, change=side * deviations[i], excess=widths[i] ** 2)
        for i in bounded
        for side in (-widths[i], widths[i])
    ]
    ends = run("bounding", tasks)
    intervals = dict(zip(bounded, zip(ends[::2], ends[1::2], strict=True), strict=True))
    fitted = []
    for index, one in enumerate(free):
        value = one.value(internal[index])
        low, high = intervals.get(index, (None, None))
        deviation = one.slope(value) * unit * float(deviations[index])
        fitted.append(
            FittedParameter(
                *(one.name, VARIABLES[one.name].unit, one.start, value),
                *(deviation if index in intervals else None, low, high),
                is_open=one.name in left_open,
                at_bound=bool(best.at_bound[index]),
            )
        )
    return tuple(fitted)


def _solutions(searched: Sequence[Minimum], start: Array, spare: int) -> list[Minimum]:
    """Return the most likely minima, the nearest to the device first, and those almost as likely.

    The latter are in the likelihood region of one parameter; `spare` are the numbers to spare.
    """
    count, is_known = len(searched[0].residuals), searched[0].problem.measurements.knows_deviations
    square = float(stdtrit(inf if is_known else max(spare, 1), 0.5 + LEVEL / 2)) ** 2
    deviances = np.array([one.deviance(LEAST_NOISE if spare else MET) for one in searched])
    excesses, same = deviances - deviances.min(), SAME * count
    region = square if is_known else count * np.log1p(square / max(spare, 1))
    found: list[int] = []
    for index in np.argsort(deviances, kind="stable").tolist():
        at = searched[index].internal
        is_other = all(_distance(at, searched[one].internal) >= APART for one in found)
        if is_other and excesses[index] <= (region if spare else same):
            found.append(index)
    found.sort(key=lambda i: (excesses[i] > same, _distance(searched[i].internal, start)))
    return [searched[index] for index in found]


def _distance(one: Array, other: Array) -> float:
    return float(np.abs(one - other).max())


def _starts(problem: Problem, count: int) -> list[Array]:
    """Return internal starts: the device's own first, others at random beside it."""
    first, free = problem.start, problem.free
    factors = [REACH_OF_FREQUENCY if VARIABLES[one.name].unit == "rad/s" else REACH for one in free]
    reach = np.array(
        [np.log(f) if one.is_relative else f for f, one in zip(factors, free, strict=True)]
    )
    random = np.random.default_rng(SEED).uniform(-1.0, 1.0, (count - 1, len(free)))
    return [first, *(first + reach * random)]


@contextmanager
def isolated(
    fmu: Path, jobs: int, time_limit: float, progress: Progress = no_progress
) -> Iterator[Runner]:
    """Yield what runs tasks in processes of an FMU, each for up to `time_limit` (s)."""
    limit = "; the limit is for each start and each end of an interval (--time-limit)"
    with LocalProcesses(fmu, time_limit, jobs) as processes:

        def run(label: str, tasks: Sequence[Task]) -> list[Any]:
            results = []
            progress(counted(label, 0, len(tasks)), 0.0)
            for _, outcome in run_all_tasks(processes, list(enumerate(tasks))):
                if isinstance(outcome.error, FmuDied):
                    raise FmuError(
                        f"{label}: {outcome.error}{limit if outcome.error.over_limit else ''}"
                    )
                results.append(outcome.result())
                progress(counted(label, len(results), len(tasks)), len(results) / len(tasks))
            return results

        yield run
