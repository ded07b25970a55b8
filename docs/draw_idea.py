"""Draw docs/idea.png: a period of the drive, pushed while light, dragged while heavy, and many.

python docs/draw_idea.py [FMU [PICTURE]]
"""

import sys
from math import pi
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.schedule import schedule
from slider_resonator.fmu.instance import Instance, instantiate
from slider_resonator.fmu.opening import open_fmu
from slider_resonator.fmu.run import run
from slider_resonator.output.plot_style import COLOURS, save, style

ROOT = Path(__file__).resolve().parents[1]
PERIOD = 2.0 * pi / Device().drive_frequency
POINTS = 400
PERIODS = 6000
AHEAD, BEHIND = "#d8e6ee", "#f3dcd5"


def draw_idea(fmu_path: Path, path: Path) -> None:
    """Run the FMU from rest and write the picture, 1200 pixels wide, to `path`."""
    with open_fmu(fmu_path) as fmu, instantiate(fmu) as instance:
        first = _run(instance, PERIODS, POINTS, 1)
        many = _run(instance, PERIODS, 4, PERIODS)
    with style():
        figure = Figure(figsize=(8.0, 5.2), layout="constrained")
        axes = figure.subplots(2, 2)
        time = 1e3 * (first["time"] - first["time"][0])
        _draw_period(axes[0][0], time, first)
        _draw_friction(axes[0][1], time, first)
        _draw_step(axes[1][0], time, first)
        _draw_average(axes[1][1], many)
        save(figure, path)


def _run(instance: Instance, periods: int, points: int, shown: int) -> dict[str, Array]:
    """Return time and outputs of the last `shown` of `periods` from rest, at points in each."""
    coarse = schedule(periods * PERIOD, PERIOD / points if shown > 1 else PERIOD)
    if shown == 1:
        fine = (periods - 1) * PERIOD + PERIOD * np.arange(points + 1) / points
        coarse = coarse.read_at(fine, 1e-3 * PERIOD / points)
    record = run(instance, {}, coarse, outputs=["position", "velocity", "normal_force"])
    last = record.times >= (periods - shown) * PERIOD * (1.0 - 1e-12)
    return {"time": record.times[last]} | {n: c[last] for n, c in record.outputs.items()}


def _shade(axes: Axes, time: Array, velocity: Array) -> None:
    axes.fill_between(time, 0, 1, velocity > 0, color=AHEAD, transform=axes.get_xaxis_transform())
    axes.fill_between(time, 0, 1, velocity < 0, color=BEHIND, transform=axes.get_xaxis_transform())


def _draw_period(axes: Axes, time: Array, shown: dict[str, Array]) -> None:
    _shade(axes, time, shown["velocity"])
    axes.plot(time, 1e3 * shown["velocity"], color=COLOURS["velocity"])
    axes.axhline(0.0, color="0.5", lw=0.8)
    axes.set(title="1  It shakes: forward, then back", xlabel="time, ms", ylabel="velocity, mm/s")


def _draw_friction(axes: Axes, time: Array, shown: dict[str, Array]) -> None:
    friction = -0.2 * shown["normal_force"] * np.sign(shown["velocity"])
    _shade(axes, time, shown["velocity"])
    axes.plot(time, 1e3 * friction, color=COLOURS["theory"])
    axes.axhline(0.0, color="0.5", lw=0.8)
    heavy = np.mean(shown["normal_force"][shown["velocity"] < 0])
    light = np.mean(shown["normal_force"][shown["velocity"] > 0])
    middle: dict[str, Any] = {
        "ha": "center",
        "va": "bottom",
        "transform": axes.get_xaxis_transform(),
    }
    axes.text(time[shown["velocity"] > 0].mean(), 0.72, f"normal load\n{light:.2f} N", **middle)
    back = time[: int(np.argmax(shown["velocity"] > 0))]
    axes.text(back.mean(), 0.25, f"normal load\n{heavy:.2f} N", **middle)
    title = "2  Light going forward, heavy going back"
    axes.set(title=title, xlabel="time, ms", ylabel="friction, mN")


def _draw_step(axes: Axes, time: Array, shown: dict[str, Array]) -> None:
    way = 1e6 * (shown["position"] - shown["position"][0])
    axes.plot(time, way, color=COLOURS["position"])
    step = float(way[-1])
    axes.annotate("", (time[-1], step), (time[-1], 0.0), arrowprops={"arrowstyle": "<->"})
    axes.text(time[-1] * 0.97, step / 2, f"{step:.0f} um", ha="right", va="center")
    axes.axhline(0.0, color="0.5", lw=0.8)
    axes.set(title="3  A step forward remains", xlabel="time, ms", ylabel="position, um")


def _draw_average(axes: Axes, many: dict[str, Array]) -> None:
    starts = many["position"][::4]
    slow = np.diff(starts) / PERIOD
    axes.plot(many["time"][::4][1:], 1e3 * slow, color=COLOURS["slow"])
    axes.set(
        title="4  Period by period it speeds up, and settles",
        xlabel="time, s",
        ylabel="mean of a period, mm/s",
        ylim=(0.0, 140.0),
    )


if __name__ == "__main__":
    given = [Path(argument) for argument in sys.argv[1:]]
    defaults = [ROOT / "dist" / "SliderResonator.fmu", ROOT / "docs" / "idea.png"]
    draw_idea(*(given + defaults[len(given) :]))
