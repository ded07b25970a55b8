"""Plot a run: position and mean velocity over time, and the last drive periods in full."""

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from slider_resonator.arrays import Array
from slider_resonator.device.interface import VARIABLES
from slider_resonator.device.schedule import Schedule
from slider_resonator.fmu.run import Record
from slider_resonator.output.plot_style import (
    COLOURS,
    Picture,
    drawn,
    limit_to_later,
    plot_unit,
    shade_directions,
    style,
)
from slider_resonator.scenes.scene import Scene
from slider_resonator.scenes.signals_plot import schedule_for_window

ZOOM_PERIODS = 6
"""Drive periods at the end of the run that are drawn in full."""
ZOOMED = (
    ("velocity", 2.0, ("velocity",)),
    ("resonator", 1.6, ("resonator_displacement",)),
    ("force", 1.6, ("normal_force", "friction_force")),
)
"""Label, height and outputs of each panel of these periods."""
MIN_POINTS = 8
"""Points per drive period below which they are not drawn."""


def schedule_to_plot(scene: Scene) -> Schedule:
    """Return the schedule of a scene with more points in its last drive periods."""
    drive, stop = scene.drive_periods, float(scene.schedule().times[-1])
    begin = drive.instants(drive.passed_by(np.array(stop)) - ZOOM_PERIODS)
    return schedule_for_window(scene, (max(0.0, float(begin)), stop))


def run_figure(record: Record, scene: Scene) -> Figure:
    """Draw a run: the last drive periods where its points resolve them, and inputs that vary."""
    passed = scene.drive_periods.passed_by(record.times)
    before: Array = passed - passed[-1]
    before = before[before >= -ZOOM_PERIODS * (1.0 + 1e-9)]
    gaps = np.diff(before)
    resolved = gaps.size > 0 and bool(np.max(gaps) * MIN_POINTS <= 1.0)
    has_resonator = scene.device.resonator_mass > 0.0
    zoomed = [one for one in ZOOMED if resolved and (has_resonator or one[0] != "resonator")]
    given = {n: drawn(n, VARIABLES[n].unit, values) for n, values in record.given.items()}
    varying = [name for name, values in record.given.items() if np.ptp(values) > 0.0]
    constant = [
        one.named(one.values[0])
        for name, one in given.items()
        if name not in varying and record.given[name][0] != VARIABLES[name].start
    ]
    heights = [2.0, 2.0, *(height for _, height, _ in zoomed), *[1.3 for _ in varying]]
    time, position = drawn("time", "s", record.times), drawn("position", "m", record["position"])
    with style():
        figure = Picture(figsize=(8.0, sum(heights) + 0.3), layout="constrained")
        axes = figure.subplots(len(heights), 1, height_ratios=heights)
        figure.suptitle("\n".join([scene.heading, *([", ".join(constant)] if constant else [])]))
        axes[0].plot(time.values, position.values, color=COLOURS["position"])
        limit_to_later(axes[0], time.values, position.values)
        axes[0].set(ylabel=position.label)
        axes[0].tick_params(labelbottom=False)
        _velocity(axes[1], record, time.values, held=not scene.interpolates)
        inputs = axes[len(heights) - len(varying) :]
        for panel, (label, _, names) in zip(axes[2:], zoomed, strict=False):
            _zoom(panel, record, before, label, names)
        for panel, name in zip(inputs, varying, strict=True):
            one = given[name]
            panel.step(time.values, one.values, where="post", color=COLOURS["slow"])
            panel.set(ylabel=f"{one.words}\n[{one.unit}]")
        for panel in (axes[1], *inputs):
            panel.set(xlabel=time.label)
        for panel in (*axes[:2], *inputs):
            panel.set(xlim=(time.values[0], time.values[-1]))
        figure.align_ylabels(axes)
    return figure


def _velocity(axes: Axes, record: Record, times: Array, *, held: bool) -> None:
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
    axes.set(ylabel=f"velocity [{unit}]")
    limit_to_later(axes, times, factor * mean, np.where(valid, factor * steady, 0.0))
    axes.legend(loc="lower left", bbox_to_anchor=(0.0, 0.98), ncols=2)


def _zoom(axes: Axes, record: Record, before: Array, label: str, names: Sequence[str]) -> None:
    """Plot outputs in the last drive periods over the directions of slip."""
    modes = shade_directions(axes, before, record["contact_mode"][-len(before) :])
    curves = [record[name][-len(before) :] for name in names]
    factor, unit = plot_unit(VARIABLES[names[0]].unit, *curves)
    lines = []
    for name, curve in zip(names, curves, strict=True):
        look, colour = ("--", "theory") if name == "friction_force" else ("-", "velocity")
        words = name.replace("_", " ")
        lines += axes.plot(before, factor * curve, look, color=COLOURS[colour], label=words)
    axes.set(xlim=(-ZOOM_PERIODS, 0.0), ylabel=f"{label} [{unit}]")
    if label == "velocity":
        axes.axhline(0.0, color="0.4", linewidth=0.6)
    if label == "force":
        axes.set(xlabel="drive periods before the end")
    else:
        axes.tick_params(labelbottom=False)
    entries: Mapping[str, Sequence[Artist]] = {"velocity": modes, "force": lines}
    if shown := entries.get(label):
        place = (1.0, 0.98)
        axes.legend(handles=shown, loc="lower right", bbox_to_anchor=place, ncols=len(shown))
