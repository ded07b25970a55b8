"""Figure 5: steady velocity with LuGre friction over phase, q, alpha and mu."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

import numpy as np
from matplotlib.figure import Figure as Drawing

from slider_resonator.fmu.instance import Instance
from slider_resonator.references.averaged import averaged_lugre, uniform_average
from slider_resonator.references.averaged.averaged_lugre import LugreCase
from slider_resonator.studies.paper.figure import (
    SHADES,
    Data,
    PaperFigure,
    Progress,
    markers,
    panels,
    part,
    sweep,
)
from slider_resonator.studies.paper.mapping import lugre_case
from slider_resonator.studies.paper.measure import steady_velocity

FREQUENCY = 1000.0
STIFFNESS = 100.0


@dataclass(frozen=True)
class _Panel:
    """One swept parameter; the others are sigma_1 = 1, mu = 0.4, alpha = q = 1, phi = 1.57."""

    swept: str
    label: str
    points: tuple[float, ...]

    def case(self, value: float) -> LugreCase:
        return LugreCase(**{"phase": 1.57, self.swept: value})


PANELS = (
    _Panel("phase", "phase $\\phi$ [rad]", tuple(np.linspace(0.0, pi, 11).tolist())),
    _Panel("strength", "strength $q$", tuple(np.linspace(0.25, 2.5, 10).tolist())),
    _Panel("amplitude_ratio", "amplitude ratio $\\alpha$", tuple(np.linspace(0, 1, 9).tolist())),
    _Panel(
        "friction_coefficient", "friction coefficient $\\mu$", (0.1, 0.2, 0.3, 0.4, 0.6, 0.8, 1.0)
    ),
)


def _measure(instance: Instance, progress: Progress) -> Data:
    return {
        panel.swept: sweep(
            panel.points,
            lambda value, panel=panel: steady_velocity(  # type: ignore[misc]
                instance, lugre_case(panel.case(value), FREQUENCY, STIFFNESS)
            ),
            part(progress, index, len(PANELS)),
        )
        for index, panel in enumerate(PANELS)
    }


def _draw(data: Data) -> Drawing:
    drawing, axes = panels(4, height=3.0)
    for axis, panel in zip(axes, PANELS, strict=True):
        fine = np.linspace(panel.points[0], panel.points[-1], 61).tolist()
        cases = [panel.case(x) for x in fine]
        paper = [averaged_lugre.steady_velocity(case) for case in cases]
        uniform = [uniform_average.steady_velocity(case, STIFFNESS, FREQUENCY) for case in cases]
        axis.plot(fine, paper, color=SHADES[0], label="(17)")
        axis.plot(fine, uniform, ":", color=SHADES[2], label="uniform average")
        markers(axis, data[panel.swept]["x"], data[panel.swept]["v"], SHADES[1], "FMU")
        axis.set(xlabel=panel.label, ylabel="steady velocity $V$")
        axis.legend(fontsize=8)
    return drawing


FIGURE = PaperFigure(
    "figure_5",
    "Steady velocity with LuGre friction",
    "sigma_1 = 1 and, where not swept, mu = 0.4, alpha = 1, q = 1, phi = 1.57. Markers: FMU, "
    "sigma_0 = 100, Omega = 1000, by shooting. Lines: (17), dotted the uniform average.",
    {
        "frequency": FREQUENCY,
        "stiffness": STIFFNESS,
        "panels": [[p.swept, p.points] for p in PANELS],
        "base": lugre_case(LugreCase(phase=1.57), FREQUENCY, STIFFNESS),
    },
    _measure,
    _draw,
)
