"""The common style of all figures."""

import base64
import io
from collections.abc import Mapping
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from slider_resonator.arrays import Array
from slider_resonator.output.atomic import replacing

COLOURS: Mapping[str, str] = {
    "position": "#1f3b57",
    "velocity": "#1f3b57",
    "slow": "#1f5f8b",
    "theory": "#c8553d",
    "marker": "#1f5f8b",
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
    defaults: dict[Any, Any] = {
        key: mpl.rcParamsDefault[key] for key in mpl.rcParamsDefault if key != "backend"
    }
    return mpl.rc_context({**defaults, **_STYLE})


def save(figure: Figure, path: Path) -> None:
    """Write a figure without a display, in the format of the suffix of `path`.

    Raises HarnessError when it cannot be written; an existing file then stays as it is.
    """
    FigureCanvasAgg(figure)
    with style(), replacing(path) as temporary:
        figure.savefig(temporary, dpi=150)


def png_data_uri(figure: Figure) -> str:
    """Return a figure as a PNG data URI to embed in an HTML page."""
    return "data:image/png;base64," + base64.b64encode(_png(figure)).decode("ascii")


def _png(figure: Figure) -> bytes:
    FigureCanvasAgg(figure)
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
