"""Figure 3: steady velocity with Coulomb friction over phase, amplitude ratio and strength."""

from math import pi

import numpy as np

from slider_resonator.fmu.instance import Instance
from studies.paper import slow_theory
from studies.paper.figure import SHADES, Line, SweptPanel, swept_figure
from studies.paper.mapping import coulomb_case
from studies.paper.measure import steady_velocity

FREQUENCY = 1000.0


def _velocity(instance: Instance, case: dict[str, float]) -> float:
    return steady_velocity(instance, coulomb_case(frequency=FREQUENCY, **case))


PANELS = (
    SweptPanel(
        "phase",
        "phase $\\phi$ [rad]",
        tuple(np.linspace(0.0, pi, 13).tolist()),
        {"strength": 1.0, "amplitude_ratio": 1.0},
    ),
    SweptPanel(
        "amplitude_ratio",
        "amplitude ratio $\\alpha$ [1]",
        tuple(np.linspace(0.0, 1.0, 11).tolist()),
        {"strength": 1.0, "phase": 0.5},
    ),
    SweptPanel(
        "strength",
        "strength $q$ [1]",
        tuple(np.linspace(0.2, 3.0, 11).tolist()),
        {"amplitude_ratio": 1.0, "phase": 1.57},
    ),
)
LINES = (
    Line("(5)", "-", SHADES[0], lambda case: slow_theory.steady_velocity(**case)),
    Line("(7), small velocities", ":", "0.5", lambda case: slow_theory.linear_velocity(**case)),
)
FIGURE = swept_figure(
    "figure_3",
    "Steady velocity with Coulomb friction",
    "(a) alpha = 1, q = 1; (b) phi = 0.5, q = 1; (c) phi = 1.57, alpha = 1. Markers: FMU by "
    "shooting, Omega = 1000. Lines: (5), dotted (7).",
    _velocity,
    PANELS,
    LINES,
)
