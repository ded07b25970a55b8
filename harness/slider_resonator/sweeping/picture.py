"""Pictures of a sweep: lines over one variable, maps over two."""

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray

from slider_resonator.arrays import Array
from slider_resonator.device.interface import SETTABLE
from slider_resonator.errors import HarnessError
from slider_resonator.output.plot_style import Drawn, Picture, drawn, style
from slider_resonator.sweeping.grid import Sweep
from slider_resonator.sweeping.measures import unit
from slider_resonator.sweeping.table import Columns

NO_ANSWER = "no answer"
DEGREES = (1, 2, 3, 4.5, 9, 10)
"""Steps of ticks on an axis in degrees, up to a power of ten."""
MAX_LINES = 6
"""Values of a variable that are drawn as a line each; more of them make a map."""


def check_picture(sweep: Sweep, option: str) -> None:
    """Raise HarnessError, which begins with the option, for a sweep that has no picture."""
    if len(sweep.task.names) > 2:
        raise HarnessError(
            f"{option}: {len(sweep.task.names)} variables ({', '.join(sweep.task.names)}); "
            "must be one, drawn as lines, or two, drawn as lines or a map"
        )


def sweep_figure(sweep: Sweep, columns: Columns) -> Figure:
    """Draw every measure over what was varied."""
    variables = drawn_variables(sweep, columns)
    lines = split_into_lines(sweep, variables)
    with style():
        count = len(sweep.task.measures)
        figure = Picture(figsize=(6.4, 3.9 * count), layout="constrained")
        if sweep.title:
            figure.suptitle(sweep.title)
        names: Sequence[str]
        for index, measure in enumerate(sweep.task.measures):
            axes = figure.add_subplot(count, 1, index + 1)
            result = drawn_measure(columns, measure)
            if lines is not None:
                abscissa, groups = lines
                x = variables[abscissa]
                for name, chosen in groups:
                    _line(axes, x.values[chosen], result.values[chosen], name or None)
                axes.set(xlabel=x.label, ylabel=result.label)
                if len(groups) > 1:
                    axes.legend()
                names = (abscissa,)
            else:
                _map(axes, sweep, variables, result)
                names = list(variables)
            for name, set_scale in zip(names, (axes.set_xscale, axes.set_yscale), strict=False):
                set_scale("log" if name in sweep.logarithmic else "linear")
            for name, axis in zip(names, (axes.xaxis, axes.yaxis), strict=False):
                if SETTABLE[name] == "rad":
                    axis.set_major_locator(MaxNLocator("auto", steps=DEGREES))
    return figure


def _map(axes: Axes, sweep: Sweep, variables: Mapping[str, Drawn], result: Drawn) -> None:
    """Draw a measure over two variables: cells of a grid, or points."""
    across, up = variables.values()
    colours: ScalarMappable
    if sweep.is_grid:
        x, column = np.unique(across.values, return_inverse=True)
        y, row = np.unique(up.values, return_inverse=True)
        image = np.full((len(y), len(x)), np.nan)
        image[row, column] = result.values
        norm, name = scale_of(result.values)
        colours = axes.pcolormesh(
            x, y, image, shading="nearest", rasterized=True, norm=norm, cmap=name
        )
        axes.grid(False)
    else:
        colours = axes.scatter(across.values, up.values, c=result.values, s=12)
    missing = np.isnan(result.values)
    if missing.any():
        x, y = across.values[missing], up.values[missing]
        axes.plot(x, y, "x", color="0.5", markersize=4, label=NO_ANSWER)
        axes.legend()
    axes.set(xlabel=across.label, ylabel=up.label)
    axes.figure.colorbar(colours, ax=axes, label=result.label)


def scale_of(result: Array) -> tuple[Normalize, str]:
    """Return scale and colours for answers (n,), some NaN: symmetric about 0 if of both signs."""
    answers = result[np.isfinite(result)]
    if not answers.size:
        return Normalize(), "viridis"
    low, high = float(answers.min()), float(answers.max())
    if low < 0.0 < high:
        return Normalize(-max(-low, high), max(-low, high)), "RdBu_r"
    return Normalize(low, high), "viridis"


def _line(axes: Axes, x: Array, y: Array, label: str | None) -> None:
    order = np.argsort(x, kind="stable")
    marker = "." if len(x) <= 200 else ""
    (line,) = axes.plot(x[order], y[order], marker=marker, label=label)
    missing = x[np.isnan(y)]
    if missing.size:
        axes.plot(
            missing,
            np.zeros(missing.size),
            "x",
            color=line.get_color(),
            label=f"{label}: {NO_ANSWER}" if label else NO_ANSWER,
            transform=axes.get_xaxis_transform(),  # on the axis, whatever the results are
            clip_on=False,
        )
        axes.legend()


def drawn_variables(sweep: Sweep, columns: Columns) -> dict[str, Drawn]:
    """Return what was varied, by name, as it is drawn."""
    names = sweep.task.names
    return {n: drawn(n, SETTABLE[n], np.array(columns[n], dtype=np.float64)) for n in names}


def drawn_measure(columns: Columns, measure: str) -> Drawn:
    """Return a measure as it is drawn, NaN where there is no answer."""
    return drawn(measure, unit(measure), np.array(columns[measure], dtype=np.float64))


def split_into_lines(
    sweep: Sweep, variables: Mapping[str, Drawn]
) -> tuple[str, list[tuple[str, NDArray[np.intp]]]] | None:
    """Return the variable along lines, and the label and the points of each line; None for a map.

    A grid over two variables has lines where one of them has few values.
    """
    names = sweep.task.names
    if len(names) == 1:
        return names[0], [("", np.arange(len(sweep.points)))]
    found = {name: np.unique(variables[name].values) for name in names}
    few = min(names, key=lambda name: len(found[name]))
    if not sweep.is_grid or len(found[few]) > MAX_LINES:
        return None
    (abscissa,) = (name for name in names if name != few)
    line = variables[few]
    return abscissa, [
        (line.named(value), np.flatnonzero(line.values == value)) for value in found[few]
    ]
