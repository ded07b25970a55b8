"""The matrix as a picture: a row for each value, a column for each model."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from harness.extremes.cell import MODELS
from harness.extremes.run import Matrix
from harness.extremes.verdict import FAILED, PASSED, REFUSED
from harness.plot_style import save, style

COLOURS = {PASSED: "#a9cbb0", REFUSED: "#f2d58a", FAILED: "#c8553d"}
NO_CELL = "white"
BLOCKS = 3


def draw_matrix(matrix: Matrix, path: Path) -> None:
    """Write the picture; the suffix of `path` chooses the format."""
    rows = list(dict.fromkeys((one.axis, one.value) for one in matrix.verdicts))
    names = [model.name for model in MODELS]
    levels = np.zeros((len(rows), len(names)))
    for one in matrix.verdicts:
        place = rows.index((one.axis, one.value)), names.index(one.model)
        levels[place] = 1 + list(COLOURS).index(one.verdict)
    tall = -(-len(rows) // BLOCKS)
    with style():
        figure = Figure(figsize=(15.0, 1.8 + 0.21 * tall), layout="constrained")
        for block, axes in enumerate(np.atleast_1d(figure.subplots(1, BLOCKS))):
            part = rows[block * tall : (block + 1) * tall]
            if not part:
                axes.set_visible(False)
                continue
            axes.pcolormesh(
                levels[block * tall : (block + 1) * tall],
                cmap=ListedColormap([NO_CELL, *COLOURS.values()]),
                vmin=0,
                vmax=len(COLOURS),
                edgecolors="white",
                linewidth=1.0,
            )
            axes.set_ylim(tall, 0)
            axes.set_yticks(np.arange(len(part)) + 0.5, [f"{a}: {v}" for a, v in part], fontsize=7)
            ticks = [name.replace(", ", "\n") for name in names]
            axes.set_xticks(np.arange(len(names)) + 0.5, ticks, fontsize=6.5)
            axes.xaxis.tick_top()
            axes.tick_params(length=0)
            axes.grid(visible=False)
            for side in axes.spines.values():
                side.set_visible(False)
        handles = [
            Patch(color=colour, label=f"{verdict}: {matrix.count(verdict)}")
            for verdict, colour in COLOURS.items()
        ]
        figure.legend(handles=handles, loc="outside lower center", ncols=len(handles))
        save(figure, path)
