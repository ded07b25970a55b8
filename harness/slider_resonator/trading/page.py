"""The HTML page: ratios, work-precision plots, all rows and omissions; and the README's picture."""

from collections.abc import Sequence
from functools import partial
from math import inf, isfinite
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from slider_resonator.fmu.provenance import Provenance, provenance_html
from slider_resonator.output.hover_plot import Axis, HoverPlot, Series, look, plot_html
from slider_resonator.output.html_page import escaped, folded, rendered, write_page
from slider_resonator.output.plot_picture import draw_plot
from slider_resonator.output.plot_style import save, style
from slider_resonator.output.table import Table, numbers, texts
from slider_resonator.steady.searches import SEARCHES
from slider_resonator.trading.result import QUANTITIES, Row, Trade, comparisons, duration, front

FRONT = "Pareto front of all"
FLOOR = 1e-16
"""Errors below this, the resolution of double precision, are drawn at it."""


def work_precision_plot(rows: Sequence[Row], quantity: str) -> HoverPlot:
    """Return the plot of a quantity: a series for each family, and the Pareto front of all."""
    drawn = [row for row in rows if isfinite(row.errors.get(quantity, inf))]

    def series(label: str, rows: list[Row], **looks: Any) -> Series:
        costs = [row.cost for row in rows]
        errors = [max(row.errors[quantity], FLOOR) for row in rows]
        return Series(label, costs, errors, notes=[_note(row) for row in rows], **looks)

    all_series = []
    if drawn:
        all_series.append(series(FRONT, front(drawn, quantity), colour="#cfd8dc", width=6.0))
    for index, family in enumerate(dict.fromkeys(row.family for row in rows)):
        own = [row for row in drawn if row.family == family]
        if own:
            colour, marker, dash = look(index)
            joined, point = front(own, quantity), partial(series, colour=colour, marker=marker)
            all_series.append(point(family, joined, width=1.3, dash=dash))
            if others := [row for row in own if row not in joined]:
                all_series.append(point(f"{family}: not on its front", others))
    per = "answer" if quantity in SEARCHES else "simulated second"
    return HoverPlot(
        f"{quantity.replace('_', ' ')}: error over cost",
        Axis(f"CPU time per {per} [s]", log=True),
        Axis(f"error: {QUANTITIES[quantity]}", log=True),
        all_series,
        height=460,
    )


def _note(row: Row) -> str:
    pairs = zip(_COLUMNS, _cells(row), strict=True)
    return "\n".join(f"{column.heading}: {cell}" for column, cell in pairs if cell)


_COLUMNS = (
    *texts("method"),
    *numbers("periods", "CPU time", "range", "steps", "evaluations", "events"),
    *numbers(*QUANTITIES),
)


EXPLANATION = (
    "<p>Errors are largest deviations from the reference, Taylor integration with located events, "
    "over all points of windows of a drive period that end with the run, half of it, a quarter and "
    "so on; those of steady velocity and blocking force are from shooting by the reference. Times "
    "are CPU times, medians of repeats taken in turn, of following the motion: not of the start of "
    "an FMU, nor of the first drive period, which located Taylor steps take for heyoka in one "
    "call, since it cannot start at rest. A method that would exceed its budget is followed over "
    "fewer drive periods, as listed. Inputs that ramp do so for all methods; an FMU that takes no "
    "derivatives of inputs holds them over its steps. Steps are an FMU's communication steps or an "
    "integrator's own; events are those that were located, else reversals.</p>"
)


def write_trades(path: Path, trades: Sequence[Trade], provenance: Provenance) -> None:
    """Write the page; HarnessError when that is impossible."""
    parts = []
    for trade in trades:
        parts.append(f"<h2>{escaped(trade.heading)}</h2>")
        for target, sentences in comparisons(trade):
            items = "".join(f"<li>{escaped(words)}</li>" for words in sentences)
            parts.append(f"<p><strong>{escaped(target)}</strong></p><ul>{items}</ul>")
        run = f"{trade.periods} drive periods, {trade.simulated:.4g} s simulated."
        parts.append(f"<p>{escaped(run)}</p>")
        shown = [quantity for quantity in QUANTITIES if trade.having(quantity)]
        parts += [plot_html(work_precision_plot(trade.rows, quantity)) for quantity in shown]
        table = Table(_COLUMNS, [_cells(row) for row in trade.rows])
        parts.append(folded(f"All {len(trade.rows)} rows", rendered(table)))
        omitted = [(one.method, one.quantity, one.reason) for one in trade.omissions]
        missing = rendered(Table(texts("method", "quantity", "reason"), omitted))
        parts.append(folded(f"{len(omitted)} omissions: what is missing, and why", missing))
    write_page(path, "What accuracy costs", [*parts, EXPLANATION, provenance_html(provenance)])


def _cells(row: Row) -> list[str]:
    return [
        row.method if row.answer == "run" else f"{row.method}: {row.answer}",
        str(row.periods),
        duration(row.cost),
        f"{duration(min(row.cpu))} to {duration(max(row.cpu))}",
        *("" if n is None else str(n) for n in (row.steps, row.evaluations, row.events)),
        *(f"{row.errors[q]:.1e}" if q in row.errors else "" for q in QUANTITIES),
    ]


PANELS = ("position", "mean_velocity")
"""The quantities in the picture."""


def draw_picture(trade: Trade, path: Path) -> None:
    """Write errors of position and mean velocity over cost, side by side."""
    rows = [row for row in trade.rows if row.friction_law == trade.friction_law]
    entries: dict[str, Line2D] = {}
    with style():
        figure = Figure(figsize=(8.0, 5.4), layout="constrained")
        for quantity, axes in zip(PANELS, figure.subplots(1, len(PANELS)), strict=True):
            axes.set_title(f"error of the {quantity.replace('_', ' ')}")
            plot = work_precision_plot(rows, quantity)
            if not plot.series:
                axes.text(0.5, 0.5, "no method has any", ha="center", transform=axes.transAxes)
                continue
            draw_plot(axes, plot)
            lines = {one.label: line for one, line in zip(plot.series, axes.lines, strict=True)}
            lines[FRONT].set(drawstyle="steps-post", zorder=1)
            names = (FRONT, *(row.family for row in rows))
            entries |= {name: lines[name] for name in names if name in lines}
            for row in trade.candidates(quantity):  # the spread of the repeats
                if line := lines.get(row.family):
                    error, colour = max(row.errors[quantity], FLOOR), line.get_color()
                    axes.hlines(error, min(row.cpu), max(row.cpu), colour, linewidth=0.8)
            axes.margins(y=0.14)
            axes.set_ylabel("")
        figure.axes[0].set_ylabel("share of the peak")
        figure.legend(entries.values(), entries, loc="outside lower center", ncols=3, fontsize=8.5)
    save(figure, path)
