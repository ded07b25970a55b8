"""A figure of the report and the style of its panels."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure as Drawing

from slider_resonator.arrays import Array
from slider_resonator.fmu.instance import Instance
from studies.paper import labels

LINE_POINTS = 121
"""Points of a line over a panel."""
Data = dict[str, Any]
"""Measurements as plain data for JSON."""

SHADES = ("#c8553d", "#1f5f8b", "#6a994e", "#8a6fae", "#b8860b")
"""Colours of cases within a panel; a line and the markers of a case share one."""


@dataclass(frozen=True)
class PaperFigure:
    """A figure: what is measured on the FMU, and how it is drawn."""

    name: str
    title: str
    caption: str
    measure: Callable[[Instance], Data]
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
    """Draw the FMU's results; None, where there is no steady motion, is left out."""
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


def curve(x: Sequence[float], y: Sequence[float | None]) -> dict[str, list[float | None]]:
    """Return the points of a curve as they are stored."""
    return {"x": list(x), "v": list(y)}


@dataclass(frozen=True)
class Line:
    """A theory over the parameters of a panel, and how it is drawn."""

    label: str
    dash: str
    shade: str
    velocity: Callable[[dict[str, float]], float]


@dataclass(frozen=True)
class SweptPanel:
    """A panel over one parameter, named `swept`; the others keep the values of `fixed`."""

    swept: str
    label: str
    points: tuple[float, ...]
    fixed: Mapping[str, float]

    def case(self, value: float) -> dict[str, float]:
        """Return the parameters at a value of the swept one."""
        return {**self.fixed, self.swept: value}

    def measure(self, velocity: Callable[[dict[str, float]], float]) -> Data:
        """Return the velocities at all points."""
        return curve(self.points, [velocity(self.case(value)) for value in self.points])

    def draw(self, axes: Axes, data: Data, lines: Sequence[Line]) -> None:
        """Draw ``lines`` and the FMU's results."""
        fine = np.linspace(self.points[0], self.points[-1], LINE_POINTS).tolist()
        for line in lines:
            velocities = [line.velocity(self.case(x)) for x in fine]
            axes.plot(fine, velocities, line.dash, color=line.shade, label=line.label)
        markers(axes, data["x"], data["v"], SHADES[1], "FMU")
        axes.set(xlabel=self.label, ylabel=labels.STEADY_VELOCITY)
        axes.legend(fontsize=8)


def swept_figure(
    name: str,
    title: str,
    caption: str,
    velocity: Callable[[Instance, dict[str, float]], float],
    swept: Sequence[SweptPanel],
    lines: Sequence[Line],
    height: float = 3.4,
) -> PaperFigure:
    """Return the figure with a panel for each parameter that is swept, over which `lines` lie."""

    def measure(instance: Instance) -> Data:
        return {panel.swept: panel.measure(partial(velocity, instance)) for panel in swept}

    def draw(data: Data) -> Drawing:
        drawing, axes = panels(len(swept), height)
        for axis, panel in zip(axes, swept, strict=True):
            panel.draw(axis, data[panel.swept], lines)
        return drawing

    return PaperFigure(name, title, caption, measure, draw)
