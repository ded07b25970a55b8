"""Figure 5: steady velocity with LuGre friction over phase, q, alpha and mu."""

from math import pi

import numpy as np

from slider_resonator.fmu.instance import Instance
from slider_resonator.references.averaged.uniform_average import LugreCase
from studies.paper import slow_theory
from studies.paper.figure import SHADES, Line, SweptPanel, swept_figure
from studies.paper.mapping import lugre_case
from studies.paper.measure import steady_velocity

FREQUENCY = 1000.0
STIFFNESS = 100.0
FIXED = {"phase": 1.57}
"""The others are sigma_1 = 1, mu = 0.4, alpha = q = 1."""
MU = (0.1, 0.2, 0.3, 0.4, 0.6, 0.8, 1.0)
PANELS = tuple(
    SweptPanel(swept, label, tuple(points), FIXED)
    for swept, label, points in (
        ("phase", "phase $\\phi$ [rad]", np.linspace(0.0, pi, 11).tolist()),
        ("strength", "strength $q$ [1]", np.linspace(0.25, 2.5, 10).tolist()),
        ("amplitude_ratio", "amplitude ratio $\\alpha$ [1]", np.linspace(0.0, 1.0, 9).tolist()),
        ("friction_coefficient", "friction coefficient $\\mu$ [1]", MU),
    )
)


def _velocity(instance: Instance, case: dict[str, float]) -> float:
    return steady_velocity(instance, lugre_case(LugreCase(**case), FREQUENCY, STIFFNESS))


def _uniform(case: dict[str, float]) -> float:
    return slow_theory.uniform_velocity(LugreCase(**case), STIFFNESS, FREQUENCY)


LINES = (
    Line("(17)", "-", SHADES[0], lambda case: slow_theory.lugre_steady_velocity(LugreCase(**case))),
    Line("uniform average", ":", SHADES[2], _uniform),
)
FIGURE = swept_figure(
    "figure_5",
    "Steady velocity with LuGre friction",
    "sigma_1 = 1 and, where not swept, mu = 0.4, alpha = 1, q = 1, phi = 1.57. Markers: FMU, "
    "sigma_0 = 100, Omega = 1000, by shooting. Lines: (17), dotted the uniform average.",
    _velocity,
    PANELS,
    LINES,
    height=3.0,
)
