"""The page to look at: ratios, plots, all rows and what is missing, in one file of HTML."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from pathlib import Path

from slider_resonator.output.html_page import write_page
from slider_resonator.studies.trade.needs import title
from slider_resonator.studies.trade.plots import work_precision_png
from slider_resonator.studies.trade.result import Omission, Row, Trade
from slider_resonator.studies.trade.solution import QUANTITIES
from slider_resonator.studies.trade.summary import comparisons, duration

_HEAD = ("method", "periods", "CPU time", "least to most", "steps", "evaluations", "events")


def write_trades(path: Path, trades: Sequence[Trade]) -> None:
    """Write the page; HarnessError when that is impossible."""
    parts = [part for trade in trades for part in _ratios(trade)]
    parts.append(_explanation())
    parts += [part for trade in trades for part in _scene(trade)]
    write_page(path, "What accuracy costs", parts)


def _ratios(trade: Trade) -> list[str]:
    parts = [f"<h2>{escape(title(trade))}</h2>"]
    for target, sentences in comparisons(trade):
        items = "".join(f"<li>{escape(words)}</li>" for words in sentences)
        parts.append(f"<p><strong>{escape(target)}</strong></p><ul>{items}</ul>")
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
        "what they cost a user of Python: heyoka compiles its equations, scipy and CVODE call them "
        "in Python, and Moreau-Jean is a loop in Python. Steps are an FMU's communication steps "
        "or an integrator's own; events are those that were located, else reversals.</p>"
    )


def _scene(trade: Trade) -> list[str]:
    parts = [f"<h2>{escape(title(trade))}: in full</h2>"]
    run = f"{trade.periods} drive periods, {trade.simulated:.4g} s simulated."
    if trade.uncertainty:
        run += (
            f" The reference holds inputs that vary in fine steps, which leaves an uncertainty of "
            f"{trade.uncertainty:.0e} of the position: errors below it mean nothing."
        )
    parts.append(f"<p>{escape(run)}</p>")
    for quantity, meaning in QUANTITIES.items():
        if trade.having(quantity):
            source = work_precision_png(trade, quantity)
            parts.append(f"<h3>{escape(quantity)}</h3>")
            parts.append(f'<img alt="{escape(meaning)} over CPU time" src="{source}">')
    parts.append(_table(trade.rows))
    parts.append(_omissions(trade.omissions))
    return parts


def _table(rows: Sequence[Row]) -> str:
    head = "".join(f"<th>{escape(name)}</th>" for name in (*_HEAD, *QUANTITIES))
    body = "\n".join(_row(row) for row in rows)
    return (
        f'<details><summary>All {len(rows)} rows</summary><div class="wide"><table>'
        f"<thead><tr>{head}</tr></thead><tbody>\n{body}\n</tbody></table></div></details>"
    )


def _row(row: Row) -> str:
    numbers = [
        str(row.periods),
        duration(row.cost),
        f"{duration(min(row.cpu))} to {duration(max(row.cpu))}",
        *("" if n is None else str(n) for n in (row.steps, row.evaluations, row.events)),
        *(f"{row.errors[q]:.1e}" if q in row.errors else "" for q in QUANTITIES),
    ]
    what = row.method if row.answer == "run" else f"{row.method}: {row.answer}"
    cells = "".join(f'<td class="n">{escape(text)}</td>' for text in numbers)
    return f"<tr><td>{escape(what)}</td>{cells}</tr>"


def _omissions(omissions: Sequence[Omission]) -> str:
    body = "\n".join(
        f"<tr><td>{escape(o.method)}</td><td>{escape(o.quantity)}</td><td>{escape(o.reason)}</td>"
        "</tr>"
        for o in omissions
    )
    return (
        f"<details><summary>{len(omissions)} omissions: who or what is missing, and why</summary>"
        "<table><thead><tr><th>method</th><th>quantity</th><th>reason</th></tr></thead>"
        f"<tbody>\n{body}\n</tbody></table></details>"
    )
