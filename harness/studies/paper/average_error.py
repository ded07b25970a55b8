"""How fast averages become right: error of the steady velocity over the drive frequency."""

import numpy as np
from matplotlib.figure import Figure as Drawing

from slider_resonator.arrays import Array
from slider_resonator.fmu.instance import Instance
from slider_resonator.references.averaged.uniform_average import LugreCase
from studies.paper import labels, slow_theory
from studies.paper.figure import SHADES, Data, PaperFigure, curve, panels
from studies.paper.mapping import coulomb_case, lugre_case, stiffness_of
from studies.paper.measure import steady_velocity

PHASE, AMPLITUDE_RATIO = 1.0, 0.8
CASE = LugreCase(phase=PHASE, amplitude_ratio=AMPLITUDE_RATIO)
COULOMB_FREQUENCIES = tuple(np.geomspace(10.0, 10000.0, 13).tolist())
LUGRE_FREQUENCIES = tuple(np.geomspace(30.0, 3000.0, 7).tolist())
KAPPAS = (0.25, 2.5, 25.0)


def _measure(instance: Instance) -> Data:
    cases = {"Coulomb": [coulomb_case(1.0, w, AMPLITUDE_RATIO, PHASE) for w in COULOMB_FREQUENCIES]}
    for kappa in KAPPAS:
        cases[f"LuGre {kappa:g}"] = [
            lugre_case(CASE, w, stiffness_of(kappa, CASE, w)) for w in LUGRE_FREQUENCIES
        ]
    return {
        name: curve(
            [values["drive_frequency"] for values in group],
            [steady_velocity(instance, values) for values in group],
        )
        for name, group in cases.items()
    }


def errors(data: Data) -> dict[str, tuple[Array, Array]]:
    """Return frequencies and errors of the average, each shape (n,), by case."""
    result = {}
    for name, points in data.items():
        frequencies = np.array(points["x"])
        if name == "Coulomb":
            average = slow_theory.steady_velocity(1.0, AMPLITUDE_RATIO, PHASE)
        else:
            # At a given kappa the average does not depend on the frequency.
            stiffness = stiffness_of(float(name.split()[1]), CASE, 1000.0)
            average = slow_theory.uniform_velocity(CASE, stiffness, 1000.0)
        result[name] = frequencies, np.abs(np.array(points["v"]) - average)
    return result


def slope(frequencies: Array, error: Array) -> float:
    """Return the exponent of the power law through the errors."""
    return float(np.polyfit(np.log(frequencies), np.log(error), 1)[0])


def _draw(data: Data) -> Drawing:
    drawing, (axis,) = panels(1)
    for (name, (frequencies, error)), shade in zip(errors(data).items(), SHADES, strict=False):
        law, _, kappa = name.partition(" ")
        case = f"{law}, $\\kappa$ = {kappa}" if kappa else law
        label = f"{case}: slope {slope(frequencies, error):.2f}"
        axis.loglog(frequencies, error, "o-", markersize=4, color=shade, label=label)
    ends = np.array([10.0, 10000.0])
    axis.loglog(ends, 1.0 / ends, ":", color="0.4", label="$1 / \\Omega$")
    axis.set(xlabel=labels.FREQUENCY, ylabel="error of the averaged velocity [$x_0 \\omega_0$]")
    axis.legend(fontsize=8)
    return drawing


FIGURE = PaperFigure(
    "average_error",
    "Error of the averages over the drive frequency",
    "q = 1, alpha = 0.8, phi = 1; LuGre sigma_1 = 1, mu = 0.4 and kappa = sigma_0 q / (mu Omega) "
    "held. FMU by shooting against (5) and the uniform average.",
    _measure,
    _draw,
)
