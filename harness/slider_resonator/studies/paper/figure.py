"""What a figure of the report is, and how its panels look."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure as Drawing
from numpy.typing import NDArray

from slider_resonator.fmu.instance import Instance

Array = NDArray[np.float64]
Data = dict[str, Any]
"""What was measured, as JSON holds it."""
Progress = Callable[[float], None]
"""Is told which share of a measurement is done."""

SHADES = ("#c8553d", "#1f5f8b", "#6a994e", "#8a6fae", "#b8860b")
"""Colours of cases within a panel; a line and the markers of a case share one."""


@dataclass(frozen=True)
class PaperFigure:
    """A figure: what is measured on the FMU with which parameters, and how it is drawn."""

    name: str
    title: str
    caption: str
    parameters: Mapping[str, Any]
    measure: Callable[[Instance, Progress], Data]
    draw: Callable[[Data], Drawing]


def panels(count: int, height: float = 3.4) -> tuple[Drawing, list[Axes]]:
    """Return a figure with panels (a), (b), ... in rows of two, or of three where there are 3."""
    columns = count if count <= 3 else 2
    rows = -(-count // columns)
    width = 3.9 * columns if columns > 1 else 6.2
    drawing = Drawing(figsize=(width, height * rows), layout="constrained")
    axes: list[Axes] = list(np.atleast_1d(drawing.subplots(rows, columns)).ravel())
    if count > 1:
        for letter, axis in zip("abcdef", axes, strict=False):
            axis.set_title(f"({letter})", loc="left")
    return drawing, axes


def markers(
    axes: Axes,
    x: Sequence[float] | Array,
    y: Sequence[float | None] | Array,
    shade: str,
    label: str,
) -> None:
    """Draw what the FMU gave; None, where it has no steady motion, is left out."""
    axes.plot(
        x,
        np.array(y, dtype=np.float64),
        linestyle="none",
        marker="o",
        markersize=4.5,
        markerfacecolor="white",
        markeredgecolor=shade,
        markeredgewidth=1.2,
        label=label,
        zorder=3,
    )


def sweep(
    points: Sequence[float], measure: Callable[[float], float], progress: Progress
) -> dict[str, list[float]]:
    """Measure at each point; returns lists x and v."""
    values = []
    for index, point in enumerate(points):
        values.append(measure(point))
        progress((index + 1) / len(points))
    return {"x": [float(point) for point in points], "v": values}


def part(progress: Progress, index: int, count: int) -> Progress:
    """Return the progress of one of ``count`` equal parts."""
    return lambda share: progress((index + share) / count)
