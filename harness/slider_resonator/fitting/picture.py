"""The picture of a fit: data, fit and residuals."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from slider_resonator.arrays import Array
from slider_resonator.device.interface import VARIABLES
from slider_resonator.fitting.measurements import Measurements, Point
from slider_resonator.output.plot_style import COLOURS, Picture, style
from slider_resonator.output.plot_units import Drawn, drawn, plot_unit

Panel = tuple[Drawn, str, Array, Array, Array]
"""Abscissa, title, measured and predicted values, and residuals, (n,) each."""


def fit_figure(measurements: Measurements, numbers: Array) -> Figure:
    """Draw data and fit above, residuals below: points over what varies most, runs over time.

    `numbers` are measured and predicted values and residuals, (3, n).
    """
    panels = list(_panels(measurements, numbers))
    with style():
        figure = Picture((3.6 + 3.2 * len(panels), 5.2), layout="constrained")
        axes = figure.subplots(
            2, len(panels), squeeze=False, sharex="col", height_ratios=[2.0, 1.0]
        )
        for column, (over, title, measured, predicted, residuals) in enumerate(panels):
            above, below = axes[0][column], axes[1][column]
            x = over.values
            above.plot(x, measured, "o", ms=4, color=COLOURS["theory"], label="measured")
            order = np.argsort(x, kind="stable")
            is_line = len(np.unique(x)) == len(x)
            mark = "-" if is_line else "+"
            above.plot(x[order], predicted[order], mark, color=COLOURS["slow"], label="fit")
            above.set_title(title)
            above.legend()
            below.axhline(0.0, color="0.6", lw=0.8)
            below.plot(x, residuals, "o", ms=3, color=COLOURS["slow"])
            below.set_xlabel(over.label)
            below.set_ylabel("residual / deviation")
    return figure


def _panels(measurements: Measurements, numbers: Array) -> Iterator[Panel]:
    points = measurements.points
    for quantity in dict.fromkeys(point.quantity for point in points):
        rows = [i for i, point in enumerate(points) if point.quantity == quantity]
        yield _panel(_abscissa([points[i] for i in rows]), quantity, "", numbers[:, rows])
    begin = len(points)
    for run in measurements.runs:
        for name, column in run.outputs.items():
            there = np.isfinite(column)
            own = slice(begin, begin + int(there.sum()))
            begin = own.stop
            over = drawn("time", "s", run.schedule.times[there])
            yield _panel(over, name, f" ({Path(run.source).name})", numbers[:, own])


def _panel(over: Drawn, name: str, source: str, numbers: Array) -> Panel:
    """Return the panel of a measured output; `numbers` (3, n) are those of `fit_figure`."""
    measured, predicted, residuals = numbers
    factor, unit = plot_unit(VARIABLES[name].unit, measured, predicted)
    title = f"{name.replace('_', ' ')} [{unit}]{source}"
    return over, title, factor * measured, factor * predicted, residuals


def _abscissa(points: list[Point]) -> Drawn:
    """Return the variable with most values among the points, or their numbers."""
    names = dict.fromkeys(name for point in points for name in point.values)
    counts = {name: len({point.values.get(name) for point in points}) for name in names}
    if not counts or max(counts.values()) < 2:
        return Drawn("number of the measurement", "1", np.arange(1.0, len(points) + 1.0))
    name = max(counts, key=lambda one: counts[one])
    start = VARIABLES[name].start or 0.0
    values = np.array([point.values.get(name, start) for point in points])
    return drawn(name, VARIABLES[name].unit, values)
