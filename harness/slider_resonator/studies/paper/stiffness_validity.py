"""Where (17) holds: steady LuGre velocity and blocking load over the stiffness number kappa."""

from __future__ import annotations

from math import pi

import numpy as np
from matplotlib.figure import Figure as Drawing

from slider_resonator.fmu.instance import Instance
from slider_resonator.references import closed_forms
from slider_resonator.references.averaged import averaged_lugre, uniform_average
from slider_resonator.references.averaged.averaged_lugre import LugreCase
from slider_resonator.studies.paper.figure import SHADES, Data, PaperFigure, curve, markers, panels
from slider_resonator.studies.paper.mapping import lugre_case
from slider_resonator.studies.paper.measure import blocking_force, steady_velocity

FREQUENCY = 1000.0
CASE = LugreCase()
KAPPAS = tuple(np.geomspace(0.01, 1000.0, 11).tolist())


def stiffness_of(kappa: float) -> float:
    """Return sigma_0 of the case for kappa = sigma_0 q / (mu Omega)."""
    return kappa * CASE.friction_coefficient * FREQUENCY / CASE.strength


def _measure(instance: Instance) -> Data:
    cases = [lugre_case(CASE, FREQUENCY, stiffness_of(kappa)) for kappa in KAPPAS]
    return {
        "velocity": curve(KAPPAS, [steady_velocity(instance, values) for values in cases]),
        "blocking": curve(KAPPAS, [blocking_force(instance, values) for values in cases]),
    }


def _draw(data: Data) -> Drawing:
    drawing, axes = panels(3)
    fine = np.geomspace(KAPPAS[0], KAPPAS[-1], 81).tolist()
    uniform = [uniform_average.steady_velocity(CASE, stiffness_of(k), FREQUENCY) for k in fine]
    paper = averaged_lugre.steady_velocity(CASE)
    coulomb_strength = CASE.strength / CASE.friction_coefficient
    hard = CASE.friction_coefficient * closed_forms.steady_velocity(coulomb_strength, 1.0, pi / 2)
    axes[0].plot(fine, uniform, color=SHADES[2], label="uniform average")
    axes[0].axhline(paper, color=SHADES[0], linestyle="--", label="(17)")
    axes[0].axhline(hard, color="0.4", linestyle=":", label="(5), Coulomb")
    markers(axes[0], data["velocity"]["x"], data["velocity"]["v"], SHADES[1], "FMU")
    axes[0].set(xscale="log", ylabel="steady velocity $V$")

    points, found = KAPPAS, np.array(data["velocity"]["v"])
    averages = [uniform_average.steady_velocity(CASE, stiffness_of(k), FREQUENCY) for k in points]
    axes[1].plot(points, np.abs(paper - found), "--", color=SHADES[0], label="(17) against FMU")
    axes[1].plot(
        points, np.abs(np.array(averages) - found), color=SHADES[2], label="uniform against FMU"
    )
    axes[1].set(xscale="log", yscale="log", ylabel="error of $V$")

    blocked = [uniform_average.blocking_load(CASE, stiffness_of(k), FREQUENCY) for k in fine]
    axes[2].plot(fine, blocked, color=SHADES[2], label="uniform average")
    axes[2].axhline(
        averaged_lugre.blocking_load(CASE), color=SHADES[0], linestyle="--", label="(24)"
    )
    axes[2].axhline(
        CASE.friction_coefficient * closed_forms.blocking_load(1.0, pi / 2),
        color="0.4",
        linestyle=":",
        label="(21), Coulomb",
    )
    markers(axes[2], data["blocking"]["x"], data["blocking"]["v"], SHADES[1], "FMU")
    axes[2].set(xscale="log", ylabel="blocking load $L_b$")
    for axis in axes:
        axis.set(xlabel="$\\kappa = \\sigma_0 q / (\\mu \\Omega)$")
        axis.legend(fontsize=8)
    return drawing


FIGURE = PaperFigure(
    "stiffness_validity",
    "Where the slow manifold of the paper holds",
    "q = alpha = 1, phi = pi/2, sigma_1 = 1, mu = 0.4, Omega = 1000, sigma_0 = kappa mu Omega / q. "
    "(a) steady velocity, (b) its errors against the FMU, (c) blocking load. Markers: FMU, by "
    "shooting. (17) and (24) assume kappa << 1, Coulomb friction is the limit of large kappa.",
    _measure,
    _draw,
)
