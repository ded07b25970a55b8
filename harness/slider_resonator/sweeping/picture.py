"""Pictures of a sweep: lines over one variable, maps over two."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from numpy.typing import NDArray

from slider_resonator.arrays import Array
from slider_resonator.device.interface import SETTABLE
from slider_resonator.errors import HarnessError
from slider_resonator.output.plot_style import Picture, style
from slider_resonator.sweeping.grid import Sweep
from slider_resonator.sweeping.measures import unit
from slider_resonator.sweeping.table import Columns

NO_ANSWER = "no answer"
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
    names = sweep.task.names
    values = {name: np.array(columns[name], dtype=np.float64) for name in names}
    lines = split_into_lines(sweep, values)
    with style():
        count = len(sweep.task.measures)
        figure = Picture(figsize=(6.4, 3.9 * count), layout="constrained")
        if sweep.title:
            figure.suptitle(sweep.title)
        for index, measure in enumerate(sweep.task.measures):
            axes = figure.add_subplot(count, 1, index + 1)
            result = np.array(columns[measure], dtype=np.float64)  # None becomes NaN: a gap
            label = measure_label(measure)
            if lines is not None:
                abscissa, groups = lines
                for name, chosen in groups:
                    _line(axes, values[abscissa][chosen], result[chosen], name or None)
                axes.set(xlabel=variable_label(abscissa), ylabel=label)
                if len(groups) > 1:
                    axes.legend()
            elif sweep.is_grid:
                _map(axes, sweep, values, result, label)
            else:
                points = axes.scatter(values[names[0]], values[names[1]], c=result, s=12)
                _unanswered(axes, values[names[0]], values[names[1]], result)
                axes.set_ylabel(variable_label(names[1]))
                figure.colorbar(points, ax=axes, label=label)
            if not axes.get_xlabel():
                axes.set_xlabel(variable_label(names[0]))
            _scale(axes, sweep, lines[0] if lines else names[0], None if lines else names[1])
    return figure


def _map(axes: Axes, sweep: Sweep, values: Mapping[str, Array], result: Array, label: str) -> None:
    one, other = sweep.task.names
    x, column = np.unique(values[one], return_inverse=True)
    y, row = np.unique(values[other], return_inverse=True)
    image = np.full((len(y), len(x)), np.nan)
    image[row, column] = result
    norm, colours = scale_of(result)
    mesh = axes.pcolormesh(x, y, image, shading="nearest", rasterized=True, norm=norm, cmap=colours)
    _unanswered(axes, values[one], values[other], result)
    axes.grid(False)
    axes.set_ylabel(variable_label(other))
    axes.figure.colorbar(mesh, ax=axes, label=label)


def scale_of(result: Array) -> tuple[Normalize, str]:
    """Return scale and colours for answers (n,), some NaN: symmetric about 0 if of both signs."""
    answers = result[np.isfinite(result)]
    if not answers.size:
        return Normalize(), "viridis"
    low, high = float(answers.min()), float(answers.max())
    if low < 0.0 < high:
        return Normalize(-max(-low, high), max(-low, high)), "RdBu_r"
    return Normalize(low, high), "viridis"


def _scale(axes: Axes, sweep: Sweep, x: str, y: str | None) -> None:
    """Make the axes of variables with logarithmic spacing logarithmic."""
    if x in sweep.logarithmic:
        axes.set_xscale("log")
    if y in sweep.logarithmic:
        axes.set_yscale("log")


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


def _unanswered(axes: Axes, x: Array, y: Array, result: Array) -> None:
    """Mark the points without a result."""
    missing = np.isnan(result)
    if missing.any():
        axes.plot(x[missing], y[missing], "x", color="0.5", markersize=4, label=NO_ANSWER)
        axes.legend()


def _unit(name: str) -> str:
    """Return the unit of a parameter or input, 1 where it has none."""
    return SETTABLE[name]


def variable_label(name: str) -> str:
    """Return the label of an axis over a parameter or input, with its unit."""
    return f"{_name(name)} [{_unit(name)}]"


def measure_label(measure: str) -> str:
    """Return the label of an axis over a measure, with its unit."""
    return f"{_name(measure)} [{unit(measure)}]"


def split_into_lines(
    sweep: Sweep, values: Mapping[str, Array]
) -> tuple[str, list[tuple[str, NDArray[np.intp]]]] | None:
    """Return the variable along lines, and the label and the points of each line; None for a map.

    A grid over two variables has lines where one of them has few values.
    """
    names = sweep.task.names
    if len(names) == 1:
        return names[0], [("", np.arange(len(sweep.points)))]
    few = min(names, key=lambda name: len(np.unique(values[name])))
    if not sweep.is_grid or len(np.unique(values[few])) > MAX_LINES:
        return None
    (abscissa,) = (name for name in names if name != few)
    return abscissa, [
        (
            f"{_name(few)} {value:.4g} {_unit(few)}".removesuffix(" 1"),
            np.flatnonzero(values[few] == value),
        )
        for value in np.unique(values[few])
    ]


def _name(name: str) -> str:
    return name.replace("_", " ")
