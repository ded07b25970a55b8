"""The plots of pages as pictures: the same series, drawn by matplotlib."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_rgba_array
from matplotlib.ticker import MaxNLocator

from slider_resonator.output.hover_plot import MARKERS, HoverPlot, Series

SHAPES = dict(zip(MARKERS, "os^Dv*P<>os^DX", strict=True))
HOLLOW = "○□△◇"


def draw_plot(axes: Axes, plot: HoverPlot) -> None:
    """Draw a plot of a page but for its title; a point without y is marked on the x axis."""
    for series in plot.series:
        if series.cells:
            _fill_cells(axes, plot, series)
        elif series.colours:
            y = [y or 0.0 for y in series.y]
            # With an edge: the middle of a scale may be white.
            axes.scatter(series.x, y, 12, series.colours, edgecolors="0.5", linewidths=0.4)
        else:
            _draw_line(axes, series)
    axes.set(xlabel=plot.x.label, ylabel=plot.y.label)
    axes.set(xscale="log" if plot.x.log else "linear", yscale="log" if plot.y.log else "linear")
    for axis, described in ((axes.xaxis, plot.x), (axes.yaxis, plot.y)):
        if described.label.endswith("[deg]") and not described.log:
            axis.set_major_locator(MaxNLocator("auto", steps=(1, 2, 3, 4.5, 9, 10)))


def _fill_cells(axes: Axes, plot: HoverPlot, series: Series) -> None:
    """Fill the cells of a grid, which all series of the plot make up."""
    x = np.unique(np.concatenate([one.x for one in plot.series]))
    y = np.unique(np.concatenate([np.array(one.y, np.float64) for one in plot.series]))
    place = np.searchsorted(y, np.array(series.y, np.float64)), np.searchsorted(x, series.x)
    cells = np.zeros((len(y), len(x), 4))
    cells[place] = to_rgba_array(list(series.colours))
    axes.pcolormesh(x, y, cells, shading="nearest", rasterized=True)
    axes.grid(False)


def _draw_line(axes: Axes, series: Series) -> None:
    on_axis = None in series.y
    axes.plot(
        series.x,
        [0.0 if y is None else y for y in series.y],
        color=series.colour,
        linewidth=series.width,
        linestyle=(0, tuple(series.dash)) if series.dash and series.width else "-",
        marker=SHAPES.get(series.marker, "") if len(series.x) <= 200 else "",
        markersize=5.5,
        markerfacecolor="white" if series.marker in HOLLOW else series.colour,
        markeredgewidth=0.5,
        markeredgecolor=series.colour if series.marker in HOLLOW else "white",
        label=series.label,
        transform=axes.get_xaxis_transform() if on_axis else axes.transData,
        clip_on=not on_axis,
    )
