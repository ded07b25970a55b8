"""A sweep as a page of HTML: every measure over what was varied, each point to be hovered."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import to_hex

from slider_resonator.device.interface import SETTABLE
from slider_resonator.errors import HarnessError
from slider_resonator.fmu.provenance import Provenance, provenance_html
from slider_resonator.output.hover_plot import plot_html, write_plot_page
from slider_resonator.output.html_page import escaped, rendered
from slider_resonator.output.plot_style import Drawn, drawn
from slider_resonator.output.readable import number_of
from slider_resonator.output.table import Row, Table, numbers, texts
from slider_resonator.sweeping.grid import Sweep
from slider_resonator.sweeping.picture import check_picture, drawn_variables, measure_plot
from slider_resonator.sweeping.table import Columns

MAX_POINTS = 20_000
"""Points of a page, some 200 bytes each for every measure."""


def check_page(sweep: Sweep, option: str) -> None:
    """Raise HarnessError, which begins with the option, for a sweep that has no page."""
    check_picture(sweep, option)
    if len(sweep.points) > MAX_POINTS:
        raise HarnessError(f"{option}: {len(sweep.points)} points; must be at most {MAX_POINTS}")


def write_sweep_page(path: Path, sweep: Sweep, columns: Columns, provenance: Provenance) -> None:
    """Write the page of a sweep over one or two variables."""
    failed = sum(error is not None for error in columns["error"])
    counts = f"<p>{number_of(len(sweep.points), 'point')}, {failed} of them failed.</p>"
    parts = [counts, rendered(_setup(sweep, drawn_variables(sweep, columns)))]
    for measure in sweep.task.measures:
        plot, scale = measure_plot(sweep, columns, measure)
        parts.append(plot_html(plot))
        parts += [_scale_html(scale, plot.title)] if scale else []
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


def _scale_html(scale: ScalarMappable, label: str) -> str:
    low, high = scale.get_clim()
    shades = ",".join(to_hex(shade) for shade in scale.cmap(np.linspace(0.0, 1.0, 9)))
    return (
        f'<div class="scale"><span>{low:.4g}</span>'
        f'<i style="background:linear-gradient(to right,{shades})"></i>'
        f"<span>{high:.4g}</span><span>{escaped(label)}</span></div>"
    )
