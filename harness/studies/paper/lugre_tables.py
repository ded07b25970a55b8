"""Tables of LuGre friction from soft to hard bristles: the blocking force, and table 1's device."""

import numpy as np

from slider_resonator.device.device import Device
from slider_resonator.fmu.instance import Instance
from slider_resonator.references.averaged import device_average
from slider_resonator.references.averaged.uniform_average import LugreCase
from slider_resonator.references.equivalent_force import equivalent_force
from studies.paper import slow_theory
from studies.paper.mapping import lugre_case, stiffness_of
from studies.paper.measure import blocking_force, steady_velocity
from studies.paper.table import PaperTable

KAPPAS = tuple(np.geomspace(0.01, 1000.0, 11).tolist())
CASE = LugreCase()
FREQUENCY = 1000.0
TABLE_1 = Device(friction_law=1)


def _blocking_row(instance: Instance, kappa: float) -> dict[str, float]:
    stiffness = stiffness_of(kappa, CASE, FREQUENCY)
    direct = blocking_force(instance, lugre_case(CASE, FREQUENCY, stiffness))
    uniform = slow_theory.uniform_blocking_load(CASE, stiffness, FREQUENCY)
    paper = slow_theory.lugre_blocking_load(CASE)
    return {
        "kappa": kappa,
        "stiffness": stiffness,
        "direct": direct,
        "uniform": uniform,
        "paper": paper,
        "uniform_deviation": uniform / direct - 1.0,
        "paper_deviation": paper / direct - 1.0,
    }


BLOCKING = PaperTable(
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
    *(KAPPAS, _blocking_row),
)


def _device_row(instance: Instance, kappa: float) -> dict[str, float]:
    fast = equivalent_force(TABLE_1).velocity_amplitude
    coefficient = TABLE_1.friction_coefficient
    stiffness = kappa * coefficient * TABLE_1.drive_frequency / fast
    greatest = coefficient + TABLE_1.bristle_damping * fast
    friction = TABLE_1.friction_faces * TABLE_1.normal_preload * greatest
    device = Device(friction_law=1, bristle_stiffness=stiffness)
    values = {"friction_law": 1.0, "bristle_stiffness": stiffness}
    two, one = (steady_velocity(instance, {**values, "fidelity": f}) for f in (2.0, 1.0))
    force = blocking_force(instance, values)
    velocity = device_average.steady_velocity(device, 0.0, 0.0, 1.0)
    blocking = device_average.blocking_force(device, 0.0, 1.0)
    return {
        "kappa": kappa,
        "stiffness": stiffness,
        "velocity": two,
        "one": one,
        "uniform_velocity": velocity,
        "velocity_deviation": (velocity - two) / fast,
        "force": force,
        "uniform_force": blocking,
        "force_deviation": (blocking - force) / friction,
    }


DEVICE = PaperTable(
    "lugre_device",
    "The device of table 1 with LuGre friction",
    "Steady velocity and blocking force of the device with its resonator, sigma_1 = 10 s/m, phase "
    "0. Velocities deviate in units of the fast velocity v_q = 0.2366 m/s, forces in units of the "
    "largest friction, faces N0 (mu + sigma_1 v_q) = 4.93 N: the average neglects the ratio of "
    "friction to drive. Coulomb friction has 0.126667 m/s and 0.0851861 N.",
    {
        "kappa": "sigma_0 v_q / (mu w)",
        "stiffness": "sigma_0 [1/m]",
        "velocity": "V, FMU fidelity 2 [m/s]",
        "one": "V, FMU fidelity 1 [m/s]",
        "uniform_velocity": "V, uniform average [m/s]",
        "velocity_deviation": "(uniform - FMU) / v_q",
        "force": "blocking force, FMU fidelity 2 [N]",
        "uniform_force": "blocking force, uniform average [N]",
        "force_deviation": "(uniform - FMU) / largest friction",
    },
    {"velocity_deviation": 2e-3, "force_deviation": 2e-3},
    *(KAPPAS, _device_row),
)
