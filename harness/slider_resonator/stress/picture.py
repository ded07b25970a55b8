"""The matrix as a picture: a group for each axis, a row for each value, a column for each model."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LinearSegmentedColormap, Normalize
from matplotlib.figure import Figure
from matplotlib.patches import Patch, Rectangle

from slider_resonator.output.plot_style import save, style
from slider_resonator.stress.case import MODELS
from slider_resonator.stress.run import Matrix
from slider_resonator.stress.verdict import FAILED, PASSED, REFUSED, CellVerdict

FAR, NEAR = -8.0, 0.0
"""Decimal logarithm of a deviation over its bound, at the ends of the scale."""
SHADES = LinearSegmentedColormap.from_list("margin", ["#e3efe6", "#9cc6b1", "#2f7f79"])
REFUSED_COLOUR, FAILED_COLOUR = "#edc46b", "#c8553d"
BLOCKS = 4
HEADING = 1.7
"""Height of a group's heading, in rows."""
GAP = 0.35
"""Between the columns of the two friction laws."""
LABEL = 11.5
"""Width kept for the names of values, in columns."""

Groups = dict[str, list[CellVerdict]]


def draw_matrix(matrix: Matrix, path: Path) -> None:
    """Write the picture; the suffix of `path` chooses the format."""
    blocks = _blocks(matrix.by_axis())
    rows = max(sum(_height(group) for group in block.values()) for block in blocks)
    with style():
        figure = Figure(figsize=(16.0, 1.9 + 0.152 * rows), layout="constrained")
        figure.suptitle(
            f"{Path(matrix.fmu).name}: {matrix.count(PASSED)} of {len(matrix.verdicts)} cells "
            "passed, shaded by their largest deviation over its bound",
            fontsize=12,
        )
        panels = figure.subplots(1, BLOCKS)
        for block, axes in zip(blocks, panels, strict=True):
            _draw_block(axes, block, rows)
        _explain(figure, matrix)
        save(figure, path)


def margin(verdict: CellVerdict) -> float:
    """Return the largest deviation over its bound, as a decimal logarithm within the scale.

    What a step costs is no deviation and does not count.
    """
    found = max((c.found for c in verdict.checks if c.is_deviation), default=0.0)
    return min(max(math.log10(found), FAR), NEAR) if found > 0.0 else FAR


def cell_colour(verdict: CellVerdict) -> tuple[float, float, float, float] | str:
    """Return the colour of a cell: shaded by its margin where it passed."""
    if verdict.verdict == PASSED:
        return SHADES((margin(verdict) - FAR) / (NEAR - FAR))
    return {REFUSED: REFUSED_COLOUR, FAILED: FAILED_COLOUR}[verdict.verdict]


def _height(group: Sequence[CellVerdict]) -> float:
    return HEADING + len({one.value for one in group})


def _blocks(groups: Groups) -> list[Groups]:
    """Distribute the groups in their order over blocks of about equal height."""
    total = sum(_height(group) for group in groups.values())
    blocks: list[Groups] = [{} for _ in range(BLOCKS)]
    passed = 0.0
    for axis, group in groups.items():
        middle = passed + 0.5 * _height(group)
        blocks[min(int(middle / total * BLOCKS), BLOCKS - 1)][axis] = group
        passed += _height(group)
    return blocks


def _columns() -> Iterator[tuple[str, float]]:
    """Each model and its place."""
    for index, model in enumerate(MODELS):
        yield model.name, index + GAP * model.friction_law


def _draw_block(axes: Axes, block: Groups, rows: float) -> None:
    places = dict(_columns())
    top = 0.0
    for axis, group in block.items():
        heading = {**_small("right", "0.1"), "fontsize": 9.5, "weight": "bold"}
        axes.text(-0.3, top + 0.6 * HEADING, axis, **heading)
        for model in MODELS:
            place = places[model.name] + 0.5
            text = f"{model.fidelity}{'*' if model.second_order else ''}"
            axes.text(place, top + 1.25, text, **_small("center", "0.45"))
        for law, name in ((0, "Coulomb"), (1, "LuGre")):
            place = (0.5 + law) * (len(MODELS) / 2) + GAP * law
            axes.text(place, top + 0.55, name, **_small("center", "0.45"))
        top += HEADING
        values = list(dict.fromkeys(one.value for one in group))
        for row, value in enumerate(values):
            axes.text(-0.3, top + row + 0.5, value, **_small("right", "0.2"))
        for one in group:
            corner = places[one.model] + 0.04, top + values.index(one.value) + 0.06
            axes.add_patch(Rectangle(corner, 0.92, 0.88, color=cell_colour(one), linewidth=0.0))
        top += len(values)
    axes.set_xlim(-LABEL, len(MODELS) + GAP)
    axes.set_ylim(rows, 0.0)
    axes.set_axis_off()


def _small(align: str, colour: str) -> dict[str, Any]:
    return {"fontsize": 7.5, "ha": align, "va": "center", "color": colour}


def _explain(figure: Figure, matrix: Matrix) -> None:
    scale = ScalarMappable(Normalize(FAR, NEAR), SHADES)
    bar = figure.colorbar(
        scale,
        ax=figure.axes,
        orientation="horizontal",
        location="bottom",
        shrink=0.3,
        aspect=45,
        pad=0.012,
        ticks=[FAR, -6, -4, -2, NEAR],
    )
    bar.ax.set_xticklabels(["below 1e-8", "1e-6", "1e-4", "1e-2", "at its bound"], fontsize=8)
    bar.outline.set_visible(False)
    handles = [
        Patch(color=REFUSED_COLOUR, label=f"{REFUSED}: {matrix.count(REFUSED)}"),
        Patch(color=FAILED_COLOUR, label=f"{FAILED}: {matrix.count(FAILED)}"),
    ]
    figure.legend(handles=handles, loc="lower right", ncols=2)
    words = (
        "columns: friction law and fidelity, the number of resolved degrees of freedom; "
        "0*: averages of second order"
    )
    figure.text(0.01, 0.008, words, fontsize=8.5, color="0.35")
