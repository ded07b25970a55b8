"""Figure 8: normal and tangential frequencies that differ."""

from math import pi

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure as Drawing

from slider_resonator.device.device import Device
from slider_resonator.fmu.instance import Instance
from slider_resonator.references.averaged.averaged_motion import slow_start, slow_trajectory
from slider_resonator.references.averaged.device_average import steady_velocity
from slider_resonator.references.equivalent_force import equivalent_force
from slider_resonator.steady.searches import find_steady
from studies.paper import labels, slow_theory
from studies.paper.figure import SHADES, Data, PaperFigure, markers, panels
from studies.paper.measure import plain, record

DEVICE = Device()
PERIOD = 2.0 * pi / DEVICE.drive_frequency
RATIOS = tuple((np.arange(1, 31) / 4.0).tolist())
PHASES = tuple(np.linspace(0.0, 2.0 * pi, 17).tolist())
SHOWN_RATIOS = (1.0, 3.0, 5.0)
DETUNINGS = (1.0, 2.0, 4.0)
HISTORY_RATIOS = (1.0, 3.0, 5.0, 1.5)
STOP = 16.0
POINTS = 400


def velocity_at(instance: Instance, phase: float, ratio: float) -> float | None:
    """Return the FMU's steady velocity in x0 w0 by shooting; None where it finds none."""
    velocity = find_steady(instance, {"phase": phase, "frequency_ratio": ratio}).steady_velocity
    return None if velocity is None else velocity / slow_theory.length_scale(DEVICE)


def _measure(instance: Instance) -> Data:
    def history(ratio: float) -> Data:
        return plain(record(instance, {"frequency_ratio": ratio}, STOP, POINTS))

    return {
        "ratio": [velocity_at(instance, 0.0, ratio) for ratio in RATIOS],
        "phase": {
            f"{ratio:g}": [velocity_at(instance, phase, ratio) for phase in PHASES]
            for ratio in SHOWN_RATIOS
        },
        "detuned": {f"{d:g}": history(1.0 + d / DEVICE.drive_frequency) for d in DETUNINGS},
        "history": {f"{ratio:g}": history(ratio) for ratio in HISTORY_RATIOS},
    }


def _draw(data: Data) -> Drawing:
    drawing, axes = panels(4, height=3.2)
    _over_ratio(axes[0], data)
    _over_phase(axes[1], data)
    _detuned(axes[2], data)
    _histories(axes[3], data)
    for axis in axes:
        axis.legend(fontsize=7.5)
    return drawing


def _scaled(phase: float, ratio: float) -> float:
    length = slow_theory.length_scale(DEVICE)
    return steady_velocity(DEVICE, phase, 0.0, ratio) / length


def _over_ratio(axis: Axes, data: Data) -> None:
    axis.axhline(0.0, color="0.4", linewidth=0.6)
    integers = [float(n) for n in range(1, 8)]
    averages = [_scaled(0.0, n) for n in integers]
    axis.vlines(integers, 0.0, averages, color=SHADES[0], label="average at integer ratios")
    markers(axis, RATIOS, data["ratio"], SHADES[1], "FMU")
    axis.set(xlabel=labels.RATIO, ylabel=labels.STEADY_VELOCITY)


def _over_phase(axis: Axes, data: Data) -> None:
    fine = np.linspace(0.0, 2.0 * pi, 121).tolist()
    for ratio, shade in zip(SHOWN_RATIOS, SHADES, strict=False):
        axis.plot(fine, [_scaled(p, ratio) for p in fine], color=shade)
        values = data["phase"][f"{ratio:g}"]
        markers(axis, PHASES, values, shade, f"$\\lambda$ = {ratio:g}")
    axis.set(xlabel="phase $\\phi_1$ [rad]", ylabel=labels.STEADY_VELOCITY)


def _detuned(axis: Axes, data: Data) -> None:
    force, strength = equivalent_force(DEVICE), slow_theory.strength_of(DEVICE)
    times = np.linspace(0.0, STOP, 401)
    for detuning, shade in zip(DETUNINGS, SHADES, strict=False):

        def acceleration(time: float, velocity: float, detuning: float = detuning) -> float:
            phase = detuning * time + force.angle  # psi of (A.1)
            return slow_theory.slow_acceleration(velocity, strength, 1.0, phase)

        start = slow_start(DEVICE) / slow_theory.length_scale(DEVICE)
        axis.plot(times, slow_trajectory(acceleration, times, start)[0], color=shade)
        run = data["detuned"][f"{detuning:g}"]
        position = np.array(run["position"]) / slow_theory.length_scale(DEVICE)
        label = f"$\\Delta\\Omega$ = {detuning:g}"
        markers(axis, run["time"][::8], position[::8], shade, label)
    axis.set(xlabel=labels.TIME, ylabel=labels.DISPLACEMENT, ylim=(0.0, 2.3))


def _histories(axis: Axes, data: Data) -> None:
    length = slow_theory.length_scale(DEVICE)
    for ratio, shade in zip(HISTORY_RATIOS, SHADES, strict=False):
        run = data["history"][f"{ratio:g}"]
        position = np.array(run["position"]) / length
        axis.plot(run["time"], position, color=shade, label=f"$\\lambda$ = {ratio:g}")
    axis.set(xlabel=labels.TIME, ylabel=labels.DISPLACEMENT)


FIGURE = PaperFigure(
    "figure_8",
    "Different frequencies of normal load and drive",
    "The device of table 1 (Omega = Omega_n = 3500, a = 0.00055, mu = 0.1, r_m = 0.0909, "
    "alpha = 1, xi = 0.05), lengths in x0, time in 1/w0. (a) phi_1 = 0; (b) over phi_1; (c) "
    "small detuning, lambda = 1 + DeltaOmega / Omega; (d) from rest. Markers: FMU, by shooting "
    "in (a) and (b). Lines: the average at integer ratios in (a) and (b), (A.2) in (c), the "
    "FMU in (d).",
    _measure,
    _draw,
)
