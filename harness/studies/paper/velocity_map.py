"""Steady velocity of the device of table 1 over frequency ratio and phase."""

from math import pi

import numpy as np
from matplotlib.figure import Figure as Drawing

from slider_resonator.fmu.instance import Instance
from slider_resonator.references.averaged.device_average import steady_velocity
from studies.paper import labels, slow_theory
from studies.paper.figure import Data, PaperFigure, panels
from studies.paper.figure_8 import DEVICE, velocity_at

RATIOS = tuple((np.arange(2, 21) / 4.0).tolist())
PHASES = tuple(np.linspace(-pi, pi, 25)[:-1].tolist())


def _measure(instance: Instance) -> Data:
    rows = [[velocity_at(instance, phase, ratio) for phase in PHASES] for ratio in RATIOS]
    return {"velocity": rows}


def _draw(data: Data) -> Drawing:
    drawing, axes = panels(2)
    length = slow_theory.length_scale(DEVICE)
    found = np.array(data["velocity"], dtype=np.float64)
    theory = [[steady_velocity(DEVICE, p, 0.0, r) / length for p in PHASES] for r in RATIOS]
    for axis, values, title in zip(
        axes, (found, np.array(theory)), ("FMU", "average"), strict=True
    ):
        axis.grid(False)
        axis.set_facecolor("0.75")
        image = axis.pcolormesh(RATIOS, PHASES, values.T, cmap="RdBu_r", vmin=-0.9, vmax=0.9)
        axis.set(title=title, xlabel=labels.RATIO, ylabel="phase $\\phi_1$ [rad]")
    drawing.colorbar(image, ax=axes, label=labels.STEADY_VELOCITY)
    return drawing


FIGURE = PaperFigure(
    "velocity_map",
    "Steady velocity over frequency ratio and phase",
    "The device of table 1. (a) FMU by shooting at ratios of quarters, grey where it finds no "
    "steady motion; (b) the average: integer ratios drive the slider, at others only the mean load "
    "counts.",
    _measure,
    _draw,
)
