"""A sweep as a page of HTML: every measure over what was varied, each point to be hovered."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.colors import to_hex
from numpy.typing import NDArray

from slider_resonator.arrays import Array
from slider_resonator.device.interface import SETTABLE
from slider_resonator.errors import HarnessError
from slider_resonator.fmu.provenance import Provenance, provenance_html
from slider_resonator.output.hover_plot import (
    Axis,
    HoverPlot,
    Series,
    look,
    plot_html,
    write_plot_page,
)
from slider_resonator.output.html_page import escaped, rendered
from slider_resonator.output.plot_style import Drawn, drawn
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
    y, words = answers.values, answers.words
    notes = [_note(columns, measure, answers, point) for point in range(len(y))]
    axes = {n: Axis(one.label, log=n in sweep.logarithmic) for n, one in variables.items()}
    lines = split_into_lines(sweep, variables)
    abscissa, groups = lines or (next(iter(variables)), [])
    x = variables[abscissa].values

    def series(label: str, chosen: NDArray[np.intp], up: Array | None, **looks: Any) -> Series:
        """Return a series of some points, those without an answer at no height."""
        heights = [None] * len(chosen) if up is None else up[chosen].tolist()
        own = [notes[point] for point in chosen]
        return Series(label, x[chosen].tolist(), heights, notes=own, **looks)

    all_series: list[Series] = []
    for index, (name, chosen) in enumerate(groups):
        label, (colour, marker, dash) = name or words, look(index)
        points = chosen[np.argsort(x[chosen], kind="stable")]
        none = np.isnan(y[points])
        looks = {"colour": colour, "marker": marker, "width": 1.4, "dash": dash}
        all_series.append(series(label, points[~none], y, **looks))
        if none.any():
            missed = f"{label}: {NO_ANSWER}"
            all_series.append(series(missed, points[none], None, colour=colour, marker="✖"))
    if lines is not None:
        plot = HoverPlot(words, axes[abscissa], Axis(answers.label), all_series)
        return [plot_html(plot)]
    (across, up_axis), (_, up) = axes.values(), variables.values()
    found, missing = np.flatnonzero(np.isfinite(y)), np.flatnonzero(np.isnan(y))
    colours, scale = _coloured(answers)
    if found.size:
        looks = {"colour": colours[len(found) // 2], "marker": "●", "colours": colours}
        all_series.append(series(words, found, up.values, cells=sweep.is_grid, **looks))
    if missing.size:
        all_series.append(series(NO_ANSWER, missing, up.values, colour=GREY, marker="✖"))
    return [plot_html(HoverPlot(words, across, up_axis, all_series)), scale]


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
