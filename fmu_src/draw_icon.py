"""Draw the icon of the FMUs: `python -m fmu_src.draw_icon` rewrites assets/model.png.

The result is committed: a build needs no matplotlib, and its bytes do not depend on the version.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import FancyArrowPatch, FancyBboxPatch, Rectangle

ICON = Path(__file__).parent / "assets" / "model.png"

_STEEL, _BODY, _MASS, _MOTION = "#37474f", "#dde7ee", "#e07b39", "#1f6fb2"


def draw(target: Path) -> None:
    """Write a 256 x 256 pixel picture: a slider on a surface, a spring and a mass inside it."""
    figure = Figure(figsize=(2.56, 2.56), dpi=100)
    FigureCanvasAgg(figure)
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set(xlim=(0, 10), ylim=(0, 10), aspect="equal")
    axes.axis("off")
    axes.plot([0.4, 9.6], [2.5, 2.5], color=_STEEL, linewidth=3, solid_capstyle="round")
    for x in np.arange(0.9, 9.8, 0.9):
        axes.plot([x, x - 0.6], [2.4, 1.7], color=_STEEL, linewidth=1.5)
    axes.add_patch(
        FancyBboxPatch(
            (1.5, 2.85),
            7.0,
            3.9,
            boxstyle="round,pad=0,rounding_size=0.45",
            facecolor=_BODY,
            edgecolor=_STEEL,
            linewidth=3,
        )
    )
    turns = np.linspace(0.0, 1.0, 13)
    axes.plot(
        np.concatenate(([1.7], 2.3 + 2.5 * turns, [5.4])),
        4.8 + 0.6 * np.concatenate(([0, 0], np.tile([1, -1], 6)[:11], [0, 0])),
        color=_STEEL,
        linewidth=2,
        solid_joinstyle="round",
    )
    axes.add_patch(
        Rectangle((5.4, 3.75), 2.0, 2.1, facecolor=_MASS, edgecolor=_STEEL, linewidth=2.5)
    )
    axes.add_patch(
        FancyArrowPatch(
            (3.3, 8.3),
            (7.1, 8.3),
            arrowstyle="-|>",
            mutation_scale=18,
            linewidth=3,
            color=_MOTION,
        )
    )
    figure.savefig(target, transparent=True, metadata={"Software": None})


if __name__ == "__main__":
    draw(ICON)
