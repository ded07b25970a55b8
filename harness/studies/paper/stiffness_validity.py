"""Where (17) holds: steady LuGre velocity and blocking load over the stiffness number kappa."""

from collections.abc import Iterable
from math import pi

import numpy as np
from matplotlib.figure import Figure as Drawing

from slider_resonator.arrays import Array
from slider_resonator.fmu.instance import Instance
from slider_resonator.references.averaged.uniform_average import LugreCase
from studies.paper import labels, slow_theory
from studies.paper.figure import SHADES, Data, PaperFigure, curve, markers, panels
from studies.paper.mapping import lugre_case, stiffness_of
from studies.paper.measure import blocking_force, steady_velocity

FREQUENCY = 1000.0
CASE = LugreCase()
KAPPAS = tuple(np.geomspace(0.01, 1000.0, 11).tolist())


def _measure(instance: Instance) -> Data:
    cases = [lugre_case(CASE, FREQUENCY, stiffness) for stiffness in _stiffnesses(KAPPAS)]
    return {
        "velocity": curve(KAPPAS, [steady_velocity(instance, values) for values in cases]),
        "blocking": curve(KAPPAS, [blocking_force(instance, values) for values in cases]),
    }


def _draw(data: Data) -> Drawing:
    drawing, (velocity, error, blocking) = panels(3)
    fine = np.geomspace(KAPPAS[0], KAPPAS[-1], 81).tolist()
    coulomb_strength = CASE.strength / CASE.friction_coefficient
    hard = CASE.friction_coefficient * slow_theory.steady_velocity(coulomb_strength, 1.0, pi / 2)
    paper = slow_theory.lugre_steady_velocity(CASE)
    velocity.plot(fine, _uniform_velocity(fine), color=SHADES[2], label="uniform average")
    velocity.axhline(paper, color=SHADES[0], linestyle="--", label="(17)")
    velocity.axhline(hard, color="0.4", linestyle=":", label="(5), Coulomb")
    markers(velocity, data["velocity"]["x"], data["velocity"]["v"], SHADES[1], "FMU")
    velocity.set(ylabel=labels.STEADY_VELOCITY)

    found = np.array(data["velocity"]["v"])
    uniform = np.abs(_uniform_velocity(KAPPAS) - found)
    error.plot(KAPPAS, np.abs(paper - found), "--", color=SHADES[0], label="(17) against FMU")
    error.plot(KAPPAS, uniform, color=SHADES[2], label="uniform against FMU")
    error.set(yscale="log", ylabel="error of $V$ [$x_0 \\omega_0$]")

    blocked = [slow_theory.uniform_blocking_load(CASE, s, FREQUENCY) for s in _stiffnesses(fine)]
    paper = slow_theory.lugre_blocking_load(CASE)
    hard = CASE.friction_coefficient * slow_theory.blocking_load(1.0, pi / 2)
    blocking.plot(fine, blocked, color=SHADES[2], label="uniform average")
    blocking.axhline(paper, color=SHADES[0], linestyle="--", label="(24)")
    blocking.axhline(hard, color="0.4", linestyle=":", label="(21), Coulomb")
    markers(blocking, data["blocking"]["x"], data["blocking"]["v"], SHADES[1], "FMU")
    blocking.set(ylabel="blocking load $L_b$ [$m x_0 \\omega_0^2$]")
    for axis in (velocity, error, blocking):
        axis.set(xscale="log", xlabel="$\\kappa = \\sigma_0 q / (\\mu \\Omega)$ [1]")
        axis.legend(fontsize=8)
    return drawing


def _stiffnesses(kappas: Iterable[float]) -> list[float]:
    return [stiffness_of(kappa, CASE, FREQUENCY) for kappa in kappas]


def _uniform_velocity(kappas: Iterable[float]) -> Array:
    stiffnesses = _stiffnesses(kappas)
    return np.array([slow_theory.uniform_velocity(CASE, s, FREQUENCY) for s in stiffnesses])


FIGURE = PaperFigure(
    "stiffness_validity",
    "Where the slow manifold of the paper holds",
    "q = alpha = 1, phi = pi/2, sigma_1 = 1, mu = 0.4, Omega = 1000, sigma_0 = kappa mu Omega / q. "
    "(a) steady velocity, (b) its errors against the FMU, (c) blocking load. Markers: FMU, by "
    "shooting. (17) and (24) assume kappa << 1, Coulomb friction is the limit of large kappa.",
    _measure,
    _draw,
)
