"""The axes as a picture: a row for each value, a column for each model."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LinearSegmentedColormap, Normalize, to_rgba
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from slider_resonator.output.plot_style import save, style
from slider_resonator.stress.case import MODELS, RANDOM, name_of
from slider_resonator.stress.run import StressResult
from slider_resonator.stress.verdict import FAILED, PASSED, REFUSED, Verdict

FAR, NEAR = -8.0, 0.0
"""Decimal logarithm of a deviation over its bound, at the ends of the scale."""
SHADES = LinearSegmentedColormap.from_list("margin", ["#e3efe6", "#9cc6b1", "#2f7f79"])
REFUSED_COLOUR, FAILED_COLOUR = "#edc46b", "#c8553d"
BLOCKS = 4
"""Columns of the page among which the rows are distributed."""


def draw_map(result: StressResult, path: Path) -> None:
    """Write the picture of all axes; the suffix of `path` chooses the format."""
    cases = [one for one in result.verdicts if one.axis != RANDOM]
    rows = list(dict.fromkeys((one.axis, one.value) for one in cases))
    columns = [name_of(model) for model in MODELS]
    colours = np.ones((len(rows), len(columns), 4))
    for one in cases:
        place = rows.index((one.axis, one.value)), columns.index(one.model)
        colours[place] = to_rgba(colour(one))
    heads = [f"{'LC'[m.friction_law == 0]}{m.fidelity}{'*' * m.leaps}" for m in MODELS]
    passed = sum(one.verdict == PASSED for one in cases)
    with style():
        figure = Figure(figsize=(16.0, 2.0 + 0.04 * len(rows)), layout="constrained")
        figure.suptitle(
            f"{Path(result.fmu).name}: {passed} of {len(cases)} cases passed, "
            "shaded by their largest deviation over its bound"
        )
        blocks = np.array_split(np.arange(len(rows)), BLOCKS)
        for axes, block in zip(figure.subplots(1, BLOCKS), blocks, strict=True):
            axes.set_visible(len(block) > 0)
            if len(block):
                axes.imshow(colours[block], aspect="auto")
                axes.set_yticks(
                    range(len(block)), [": ".join(rows[i]) for i in block], fontsize=7.5
                )
                axes.set_xticks(range(len(heads)), heads, fontsize=7.5)
                axes.tick_params(length=0, labeltop=True, labelbottom=False)
                # Lines of paper between the cells.
                axes.set_xticks(np.arange(0.5, len(heads)), minor=True)
                axes.set_yticks(np.arange(0.5, len(block)), minor=True)
                axes.grid(which="major", visible=False)
                axes.grid(which="minor", color="white", linewidth=1.5)
        _explain(figure, result)
        save(figure, path)


def margin(verdict: Verdict) -> float:
    """Return the largest deviation over its bound, as a decimal logarithm within the scale.

    What a step costs is no deviation and does not count.
    """
    found = verdict.nearest.found if verdict.nearest else 0.0
    return min(max(math.log10(found), FAR), NEAR) if found > 0.0 else FAR


def colour(verdict: Verdict) -> tuple[float, float, float, float] | str:
    """Return the colour of a case: shaded by its margin where it passed."""
    if verdict.verdict == PASSED:
        return SHADES((margin(verdict) - FAR) / (NEAR - FAR))
    return FAILED_COLOUR if verdict.verdict == FAILED else REFUSED_COLOUR


def _explain(figure: Figure, result: StressResult) -> None:
    bar = figure.colorbar(
        ScalarMappable(Normalize(FAR, NEAR), SHADES),
        ax=figure.axes,
        location="bottom",
        shrink=0.3,
        aspect=45,
        ticks=[FAR, -6, -4, -2, NEAR],
    )
    bar.ax.set_xticklabels(["below 1e-8", "1e-6", "1e-4", "1e-2", "at its bound"], fontsize=8)
    inks = {REFUSED: REFUSED_COLOUR, FAILED: FAILED_COLOUR}
    handles = [Patch(color=ink, label=f"{n}: {result.counts[n]}") for n, ink in inks.items()]
    figure.legend(handles=handles, loc="lower right", ncols=2)
    words = "columns: C Coulomb, L LuGre friction, with fidelity; * averages of second order"
    figure.text(0.01, 0.008, words, fontsize=8.5, color="0.35")
