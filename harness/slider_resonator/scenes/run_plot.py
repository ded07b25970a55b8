"""Plot a run: position and mean velocity over time, and the last drive periods in full."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from numpy.typing import NDArray

from slider_resonator.arrays import Array
from slider_resonator.device.interface import VARIABLES
from slider_resonator.device.schedule import Schedule
from slider_resonator.fmu.record import Record
from slider_resonator.output.plot_style import COLOURS, Picture, shade_directions, style
from slider_resonator.output.start_beyond import limit_to_later
from slider_resonator.scenes.plot_units import plot_unit
from slider_resonator.scenes.scene import Scene

ZOOM_PERIODS = 6
"""Drive periods at the end of the run that are drawn in full."""
MIN_POINTS = 8
"""Points per drive period below which they are not drawn."""
SMOOTH_POINTS = 64
"""Points per drive period for a smooth curve."""


def schedule_to_plot(scene: Scene) -> Schedule:
    """Return the schedule of a scene with more points in its last drive periods."""
    period = scene.drive_period
    schedule = scene.schedule()
    return schedule.refined(
        float(schedule.times[-1]) - ZOOM_PERIODS * period, period / SMOOTH_POINTS
    )


def run_figure(record: Record, scene: Scene) -> Figure:
    """Draw a run: the last drive periods where its points resolve them, and inputs that vary."""
    period = scene.drive_period
    varying = [name for name, values in record.given.items() if np.ptp(values) > 0.0]
    gaps = np.diff(record.times[_last_periods(record, period)])
    resolved = gaps.size > 0 and bool(np.max(gaps) * MIN_POINTS <= period)
    with style():
        heights = [2.0, 2.0, *([2.0, 1.6, 1.6] if resolved else []), *[1.3 for _ in varying]]
        figure = Picture(figsize=(8.0, sum(heights) + 0.3), layout="constrained")
        axes = figure.subplots(len(heights), 1, height_ratios=heights)
        figure.suptitle(f"{scene.title}  ({scene.name}){_constant_inputs(record, varying)}")
        factor, unit = plot_unit("s", record.times)
        times = factor * record.times
        _position(axes[0], record, times)
        _velocity(axes[1], record, times, unit, held=not scene.interpolates)
        if resolved:
            _zoom(axes[2], record, period)
            _resonator(axes[3], record, period)
            _forces(axes[4], record, period)
        for panel, name in zip(axes[len(heights) - len(varying) :], varying, strict=True):
            _input(panel, record, times, unit, name)
        figure.align_ylabels(axes)
    return figure


def _position(axes: Axes, record: Record, times: Array) -> None:
    factor, unit = plot_unit("m", record["position"])
    axes.plot(times, factor * record["position"], color=COLOURS["position"])
    limit_to_later(axes, times, factor * record["position"])
    axes.set(ylabel=f"position [{unit}]", xlim=(times[0], times[-1]))
    axes.tick_params(labelbottom=False)


def _velocity(axes: Axes, record: Record, times: Array, time_unit: str, *, held: bool) -> None:
    """Plot the mean velocity, and the steady one: of inputs that are held, of the step before."""
    mean, steady = record["mean_velocity"], record["steady_velocity"]
    valid = record.outputs.get("prediction_valid", np.ones_like(steady)) == 1.0
    factor, unit = plot_unit("m/s", mean, steady[valid])
    axes.plot(times, factor * mean, color=COLOURS["slow"], label="mean velocity")
    if valid.any():
        predicted = np.where(valid, factor * steady, np.nan)
        axes.plot(
            times,
            predicted,
            "--",
            color=COLOURS["theory"],
            drawstyle="steps-pre" if held else "default",
            label="steady, for these inputs",
        )
    axes.set(xlabel=f"time [{time_unit}]", ylabel=f"velocity [{unit}]", xlim=(times[0], times[-1]))
    limit_to_later(axes, times, factor * mean, np.where(valid, factor * steady, 0.0))
    axes.legend()


def _zoom(axes: Axes, record: Record, period: float) -> None:
    """Plot the last drive periods over the directions of slip."""
    window = _last_periods(record, period)
    entries = _over_last_periods(axes, record, period)
    velocity = record["velocity"][window]
    factor, unit = plot_unit("m/s", velocity)
    axes.plot(_periods(record, period), factor * velocity, color=COLOURS["velocity"])
    axes.axhline(0.0, color="0.4", linewidth=0.6)
    axes.set(ylabel=f"velocity [{unit}]")
    axes.tick_params(labelbottom=False)
    axes.legend(handles=entries, loc="lower right", bbox_to_anchor=(1.0, 0.98), ncols=len(entries))


def _resonator(axes: Axes, record: Record, period: float) -> None:
    """Plot the resonator relative to the slider."""
    _over_last_periods(axes, record, period)
    displacement = record["resonator_displacement"][_last_periods(record, period)]
    factor, unit = plot_unit("m", displacement)
    axes.plot(_periods(record, period), factor * displacement, color=COLOURS["position"])
    axes.set(ylabel=f"resonator [{unit}]")
    axes.tick_params(labelbottom=False)


def _forces(axes: Axes, record: Record, period: float) -> None:
    """Plot normal force and friction."""
    window = _last_periods(record, period)
    _over_last_periods(axes, record, period)
    for name, look in (("normal_force", "-"), ("friction_force", "--")):
        colour = COLOURS["theory" if name == "friction_force" else "velocity"]
        label = name.replace("_", " ")
        axes.plot(_periods(record, period), record[name][window], look, color=colour, label=label)
    axes.set(xlabel="drive periods before the end", ylabel="force [N]")
    axes.legend(loc="lower right", bbox_to_anchor=(1.0, 0.98), ncols=2)


def _over_last_periods(axes: Axes, record: Record, period: float) -> list[Patch]:
    """Shade the directions of slip in the last drive periods and return their legend entries."""
    modes = record["contact_mode"][_last_periods(record, period)]
    axes.set(xlim=(-ZOOM_PERIODS, 0.0))
    return shade_directions(axes, _periods(record, period), modes)


def _periods(record: Record, period: float) -> Array:
    """Return the last times in drive periods before the end."""
    times: Array = (record.times[_last_periods(record, period)] - record.times[-1]) / period
    return times


def _last_periods(record: Record, period: float) -> NDArray[np.bool_]:
    """Return which points of the run are in the last drive periods."""
    window: NDArray[np.bool_]
    window = record.times >= record.times[-1] - ZOOM_PERIODS * period * (1.0 + 1e-9)
    return window


def _constant_inputs(record: Record, varying: list[str]) -> str:
    """Return a line with the inputs that are constant, but not at their start value."""
    shown = [
        f"{name} {values[0]:g} {VARIABLES[name].unit.removeprefix('1')}".strip()
        for name, values in record.given.items()
        if name not in varying and values[0] != VARIABLES[name].start
    ]
    return "\n" + ", ".join(shown) if shown else ""


def _input(axes: Axes, record: Record, times: Array, unit: str, name: str) -> None:
    axes.step(times, record.given[name], where="post", color=COLOURS["slow"])
    label = f"{name.replace('_', ' ')}\n[{VARIABLES[name].unit}]"
    axes.set(xlabel=f"time [{unit}]", ylabel=label, xlim=(times[0], times[-1]))
