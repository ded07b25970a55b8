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
from slider_resonator.device.values import with_unit
from slider_resonator.fitting.measurements import Measurements, Point
from slider_resonator.output.plot_style import COLOURS, Picture, style
from slider_resonator.output.plot_units import Drawn, drawn, plot_unit

MAX_CURVES = 8
"""Number of settings of a second variable up to which each has a colour."""


@dataclass(frozen=True)
class Panel:
    """A measured output: measured and predicted values and residuals over `x`, (n,) each.

    `curves` are the indices of the points of each curve, by its name: one, without a name, or those
    of the settings of what varies beside the abscissa.
    """

    x: Drawn
    title: str
    measured: Array
    predicted: Array
    residuals: Array
    curves: Mapping[str, Sequence[int]]


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
        for column, panel in enumerate(panels):
            above, below = axes[0][column], axes[1][column]
            below.axhline(0.0, color="0.6", lw=0.8)
            for number, (name, indices) in enumerate(panel.curves.items()):
                _draw_curve(above, below, panel, np.array(indices), name, f"C{number}")
            above.set_title(panel.title)
            above.legend(title="points measured, lines fit" if len(panel.curves) > 1 else None)
            below.set_xlabel(panel.x.label)
            below.set_ylabel("residual / deviation")
    return figure


def _draw_curve(
    above: Axes, below: Axes, panel: Panel, indices: NDArray[np.intp], name: str, colour: str
) -> None:
    """Draw the points with these indices; a curve without a name shows what is measured and fit."""
    indices = indices[np.argsort(panel.x.values[indices], kind="stable")]
    x = panel.x.values[indices]
    mark = "-" if len(np.unique(x)) == len(x) else "+"
    data, fit = (colour, colour) if name else (COLOURS["theory"], COLOURS["slow"])
    above.plot(x, panel.measured[indices], "o", ms=4, color=data, label=name or "measured")
    above.plot(x, panel.predicted[indices], mark, color=fit, label="" if name else "fit")
    below.plot(x, panel.residuals[indices], "o", ms=3, color=fit)


def _panels(measurements: Measurements, numbers: Array) -> Iterator[Panel]:
    points = measurements.points
    for quantity in dict.fromkeys(point.quantity for point in points):
        rows = [i for i, point in enumerate(points) if point.quantity == quantity]
        x, curves = _abscissa_and_curves([points[i] for i in rows])
        yield _panel(x, quantity, "", numbers[:, rows], curves)
    begin = len(points)
    for run in measurements.runs:
        for name, column in run.outputs.items():
            there = np.isfinite(column)
            own = slice(begin, begin + int(there.sum()))
            begin = own.stop
            x = drawn("time", "s", run.schedule.times[there])
            source = f" ({Path(run.source).name})"
            yield _panel(x, name, source, numbers[:, own], {"": range(len(x.values))})


def _panel(
    x: Drawn, name: str, source: str, numbers: Array, curves: Mapping[str, Sequence[int]]
) -> Panel:
    """Return the panel of a measured output; `numbers` (3, n) are those of `fit_figure`."""
    measured, predicted, residuals = numbers
    factor, unit = plot_unit(VARIABLES[name].unit, measured, predicted)
    title = f"{name.replace('_', ' ')} [{unit}]{source}"
    return Panel(x, title, factor * measured, factor * predicted, residuals, curves)


def _abscissa_and_curves(points: Sequence[Point]) -> tuple[Drawn, dict[str, list[int]]]:
    """Return the variable with most values among the points, or their numbers, and the curves.

    Points with the same values of all that varies beside it are a curve.
    """
    names = dict.fromkeys(name for point in points for name in point.values)
    values = {
        name: [point.values.get(name, VARIABLES[name].start or 0.0) for point in points]
        for name in names
    }
    counts = {name: len(set(column)) for name, column in values.items()}
    varying = sorted((name for name in names if counts[name] > 1), key=lambda name: -counts[name])
    in_order = list(range(len(points)))
    if not varying:
        return Drawn("number of the measurement", "1", np.array(in_order) + 1.0), {"": in_order}
    first, *others = varying
    curves: dict[str, list[int]] = {}
    for i in range(len(points)):
        name = ", ".join(f"{other} {with_unit(other, values[other][i])}" for other in others)
        curves.setdefault(name, []).append(i)
    x = drawn(first, VARIABLES[first].unit, np.array(values[first]))
    return x, curves if len(curves) <= MAX_CURVES else {"": in_order}
