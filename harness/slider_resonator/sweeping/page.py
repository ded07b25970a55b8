"""A sweep as a page of HTML: every measure over what was varied, each point to be hovered."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib.colors import to_hex
from numpy.typing import NDArray

from slider_resonator.arrays import Array
from slider_resonator.device.interface import SETTABLE
from slider_resonator.errors import HarnessError
from slider_resonator.fmu.provenance import Provenance
from slider_resonator.fmu.provenance_text import provenance_html
from slider_resonator.output.hover_plot import (
    Axis,
    HoverPlot,
    Series,
    look,
    plot_html,
    write_plot_page,
)
from slider_resonator.output.html_page import escaped, rendered
from slider_resonator.output.plot_units import Drawn, drawn
from slider_resonator.output.readable import number_of
from slider_resonator.output.table import Row, Table, numbers, texts
from slider_resonator.sweeping.grid import Sweep
from slider_resonator.sweeping.picture import (
    NO_ANSWER,
    check_picture,
    drawn_measure,
    drawn_variables,
    scale_of,
    split_into_lines,
)
from slider_resonator.sweeping.table import Columns

MAX_POINTS = 20_000
"""Points of a page, some 200 bytes each for every measure."""
GREY = "#78909c"


def check_page(sweep: Sweep, option: str) -> None:
    """Raise HarnessError, which begins with the option, for a sweep that has no page."""
    check_picture(sweep, option)
    if len(sweep.points) > MAX_POINTS:
        raise HarnessError(f"{option}: {len(sweep.points)} points; must be at most {MAX_POINTS}")


def write_sweep_page(path: Path, sweep: Sweep, columns: Columns, provenance: Provenance) -> None:
    """Write the page of a sweep over one or two variables."""
    failed = sum(error is not None for error in columns["error"])
    counts = f"<p>{number_of(len(sweep.points), 'point')}, {failed} of them failed.</p>"
    variables = drawn_variables(sweep, columns)
    parts = [counts, rendered(_setup(sweep, variables))]
    for measure in sweep.task.measures:
        parts += _measure(sweep, variables, columns, measure)
    parts.append(provenance_html(provenance))
    write_plot_page(path, sweep.title or "Sweep", parts)


def _setup(sweep: Sweep, variables: Mapping[str, Drawn]) -> Table:
    rows: list[Row] = []
    for name, one in variables.items():
        spacing = ", logarithmic" if name in sweep.logarithmic else ""
        count = len(np.unique(one.values))
        span = (f"{one.values.min():g}", f"{one.values.max():g}")
        rows.append((one.label, *span, f"{count}{spacing}"))
    for name, value in sweep.task.fixed:
        one = drawn(name, SETTABLE[name], np.array([value]))
        rows.append((one.label, f"{one.values[0]:g}", f"{one.values[0]:g}", "fixed"))
    return Table((*texts("variable"), *numbers("from", "to", "values")), rows)


def _measure(
    sweep: Sweep, variables: Mapping[str, Drawn], columns: Columns, measure: str
) -> list[str]:
    answers = drawn_measure(columns, measure)
    notes = [_note(columns, measure, answers, point) for point in range(len(answers.values))]
    axes = {n: Axis(one.label, log=n in sweep.logarithmic) for n, one in variables.items()}
    lines = split_into_lines(sweep, variables)
    if lines is None:
        x, y = (one.values for one in variables.values())
        colours, scale = _coloured(answers)
        series = _points(x, y, answers, notes, colours, cells=sweep.is_grid)
        across, up = axes.values()
        return [plot_html(HoverPlot(answers.words, across, up, series)), scale]
    abscissa, groups = lines
    x = variables[abscissa].values
    series = [
        one
        for index, (name, chosen) in enumerate(groups)
        for one in _line(index, name or answers.words, x, answers.values, chosen, notes)
    ]
    return [plot_html(HoverPlot(answers.words, axes[abscissa], Axis(answers.label), series))]


def _points(
    x: Array, y: Array, answers: Drawn, notes: list[str], colours: list[str], *, cells: bool
) -> list[Series]:
    """Return the series of points with and without an answer; `colours` are those of the former."""
    found = np.flatnonzero(np.isfinite(answers.values)).tolist()
    missing = np.flatnonzero(np.isnan(answers.values)).tolist()
    series = []
    if found:
        colour = colours[len(found) // 2]
        answered = Series(
            *(answers.words, x[found].tolist(), y[found].tolist(), colour, "●"),
            notes=[notes[i] for i in found],
            colours=colours,
            cells=cells,
        )
        series.append(answered)
    if missing:
        none = Series(
            *(NO_ANSWER, x[missing].tolist(), y[missing].tolist(), GREY, "✖"),
            notes=[notes[i] for i in missing],
        )
        series.append(none)
    return series


def _line(
    index: int, label: str, x: Array, result: Array, chosen: NDArray[np.intp], notes: Sequence[str]
) -> list[Series]:
    """Return the series of one line, and one of its points without an answer, if any."""
    colour, marker, dash = look(index)
    points = chosen[np.argsort(x[chosen], kind="stable")]
    found = [i for i in points if not np.isnan(result[i])]
    missing = [i for i in points if np.isnan(result[i])]
    line = Series(
        *(label, x[found].tolist(), result[found].tolist(), colour, marker, 1.4, dash),
        notes=[notes[i] for i in found],
    )
    none = Series(
        *(f"{label}: {NO_ANSWER}", x[missing].tolist(), [None] * len(missing), colour, "✖"),
        notes=[notes[i] for i in missing],
    )
    return [line, none] if missing else [line]


def _coloured(answers: Drawn) -> tuple[list[str], str]:
    """Return the colours of the answers, and their scale as HTML; symmetric about 0 if signed."""
    found = answers.values[np.isfinite(answers.values)]
    if not found.size:
        return [], ""
    norm, name = scale_of(found)
    colours = mpl.colormaps[name]
    shades = ",".join(to_hex(colours(share)) for share in np.linspace(0.0, 1.0, 9))
    scale = (
        f'<div class="scale"><span>{norm.vmin:.4g}</span>'
        f'<i style="background:linear-gradient(to right,{shades})"></i>'
        f"<span>{norm.vmax:.4g}</span><span>{escaped(answers.label)}</span></div>"
    )
    return [to_hex(one) for one in colours(norm(found))], scale


def _note(columns: Columns, measure: str, answers: Drawn, point: int) -> str:
    value, error = answers.values[point], columns["error"][point]
    lines = [NO_ANSWER if np.isnan(value) else f"{answers.label}: {value:.8g}"]
    status = columns.get(f"{measure}_status")
    if status is not None and status[point] is not None:
        lines.append(str(status[point]))
    return "\n".join([*lines, *([str(error)] if error else [])])
