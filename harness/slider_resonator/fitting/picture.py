"""The picture of a fit: data, fit and residuals."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from slider_resonator.arrays import Array
from slider_resonator.device.interface import VARIABLES
from slider_resonator.fitting.measurements import Point, abscissa_and_curves, set_value, variable
from slider_resonator.output.plot_style import COLOURS, Drawn, Picture, drawn, plot_unit, style


def fit_figure(points: Sequence[Point], numbers: Array, between: Sequence[Point]) -> Figure:
    """Draw data and fit above, residuals below: points over what varies most, runs over time.

    `numbers` are measured and predicted values and residuals of the points, (3, n); `between` are
    predictions between the measured points.
    """
    panels: dict[tuple[str, str], list[int]] = {}
    for index, point in enumerate(points):
        run = point.source if "time" in point.values else ""
        panels.setdefault((point.quantity, run), []).append(index)
    count = len(panels)
    with style():
        figure = Picture((3.6 + 3.2 * count, 5.5), layout="constrained")
        axes = figure.subplots(2, count, squeeze=False, sharex="col", height_ratios=[2.0, 1.0])
        for column, ((quantity, run), rows) in zip(axes.T.tolist(), panels.items(), strict=True):
            more = [point for point in between if point.quantity == quantity and not run]
            _draw(column, [*(points[row] for row in rows), *more], numbers[:, rows])
    return figure


def _draw(axes: Sequence[Axes], points: Sequence[Point], numbers: Array) -> None:
    """Draw what is measured at the first n points, `numbers` (3, n), and predictions at the others.

    A single curve shows what is measured and fit; each of several has a colour and a name.
    """
    above, below = axes
    name = points[0].quantity
    first, curves = abscissa_and_curves(points)
    if first:
        x = drawn(first, variable(first).unit, np.array([set_value(one, first) for one in points]))
    else:
        x = Drawn("number of the measurement", "1", np.arange(1.0, len(points) + 1.0))
    between = np.array([one.measured for one in points[numbers.shape[1] :]])
    factor, unit = plot_unit(VARIABLES[name].unit, *numbers[:2], between)
    measured, predicted = factor * numbers[0], factor * np.concatenate([numbers[1], between])
    below.axhline(0.0, color="0.6", lw=0.8)
    for number, (curve, rows) in enumerate(curves.items()):
        indices = np.array(rows)
        indices = indices[np.argsort(x.values[indices], kind="stable")]
        own = indices[indices < len(measured)]
        colour = f"C{number}"
        data, fit = (colour, colour) if curve else (COLOURS["theory"], COLOURS["slow"])
        label = "" if curve else "fit"
        above.plot(x.values[own], measured[own], "o", ms=4, color=data, label=curve or "measured")
        mark = "-" if len(own) < len(indices) else "+"  # between samples a run may swing
        above.plot(x.values[indices], predicted[indices], mark, color=fit, label=label)
        below.plot(x.values[own], numbers[2][own], "o", ms=3, color=fit)
    source = f" ({Path(points[0].source).name})" if "time" in points[0].values else ""
    above.set_title(f"{name.replace('_', ' ')} [{unit}]{source}")
    if len(curves) > 1:
        above.legend(title="points measured, lines fit", loc="upper left", bbox_to_anchor=(1, 1))
    elif not above.figure.legends:
        shown = above.get_legend_handles_labels()
        above.figure.legend(*shown, loc="outside upper right", ncols=2)
    below.set_xlabel(x.label)
    below.set_ylabel("(fit - measured)\n/ standard deviation")
