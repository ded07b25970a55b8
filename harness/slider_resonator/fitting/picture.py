"""The picture of a fit: data, fit and residuals."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from slider_resonator.arrays import Array
from slider_resonator.device.interface import VARIABLES
from slider_resonator.fitting.measurements import (
    Measurements,
    Point,
    abscissa_and_curves,
    set_value,
)
from slider_resonator.output.plot_style import COLOURS, Drawn, Picture, drawn, plot_unit, style


@dataclass(frozen=True)
class Panel:
    """A measured output: measured values and residuals, (n,), over the first n values of `x`.

    `predicted` has the other values of `x` as well, which are between the measured points. `curves`
    are the indices of the points of each curve, by its name, as `abscissa_and_curves` has them.
    """

    x: Drawn
    title: str
    measured: Array
    predicted: Array
    residuals: Array
    curves: Mapping[str, Sequence[int]]


def fit_figure(measurements: Measurements, numbers: Array, between: Sequence[Point]) -> Figure:
    """Draw data and fit above, residuals below: points over what varies most, runs over time.

    `numbers` are measured and predicted values and residuals, (3, n); `between` are predictions
    between the measured points.
    """
    panels = list(_panels(measurements, numbers, between))
    with style():
        figure = Picture((3.6 + 3.2 * len(panels), 5.2), layout="constrained")
        axes = figure.subplots(
            2, len(panels), squeeze=False, sharex="col", height_ratios=[2.0, 1.0]
        )
        for column, panel in enumerate(panels):
            above, below = axes[0][column], axes[1][column]
            below.axhline(0.0, color="0.6", lw=0.8)
            for number, (name, indices) in enumerate(panel.curves.items()):
                _draw_curve(above, below, panel, np.array(indices), name, f"C{number}")
            above.set_title(panel.title)
            above.legend(title="points measured, lines fit" if len(panel.curves) > 1 else None)
            below.set_xlabel(panel.x.label)
            below.set_ylabel("(fit - measured)\n/ standard deviation")
    return figure


def _draw_curve(
    above: Axes, below: Axes, panel: Panel, indices: NDArray[np.intp], name: str, colour: str
) -> None:
    """Draw the points with these indices; a curve without a name shows what is measured and fit."""
    indices = indices[np.argsort(panel.x.values[indices], kind="stable")]
    x = panel.x.values
    own = indices[indices < len(panel.measured)]
    is_line = len(own) < len(indices) or len(np.unique(x[own])) == len(own)
    data, fit = (colour, colour) if name else (COLOURS["theory"], COLOURS["slow"])
    above.plot(x[own], panel.measured[own], "o", ms=4, color=data, label=name or "measured")
    mark = "-" if is_line else "+"
    above.plot(x[indices], panel.predicted[indices], mark, color=fit, label="" if name else "fit")
    below.plot(x[own], panel.residuals[own], "o", ms=3, color=fit)


def _panels(
    measurements: Measurements, numbers: Array, between: Sequence[Point]
) -> Iterator[Panel]:
    points = measurements.points
    for quantity in dict.fromkeys(point.quantity for point in points):
        rows = [i for i, point in enumerate(points) if point.quantity == quantity]
        more = [point for point in between if point.quantity == quantity]
        shown = [*(points[i] for i in rows), *more]
        first, curves = abscissa_and_curves(shown)
        if first:
            values = np.array([set_value(point, first) for point in shown])
            x = drawn(first, VARIABLES[first].unit, values)
        else:
            numbered = np.array(range(1, len(shown) + 1), np.float64)
            x = Drawn("number of the measurement", "1", numbered)
        beyond = np.array([point.measured for point in more])
        yield _panel(x, quantity, "", numbers[:, rows], beyond, curves)
    begin = len(points)
    for run in measurements.runs:
        for name, column in run.outputs.items():
            there = np.isfinite(column)
            own = slice(begin, begin + int(there.sum()))
            begin = own.stop
            x = drawn("time", "s", run.schedule.times[there])
            source = f" ({Path(run.source).name})"
            curves = {"": list(range(len(x.values)))}
            yield _panel(x, name, source, numbers[:, own], np.empty(0), curves)


def _panel(
    x: Drawn,
    name: str,
    source: str,
    numbers: Array,
    between: Array,
    curves: Mapping[str, Sequence[int]],
) -> Panel:
    """Return the panel of a measured output.

    `numbers` (3, n) are those of `fit_figure`, `between` what is predicted between them.
    """
    measured, predicted, residuals = numbers
    factor, unit = plot_unit(VARIABLES[name].unit, measured, predicted, between)
    title = f"{name.replace('_', ' ')} [{unit}]{source}"
    predicted = factor * np.concatenate([predicted, between])
    return Panel(x, title, factor * measured, predicted, residuals, curves)
