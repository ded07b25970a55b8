"""Plots in HTML pages that describe the point under the pointer, drawn by uPlot from page data.

A mouse or a finger near a point, or the arrow keys on a plot in focus, show its text.
"""

import json
from collections.abc import Sequence
from dataclasses import dataclass

from slider_resonator.output.html_page import PLOT, escaped
from slider_resonator.output.json_output import plain
from slider_resonator.output.readable import printable

COLOURS = (
    *("#1f5f8b", "#c8553d", "#2e7d32", "#8e24aa", "#b8860b", "#00838f", "#5d4037", "#ad1457"),
    *("#455a64", "#ef6c00", "#3949ab", "#7cb342", "#d81b60", "#4fc3f7", "#000000", "#ba9bd8"),
    *("#9e9d24", "#f48fb1", "#26a69a", "#a1887f"),
)
MARKERS = "●■▲◆▼★✚◀▶○□△◇✖"
DASHES: tuple[tuple[int, ...], ...] = ((), (8, 4), (2, 3), (8, 3, 2, 3))


@dataclass(frozen=True)
class Axis:
    """An axis with its unit in the label; a logarithmic one is for positive values only.

    `range` are its ends, by default those of the data.
    """

    label: str
    log: bool = False
    range: tuple[float, float] | None = None


@dataclass(frozen=True)
class Series:
    """Points with a label, joined in their order where `width` (px) is not 0.

    `notes` are further lines of text for each point, `colours` replace `colour` point by point. A
    point without y is marked on the x axis. `cells` fill the plane up to their neighbours.
    """

    label: str
    x: Sequence[float]
    y: Sequence[float | None]
    colour: str
    marker: str = ""
    width: float = 0.0
    dash: Sequence[int] = ()
    notes: Sequence[str] = ()
    colours: Sequence[str] = ()
    cells: bool = False


@dataclass(frozen=True)
class HoverPlot:
    """A plot of some series; `height` in px."""

    title: str
    x: Axis
    y: Axis
    series: Sequence[Series]
    height: int = 420


def look(index: int) -> tuple[str, str, tuple[int, ...]]:
    """Return colour, marker and dash of the series with an index; 20 have colours of their own."""
    dash = DASHES[index // len(COLOURS) % len(DASHES)]
    return COLOURS[index % len(COLOURS)], MARKERS[index % len(MARKERS)], dash


def plot_html(plot: HoverPlot) -> str:
    """Return the plot as HTML for a page."""
    text = json.dumps(_printable(plain(plot)), separators=(",", ":"), ensure_ascii=True)
    # "<" could end the script element; in JSON it occurs in strings only.
    data = text.replace("<", "\\u003c")
    return (
        f"<figure><figcaption>{escaped(plot.title)}</figcaption>{PLOT}"
        f'<script type="application/json">{data}</script></div></figure>'
    )


def _printable(value: object) -> object:
    if isinstance(value, str):
        return printable(value)
    if isinstance(value, float):
        return float(f"{value:.9g}")  # more digits than a plot shows or its texts say
    if isinstance(value, dict):
        return {key: _printable(item) for key, item in value.items()}
    return [_printable(item) for item in value] if isinstance(value, list) else value
