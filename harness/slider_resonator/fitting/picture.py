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

MAX_CURVES = 8
"""Number of settings of a second variable up to which each has a colour."""


def fit_figure(points: Sequence[Point], numbers: Array) -> Figure:
    """Draw data and fit above, residuals below: points over what varies most, runs over time.

    `numbers` are measured and predicted values and residuals of the points, (3, n).
    """
    panels: dict[tuple[str, str], list[int]] = {}
    for index, point in enumerate(points):
        run = point.source if "time" in point.values else ""
        panels.setdefault((point.quantity, run), []).append(index)
    count = len(panels)
    with style():
        figure = Picture((3.6 + 3.2 * count, 5.5), layout="constrained")
        axes = figure.subplots(2, count, squeeze=False, sharex="col", height_ratios=[2.0, 1.0])
        for column, rows in zip(axes.T.tolist(), panels.values(), strict=True):
            _draw(column, [points[row] for row in rows], numbers[:, rows])
    return figure


def _draw(axes: Sequence[Axes], points: Sequence[Point], numbers: Array) -> None:
    """Draw `numbers` (3, n), in their order in `fit_figure`, of points of one quantity.

    Each of a few curves has a colour and a name.
    """
    above, below = axes
    name, is_run = points[0].quantity, "time" in points[0].values
    first, curves = abscissa_and_curves(points)
    if first:
        x = drawn(first, variable(first).unit, np.array([set_value(one, first) for one in points]))
    else:
        x = Drawn("number of the measurement", "1", np.arange(1.0, len(points) + 1.0))
    factor, unit = plot_unit(VARIABLES[name].unit, *numbers[:2])
    measured, predicted = factor * numbers[:2]
    has_names = 1 < len(curves) <= MAX_CURVES
    data, fit, labels = COLOURS["theory"], COLOURS["slow"], ("measured", "fit")
    below.axhline(0.0, color="0.6", lw=0.8)
    for number, (curve, rows) in enumerate(curves.items()):
        if has_names:
            data, fit, labels = f"C{number}", f"C{number}", (curve, "")
        above.plot(x.values[rows], measured[rows], "o", ms=4, color=data, label=labels[0])
        above.plot(x.values[rows], predicted[rows], "+", color=fit, label=labels[1])
        below.plot(x.values[rows], numbers[2][rows], "o", ms=3, color=fit)
        labels = ("", "")
    source = f" ({Path(points[0].source).name})" if is_run else ""
    above.set_title(f"{name.replace('_', ' ')} [{unit}]{source}")
    if has_names:
        above.legend(title="dots measured, crosses fit", loc="upper left", bbox_to_anchor=(1, 1))
    elif not above.figure.legends:
        shown = above.get_legend_handles_labels()
        above.figure.legend(*shown, loc="outside upper right", ncols=2)
    below.set_xlabel(x.label)
    below.set_ylabel("(fit - measured)\n/ standard deviation")
