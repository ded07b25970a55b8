"""Figure 3: steady velocity with Coulomb friction over phase, amplitude ratio and strength."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

import numpy as np
from matplotlib.figure import Figure as Drawing

from slider_resonator.fmu.instance import Instance
from slider_resonator.references import closed_forms
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
from slider_resonator.studies.paper.mapping import coulomb_case
from slider_resonator.studies.paper.measure import steady_velocity

FREQUENCY = 1000.0


@dataclass(frozen=True)
class _Panel:
    """One swept parameter; the others keep their values."""

    swept: str
    label: str
    points: tuple[float, ...]
    base: dict[str, float]

    def case(self, value: float) -> dict[str, float]:
        return {**self.base, self.swept: value}


PANELS = (
    _Panel(
        "phase",
        "phase $\\phi$ [rad]",
        tuple(np.linspace(0.0, pi, 13).tolist()),
        {"strength": 1.0, "amplitude_ratio": 1.0},
    ),
    _Panel(
        "amplitude_ratio",
        "amplitude ratio $\\alpha$",
        tuple(np.linspace(0.0, 1.0, 11).tolist()),
        {"strength": 1.0, "phase": 0.5},
    ),
    _Panel(
        "strength",
        "strength $q$",
        tuple(np.linspace(0.2, 3.0, 11).tolist()),
        {"amplitude_ratio": 1.0, "phase": 1.57},
    ),
)


def _measure(instance: Instance, progress: Progress) -> Data:
    def velocity(panel: _Panel, value: float) -> float:
        return steady_velocity(instance, coulomb_case(frequency=FREQUENCY, **panel.case(value)))

    return {
        panel.swept: sweep(
            panel.points,
            lambda value, panel=panel: velocity(panel, value),  # type: ignore[misc]
            part(progress, index, len(PANELS)),
        )
        for index, panel in enumerate(PANELS)
    }


def _draw(data: Data) -> Drawing:
    drawing, axes = panels(3)
    for axis, panel in zip(axes, PANELS, strict=True):
        fine = np.linspace(panel.points[0], panel.points[-1], 201).tolist()
        exact = [closed_forms.steady_velocity(**panel.case(x)) for x in fine]
        linear = [closed_forms.linear_velocity(**panel.case(x)) for x in fine]
        axis.plot(fine, exact, color=SHADES[0], label="(5)")
        axis.plot(fine, linear, ":", color="0.5", label="(7), small velocities")
        markers(axis, data[panel.swept]["x"], data[panel.swept]["v"], SHADES[1], "FMU")
        axis.set(xlabel=panel.label, ylabel="steady velocity $V$")
        axis.legend(fontsize=8)
    return drawing


FIGURE = PaperFigure(
    "figure_3",
    "Steady velocity with Coulomb friction",
    "(a) alpha = 1, q = 1; (b) phi = 0.5, q = 1; (c) phi = 1.57, alpha = 1. Markers: FMU by "
    "shooting, Omega = 1000. Lines: (5), dotted (7).",
    {"frequency": FREQUENCY, "panels": [[p.swept, p.points, p.base] for p in PANELS]},
    _measure,
    _draw,
)
