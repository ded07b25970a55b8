"""Table: blocking force with LuGre friction from soft to hard bristles, and what predicts it."""

from __future__ import annotations

import numpy as np

from slider_resonator.fmu.instance import Instance
from slider_resonator.references.averaged import averaged_lugre, uniform_average
from slider_resonator.references.averaged.averaged_lugre import LugreCase
from slider_resonator.studies.paper.mapping import lugre_case
from slider_resonator.studies.paper.measure import blocking_force
from slider_resonator.studies.paper.table import PaperTable, rows_over

CASE = LugreCase()
FREQUENCY = 1000.0
KAPPAS = tuple(np.geomspace(0.01, 1000.0, 11).tolist())


def _row(instance: Instance, kappa: float) -> dict[str, float]:
    stiffness = kappa * CASE.friction_coefficient * FREQUENCY / CASE.strength
    direct = blocking_force(instance, lugre_case(CASE, FREQUENCY, stiffness))
    uniform = uniform_average.blocking_load(CASE, stiffness, FREQUENCY)
    paper = averaged_lugre.blocking_load(CASE)
    return {
        "kappa": kappa,
        "stiffness": stiffness,
        "direct": direct,
        "uniform": uniform,
        "paper": paper,
        "uniform_deviation": uniform / direct - 1.0,
        "paper_deviation": paper / direct - 1.0,
    }


TABLE = PaperTable(
    "lugre_blocking",
    "Blocking force with LuGre friction",
    "q = alpha = sigma_1 = 1, mu = 0.4, phi = pi/2, Omega = 1000; one degree of freedom; forces in "
    "N0. (24) holds for kappa << 1. Coulomb friction, the limit of large kappa, has "
    "2 mu / pi = 0.254648. Deviations are relative to the force of the FMU.",
    {
        "kappa": "sigma_0 q / (mu Omega)",
        "stiffness": "sigma_0",
        "direct": "FMU by shooting",
        "uniform": "uniform average",
        "paper": "(24)",
        "uniform_deviation": "uniform / FMU - 1",
        "paper_deviation": "(24) / FMU - 1",
    },
    {"uniform_deviation": 2e-3},
    rows_over(KAPPAS, _row),
)
