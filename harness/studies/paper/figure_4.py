"""Figure 4: velocity against load, Coulomb and LuGre."""

from math import pi

import numpy as np
from matplotlib.figure import Figure as Drawing

from slider_resonator.fmu.instance import Instance
from slider_resonator.references.averaged.uniform_average import LugreCase
from studies.paper import labels, slow_theory
from studies.paper.figure import SHADES, Data, PaperFigure, curve, markers, panels
from studies.paper.mapping import coulomb_case, lugre_case
from studies.paper.measure import steady_velocity

FREQUENCY = 1000.0
STIFFNESS = 100.0
STRENGTHS = (1.0, 2.0)
SHARES = tuple(np.linspace(0.0, 0.98, 8).tolist())
"""Loads as shares of the blocking load of the theory that is drawn."""


def _measure(instance: Instance) -> Data:
    data: Data = {}
    for strength in STRENGTHS:
        lugre = LugreCase(strength=strength)
        coulomb_load = slow_theory.blocking_load(1.0, pi / 2.0)
        lugre_load = slow_theory.uniform_blocking_load(lugre, STIFFNESS, FREQUENCY)
        for law, values, blocking in (
            ("Coulomb", coulomb_case(strength, FREQUENCY), coulomb_load),
            ("LuGre", lugre_case(lugre, FREQUENCY, STIFFNESS), lugre_load),
        ):
            loads = [blocking * share for share in SHARES]
            velocities = [steady_velocity(instance, {**values, "load": load}) for load in loads]
            data[f"{law} {strength:g}"] = curve(loads, velocities)
    return data


def _draw(data: Data) -> Drawing:
    drawing, axes = panels(2)
    for strength, shade, dash in zip(STRENGTHS, SHADES, ("-", "--"), strict=False):
        end = slow_theory.blocking_load(1.0, pi / 2.0)
        loads = np.linspace(0.0, end, 101).tolist()
        curve = [slow_theory.steady_velocity(strength, 1.0, pi / 2.0, load) for load in loads]
        axes[0].plot(loads, curve, dash, color=shade, label=f"(20), q = {strength:g}")
        case = LugreCase(strength=strength)
        end = slow_theory.lugre_blocking_load(case)
        loads = np.linspace(0.0, end, 101).tolist()
        curve = [slow_theory.lugre_steady_velocity(case, load) for load in loads]
        axes[1].plot(loads, curve, dash, color=shade, label=f"(23), q = {strength:g}")
        end = slow_theory.uniform_blocking_load(case, STIFFNESS, FREQUENCY)
        loads = np.linspace(0.0, end, 61).tolist()
        curve = [
            slow_theory.uniform_velocity(case, STIFFNESS, FREQUENCY, load=load) for load in loads
        ]
        axes[1].plot(loads, curve, ":", color=shade, label=f"uniform, q = {strength:g}")
        for axis, law in zip(axes, ("Coulomb", "LuGre"), strict=True):
            points = data[f"{law} {strength:g}"]
            markers(axis, points["x"], points["v"], shade, f"FMU, q = {strength:g}")
    for axis, law in zip(axes, ("Coulomb", "LuGre"), strict=True):
        axis.set(title=f"{law} friction", xlabel=labels.LOAD, ylabel=labels.STEADY_VELOCITY)
        axis.set(xlim=(0.0, None), ylim=(0.0, None))
        axis.legend(fontsize=8)
    axes[1].axvline(0.4, color="0.6", linewidth=0.8)
    axes[1].annotate(
        "$L = \\mu$",
        (0.4, 1.0),
        (3, -9),
        textcoords="offset points",
        fontsize=8,
        color="0.4",
        xycoords=("data", "axes fraction"),
    )
    return drawing


FIGURE = PaperFigure(
    "figure_4",
    "Velocity against load",
    "alpha = 1, phi = pi/2, q = 1 and 2; (b) sigma_1 = 1, mu = 0.4, sigma_0 = 100. Markers: FMU, "
    "Omega = 1000, by shooting. Lines: (20) and (23); dotted the uniform average. The "
    "blocking load of (b) lies above mu, the friction of full sliding.",
    _measure,
    _draw,
)
