"""The picture of the README: error over CPU time by family, with the Pareto front of all."""

from pathlib import Path

from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from slider_resonator.output.plot_picture import draw_plot
from slider_resonator.output.plot_style import save, style
from slider_resonator.trading.page import FRONT, work_precision_plot
from slider_resonator.trading.result import Trade, drawn_error, families

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
            entries |= {name: lines[name] for name in (FRONT, *families(rows)) if name in lines}
            for row in trade.candidates(quantity):  # the spread of the repeats
                if line := lines.get(row.family):
                    spread = drawn_error(row, quantity), min(row.cpu), max(row.cpu)
                    axes.hlines(*spread, line.get_color(), linewidth=0.8)
            axes.margins(y=0.14)
            axes.set_ylabel("")
        figure.axes[0].set_ylabel("share of the peak")
        figure.legend(entries.values(), entries, loc="outside lower center", ncols=3, fontsize=8.5)
    save(figure, path)
