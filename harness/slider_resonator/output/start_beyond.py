"""The range of a curve over time whose start is far outside what follows."""

import numpy as np
from matplotlib.axes import Axes

from slider_resonator.arrays import Array

START = 0.1
"""Share of the time of a curve that counts as its start."""
FAR = 2.0
"""How far outside a start must be, in widths of the range that follows."""
ROUNDING = 1e-6
"""Width below which what follows is no more than rest, as a share of the whole."""
MARGIN = 0.06


def range_after_start(times: Array, *curves: Array) -> tuple[float, float] | None:
    """Return the range of curves after a start that is far outside it, with 0 and a margin.

    `times` and curves have shape (n,). None where the start is not far outside.
    """
    later = times >= times[0] + START * (times[-1] - times[0])
    values = np.array(curves)
    lowest, highest = min(0.0, np.min(values)), max(0.0, np.max(values))
    low, high = min(0.0, np.min(values[:, later])), max(0.0, np.max(values[:, later]))
    width = high - low
    far = max(highest - high, low - lowest) > FAR * width > FAR * ROUNDING * (highest - lowest)
    return (low - MARGIN * width, high + MARGIN * width) if far else None


def words_for_start(*curves: Array) -> str:
    """Return what a plot says whose range leaves out the start of curves."""
    return f"start beyond the axis: {np.min(curves):.3g} to {np.max(curves):.3g}"


def limit_to_later(axes: Axes, times: Array, *curves: Array) -> None:
    """Let what follows a start far outside set the axis of y, and say so above the plot."""
    found = range_after_start(times, *curves)
    if found is not None:
        axes.set_ylim(found)
        axes.set_title(words_for_start(*curves), loc="right", fontsize=8, pad=2.0)
