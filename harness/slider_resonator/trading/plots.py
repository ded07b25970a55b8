"""The picture of the README: error over CPU time by family, with the Pareto front of all."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from slider_resonator.output.hover_plot import look
from slider_resonator.output.plot_style import save, style
from slider_resonator.trading.result import Row, Trade, cost_label, drawn_error, families, front

PANELS = ("position", "mean_velocity")
"""The quantities in the picture."""
MARKERS = "os^dDvPX*<>ph8|H"


def draw_picture(trade: Trade, path: Path) -> None:
    """Write errors of position and mean velocity over cost, side by side."""
    looks = _looks(trade)
    with style():
        figure = Figure(figsize=(8.0, 5.4), layout="constrained")
        for quantity, axes in zip(PANELS, figure.subplots(1, len(PANELS)), strict=True):
            _draw(axes, trade.candidates(quantity), quantity, looks)
            axes.set_title(f"error of the {quantity.replace('_', ' ')}")
        figure.axes[0].set_ylabel("share of the peak")
        handles, labels = figure.axes[0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside lower center", ncols=3, fontsize=8.5)
    save(figure, path)


def _draw(
    axes: Axes, rows: Sequence[Row], quantity: str, looks: Mapping[str, Mapping[str, Any]]
) -> None:
    drawn = [row for row in rows if row.errors[quantity] < float("inf")]
    if not drawn:
        axes.text(0.5, 0.5, "no method has any", ha="center", transform=axes.transAxes)
        return
    axes.step(
        *_points(front(drawn, quantity), quantity),
        where="post",
        color="0.8",
        linewidth=6.0,
        solid_capstyle="round",
        zorder=1,
        label="Pareto front of all",
    )
    for family in families(drawn):
        own = [row for row in drawn if row.family == family]
        axes.plot(*_points(front(own, quantity), quantity), color=looks[family]["color"], zorder=2)
        spread = [(row.cost - min(row.cpu), max(row.cpu) - row.cost) for row in own]
        axes.errorbar(
            *_points(own, quantity),
            xerr=list(zip(*spread, strict=True)),
            **looks[family],
            linestyle="none",
            markersize=5.5,
            markeredgecolor="white",
            markeredgewidth=0.5,
            elinewidth=0.8,
            label=family,
            zorder=3,
        )
    axes.margins(y=0.14)
    axes.set(xscale="log", yscale="log", xlabel=cost_label(drawn))


def _points(rows: Sequence[Row], quantity: str) -> tuple[list[float], list[float]]:
    """Return costs and errors."""
    return [row.cost for row in rows], [drawn_error(row, quantity) for row in rows]


def _looks(trade: Trade) -> dict[str, dict[str, Any]]:
    """Return colour and marker of each family, the same in all plots of a trade."""
    return {
        family: {"color": look(index)[0], "marker": MARKERS[index % len(MARKERS)]}
        for index, family in enumerate(families(trade.rows))
    }
