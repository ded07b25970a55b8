"""Plot chosen signals of one or several runs of a scene over a window of time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from numpy.typing import NDArray

from slider_resonator.arrays import Array
from slider_resonator.device.interface import INPUTS, OUTPUTS
from slider_resonator.device.schedule import Schedule
from slider_resonator.errors import HarnessError, unknown_name
from slider_resonator.fmu.record import Record
from slider_resonator.output.plot_style import CONTACT, save, shade_directions, style
from slider_resonator.scenes.plot_units import plot_unit
from slider_resonator.scenes.scene import Scene

SIGNALS = (
    *("position", "mean_velocity", "velocity", "resonator_displacement"),
    *("normal_force", "friction_force"),
)
"""The signals of a plot for which none are named."""
COLOURS = ("#1f3b57", "#c8553d", "#2e7d32", "#8e24aa", "#b8860b", "#00838f")
DASHES = ("-", "--", ":", "-.")
SMOOTH_POINTS = 64
"""Points per drive period of a smooth curve."""
MAX_POINTS = 8000
"""Points added to a window; a longer one is drawn with longer steps."""
BAND_PERIODS = 30.0
"""The longest window, in drive periods, in which contact is shown as bands behind the curves."""


@dataclass(frozen=True)
class Run:
    """A run with its name in the legend."""

    label: str
    record: Record


def check_signals(names: Sequence[str]) -> None:
    """Raise HarnessError for a name that is no output or input, or is given twice."""
    allowed = [*OUTPUTS, *INPUTS]
    for name in names:
        if name not in allowed:
            raise HarnessError(f"--signals: {unknown_name('output or input', name, allowed)}")
        if list(names).count(name) > 1:
            raise HarnessError(f"--signals: {name} is given twice; must be given once")


def check_window(window: tuple[float, float], scene: Scene) -> None:
    """Raise HarnessError for a window (s) that is empty or not within the run."""
    begin, end = window
    stop = float(scene.schedule().times[-1])
    if not 0.0 <= begin < end <= stop:
        raise HarnessError(
            f"--window {begin:g}:{end:g}: must be FROM:TO with 0 <= FROM < TO <= {stop:g} s, "
            f"the end of {scene.name}"
        )


def schedule_for_window(scene: Scene, window: tuple[float, float]) -> Schedule:
    """Return the schedule of a scene with more points in the window."""
    begin, end = window
    count = int(np.ceil((end - begin) / scene.drive_period * SMOOTH_POINTS)) + 1
    times = np.linspace(begin, end, min(max(count, 2), MAX_POINTS))
    return scene.schedule().read_at(times, 0.01 * float(times[1] - times[0]))


def plot_signals(
    runs: Sequence[Run],
    scene: Scene,
    signals: Sequence[str],
    window: tuple[float, float],
    path: Path,
) -> None:
    """Write a plot with a panel for each signal; each run has its own colour and dash."""
    with style():
        figure = Figure(figsize=(8.0, 1.9 * len(signals) + 0.8), layout="constrained")
        figure.suptitle(f"{scene.title}  ({scene.name})")
        panels = figure.subplots(len(signals), 1, sharex=True, squeeze=False)[:, 0]
        short = window[1] - window[0] <= BAND_PERIODS * scene.drive_period
        time_factor, time_unit = plot_unit("s", np.asarray(window))
        bands: dict[str, Patch] = {}
        for axes, name in zip(panels, signals, strict=True):
            _panel(axes, runs, name, window, time_factor)
            if short and len(runs) == 1 and name != "contact_mode":
                bands |= _shade(axes, runs[0].record, window, time_factor)
        ends = (time_factor * window[0], time_factor * window[1])
        panels[-1].set(xlabel=f"time [{time_unit}]", xlim=ends)
        figure.align_ylabels(panels)
        panels[-1].ticklabel_format(axis="x", useOffset=False)
        handles = panels[0].get_lines() if len(runs) > 1 else [*bands.values()]
        if handles:
            figure.legend(handles=handles, loc="outside lower center", ncols=min(4, len(handles)))
        save(figure, path)


def _panel(
    axes: Axes, runs: Sequence[Run], name: str, window: tuple[float, float], time_factor: float
) -> None:
    windows = [_inside(one.record, window) for one in runs]
    curves = [_values(one.record, name)[inside] for one, inside in zip(runs, windows, strict=True)]
    factor, unit = plot_unit(INPUTS.get(name) or OUTPUTS[name], *curves)
    held = name in INPUTS or name == "contact_mode"
    for index, (one, inside, curve) in enumerate(zip(runs, windows, curves, strict=True)):
        axes.plot(
            time_factor * one.record.times[inside],
            factor * curve,
            linestyle=DASHES[index % len(DASHES)],
            color=COLOURS[index % len(COLOURS)],
            drawstyle="steps-post" if held else "default",
            label=one.label,
        )
    axes.set(ylabel=f"{name.replace('_', ' ')}\n[{unit}]")
    if name == "contact_mode":
        axes.set_yticks([*CONTACT], [words for words, _ in CONTACT.values()])
        axes.set(ylabel="contact")


def _shade(
    axes: Axes, record: Record, window: tuple[float, float], time_factor: float
) -> dict[str, Patch]:
    """Show contact behind the curves; return the legend entry of each mode by its label."""
    inside = _inside(record, window)
    times = time_factor * record.times[inside]
    entries = shade_directions(axes, times, record["contact_mode"][inside])
    return {str(entry.get_label()): entry for entry in entries}


def _inside(record: Record, window: tuple[float, float]) -> NDArray[np.bool_]:
    inside: NDArray[np.bool_] = (record.times >= window[0]) & (record.times <= window[1])
    return inside


def _values(record: Record, name: str) -> Array:
    return record.inputs[:, list(INPUTS).index(name)] if name in INPUTS else record[name]
