"""Plot a run, or chosen signals of one or several runs of a scene over a window of time."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from slider_resonator.arrays import Array
from slider_resonator.device.drive_periods import DrivePeriods
from slider_resonator.device.interface import ALL_OUTPUTS, INPUTS, VARIABLES
from slider_resonator.device.schedule import Schedule
from slider_resonator.errors import HarnessError, unknown_name
from slider_resonator.fmu.run import Record
from slider_resonator.output.plot_style import (
    COLOURS,
    CONTACT,
    Picture,
    drawn,
    limit_to_later,
    plot_unit,
    save,
    shade_directions,
    style,
)
from slider_resonator.scenes.scene import Scene

SIGNALS = (
    *("position", "mean_velocity", "velocity", "resonator_displacement"),
    *("normal_force", "friction_force"),
)
"""The signals of a plot for which none are named."""
RUN_COLOURS = ("#1f3b57", "#c8553d", "#2e7d32", "#8e24aa", "#b8860b", "#00838f")
DASHES = ("-", "--", ":", "-.")
SMOOTH_POINTS = 64
"""Points per drive period of a smooth curve."""
DRAWN_PERIODS = 400
"""Drive periods, evenly spread, that are drawn of a longer one."""
ZOOM_PERIODS = 6
"""Drive periods at the end of the run that are drawn in full."""
ZOOMED = (
    ("velocity", 2.0, ("velocity",)),
    ("resonator", 1.6, ("resonator_displacement",)),
    ("force", 1.6, ("normal_force", "friction_force")),
)
"""Label, height and outputs of each panel of these periods."""

Run = tuple[str, Mapping[str, Array]]
"""A run: its name in the legend, and its table as that of a `Record`."""
Window = tuple[float, float]
"""The beginning and the end of the time that is drawn, s."""


def check_plot(scene: Scene, names: Sequence[str], window: Window | None) -> None:
    """Raise HarnessError for names of no signal, and windows beyond the run."""
    allowed = [*ALL_OUTPUTS, *INPUTS, *scene.tuning]
    for name in names:
        if name not in allowed:
            raise HarnessError(f"--signals: {unknown_name('output or input', name, allowed)}")
    stop = float(scene.schedule().times[-1])
    begin, end = window or (0.0, stop)
    if not 0.0 <= begin < end <= stop:
        raise HarnessError(
            f"--window {begin:g}:{end:g}: must be FROM:TO with 0 <= FROM < TO <= {stop:g} s, "
            f"the end of {scene.name}"
        )


def schedule_for_window(scene: Scene, window: Window) -> Schedule:
    """Return the schedule of a scene with more points in the window.

    They are on the whole of a short window, and on `DRAWN_PERIODS` of a long one: every n-th point
    of all would show a beat that the vibration does not have.
    """
    drive = scene.drive_periods
    begin, periods = drive.passed_by(np.array(window[0])), _periods_in(window, drive)
    if periods > 120.0:
        begins = begin + np.unique(np.floor(np.linspace(0.0, periods, DRAWN_PERIODS + 1)))[:-1]
        times = drive.instants(begins[:, None] + np.arange(SMOOTH_POINTS + 1) / SMOOTH_POINTS)
    else:
        times = np.linspace(*window, max(int(np.ceil(periods * SMOOTH_POINTS)) + 1, 2))
    closest = 0.01 * float(np.diff(times).min())
    return scene.schedule().read_at(times[times <= window[1]], closest)


def _periods_in(window: Window, drive: DrivePeriods) -> float:
    begin, end = drive.passed_by(np.array(window)).tolist()
    return float(end - begin)


def plot_signals(
    runs: Sequence[Run], scene: Scene, signals: Sequence[str], window: Window, path: Path
) -> None:
    """Write a plot with a panel for each signal; each run has its own colour and dash.

    With several runs a panel below that of an output has the others less the first. Raises
    HarnessError for a signal that a run does not have.
    """
    shown: list[Run] = []
    for label, table in runs:
        if missing := [name for name in signals if name not in table]:
            raise HarnessError(f"--signals: {', '.join(missing)}: {label} has no such output")
        inside = (table["time"] >= window[0]) & (table["time"] <= window[1])
        shown.append((label, {name: values[inside] for name, values in table.items()}))
    are_compared = len(runs) > 1 and _same_times(shown)
    compared = ALL_OUTPUTS.keys() - {"contact_mode"} if are_compared else ()
    rows = [(n, below) for n in signals for below in (False, True) if not below or n in compared]
    heights = [1.2 if below else 1.9 for _, below in rows]
    # In longer windows bands of contact behind the curves would be too narrow.
    has_bands = len(runs) == 1 and _periods_in(window, scene.drive_periods) <= 30.0
    with style():
        figure = Figure(figsize=(8.0, sum(heights) + 0.8), layout="constrained")
        figure.suptitle(scene.heading)
        panels = np.atleast_1d(figure.subplots(len(rows), 1, sharex=True, height_ratios=heights))
        time_factor, time_unit = plot_unit("s", np.asarray(window))
        handles: Sequence[Artist] = []
        for axes, (name, below) in zip(panels, rows, strict=True):
            _panel(axes, shown, name, time_factor, differences=below)
            if has_bands and name != "contact_mode":
                _, table = shown[0]
                handles = shade_directions(axes, time_factor * table["time"], table["contact_mode"])
        ends = (time_factor * window[0], time_factor * window[1])
        panels[-1].set(xlabel=f"time [{time_unit}]", xlim=ends)
        figure.align_ylabels(panels)
        panels[-1].ticklabel_format(axis="x", useOffset=False)
        if len(runs) > 1:
            handles = panels[0].get_lines()
        if handles:
            figure.legend(handles=handles, loc="outside lower center", ncols=min(4, len(handles)))
        save(figure, path)


def _panel(
    axes: Axes, shown: Sequence[Run], name: str, time_factor: float, *, differences: bool
) -> None:
    curves = [table[name] for _, table in shown]
    if differences:
        curves = [curve - curves[0] for curve in curves]
    factor, unit = plot_unit(VARIABLES[name].unit, *curves)
    held = name not in ALL_OUTPUTS or name == "contact_mode"
    if _same_times(shown) and not held:
        limit_to_later(axes, shown[0][1]["time"], *(factor * one for one in curves))
    for index, ((label, table), curve) in enumerate(zip(shown, curves, strict=True)):
        if differences and index == 0:
            continue
        axes.plot(
            time_factor * table["time"],
            factor * curve,
            linestyle=DASHES[index % len(DASHES)],
            color=RUN_COLOURS[index % len(RUN_COLOURS)],
            drawstyle="steps-post" if held else "default",
            label=label,
        )
    words = "difference" if differences else name.replace("_", " ")
    axes.set(ylabel=f"{words}\n[{unit}]")
    if name == "contact_mode":
        axes.set_yticks([*CONTACT], [words for words, _ in CONTACT.values()])
        axes.set(ylabel="contact")


def _same_times(shown: Sequence[Run]) -> bool:
    times = [table["time"] for _, table in shown]
    return all(np.array_equal(one, times[0]) for one in times)


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
    resolved = gaps.size > 0 and bool(np.max(gaps) <= 0.125)
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
        for panel in (*axes[:2], *inputs):
            panel.set(xlim=(time.values[0], time.values[-1]))
            panel.set(xlabel="" if panel is axes[0] else time.label)
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
    handles: Sequence[Artist] = modes if label == "velocity" else lines
    axes.legend(handles=handles, loc="lower right", bbox_to_anchor=(1.0, 0.98), ncols=len(handles))
