"""What all figures have in common: style, units of curves, ranges of axes."""

import base64
import io
from collections.abc import Mapping, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass
from math import inf, pi
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from matplotlib.style import context

from slider_resonator.arrays import Array
from slider_resonator.output.files import replacing

COLOURS: Mapping[str, str] = {
    "position": "#1f3b57",
    "velocity": "#1f3b57",
    "slow": "#1f5f8b",
    "theory": "#c8553d",
}
CONTACT: Mapping[int, tuple[str, str]] = {
    -1: ("slips backward", "#f3dcd5"),
    0: ("sticks", "#e2e2e2"),
    1: ("slips forward", "#d8e6ee"),
    2: ("lifted", "#fdf6dc"),
}
"""Contact mode to name and background."""

_STYLE: dict[Any, Any] = {
    "font.size": 9.5,
    "axes.titlesize": 10.5,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.edgecolor": "0.35",
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": "0.9",
    "grid.linewidth": 0.6,
    "lines.linewidth": 1.4,
    "legend.frameon": False,
    "xtick.color": "0.25",
    "ytick.color": "0.25",
    "svg.hashsalt": "slider-resonator",
}


def style() -> AbstractContextManager[None]:
    """Return what applies the common style to figures made in its block.

    The settings of a user's own matplotlibrc do not show, nor does the backend change.
    """
    return context(_STYLE, after_reset=True)


def save(figure: Figure, path: Path) -> None:
    """Write a figure without a display, in the format of the suffix of `path`.

    Raises HarnessError when it cannot be written; an existing file then stays as it is.
    """
    with style(), replacing(path) as temporary:
        figure.savefig(temporary, dpi=150)


def png_data_uri(figure: Figure) -> str:
    """Return a figure as a PNG data URI to embed in an HTML page."""
    return "data:image/png;base64," + base64.b64encode(_png(figure)).decode("ascii")


def _png(figure: Figure) -> bytes:
    buffer = io.BytesIO()
    with style():
        figure.savefig(buffer, format="png", dpi=100)
    return buffer.getvalue()


class Picture(Figure):
    """A figure that a notebook shows without pyplot."""

    def _repr_png_(self) -> bytes:
        return _png(self)


def shade_directions(axes: Axes, abscissa: Array, modes: Array) -> list[Patch]:
    """Shade each interval of constant contact mode and return the legend entries of its modes.

    `abscissa` and `modes` have shape (n,); a mode changes at the midpoint between two points.
    """
    changes = np.flatnonzero(np.diff(modes)) + 1
    middles = 0.5 * (abscissa[changes] + abscissa[changes - 1])
    edges = [float(abscissa[0]), *middles.tolist(), float(abscissa[-1])]
    for left, right, first in zip(edges, edges[1:], [0, *changes.tolist()], strict=False):
        axes.axvspan(left, right, color=CONTACT[round(modes[first])][1], linewidth=0.0, zorder=0)
    present = sorted({round(mode) for mode in modes})
    return [Patch(color=CONTACT[mode][1], label=CONTACT[mode][0]) for mode in present]


_LADDERS: Mapping[str, Sequence[tuple[float, float, str]]] = {
    "m": ((1e-4, 1e6, "um"), (2.0, 1e3, "mm")),
    "m/s": ((2.0, 1e3, "mm/s"),),
    "s": ((2.0, 1e3, "ms"),),
    "N": ((0.5, 1e3, "mN"),),
    "W": ((0.5, 1e3, "mW"),),
    "kg": ((0.5, 1e3, "g"),),
    "rad": ((inf, 180.0 / pi, "deg"),),
    "rad/s": ((2e4 * pi, 0.5 / pi, "Hz"), (inf, 5e-4 / pi, "kHz")),
}
"""For a unit, the peaks below which another unit suits curves, with the factor to it."""


def plot_unit(unit: str, *curves: Array) -> tuple[float, str]:
    """Return the factor from `unit` to the unit that suits the peak of these curves, and that unit.

    Each curve has shape (n,); all share the unit, so that they can be compared in one panel.
    """
    peak = max((float(np.abs(curve).max()) for curve in curves if curve.size), default=0.0)
    for limit, factor, smaller in _LADDERS.get(unit, ()):
        if peak < limit:
            return factor, smaller
    return 1.0, unit


@dataclass(frozen=True)
class Drawn:
    """A quantity as it is drawn: `values` (n,) in `unit`, NaN where there is none."""

    words: str
    unit: str
    values: Array

    @property
    def label(self) -> str:
        """The label of an axis."""
        return f"{self.words} [{self.unit}]"

    def named(self, value: float) -> str:
        """Return the name of a line of one value in `unit`."""
        return f"{self.words} {value:.4g} {self.unit}".removesuffix(" 1")


def drawn(name: str, unit: str, values: Array) -> Drawn:
    """Return a quantity of this name, whose values (n,) are in `unit`, as it is drawn."""
    factor, suited = plot_unit(unit, values[np.isfinite(values)])
    return Drawn(name.replace("_", " "), suited, factor * values)


def range_after_start(times: Array, *curves: Array) -> tuple[tuple[float, float] | None, str]:
    """Return the range of curves after a start that is far outside it, with 0 and a margin.

    `times` and curves have shape (n,). The start is the first tenth of the time, and far outside
    where it is so by more than the width of what follows. Return also what the plot says then; None
    and "" where the start is not far outside.
    """
    later = times >= times[0] + 0.1 * (times[-1] - times[0])
    values = np.array(curves)
    lowest, highest = min(0.0, np.min(values)), max(0.0, np.max(values))
    low, high = min(0.0, np.min(values[:, later])), max(0.0, np.max(values[:, later]))
    width, rounding = high - low, 1e-6 * (highest - lowest)
    if not max(highest - high, low - lowest) > width > rounding:
        return None, ""
    words = f"start beyond the axis: {np.min(values):.3g} to {np.max(values):.3g}"
    return (low - 0.06 * width, high + 0.06 * width), words


def limit_to_later(axes: Axes, times: Array, *curves: Array) -> None:
    """Let what follows a start far outside set the axis of y, and say so above the plot."""
    found, words = range_after_start(times, *curves)
    if found is not None:
        axes.set_ylim(found)
        axes.set_title(words, loc="right", fontsize=8, pad=2.0)
