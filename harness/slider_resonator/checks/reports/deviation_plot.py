"""Plot a signal that deviates from its reference: the whole run and the first deviation."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from slider_resonator.checks.validate import Curves
from slider_resonator.output.plot_style import COLOURS, png_data_uri, style

NEAR = "around the first deviation"
ZOOM_POINTS = 64
"""Points shown on each side of the first one outside the tolerance."""


def deviation_png(curves: Curves) -> str:
    """Return a PNG as a data URI: FMU and reference over the run and near the first deviation.

    Few points, such as those of a baseline, are drawn in one panel and not joined: many periods
    may lie between them.
    """
    sparse = len(curves.times) <= ZOOM_POINTS
    first = curves.check.first_time
    index = 0 if first is None else int(np.searchsorted(curves.times, first))
    near = slice(max(0, index - ZOOM_POINTS), index + ZOOM_POINTS)
    parts = {"points of the run": slice(None)} if sparse else {"whole run": slice(None), NEAR: near}
    with style():
        figure = Figure(figsize=(9.0, 4.2), layout="constrained")
        axes = figure.subplots(2, len(parts), sharex="col", squeeze=False)
        for column, (title, part) in enumerate(parts.items()):
            _draw(axes[0][column], axes[1][column], curves, part, joined=not sparse)
            axes[0][column].set(title=title)
        unit = curves.check.unit or 1
        axes[0][0].set(ylabel=f"{curves.check.quantity} [{unit}]")
        axes[1][0].set(ylabel=f"FMU - reference [{unit}]")
        axes[0][0].legend()
        return png_data_uri(figure)


def _draw(above: Axes, below: Axes, curves: Curves, part: slice, *, joined: bool) -> None:
    times = curves.times[part]
    reference, fmu, difference = ("-", "--", "-") if joined else ("o", "+", "+")
    above.plot(times, curves.reference[part], reference, color=COLOURS["theory"], label="reference")
    above.plot(times, curves.fmu[part], fmu, color=COLOURS["velocity"], label="FMU")
    off = curves.fmu[part] - curves.reference[part]
    below.plot(times, off, difference, color=COLOURS["velocity"])
    below.set(xlabel="time [s]")
    if curves.check.first_time is not None:
        for axes in (above, below):
            axes.axvline(curves.check.first_time, color="0.4", linewidth=0.8)
