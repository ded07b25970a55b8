"""Work-precision plots for pages: error over CPU time, with a description of each point."""

from __future__ import annotations

from math import isfinite

from slider_resonator.output.hover_plot import Axis, HoverPlot, Series, look
from slider_resonator.trade.result import (
    Row,
    Trade,
    cost_label,
    curve,
    drawn_error,
    families,
    front,
)
from slider_resonator.trade.solution import QUANTITIES
from slider_resonator.trade.summary import duration


def work_precision_plot(trade: Trade, quantity: str) -> HoverPlot:
    """Return the plot of a quantity: a series for each family, and the Pareto front of all."""
    drawn = [row for row in trade.having(quantity) if isfinite(row.errors[quantity])]
    best = front(drawn, quantity)
    series = [_series("Pareto front of all", best, quantity, "#cfd8dc", "", 6.0)]
    for index, family in enumerate(families(trade.rows)):
        own = [row for row in drawn if row.family == family]
        if own:
            colour, marker, dash = look(index)
            joined = curve(own, quantity)
            others = [row for row in own if row not in joined]
            series.append(_series(family, joined, quantity, colour, marker, 1.3, dash))
            if others:
                label = f"{family}: not on its front"
                series.append(_series(label, others, quantity, colour, marker))
    return HoverPlot(
        f"{quantity.replace('_', ' ')}: error over cost",
        Axis(cost_label(drawn), log=True),
        Axis(f"error: {QUANTITIES[quantity]}", log=True),
        series,
        height=460,
    )


def _series(
    label: str,
    rows: list[Row],
    quantity: str,
    colour: str,
    marker: str,
    width: float = 0.0,
    dash: tuple[int, ...] = (),
) -> Series:
    return Series(
        label=label,
        x=[row.cost for row in rows],
        y=[drawn_error(row, quantity) for row in rows],
        colour=colour,
        marker=marker,
        width=width,
        dash=dash,
        notes=[_note(row) for row in rows],
    )


def _note(row: Row) -> str:
    lines = [
        row.method,
        f"CPU time {duration(row.cost)} ({duration(min(row.cpu))} to {duration(max(row.cpu))})",
    ]
    if row.step is not None:
        lines.append(f"step {row.step:g} drive periods")
    if row.tolerance is not None:
        lines.append(f"tolerance {row.tolerance:g}")
    lines.append(f"{row.periods} drive periods")
    counts = {"steps": row.steps, "evaluations": row.evaluations, "events": row.events}
    lines += [f"{count} {name}" for name, count in counts.items() if count is not None]
    return "\n".join(lines)
