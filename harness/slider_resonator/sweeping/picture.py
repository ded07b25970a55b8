"""Plots of a sweep, lines over one variable, maps over two: a picture and a page of HTML.

In the page each point says its values under the pointer.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize, to_hex
from matplotlib.figure import Figure
from numpy.typing import NDArray

from slider_resonator.arrays import Array
from slider_resonator.device.interface import SETTABLE, VARIABLES
from slider_resonator.errors import HarnessError
from slider_resonator.fmu.provenance import Provenance, provenance_html
from slider_resonator.output.hover_plot import Axis, HoverPlot, Series, look, plot_html
from slider_resonator.output.html_page import escaped, write_page
from slider_resonator.output.plot_picture import draw_plot
from slider_resonator.output.plot_style import Drawn, Picture, drawn, style
from slider_resonator.output.readable import number_of
from slider_resonator.sweeping.grid import Sweep
from slider_resonator.sweeping.measures import Columns, unit

NO_ANSWER = "no answer"
GREY = "#78909c"
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
    with style():
        count = len(sweep.task.measures)
        figure = Picture(figsize=(6.4, 3.9 * count), layout="constrained")
        if sweep.title:
            figure.suptitle(sweep.title)
        for index, measure in enumerate(sweep.task.measures):
            axes = figure.add_subplot(count, 1, index + 1)
            plot, scale = measure_plot(sweep, columns, measure)
            draw_plot(axes, plot)
            if scale is not None:
                figure.colorbar(scale, ax=axes, label=plot.title)
            if len(plot.series) > 1 or NO_ANSWER in plot.series[0].label:
                axes.legend()
    return figure


def measure_plot(
    sweep: Sweep, columns: Columns, measure: str
) -> tuple[HoverPlot, ScalarMappable | None]:
    """Return the plot of a measure over what was varied, and the scale of colours of a map."""
    answers = drawn(measure, unit(measure), np.array(columns[measure], dtype=np.float64))
    variables = {
        name: drawn(name, SETTABLE[name], np.array(columns[name], dtype=np.float64))
        for name in sweep.task.names
    }
    axes = {n: Axis(one.label, log=n in sweep.logarithmic) for n, one in variables.items()}
    notes = [_note(columns, measure, answers, point) for point in range(len(sweep.points))]
    none = np.isnan(answers.values)
    lines = _split_into_lines(sweep, variables)
    abscissa, groups = lines or (sweep.task.names[0], [])
    x = variables[abscissa].values

    def series(label: str, chosen: NDArray[np.intp], up: Array | None, **looks: Any) -> Series:
        """Return a series of some points, without `up` at no height."""
        heights = [None] * len(chosen) if up is None else up[chosen].tolist()
        own = [notes[point] for point in chosen]
        return Series(label, x[chosen].tolist(), heights, notes=own, **looks)

    all_series: list[Series] = []
    if lines is not None:
        for index, (name, chosen) in enumerate(groups):
            label, (colour, marker, dash) = name or answers.words, look(index)
            points = chosen[np.argsort(x[chosen], kind="stable")]
            looks = {"colour": colour, "marker": marker, "width": 1.4, "dash": dash}
            all_series.append(series(label, points[~none[points]], answers.values, **looks))
            if none[points].any():
                missed, cross = f"{label}: {NO_ANSWER}", {"colour": colour, "marker": "✖"}
                all_series.append(series(missed, points[none[points]], None, **cross))
        return HoverPlot(answers.words, axes[abscissa], Axis(answers.label), all_series), None
    (_, ordinate), found = sweep.task.names, np.flatnonzero(~none)
    up = variables[ordinate].values
    scale = None
    if found.size:
        scale = _scale_of(answers.values[found])
        colours = [to_hex(one) for one in scale.to_rgba(answers.values[found])]
        looks = {"colour": colours[len(found) // 2], "marker": "●", "colours": colours}
        all_series.append(series(answers.words, found, up, cells=sweep.is_grid, **looks))
    if none.any():
        missed, chosen = f"{answers.words}: {NO_ANSWER}", np.flatnonzero(none)
        all_series.append(series(missed, chosen, up, colour=GREY, marker="✖"))
    return HoverPlot(answers.label, axes[abscissa], axes[ordinate], all_series), scale


def _scale_of(answers: Array) -> ScalarMappable:
    """Return the scale of colours of answers (n,): symmetric about 0 if they have both signs."""
    low, high = float(answers.min()), float(answers.max())
    if low < 0.0 < high:
        return ScalarMappable(Normalize(-max(-low, high), max(-low, high)), "RdBu_r")
    return ScalarMappable(Normalize(low, high), "viridis")


def _note(columns: Columns, measure: str, answers: Drawn, point: int) -> str:
    value, error = answers.values[point], columns["error"][point]
    status = columns.get(f"{measure}_status", {point: None})[point]
    first = NO_ANSWER if np.isnan(value) else f"{answers.label}: {value:.8g}"
    return "\n".join([first, *(str(line) for line in (status, error) if line)])


def _split_into_lines(
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


def write_sweep_page(path: Path, sweep: Sweep, columns: Columns, provenance: Provenance) -> None:
    """Write the page of a sweep over one or two variables."""
    failed = sum(error is not None for error in columns["error"])
    fixed = [f"{name} {VARIABLES[name].shown(value)}" for name, value in sweep.task.fixed]
    counts = f"{number_of(len(sweep.points), 'point')}, {failed} of them failed"
    parts = [f"<p>{counts}. Fixed: {', '.join(fixed) or 'nothing'}.</p>"]
    for measure in sweep.task.measures:
        plot, scale = measure_plot(sweep, columns, measure)
        parts.append(plot_html(plot))
        parts += [_scale_html(scale, plot.title)] if scale else []
    parts.append(provenance_html(provenance))
    write_page(path, sweep.title or "Sweep", parts)


def _scale_html(scale: ScalarMappable, label: str) -> str:
    low, high = scale.get_clim()
    shades = ",".join(to_hex(shade) for shade in scale.cmap(np.linspace(0.0, 1.0, 9)))
    return (
        f'<div class="scale"><span>{low:.4g}</span>'
        f'<i style="background:linear-gradient(to right,{shades})"></i>'
        f"<span>{high:.4g}</span><span>{escaped(label)}</span></div>"
    )
