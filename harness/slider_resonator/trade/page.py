"""The HTML page: ratios, plots, all rows and the omissions."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from slider_resonator.fmu.provenance import Provenance
from slider_resonator.fmu.provenance_text import provenance_html
from slider_resonator.output.hover_plot import hover_scripts, hover_style, plot_html
from slider_resonator.output.html_page import escaped, folded, rendered, write_page
from slider_resonator.output.table import Table, numbers, texts
from slider_resonator.trade.hover import work_precision_plot
from slider_resonator.trade.needs import title
from slider_resonator.trade.result import Omission, Row, Trade
from slider_resonator.trade.solution import QUANTITIES
from slider_resonator.trade.summary import comparisons, duration

_COLUMNS = (
    *texts("method"),
    *numbers("periods", "CPU time", "range", "steps", "evaluations", "events"),
    *numbers(*QUANTITIES),
)


def write_trades(path: Path, trades: Sequence[Trade], provenance: Provenance) -> None:
    """Write the page; HarnessError when that is impossible."""
    parts = [part for trade in trades for part in _ratios(trade)]
    parts.append(_explanation())
    parts += [part for trade in trades for part in _scene(trade)]
    parts.append(provenance_html(provenance))
    write_page(path, "What accuracy costs", parts, hover_scripts(), hover_style())


def _ratios(trade: Trade) -> list[str]:
    parts = [f"<h2>{escaped(title(trade))}</h2>"]
    for target, sentences in comparisons(trade):
        items = "".join(f"<li>{escaped(words)}</li>" for words in sentences)
        parts.append(f"<p><strong>{escaped(target)}</strong></p><ul>{items}</ul>")
    return parts


def _explanation() -> str:
    return (
        "<p>Errors are largest deviations from the reference, Taylor integration with located "
        "events, over all points of windows of a drive period that end with the run, half of it, a "
        "quarter and so on; those of steady velocity and blocking force are from shooting by the "
        "reference. Times are CPU times, medians of repeats taken in turn, of following the "
        "motion: not of the start of an FMU, nor of the first drive period, which located Taylor "
        "steps take for heyoka in one call, since it cannot start at rest. A method that would "
        "exceed its budget is followed over fewer drive periods, as listed. Peers hold "
        "inputs that vary over the scene's own communication step (FMUs over theirs), and cost "
        "what they cost a user of Python: heyoka compiles its equations, scipy calls them "
        "in Python, and Moreau-Jean is a loop in Python. Steps are an FMU's communication steps "
        "or an integrator's own; events are those that were located, else reversals.</p>"
    )


def _scene(trade: Trade) -> list[str]:
    parts = [f"<h2>{escaped(title(trade))}: in full</h2>"]
    run = f"{trade.periods} drive periods, {trade.simulated:.4g} s simulated."
    if trade.uncertainty:
        run += (
            f" The reference holds inputs in fine steps, which leaves an uncertainty of "
            f"{trade.uncertainty:.0e} of the position: errors below it mean nothing."
        )
    parts.append(f"<p>{escaped(run)}</p>")
    for quantity in QUANTITIES:
        if trade.having(quantity):
            parts.append(plot_html(work_precision_plot(trade, quantity)))
    table = Table(_COLUMNS, [_cells(row) for row in trade.rows])
    parts.append(folded(f"All {len(trade.rows)} rows", rendered(table)))
    parts.append(_omissions(trade.omissions))
    return parts


def _cells(row: Row) -> list[str]:
    return [
        row.method if row.answer == "run" else f"{row.method}: {row.answer}",
        str(row.periods),
        duration(row.cost),
        f"{duration(min(row.cpu))} to {duration(max(row.cpu))}",
        *("" if n is None else str(n) for n in (row.steps, row.evaluations, row.events)),
        *(f"{row.errors[q]:.1e}" if q in row.errors else "" for q in QUANTITIES),
    ]


def _omissions(omissions: Sequence[Omission]) -> str:
    table = Table(
        texts("method", "quantity", "reason"), [(o.method, o.quantity, o.reason) for o in omissions]
    )
    return folded(f"{len(omissions)} omissions: what is missing, and why", rendered(table))
