"""Draw docs/picture.png of the README: slow and fast motion of table 1, and its load-speed curve.

python docs/draw_picture.py [FMU [PICTURE]]
"""

import sys
from dataclasses import dataclass
from math import pi
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine

from slider_resonator.device.device import Device
from slider_resonator.device.schedule import schedule
from slider_resonator.fmu.instance import Instance, instantiate
from slider_resonator.fmu.opening import open_fmu
from slider_resonator.fmu.run import Record, run
from slider_resonator.output.plot_style import COLOURS, save, shade_directions, style
from slider_resonator.references.averaged.device_average import blocking_force, steady_velocity
from slider_resonator.steady.searches import find_steady

ROOT = Path(__file__).resolve().parents[1]
DEVICE = Device()
PERIOD = 2.0 * pi / DEVICE.drive_frequency
APPROACH_PERIODS = 5000
ZOOM_PERIODS = 3
POINTS_PER_PERIOD = 120
PHASES = (0.0, 0.4)
MARKER_LOADS = np.linspace(-0.18, 0.18, 9)
CURVE_LOADS = np.linspace(-0.1999, 0.1999, 241)


@dataclass(frozen=True)
class _Measured:
    """What the FMU contributes: two runs, and velocities (m/s) at `MARKER_LOADS` for each phase."""

    approach: Record
    zoom: Record
    velocities: dict[float, list[float]]


def draw_picture(fmu_path: Path, path: Path) -> None:
    """Run the FMU and write the picture, 1200 pixels wide, to `path`."""
    with open_fmu(fmu_path) as fmu, instantiate(fmu) as instance:
        measured = _measure(instance)
    with style():
        figure = Figure(figsize=(8.0, 4.7), layout=ConstrainedLayoutEngine(w_pad=0.06, wspace=0.03))
        panels = figure.subplot_mosaic(
            [["slow", "load"], ["fast", "load"]], width_ratios=[1.25, 1.0]
        )
        _draw_approach(panels["slow"], measured.approach)
        _draw_zoom(panels["fast"], measured.zoom)
        _draw_load_speed(panels["load"], measured.velocities)
        save(figure, path)


def _measure(instance: Instance) -> _Measured:
    approach = run(instance, {}, schedule(APPROACH_PERIODS * PERIOD, 5 * PERIOD))
    steady = find_steady(instance, {})
    initial = {f"initial_{name}": value for name, value in steady.state.items()}
    zoom = run(instance, initial, schedule(ZOOM_PERIODS * PERIOD, PERIOD / POINTS_PER_PERIOD))
    velocities = {}
    for phase in PHASES:
        motions = [find_steady(instance, {"phase": phase, "load": load}) for load in MARKER_LOADS]
        velocities[phase] = [
            float("nan") if motion.steady_velocity is None else motion.steady_velocity
            for motion in motions
        ]
    return _Measured(approach, zoom, velocities)


def _draw_approach(axes: Axes, record: Record) -> None:
    predicted = 1e3 * steady_velocity(DEVICE, 0.0, 0.0, 1.0)
    axes.axhline(predicted, color=COLOURS["theory"], linestyle="--")
    axes.annotate(
        f"averaged theory {predicted:.1f} mm/s",
        (record.times[-1], predicted),
        xytext=(0, 4),
        textcoords="offset points",
        ha="right",
        color=COLOURS["theory"],
    )
    axes.plot(record.times, 1e3 * record["mean_velocity"], color=COLOURS["slow"])
    axes.set(
        title="From rest to steady motion",
        xlabel="time [s]",
        ylabel="slow velocity [mm/s]",
        xlim=(0.0, record.times[-1]),
        ylim=(0.0, 1.18 * predicted),
    )


def _draw_zoom(axes: Axes, record: Record) -> None:
    periods = record.times / PERIOD
    entries = shade_directions(axes, periods, record["contact_mode"])
    axes.plot(periods, 1e3 * record["velocity"], color=COLOURS["velocity"])
    axes.axhline(0.0, color="0.4", linewidth=0.6)
    axes.set(
        title="Steady motion, 557 Hz, in full",
        xlabel="drive periods",
        ylabel="velocity [mm/s]",
        xlim=(0.0, ZOOM_PERIODS),
        ylim=(-190.0, 520.0),
    )
    axes.legend(
        handles=entries, loc="upper right", ncols=len(entries), framealpha=0.8, edgecolor="none"
    ).set_frame_on(True)


def _draw_load_speed(axes: Axes, velocities: dict[float, list[float]]) -> None:
    for phase, shade in zip(PHASES, (COLOURS["theory"], "#8a6fae"), strict=True):
        curve = [1e3 * steady_velocity(DEVICE, phase, load, 1.0) for load in CURVE_LOADS]
        axes.plot(1e3 * CURVE_LOADS, curve, color=shade, label=f"theory, phase {phase:g} rad")
        axes.plot(
            1e3 * MARKER_LOADS,
            1e3 * np.array(velocities[phase]),
            linestyle="none",
            marker="o",
            markersize=5,
            markerfacecolor="white",
            markeredgecolor=shade,
            markeredgewidth=1.3,
            label=f"FMU, phase {phase:g} rad",
        )
    blocking = 1e3 * blocking_force(DEVICE, PHASES[0], 1.0)
    axes.axhline(0.0, color="0.4", linewidth=0.6)
    axes.annotate(
        f"blocking force\n{blocking:.1f} mN",
        (blocking, 0.0),
        xytext=(-12, -46),
        textcoords="offset points",
        ha="right",
        arrowprops={"arrowstyle": "-", "color": "0.4", "linewidth": 0.8},
    )
    axes.set(title="Load-speed curve", xlabel="load [mN]", ylabel="steady velocity [mm/s]")
    axes.legend(loc="lower left")


if __name__ == "__main__":
    given = [Path(argument) for argument in sys.argv[1:]]
    defaults = [ROOT / "dist" / "SliderResonator.fmu", ROOT / "docs" / "picture.png"]
    draw_picture(*given, *defaults[len(given) :])
