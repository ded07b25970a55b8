"""What a report notes about measurements and their residuals."""

from collections.abc import Mapping

import numpy as np
from scipy.special import ndtr, stdtrit

from slider_resonator.arrays import Array
from slider_resonator.fitting.estimation import NOTHING
from slider_resonator.fitting.measurements import Measurements, shown
from slider_resonator.scenes.device_file import possible_slips

OUTLIER_LEVEL = 0.005
"""Level of the test for outliers: normal errors alone give some in fewer than 1 of 100 fits."""
MAX_OUTLIERS = 20
"""Number of outliers of a series that are sought, at most one for five numbers to spare."""
CHANCE = 0.01
"""Probability of as few runs about the median below which residuals count as systematic."""
ROUNDING = 1e-6
"""Residual, in root mean squares of the quantity, up to which it may be rounding of the data."""
MAX_NAMED = 5
"""Number of outliers that are named."""
MISSED = 0.5
"""Root mean square of residuals over that of the quantity from which the fit is not near it."""


def data_notes(measurements: Measurements, parameters: Mapping[str, float]) -> list[str]:
    """Return what was done in reading, numbers that may be meant in Hz or degrees, and assumptions.

    `parameters` are those of the device.
    """
    slips: dict[tuple[str, str], str] = {}
    for source, name, value in measurements.plain_numbers:
        where = f'"{name} [{"deg" if name == "phase" else "Hz"}]" as heading'
        for slip in possible_slips({name: value}, parameters, where):
            slips.setdefault((source, name), f"{source}: {slip}")
    unsaid = []
    for name, zero in (("phase", "0 rad"), ("load", "0 N")):
        points = [one for one in measurements.steady if name not in one.values]
        asked = {one.source for one in points if (name, one.quantity) != ("load", "blocking_force")}
        unsaid += [
            f"{source}: no {name} is given, and {zero} assumed: a column or a set value can say it"
            for source in sorted(asked)
        ]
    return [*measurements.notes, *slips.values(), *unsaid]


def miss_notes(measurements: Measurements, predicted: Array) -> list[str]:
    """Return a note for each quantity that a fit does not come near.

    `predicted` has shape (n,), NaN where there is no motion.
    """
    measured = measurements.measured
    sizes = dict(measurements.root_mean_squares(measured))
    shares = measurements.root_mean_squares((predicted - measured) / measurements.sizes)
    return [
        f"the fit misses {share:.0%} of {name}, which is {shown(name, sizes[name])} (rms): check "
        "units and signs, and what is held"
        for name, share in shares
        if share >= MISSED
    ]


def misfit_notes(measurements: Measurements, predicted: Array, jacobian: Array) -> list[str]:
    """Return outliers and systematic residuals of a fit.

    `predicted` has shape (n,), `jacobian` (n, p): the slopes of the weighted residuals.
    """
    measured = measurements.measured
    weighted = (predicted - measured) / measurements.scales
    is_seen = np.abs(predicted - measured) > ROUNDING * measurements.sizes
    points, series = measurements.points, measurements.series
    outliers: list[str] = []
    systematic = []
    for (quantity, source), own in series.items():
        rows = own[np.isfinite(weighted[own])]
        found = rows[outlying(weighted[rows], jacobian[rows], OUTLIER_LEVEL / len(series))]
        for index in found[is_seen[found]].tolist():
            number, fit = (shown(quantity, float(x[index])) for x in (measured, predicted))
            outliers.append(f"{source} {points[index].row}: {quantity} {number}, fit {fit}")
        rows = rows[is_seen[rows]]
        if len(rows) < 2:
            continue
        runs, expected, chance = runs_about_median(weighted[rows])
        if chance < CHANCE:
            systematic.append(
                f"{source}: residuals of {quantity} are systematic: {runs} runs above or below "
                f"their median, {expected:.0f} by chance (runs test, p = {chance:.1g}); the model "
                "misses something, and the intervals are too narrow"
            )
    if outliers:
        more = len(outliers) - MAX_NAMED
        named = "; ".join([*outliers[:MAX_NAMED], *([f"and {more} more"] if more > 0 else [])])
        systematic.insert(0, f"outliers, by their studentised deleted residuals: {named}")
    return systematic


def outlying(residuals: Array, jacobian: Array, level: float) -> list[int]:
    """Return the indices of outliers among residuals (n,), by their slopes (n, p).

    The number with the largest studentised deleted residual is left out, and the linear model is
    fitted to the others, again and again. Outliers are those up to the last that is beyond
    Student's t at `level` over the numbers left, so that none hides another: the generalised
    extreme studentised residuals of Paul and Fung, Technometrics 33 (1991), 339-348.
    """
    kept, left_out, count = np.arange(len(residuals)), list[int](), 0
    for _ in range(max(1, min((len(residuals) - jacobian.shape[1]) // 5, MAX_OUTLIERS))):
        basis, sizes, _ = np.linalg.svd(jacobian[kept], full_matrices=False)
        basis = basis[:, sizes > NOTHING * sizes.max(initial=0.0)]
        spare = len(kept) - basis.shape[1]
        if spare < 2:
            break
        rest = residuals[kept] - basis @ (basis.T @ residuals[kept])
        redundancy = 1.0 - np.sum(basis**2, axis=1)
        deleted = (rest @ rest * redundancy - rest**2) / (spare - 1)
        size = np.abs(rest) / np.sqrt(deleted.clip(min=1e-300))
        farthest = int(np.argmax(size))
        left_out.append(int(kept[farthest]))
        if size[farthest] > stdtrit(spare - 1, 1.0 - level / 2.0 / len(kept)):
            count = len(left_out)
        kept = np.delete(kept, farthest)
    return sorted(left_out[:count])


def runs_about_median(residuals: Array) -> tuple[int, float, float]:
    """Return the number of runs above and below the median, that by chance, and its chance.

    The last is the probability of as few runs. It is the runs test of Wald and Wolfowitz (1940), in
    the normal approximation with its correction for continuity; `residuals` (n,) are in the order
    of the rows.
    """
    total = len(residuals)
    is_above = residuals > np.median(residuals)
    runs = 1 + int(np.count_nonzero(np.diff(is_above)))
    above = float(is_above.sum())
    expected = 2.0 * above * (total - above) / total + 1.0
    variance = (expected - 1.0) * (expected - 2.0) / (total - 1.0)
    deviation = max(variance, 1e-300) ** 0.5
    return runs, expected, float(ndtr((runs + 0.5 - expected) / deviation))
