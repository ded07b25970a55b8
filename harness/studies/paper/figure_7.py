"""Figure 7: the device with its resonator against the single-degree-of-freedom model."""

from math import pi

import numpy as np
from matplotlib.figure import Figure as Drawing

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.fmu.instance import Instance
from slider_resonator.references.averaged.averaged_motion import slow_start, slow_trajectory
from slider_resonator.references.equivalent_force import equivalent_force
from studies.paper import labels, slow_theory
from studies.paper.figure import SHADES, Data, PaperFigure, markers, panels
from studies.paper.mapping import resonator_case
from studies.paper.measure import plain, record

PHASE = 0.85
CASE = resonator_case(0.1, 100.0, 100.0, 0.01, amplitude_ratio=1.0, phase=PHASE, damping_ratio=0.05)
FIDELITIES = {2: "two degrees of freedom", 1: "one degree of freedom"}
PERIOD = 2.0 * pi / 100.0
STOP_PERIODS = 160
POINTS_PER_PERIOD = 40
ZOOM_PERIODS = 3


def _measure(instance: Instance) -> Data:
    stop, points = STOP_PERIODS * PERIOD, STOP_PERIODS * POINTS_PER_PERIOD
    return {
        str(fidelity): plain(record(instance, {**CASE, "fidelity": fidelity}, stop, points))
        for fidelity in FIDELITIES
    }


def averaged_trajectory(times: Array) -> tuple[Array, Array]:
    """Return the averaged position and velocity (4) from rest at times, each shape (n,).

    Both models start with the momentum of the device at rest, and so with one slow velocity.
    """
    device = Device.from_mapping({k: v for k, v in CASE.items() if k != "phase"})
    force = equivalent_force(device)
    phase, strength = PHASE + force.angle, slow_theory.strength_of(device)
    return slow_trajectory(
        lambda time, velocity: slow_theory.slow_acceleration(velocity, strength, 1.0, phase),
        times,
        slow_start(device),
    )


def _draw(data: Data) -> Drawing:
    drawing, axes = panels(3)
    times = np.linspace(0.0, STOP_PERIODS * PERIOD, 401)
    position, velocity = averaged_trajectory(times)
    axes[0].plot(times, position, ":", color="0.3", label="(4)")
    axes[1].plot(times, velocity, ":", color="0.3", label="(4)")
    for fidelity, shade in zip(FIDELITIES, SHADES, strict=False):
        run = {name: np.array(values) for name, values in data[str(fidelity)].items()}
        whole = run["position"][::POINTS_PER_PERIOD]
        instants = run["time"][::POINTS_PER_PERIOD]
        name = f"FMU, {FIDELITIES[fidelity]}"
        axes[0].plot(instants, whole, color=shade, label=name)
        middles, means = 0.5 * (instants[1:] + instants[:-1]), np.diff(whole) / PERIOD
        chosen = [*range(0, 40, 2), *range(40, STOP_PERIODS, 10)]
        markers(axes[1], middles[chosen], means[chosen], shade, f"{name}, mean of a period")
        last = slice(-ZOOM_PERIODS * POINTS_PER_PERIOD - 1, None)
        dash = "-" if fidelity == 2 else "--"
        turns = (run["time"][last] - run["time"][-1]) / PERIOD
        axes[2].plot(turns, run["velocity"][last], dash, color=shade, label=name)
    axes[0].set(xlabel=labels.TIME, ylabel=labels.DISPLACEMENT)
    axes[1].set(xlabel=labels.TIME, ylabel="slow velocity [$x_0 \\omega_0$]")
    axes[2].set(xlabel="drive periods before the end", ylabel="velocity [$x_0 \\omega_0$]")
    axes[2].set_ylim(-0.3, 1.6)
    for axis in axes:
        axis.legend(fontsize=7.5)
    axes[1].set_ylim(-0.15, None)
    return drawing


FIGURE = PaperFigure(
    "figure_7",
    "Two degrees of freedom against one",
    "r_m = 0.1, Omega_n = Omega = 100, a = 0.01, alpha = 1, phi_1 = 0.85, xi = 0.05, from rest. "
    "(a) displacement at whole periods, (b) velocity averaged over a period, (c) velocity in full "
    "over the last periods. FMU with fidelity 2 and 1; dotted (4) from "
    "the slow velocity that both have at the start.",
    _measure,
    _draw,
)
