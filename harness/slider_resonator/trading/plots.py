"""The picture of the README: error over CPU time by family, with the Pareto front of all."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from slider_resonator.output.plot_style import save, style
from slider_resonator.trading.names_in_plot import Name, place_names
from slider_resonator.trading.result import (
    AVERAGED,
    PEER,
    Row,
    Trade,
    cost_label,
    curve,
    drawn_error,
    families,
    front,
)

PANELS = ("position", "mean_velocity")
"""The quantities in the picture."""
OURS = {"native": "#1f5f8b", "Python": "#6fa8d0"}
MARKERS = {(2, None): "o", (1, None): "s", (0, 1): "^", (0, 2): "d", (0, None): "^"}
"""Markers of our FMUs, by fidelity and averaging order."""
PEER_MARKERS = "DvPX*<>ph8|H"
PEER_COLOURS = (
    *("#ff7f0e", "#2ca02c", "#d62728", "#9467bd", "#8c564b", "#e377c2", "#7f7f7f", "#bcbd22"),
    *("#17becf", "#333333", "#b8860b", "#7a0177"),
)


@dataclass(frozen=True)
class _Look:
    colour: object
    marker: str
    weight: float


def draw_picture(trade: Trade, path: Path) -> None:
    """Write the picture of the README."""
    save(trade_figure(trade), path)


def trade_figure(trade: Trade) -> Figure:
    """Draw errors of position and mean velocity over cost, side by side."""
    looks = _looks(trade)
    with style():
        figure = Figure(figsize=(8.0, 5.4), layout="constrained")
        panels = dict(zip(PANELS, figure.subplots(1, len(PANELS)), strict=True))
        for quantity, axes in panels.items():
            _draw(axes, trade.candidates(quantity), quantity, looks)
            axes.set_title(f"error of the {quantity.replace('_', ' ')}")
        figure.axes[0].set_ylabel("share of the peak")
        handles, labels = figure.axes[0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside lower center", ncols=3, fontsize=8.5)
        figure.draw_without_rendering()
        figure.set_layout_engine("none")  # names are placed in the layout as it is
        for quantity, axes in panels.items():
            place_names(axes, _our_names(trade.candidates(quantity), quantity), fontsize=8.0)
    return figure


def _draw(axes: Axes, rows: Sequence[Row], quantity: str, looks: dict[str, _Look]) -> None:
    drawn = [row for row in rows if row.errors[quantity] < float("inf")]
    if not drawn:
        axes.text(0.5, 0.5, "no method has any", ha="center", transform=axes.transAxes)
        return
    best = front(drawn, quantity)
    axes.step(
        *_points(best, quantity),
        where="post",
        color="0.8",
        linewidth=6.0,
        solid_capstyle="round",
        zorder=1,
        label="Pareto front of all",
    )
    for family in families(drawn):
        own = [row for row in drawn if row.family == family]
        look = looks[family]
        points = _points(curve(own, quantity), quantity)
        axes.plot(*points, color=look.colour, linewidth=look.weight, zorder=2)
        spread = [(row.cost - min(row.cpu), max(row.cpu) - row.cost) for row in own]
        axes.errorbar(
            *_points(own, quantity),
            xerr=list(zip(*spread, strict=True)),
            linestyle="none",
            marker=look.marker,
            markersize=5.5,
            color=look.colour,
            markeredgecolor="white",
            markeredgewidth=0.5,
            elinewidth=0.8,
            label=family,
            zorder=3,
        )
    axes.margins(y=0.14)
    axes.set(xscale="log", yscale="log", xlabel=cost_label(drawn))


def _our_names(rows: Sequence[Row], quantity: str) -> list[Name]:
    """Return the names of our FMUs, which stand near their cheapest points."""
    names = []
    for family in families([row for row in rows if row.kind != PEER]):
        own = sorted((row for row in rows if row.family == family), key=lambda row: row.cost)
        points = [(row.cost, drawn_error(row, quantity)) for row in own]
        names.append(Name(family.replace(" FMU, fidelity ", " "), _our_colour(family), points))
    return names


def _points(rows: Sequence[Row], quantity: str) -> tuple[list[float], list[float]]:
    """Return costs and errors."""
    return [row.cost for row in rows], [drawn_error(row, quantity) for row in rows]


def _our_colour(family: str) -> str:
    return next((colour for build, colour in OURS.items() if family.startswith(build)), "black")


def _looks(trade: Trade) -> dict[str, _Look]:
    """Return colour and marker of each family, the same in all plots of a trade."""
    looks = {}
    peers = families([row for row in trade.rows if row.kind == PEER])
    for index, family in enumerate(peers):
        colour = PEER_COLOURS[index % len(PEER_COLOURS)]
        looks[family] = _Look(colour, PEER_MARKERS[index % len(PEER_MARKERS)], 1.0)
    for row in trade.rows:
        if row.kind != PEER:
            colour = _our_colour(row.family)
            other = "instead" in row.family or "output" in row.family
            marker = "X" if other else MARKERS[row.fidelity or 0, row.averaging_order]
            looks[row.family] = _Look(colour, marker, 0.8 if row.kind == AVERAGED else 2.0)
    return looks
